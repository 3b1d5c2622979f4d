//! Ctrl-C.

use std::process::{Command, Stdio};
use std::time::Duration;

use end_to_end::{Ended, Gradus, Terminal};

use crate::gradus;

/// What Ctrl-C in a terminal sends.
fn interrupt(process: u32) {
    let sent = Command::new("kill")
        .args(["-INT", &process.to_string()])
        .status();
    assert!(sent.expect("`kill`").success());
}

#[test]
fn ctrl_c_ends_a_command_that_waits_for_its_input_with_130() {
    let gradus = gradus();
    let mut child = gradus
        .command(&["check", "-"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the executable");
    let input = child.stdin.take();
    // Long enough for it to have begun waiting.
    std::thread::sleep(Duration::from_millis(300));
    interrupt(child.id());
    let ended = Ended::of(child);
    drop(input);
    assert_eq!((ended.status, ended.answer.as_str()), (Some(130), ""));
}

/// A ladder about which the published method thinks for years: it tries all
/// values of forty variables that two coils share.
fn endless() -> Gradus {
    let gradus = gradus();
    let inputs: Vec<String> = (0..40).map(|number| format!("x{number}")).collect();
    let all = inputs.join(" * ");
    gradus.write(
        "endless.ladder",
        format!("rung: {all} -> a\nrung: {all} -> b\n"),
    );
    gradus
}

const ENDLESS: [&str; 4] = ["suggest", "--method", "cubes", "endless.ladder"];

/// How a command ends that is interrupted when it has worked for a while.
fn interrupted(gradus: &Gradus, arguments: &[&str]) -> Ended {
    let child = gradus
        .command(arguments)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the executable");
    std::thread::sleep(Duration::from_millis(700));
    interrupt(child.id());
    Ended::of(child)
}

#[test]
fn ctrl_c_ends_a_long_computation_with_130_and_no_answer() {
    let gradus = endless();
    let ended = interrupted(&gradus, &ENDLESS);
    assert_eq!((ended.status, ended.answer.as_str()), (Some(130), ""));
    assert_eq!(ended.aside, "", "no progress but on a terminal");
}

#[test]
fn a_terminal_shows_what_takes_long_and_clears_it_in_the_end() {
    let gradus = endless();
    let mut terminal = Terminal::start(gradus.command(&ENDLESS));
    terminal.wait_for("Comparing endless.ladder");
    interrupt(terminal.id());
    let (status, shown) = terminal.end();
    assert_eq!(status, Some(130));
    // The code that erases a line.
    assert!(shown.trim_end().ends_with("\u{1b}[2K"), "{shown:?}");
}

/// A counter of forty bits, which are all on after years only: no proof finds
/// a shorter way.
#[test]
fn ctrl_c_ends_a_proof_with_130_and_no_answer() {
    let gradus = gradus();
    let bits: Vec<String> = (0..40).map(|at| format!("b{at}")).collect();
    let mut ladder = String::from("input go\nrung: go -> c0\n");
    for (at, bit) in bits.iter().enumerate() {
        ladder += &format!("rung: {bit} * c{at} -> c{}\n", at + 1);
        ladder += &format!("rung: {bit} * /c{at} + /{bit} * c{at} -> {bit}\n");
    }
    gradus.write("counter.ladder", ladder);
    let (names, all) = (bits.join(", "), bits.join("*"));
    gradus.write(
        "counter.grafcet",
        format!(
            "Step X0\nTransition t\nInput go, {names}\nMarking X0\nTransitions:\n\
             t: X0*go |- @X0\nNever:\nn: {all}\n"
        ),
    );
    let ended = interrupted(
        &gradus,
        &["verify", "counter.ladder", "--effort", "1000000"],
    );
    assert_eq!((ended.status, ended.answer.as_str()), (Some(130), ""));
}
