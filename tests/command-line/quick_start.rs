//! What the README promises to somebody who has just arrived.

use std::process::{Command, Stdio};

use end_to_end::Ended;

/// The command lines that the README gives for `cargo run`.
fn promised() -> Vec<Vec<String>> {
    let readme = std::fs::read_to_string(end_to_end::path("README.md")).expect("the README");
    readme
        .lines()
        .filter_map(|line| line.trim().strip_prefix("cargo run --release -- "))
        .map(|line| line.split_whitespace().map(str::to_owned).collect())
        .collect()
}

#[test]
fn the_first_command_prints_a_spec_that_nothing_is_wrong_with() {
    let promised = promised();
    let arguments = promised.first().expect("a first command");
    let child = Command::new(env!("CARGO_BIN_EXE_gradus"))
        .args(arguments)
        .current_dir(end_to_end::path(""))
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the executable");
    let ended = Ended::of(child);
    assert_eq!(ended.status, Some(0), "{}", ended.aside);
    assert!(ended.answer.contains("Transitions:\n"), "{}", ended.answer);
    assert!(ended.aside.contains("accepted  -> "), "{}", ended.aside);
    let checked = crate::gradus().run_with(&["check", "-"], &ended.answer);
    assert_eq!(checked.aside, "1 file checked: nothing found\n");
}
