//! `gradus fmt`: the canonical layout of the project's own texts.
//!
//! Layout changes how a text looks, never what it means. The formatters are in
//! the crates that own the notations; here is what happens to files.

use std::io::Write;
use std::path::{Path, PathBuf};

use ladder::Format;
use serde_json::{Value, json};
use source::{Diagnostic, codes};

use crate::diff;
use crate::file::{self, Unreadable};
use crate::input::{self, Candidate, Origin, numbered};
use crate::io::Io;
use crate::report;
use crate::status::Status;
use ide::language;

const DETAILS: &str = "\
A folder stands for the .ladder, .grafcet and .scenario files below it. A file
that would not change is not written; one that changes is replaced in one step
and keeps its permissions. Statements that break the grammar are left as they
are, and the rest is laid out.

Exit status: 1 if a statement was left, or with --check if a file would change;
2 if a file cannot be read or written, or has no canonical layout.

JSON:
  {\"files\": [{\"file\", \"state\", \"left\"}]}
  `state` is unchanged, changed, would_change, no_layout, unreadable or unwritable;
  `left` is the number of statements that were left as they are. With --json,
  standard input is not printed: its state is unchanged or would_change.

Examples:
  gradus fmt plant/             lay out every text below it in place
  gradus fmt --check .          show what would change
  gradus fmt - < tank.ladder    lay out standard input to standard output";

/// Lay out .ladder, .grafcet and .scenario texts canonically.
#[derive(Debug, clap::Args)]
#[command(after_long_help = DETAILS)]
pub struct Args {
    /// Files or folders to lay out in place; `-` is standard input.
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,

    /// Change nothing; show what would change.
    #[arg(long)]
    check: bool,

    /// Answer in JSON.
    #[arg(long)]
    json: bool,
}

/// A text in its canonical layout.
struct LaidOut {
    text: String,
    /// Statements that break the grammar, left as they are.
    left: usize,
}

/// Lays out the text that `bytes` hold, if it is one of those that have a
/// canonical layout.
fn lay_out(bytes: &[u8]) -> Option<LaidOut> {
    match language::of(bytes) {
        language::File::Spec(text) => {
            let formatted = grafcet::format(text);
            let is_left = |found: &&Diagnostic| found.code == codes::SPEC_SYNTAX;
            Some(LaidOut {
                left: formatted.diagnostics.iter().filter(is_left).count(),
                text: formatted.text,
            })
        }
        language::File::Scenario(text) => {
            let scenario::Formatted { text, left } = scenario::format(text);
            Some(LaidOut { text, left })
        }
        language::File::Ladder(_) if ladder::read(bytes).program.format == Format::Ladder => {
            let formatted = ladder::text::format(std::str::from_utf8(bytes).ok()?);
            Some(LaidOut {
                left: formatted.left.len(),
                text: formatted.text,
            })
        }
        language::File::Ladder(_) => None,
    }
}

/// What became of one file.
struct Outcome {
    state: State,
    left: usize,
}

enum State {
    Unchanged,
    Changed,
    WouldChange { old: String, new: String },
    Printed(String),
    NoLayout,
    Unreadable(Unreadable),
    Unwritable(std::io::Error),
}

impl From<State> for Outcome {
    fn from(state: State) -> Self {
        Self { state, left: 0 }
    }
}

/// Lays out every file.
pub fn run(args: &Args, io: &mut Io) -> std::io::Result<Status> {
    let inputs = input::expand(&args.files, &["ladder", "grafcet", "scenario"]);
    let mut status = Status::Done;
    let mut answers = Vec::new();
    for (folder, reason) in inputs.unreadable {
        let outcome = State::Unreadable(reason).into();
        status = status.max(tell(args, &folder, &outcome, io)?);
        answers.push(answer(&folder, &outcome));
    }
    for candidate in inputs.candidates {
        if io.cancel().is_cancelled() {
            return Ok(Status::Interrupted);
        }
        let outcome = treat(args, &candidate, io);
        if candidate.origin == Origin::InFolder && matches!(outcome.state, State::NoLayout) {
            continue;
        }
        status = status.max(tell(args, &candidate.path, &outcome, io)?);
        answers.push(answer(&candidate.path, &outcome));
    }
    if args.json {
        writeln!(io.answer(), "{:#}", json!({ "files": answers }))?;
    }
    Ok(status)
}

/// Lays out one file, and replaces it if that is asked for and needed.
fn treat(args: &Args, candidate: &Candidate, io: &mut Io) -> Outcome {
    let path = &candidate.path;
    let bytes = match io.read(path) {
        Ok(bytes) => bytes,
        Err(reason) => return State::Unreadable(reason).into(),
    };
    let Some(LaidOut { text: new, left }) = lay_out(&bytes) else {
        return State::NoLayout.into();
    };
    let is_printed = candidate.is_standard_input() && !args.check && !args.json;
    let state = if is_printed {
        State::Printed(new)
    } else if bytes == new.as_bytes() {
        State::Unchanged
    } else if args.check || candidate.is_standard_input() {
        let old = String::from_utf8_lossy(&bytes).into_owned();
        State::WouldChange { old, new }
    } else {
        match file::replace(path, new.as_bytes()) {
            Ok(()) => State::Changed,
            Err(error) => State::Unwritable(error),
        }
    };
    Outcome { state, left }
}

/// Says what became of a file, and how that counts.
fn tell(args: &Args, path: &Path, outcome: &Outcome, io: &mut Io) -> std::io::Result<Status> {
    let name = report::printable(&input::name(path));
    let mut status = Status::Done;
    match &outcome.state {
        State::Unchanged => {}
        State::Changed => io.aside(&format!("{name}: laid out\n"))?,
        State::WouldChange { old, new } => {
            status = Status::ProblemsFound;
            if !args.json {
                let diff = diff::unified(&name, old, new, io.answer_paint());
                io.answer().write_all(diff.as_bytes())?;
            }
        }
        State::Printed(text) => io.answer().write_all(text.as_bytes())?,
        State::NoLayout => {
            status = Status::Usage;
            let why = "only .ladder, .grafcet and .scenario texts have a canonical layout";
            io.complain(&format!("{name}: {why}"));
        }
        State::Unreadable(reason) => {
            status = Status::Usage;
            let paint = io.aside_paint();
            io.aside(&report::unreadable(path, &reason.diagnostic(), paint))?;
        }
        State::Unwritable(error) => {
            status = Status::Usage;
            io.complain(&format!("{name}: cannot be written: {error}"));
        }
    }
    if outcome.left > 0 {
        status = status.max(Status::ProblemsFound);
        let left = numbered(outcome.left, "statement");
        io.aside(&format!(
            "{name}: {left} left as written; `gradus check` says why\n"
        ))?;
    }
    Ok(status)
}

fn answer(path: &Path, outcome: &Outcome) -> Value {
    let state = match outcome.state {
        State::Unchanged | State::Printed(_) => "unchanged",
        State::Changed => "changed",
        State::WouldChange { .. } => "would_change",
        State::NoLayout => "no_layout",
        State::Unreadable(_) => "unreadable",
        State::Unwritable(_) => "unwritable",
    };
    json!({ "file": input::name(path), "state": state, "left": outcome.left })
}
