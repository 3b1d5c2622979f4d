//! The interpreter against a C compiler.
//!
//! Random programs are printed twice: as rung notation, which is read and run
//! by the machine, and as C, which a compiler turns into another interpreter.
//! Both get the same random inputs and times, and every variable must be equal
//! after every scan. The C says what a scan means in the simplest way there
//! is, statement by statement; it was written from what controllers do, not
//! from the machine.

mod c;
mod program;
mod random;
mod text;

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use ladder::scan::Machine;

use program::Program;
use random::Random;

const PROGRAMS: u64 = 300;
const SCANS: usize = 60;

/// One scan's inputs and the time since the last.
struct Latched {
    elapsed_ms: u64,
    inputs: Vec<bool>,
}

fn latched(random: &mut Random) -> Vec<Latched> {
    let mut inputs = vec![false; program::INPUTS.len()];
    let scan = |_| {
        for input in &mut inputs {
            // Inputs that change in every scan let no timer run out.
            *input ^= random.below(4) == 0;
        }
        Latched {
            elapsed_ms: [0, 10, 10, 20, 50][random.below(5)],
            inputs: inputs.clone(),
        }
    };
    (0..SCANS).map(scan).collect()
}

/// Every variable after every scan, as the machine has it.
fn run(program: &Program, scans: &[Latched]) -> Vec<String> {
    let text = text::text(program);
    let reading = ladder::read(text.as_bytes());
    let mut findings = reading.diagnostics.iter();
    assert!(
        findings.next().is_none(),
        "{:?}\n{text}",
        reading.diagnostics
    );
    let mut machine = Machine::new(&reading.program);
    let shown = program.shown();
    let scan = |latched: &Latched| {
        for (name, value) in program::INPUTS.iter().zip(&latched.inputs) {
            machine.set_input(name, *value);
        }
        machine.scan(latched.elapsed_ms);
        assert!(!machine.overran(), "{text}");
        let values = shown
            .iter()
            .map(|name| machine.value(name).integer().to_string());
        values.collect::<Vec<_>>().join(" ")
    };
    scans.iter().map(scan).collect()
}

/// The C compiler, if there is one; where CI promises one, there must be.
fn compiler() -> Option<&'static str> {
    let runs = |name: &&str| {
        let status = Command::new(name)
            .arg("--version")
            .stdout(Stdio::null())
            .status();
        status.is_ok_and(|status| status.success())
    };
    let found = ["gcc", "cc"].into_iter().find(|name| runs(name));
    let is_promised = std::env::var_os("CI").is_some_and(|ci| ci == "true");
    assert!(
        found.is_some() || !is_promised,
        "no C compiler, and CI=true"
    );
    found
}

fn compiled(compiler: &str, source: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let file = folder.join("ladders.c");
    let executable = folder.join("ladders");
    std::fs::write(&file, source).expect("a source file");
    let built = Command::new(compiler)
        .args(["-std=c99", "-Wall", "-Wextra", "-Werror", "-o"])
        .arg(&executable)
        .arg(&file)
        .output()
        .expect("a compiler");
    let said = String::from_utf8_lossy(&built.stderr);
    assert!(built.status.success(), "{said}");
    executable
}

/// What the executable prints when it reads `input`.
fn answer(executable: &Path, input: String) -> String {
    let mut child = Command::new(executable)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("an executable");
    let mut stdin = child.stdin.take().expect("its standard input");
    // It may answer more than a pipe holds before it has read everything.
    let writer = std::thread::spawn(move || stdin.write_all(input.as_bytes()));
    let output = child.wait_with_output().expect("its answer");
    writer.join().expect("a thread").expect("a reader");
    assert!(output.status.success());
    String::from_utf8(output.stdout).expect("text")
}

#[test]
fn random_programs_do_what_a_c_compiler_makes_of_them() {
    let Some(compiler) = compiler() else {
        println!("skipped: no C compiler");
        return;
    };
    let mut random = Random::new(7);
    let programs: Vec<Program> = (0..PROGRAMS)
        .map(|_| Program::random(&mut random))
        .collect();
    let executable = compiled(compiler, &c::source(&programs));
    let mut input = String::new();
    let mut runs = Vec::new();
    for (at, program) in programs.iter().enumerate() {
        let scans = latched(&mut random);
        for scan in &scans {
            input += &format!("{at} {}", scan.elapsed_ms);
            for value in &scan.inputs {
                input += if *value { " 1" } else { " 0" };
            }
            input.push('\n');
        }
        runs.push((program, run(program, &scans)));
    }
    let answer = answer(&executable, input);
    let mut lines = answer.lines();
    for (program, scans) in &runs {
        for (scan, own) in scans.iter().enumerate() {
            let other = lines.next().unwrap_or_default();
            assert_eq!(
                own,
                other,
                "scan {scan} of\n{}\n{}",
                text::text(program),
                program.shown().join(" ")
            );
        }
    }
    assert_eq!(lines.next(), None);
    assert_everything_happened(&runs);
}

/// A judge who only ever sees zeros judges nothing: of the variables that a
/// program writes, many must have changed at some time.
fn assert_everything_happened(runs: &[(&Program, Vec<String>)]) {
    let (mut changed, mut all) = (0, 0);
    for (program, scans) in runs {
        let text = text::text(program);
        let (_, rungs) = text.split_once("rung").expect("rungs");
        let columns: Vec<Vec<&str>> = scans.iter().map(|it| it.split(' ').collect()).collect();
        for (at, name) in program.shown().iter().enumerate() {
            let driven = rungs.lines().filter_map(|rung| rung.split_once("->"));
            if driven
                .clone()
                .any(|(_, outputs)| outputs.contains(name.trim_end_matches(".Q")))
            {
                all += 1;
                changed += usize::from(columns.iter().any(|row| row[at] != columns[0][at]));
            }
        }
    }
    println!("{changed} of {all} written variables change");
    assert!(
        5 * changed > 2 * all,
        "{changed} of {all} variables ever change"
    );
}
