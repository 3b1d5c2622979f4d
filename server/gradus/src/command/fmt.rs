//! `gradus fmt`: the canonical layout of the project's own texts.
//!
//! Layout changes how a text looks, never what it means. A text with errors is
//! left alone: what was not understood cannot be laid out. Byte order mark and
//! line ends stay as they are.

use std::io::Write;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};
use source::{Diagnostic, Severity};

use crate::file::{self, Unreadable};
use crate::input::{self, Candidate, Origin, numbered};
use crate::io::Io;
use crate::report::{self, Findings};
use crate::status::Status;

mod diff;
mod layout;

use layout::LaidOut;

const DETAILS: &str = "\
A folder stands for the .ladder and .grafcet files below it. A file that would
not change is not written; one that changes is replaced in one step and keeps
its permissions. A text with errors is left alone.

Exit status: 1 if a text has errors, or with --check if a file would change;
2 if a file cannot be read or written, or has no canonical layout.

JSON:
  {\"files\": [{\"file\", \"state\"}]}
  `state` is unchanged, changed, would_change, faulty, no_layout, unreadable or
  unwritable.

Examples:
  gradus fmt plant/             lay out every .ladder and .grafcet text in place
  gradus fmt --check .          show what would change
  gradus fmt - < tank.ladder    lay out standard input to standard output";

/// Lay out .ladder and .grafcet texts canonically.
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

/// What became of one file.
enum Outcome {
    Unchanged,
    Changed,
    WouldChange { old: String, new: String },
    Printed(String),
    Faulty(Findings),
    NoLayout,
    Unreadable(Unreadable),
    Unwritable(std::io::Error),
}

/// Lays out every file.
pub fn run(args: &Args, io: &mut Io) -> std::io::Result<Status> {
    let inputs = input::expand(&args.files, &["ladder", "grafcet"]);
    let mut status = Status::Done;
    let mut states = Vec::new();
    let unreadable = inputs.unreadable.into_iter();
    for (folder, reason) in unreadable {
        let outcome = Outcome::Unreadable(reason);
        status = status.max(tell(args, &folder, &outcome, io)?);
        states.push(state(&folder, &outcome));
    }
    for candidate in inputs.candidates {
        if io.cancel().is_cancelled() {
            return Ok(Status::Interrupted);
        }
        let outcome = lay_out(args, &candidate, io);
        if candidate.origin == Origin::InFolder && matches!(outcome, Outcome::NoLayout) {
            continue;
        }
        status = status.max(tell(args, &candidate.path, &outcome, io)?);
        states.push(state(&candidate.path, &outcome));
    }
    if args.json {
        writeln!(io.answer(), "{:#}", json!({ "files": states }))?;
    }
    Ok(status)
}

/// Lays out one file, and replaces it if that is asked for and needed.
fn lay_out(args: &Args, candidate: &Candidate, io: &mut Io) -> Outcome {
    let path = &candidate.path;
    let bytes = match io.read(path) {
        Ok(bytes) => bytes,
        Err(reason) => return Outcome::Unreadable(reason),
    };
    let Some(LaidOut {
        old,
        new,
        diagnostics,
    }) = layout::of(&bytes)
    else {
        return Outcome::NoLayout;
    };
    if diagnostics.iter().any(is_error) {
        return Outcome::Faulty(Findings::new(path.clone(), bytes, diagnostics));
    }
    if candidate.is_standard_input() && !args.check && !args.json {
        Outcome::Printed(new)
    } else if old == new {
        Outcome::Unchanged
    } else if args.check || candidate.is_standard_input() {
        Outcome::WouldChange { old, new }
    } else {
        match file::replace(path, new.as_bytes()) {
            Ok(()) => Outcome::Changed,
            Err(error) => Outcome::Unwritable(error),
        }
    }
}

fn is_error(diagnostic: &Diagnostic) -> bool {
    diagnostic.severity == Severity::Error
}

/// Says what became of a file, and how that counts.
fn tell(args: &Args, path: &Path, outcome: &Outcome, io: &mut Io) -> std::io::Result<Status> {
    let name = report::printable(&input::name(path));
    let paint = io.aside_paint();
    match outcome {
        Outcome::Unchanged => Ok(Status::Done),
        Outcome::Changed => {
            io.aside(&format!("{name}: laid out\n"))?;
            Ok(Status::Done)
        }
        Outcome::WouldChange { old, new } => {
            if !args.json {
                let diff = diff::unified(&name, old, new, io.answer_paint());
                io.answer().write_all(diff.as_bytes())?;
            }
            Ok(Status::ProblemsFound)
        }
        Outcome::Printed(text) => {
            io.answer().write_all(text.as_bytes())?;
            Ok(Status::Done)
        }
        Outcome::Faulty(findings) => {
            let errors = numbered(findings.count(Severity::Error), "error");
            io.aside(&report::text(findings, paint))?;
            io.aside(&format!("{name}: left alone, {errors}\n"))?;
            Ok(Status::ProblemsFound)
        }
        Outcome::NoLayout => {
            io.complain(&format!(
                "{name}: only .ladder and .grafcet texts have a canonical layout"
            ));
            Ok(Status::Usage)
        }
        Outcome::Unreadable(reason) => {
            io.aside(&report::unreadable(path, &reason.diagnostic(), paint))?;
            Ok(Status::Usage)
        }
        Outcome::Unwritable(error) => {
            io.complain(&format!("{name}: cannot be written: {error}"));
            Ok(Status::Usage)
        }
    }
}

fn state(path: &Path, outcome: &Outcome) -> Value {
    let state = match outcome {
        Outcome::Unchanged | Outcome::Printed(_) => "unchanged",
        Outcome::Changed => "changed",
        Outcome::WouldChange { .. } => "would_change",
        Outcome::Faulty(_) => "faulty",
        Outcome::NoLayout => "no_layout",
        Outcome::Unreadable(_) => "unreadable",
        Outcome::Unwritable(_) => "unwritable",
    };
    json!({ "file": input::name(path), "state": state })
}
