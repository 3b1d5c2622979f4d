//! Files that are cut, encoded otherwise, nested too deep, or made to harm.
//!
//! Beside every file in `fixtures/hostile` stands what the commands say about
//! it, under the same name with `.expected` at its end. `UPDATE=1` writes these
//! anew, to be read before they are kept.

use std::path::{Path, PathBuf};

use end_to_end::{Ended, path, update_is_asked_for};

use crate::gradus;

/// What is run on each file: what is wrong with it, and what could be read.
const COMMANDS: [&[&str]; 2] = [&["check"], &["conditions"]];

/// The other commands that read, asked only to end well.
const OTHERS: [&[&str]; 3] = [
    &["suggest"],
    &["convert", "--accept", "all", "-o", "-"],
    &["fmt", "--check"],
];

#[test]
fn every_hostile_file_gets_the_answer_beside_it() {
    let files = hostile_files();
    assert!(files.len() >= 40, "only {} files", files.len());
    let mut wrong = Vec::new();
    for file in files {
        let found = answers(&file);
        let beside = PathBuf::from(format!("{}.expected", file.display()));
        if update_is_asked_for() {
            std::fs::write(&beside, &found).expect("a file that can be written");
        }
        let expected = std::fs::read_to_string(&beside).unwrap_or_default();
        if found != expected {
            wrong.push(format!("{}\n{found}", file.display()));
        }
    }
    assert!(wrong.is_empty(), "UPDATE=1 writes:\n{}", wrong.join("\n"));
}

#[test]
fn no_hostile_file_makes_a_command_end_in_another_way_than_documented() {
    for file in hostile_files() {
        let gradus = gradus();
        let name = lend(&gradus, &file);
        for command in OTHERS {
            let arguments = [command, &[&name]].concat();
            ends_well(&gradus.run(&arguments), &arguments);
        }
    }
}

fn hostile_files() -> Vec<PathBuf> {
    let entries = std::fs::read_dir(path("fixtures/hostile")).expect("the fixtures");
    let mut files: Vec<PathBuf> = entries
        .map(|entry| entry.expect("an entry of the folder").path())
        .filter(|file| file.extension().is_none_or(|end| end != "expected"))
        .collect();
    files.sort();
    files
}

/// Puts a copy of `file` where `gradus` runs, and gives its name there.
fn lend(gradus: &end_to_end::Gradus, file: &Path) -> String {
    let name = file.file_name().expect("a name").to_string_lossy();
    gradus.write(&name, std::fs::read(file).expect("a fixture"));
    name.into_owned()
}

fn answers(file: &Path) -> String {
    let gradus = gradus();
    let name = lend(&gradus, file);
    let mut said = String::new();
    for command in COMMANDS {
        let arguments = [command, &[&name]].concat();
        let ended = gradus.run(&arguments);
        ends_well(&ended, &arguments);
        let status = ended.status.unwrap_or_default();
        said.push_str(&format!("$ gradus {}\n", arguments.join(" ")));
        said.push_str(&ended.answer);
        let aside = ended.aside.lines().map(|line| format!("! {line}\n"));
        said.extend(aside);
        said.push_str(&format!("[exit {status}]\n\n"));
    }
    said
}

/// Whether the status is one of the documented ones and nothing panicked.
#[track_caller]
fn ends_well(ended: &Ended, arguments: &[&str]) {
    assert!(
        matches!(ended.status, Some(0..=2)) && !ended.aside.contains("panicked"),
        "{arguments:?} ended with {:?}: {}",
        ended.status,
        ended.aside
    );
}
