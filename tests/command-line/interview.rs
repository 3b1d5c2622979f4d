//! `convert --interactive`, with somebody at a terminal.

use std::process::Command;

use end_to_end::{Gradus, Terminal};

use crate::gradus;

const PROMPT: &str = "[?] > ";

/// A folder with the neutralization ladder.
fn tank() -> Gradus {
    let gradus = gradus();
    let ladder = end_to_end::path("fixtures/neutralization/neutralization.ladder");
    gradus.write("tank.ladder", std::fs::read(ladder).expect("a fixture"));
    gradus
}

/// Without a search for sequences, so that suggestions come as conditions rank
/// them.
fn start(gradus: &Gradus) -> Terminal {
    let args = ["convert", "tank.ladder", "--interactive", "--effort", "0"];
    Terminal::start(gradus.command(&args))
}

fn decisions(gradus: &Gradus) -> Vec<String> {
    let spec = gradus.read("tank.grafcet");
    let lines = spec.lines().filter_map(|line| line.strip_prefix("//! "));
    lines.map(str::to_owned).collect()
}

#[track_caller]
fn send(signal: &str, terminal: &Terminal) {
    let id = terminal.id().to_string();
    let sent = Command::new("kill").args([signal, &id]).status();
    assert!(sent.expect("`kill`").success());
}

#[test]
fn a_question_shows_the_condition_and_the_evidence() {
    let gradus = tank();
    let mut terminal = start(&gradus);
    let shown = terminal.wait_for(PROMPT).replace("\r\n", "\n");
    let (introduction, question) = shown.split_once("\n\n").expect("two paragraphs");
    assert!(
        introduction.starts_with("\nv1  Open valve v1\n  ends when ls2\n  4 suggestions, of "),
        "{introduction}"
    );
    let expected = "  v1 -> v2  Open valve v2
  handover: what ends the one is what starts the other, together with h, m
  when ls2*/ls3*/as
";
    assert!(question.starts_with(expected), "{question}");
    terminal.type_line("q");
    assert_eq!(terminal.end().0, Some(0));
    assert_eq!(decisions(&gradus), [""; 0]);
}

#[test]
fn a_question_shows_the_sequence_in_which_it_was_seen() {
    let gradus = tank();
    let mut terminal =
        Terminal::start(gradus.command(&["convert", "tank.ladder", "--interactive"]));
    let shown = terminal.wait_for(PROMPT).replace("\r\n", "\n");
    assert!(shown.contains("5 suggestions, of 30 open"), "{shown}");
    let expected = "  when ls2*/ls3*/as\n  seen after on s; on ls2\n";
    assert!(shown.contains(expected), "{shown}");
    terminal.type_line("q");
    assert_eq!(terminal.end().0, Some(0));
}

#[test]
fn every_kind_of_answer_becomes_a_decision() {
    let gradus = tank();
    let mut terminal = start(&gradus);
    for (question, answers) in [
        ("v1 -> v2 ", &["together", ""][..]),
        ("v1 -> v4 ", &["l"]),
        ("v2 -> v3 ", &["?", "what", "a"]),
        ("v2 -> v4 ", &["i", "R"]),
        ("v2 -> h ", &["t", "nothing, m", "m"]),
        ("v4 -> v1 ", &["n"]),
        ("h -> v3 ", &["q"]),
    ] {
        terminal.wait_for(&format!("  {question}"));
        for answer in answers {
            terminal.wait_for(" > ");
            terminal.type_line(answer);
        }
    }
    let (status, shown) = terminal.end();
    assert_eq!(status, Some(0), "{shown}");
    assert!(shown.contains("accepted  -> v2 & h & m  (new)"), "{shown}");
    assert!(shown.contains("written"), "{shown}");
    assert_eq!(
        decisions(&gradus),
        [
            "accept v1 -> v2 & h & m",
            "accept v2 -> v3",
            "initial v2",
            "reject v2 -> v4",
            "accept v2 -> h & m",
        ]
    );
}

#[test]
fn an_answer_outlives_the_death_of_the_process_and_is_not_asked_for_again() {
    let gradus = tank();
    let mut terminal = start(&gradus);
    terminal.wait_for(PROMPT);
    terminal.type_line("r");
    terminal.wait_for("saved");
    send("-KILL", &terminal);
    assert_eq!(terminal.end().0, None);
    assert_eq!(decisions(&gradus), ["reject v1 -> v2"]);

    let mut terminal = start(&gradus);
    let question = terminal.wait_for(PROMPT);
    assert!(question.contains("v1 -> v4"), "{question}");
    assert!(!question.contains("v1 -> v2"), "{question}");
    terminal.type_line("q");
    assert_eq!(terminal.end().0, Some(0));
    assert_eq!(decisions(&gradus), ["reject v1 -> v2"]);
}

#[test]
fn ctrl_c_ends_it_with_130_and_keeps_the_answers() {
    let gradus = tank();
    let mut terminal = start(&gradus);
    terminal.wait_for(PROMPT);
    terminal.type_line("a");
    terminal.wait_for(PROMPT);
    send("-INT", &terminal);
    assert_eq!(terminal.end().0, Some(130));
    assert_eq!(decisions(&gradus), ["accept v1 -> v2"]);
}

#[test]
fn the_end_of_input_ends_it_as_quit_does() {
    let gradus = tank();
    let mut terminal = start(&gradus);
    terminal.wait_for(PROMPT);
    // Ctrl-D on an empty line.
    terminal.type_line("l");
    terminal.wait_for(PROMPT);
    terminal.press_end_of_input();
    let (status, shown) = terminal.end();
    assert_eq!(status, Some(0), "{shown}");
}

#[test]
fn what_somebody_else_writes_meanwhile_is_not_overwritten() {
    let gradus = tank();
    let mut terminal = start(&gradus);
    terminal.wait_for(PROMPT);
    let theirs = gradus.read("tank.grafcet") + "\nNever:\nn1: v1*v3\n";
    gradus.write("tank.grafcet", &theirs);
    terminal.type_line("a");
    let (status, shown) = terminal.end();
    assert_eq!(status, Some(2), "{shown}");
    assert!(
        shown.contains("somebody else has just changed it"),
        "{shown}"
    );
    assert_eq!(gradus.read("tank.grafcet"), theirs);
}

#[test]
fn when_nothing_is_open_nothing_is_asked() {
    let gradus = tank();
    gradus.run(&["convert", "tank.ladder", "--accept", "all"]);
    let before = gradus.read("tank.grafcet");
    let (status, shown) = start(&gradus).end();
    assert_eq!(status, Some(0), "{shown}");
    assert!(!shown.contains(PROMPT), "{shown}");
    assert_eq!(gradus.read("tank.grafcet"), before);
}
