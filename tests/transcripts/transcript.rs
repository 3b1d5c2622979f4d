//! A document with commands in it, run again.
//!
//! Two kinds of fenced blocks mean something; all else is for the reader.
//!
//! A block whose info string names a file, as in ```` ```ladder file=tank.ladder ````,
//! is written under that name into the folder where the commands run.
//!
//! A `console` block is a sequence of commands, each a line that begins with
//! `$ `, followed by what it answers: standard output as it is, then standard
//! error with `! ` before each line, then the exit status, if it is not 0, as
//! `[exit 1]`. An answer that does not end its last line is followed by
//! `[no line end]`. A command is a line of shell, so it may be a pipe, or a
//! `cat` that shows a file that another command wrote.
//!
//! The folder is new for every document and shared by its blocks, and holds the
//! repository's `fixtures`.

use std::fmt::Write;

use end_to_end::{Ended, Gradus};

const CONSOLE: &str = "console";
const PROMPT: &str = "$ ";

/// Whether the document has a `console` block.
pub fn is_one(document: &str) -> bool {
    parts(document).iter().any(|part| part.info == CONSOLE)
}

/// The document with what its commands answer now.
pub fn replay(document: &str, executable: &str) -> String {
    let gradus = Gradus::new(executable);
    lend_fixtures(&gradus);
    let mut out = String::new();
    for part in parts(document) {
        if let Some((_, name)) = part.info.split_once(" file=") {
            gradus.write(name, &part.body);
        }
        out.push_str(part.opening);
        if part.info == CONSOLE {
            out.push_str(&rerun(&part.body, &gradus));
        } else {
            out.push_str(&part.body);
        }
        out.push_str(part.closing);
    }
    out
}

/// A line of prose, or a fenced block.
struct Part<'d> {
    /// The line, or the one that opens the block.
    opening: &'d str,
    /// What stands after the opening backticks.
    info: &'d str,
    body: String,
    closing: &'d str,
}

fn parts(document: &str) -> Vec<Part<'_>> {
    let mut parts = Vec::new();
    let mut lines = document.split_inclusive('\n');
    while let Some(opening) = lines.next() {
        let mut part = Part {
            opening,
            info: "",
            body: String::new(),
            closing: "",
        };
        if let Some((ticks, info)) = fence(opening) {
            part.info = info;
            for line in lines.by_ref() {
                if fence(line).is_some_and(|(more, info)| more >= ticks && info.is_empty()) {
                    part.closing = line;
                    break;
                }
                part.body.push_str(line);
            }
        }
        parts.push(part);
    }
    parts
}

/// The number of backticks that a line begins with, if it opens or closes a
/// block, and what stands after them.
fn fence(line: &str) -> Option<(usize, &str)> {
    let line = line.trim_end();
    let info = line.trim_start_matches('`');
    let ticks = line.len() - info.len();
    (ticks >= 3 && !info.contains('`')).then_some((ticks, info))
}

/// Fixtures are read where they lie.
fn lend_fixtures(gradus: &Gradus) {
    let fixtures = end_to_end::path("fixtures");
    std::os::unix::fs::symlink(fixtures, gradus.folder().join("fixtures")).expect("a link");
}

fn rerun(body: &str, gradus: &Gradus) -> String {
    let commands = body.lines().filter_map(|line| line.strip_prefix(PROMPT));
    commands
        .map(|command| format!("{PROMPT}{command}\n{}", show(&gradus.shell(command))))
        .collect()
}

/// What a command answered, as a transcript shows it.
fn show(ended: &Ended) -> String {
    let mut shown = ended.answer.clone();
    if !shown.is_empty() && !shown.ends_with('\n') {
        shown.push_str("\n[no line end]\n");
    }
    for line in ended.aside.lines() {
        shown.push_str(format!("! {line}").trim_end());
        shown.push('\n');
    }
    match ended.status {
        Some(0) => {}
        // Writing into a string cannot fail.
        Some(status) => drop(writeln!(shown, "[exit {status}]")),
        None => shown.push_str("[ended by a signal]\n"),
    }
    shown
}
