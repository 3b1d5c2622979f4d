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

const PROMPT: &str = "$ ";

/// Whether the document has a `console` block with a command in it.
pub fn is_one(document: &str) -> bool {
    document.contains("```console\n$ ")
}

/// The document with what its commands answer now.
pub fn replay(document: &str, executable: &str) -> String {
    let gradus = Gradus::new(executable);
    lend_fixtures(&gradus);
    let mut out = String::new();
    let mut lines = document.split_inclusive('\n');
    while let Some(line) = lines.next() {
        out.push_str(line);
        let Some(fence) = Fence::opening(line) else {
            continue;
        };
        let mut body = String::new();
        let mut closing = "";
        for line in lines.by_ref() {
            if fence.is_closed_by(line) {
                closing = line;
                break;
            }
            body.push_str(line);
        }
        if let Some(name) = fence.file() {
            gradus.write(name, &body);
        }
        if fence.info == "console" {
            body = rerun(&body, &gradus);
        }
        out.push_str(&body);
        out.push_str(closing);
    }
    out
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

/// The line that opens a fenced block.
struct Fence<'d> {
    ticks: usize,
    info: &'d str,
}

impl<'d> Fence<'d> {
    fn opening(line: &'d str) -> Option<Self> {
        let line = line.trim_end();
        let info = line.trim_start_matches('`');
        let ticks = line.len() - info.len();
        (ticks >= 3 && !info.contains('`')).then_some(Self { ticks, info })
    }

    fn is_closed_by(&self, line: &str) -> bool {
        Fence::opening(line).is_some_and(|end| end.info.is_empty() && end.ticks >= self.ticks)
    }

    fn file(&self) -> Option<&'d str> {
        let (_, name) = self.info.split_once(" file=")?;
        Some(name)
    }
}
