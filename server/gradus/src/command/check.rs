//! `gradus check`: what is wrong or odd in ladders and specs.

use std::io::Write;
use std::path::PathBuf;

use clap::ValueEnum;
use ladder::Reading;
use logic::{Budget, Cancel};
use source::{Diagnostic, Severity, codes};

use crate::colour::Paint;
use crate::file::Unreadable;
use crate::input::{self, Candidate, Inputs, Origin, numbered};
use crate::io::Io;
use crate::language;
use crate::progress::Progress;
use crate::report::{self, Findings};
use crate::status::Status;

const DETAILS: &str = "\
A folder stands for the files below it that end in .ladder, .l5x, .l5k, .xml,
.txt or .grafcet; those of the endings .xml and .txt that hold no ladder are passed over.

Exit status: 1 if there is a finding of severity error, 2 if a file cannot be read;
the other files are checked all the same.

JSON:
  {\"diagnostics\": [{\"file\", \"code\", \"severity\", \"message\", \"help\",
    \"span\": {\"start\", \"end\"}, \"line\", \"column\",
    \"related\": [{\"message\", \"span\", \"line\", \"column\"}],
    \"fix\": {\"title\", \"edits\": [{\"span\", \"text\"}]}}]}
  A span counts bytes of the file from 0; line and column count from 1, a column
  being a character. `severity` is error, warning, information or hint. `help`
  and `fix` are null where there is none.

SARIF is version 2.1.0, with a rule for every code.

Examples:
  gradus check line3.L5X                       one program
  gradus check --severity warning plant/       a whole plant, without remarks and hints
  gradus check --format sarif . > gradus.sarif for a code-review tool
  gradus check - < pasted.txt                  what somebody pasted";

/// Report what is wrong or odd in ladders and specs.
#[derive(Debug, clap::Args)]
#[command(after_long_help = DETAILS)]
pub struct Args {
    /// Files or folders to check; `-` is standard input.
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,

    /// Leave out findings that matter less than this.
    #[arg(long, value_name = "LEAST", default_value = "hint")]
    severity: Least,

    /// The form of the answer.
    #[arg(long, default_value = "text")]
    format: Form,

    /// The same as `--format json`.
    #[arg(long, conflicts_with = "format")]
    json: bool,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Form {
    /// For people: each finding with its line.
    Text,
    /// For scripts: one JSON document.
    Json,
    /// For code-review tools: SARIF 2.1.0.
    Sarif,
}

/// A severity, as the command line spells it.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum Least {
    Error,
    Warning,
    Information,
    Hint,
}

impl From<Least> for Severity {
    fn from(least: Least) -> Self {
        match least {
            Least::Error => Self::Error,
            Least::Warning => Self::Warning,
            Least::Information => Self::Information,
            Least::Hint => Self::Hint,
        }
    }
}

/// What came of all files.
#[derive(Default)]
struct Checked {
    /// Files with findings. Of the others only the number is kept.
    findings: Vec<Findings>,
    files: usize,
    passed_over: usize,
    unreadable: Vec<(PathBuf, Unreadable)>,
}

/// Checks every file, then answers.
pub fn run(args: &Args, io: &mut Io) -> std::io::Result<Status> {
    let inputs = input::expand(&args.files, input::ENDINGS);
    let Some(checked) = check(inputs, args.severity.into(), io) else {
        return Ok(Status::Interrupted);
    };
    let form = if args.json { Form::Json } else { args.format };
    match form {
        Form::Text => {
            let paint = io.answer_paint();
            for findings in &checked.findings {
                let text = report::text(findings, paint);
                io.answer().write_all(text.as_bytes())?;
            }
        }
        Form::Json => writeln!(io.answer(), "{:#}", report::json(&checked.findings))?,
        Form::Sarif => {
            let root = std::env::current_dir().unwrap_or_default();
            let sarif = report::sarif(&checked.findings, &checked.unreadable, &root);
            writeln!(io.answer(), "{sarif:#}")?;
        }
    }
    io.aside(&aside(&checked, io.aside_paint()))?;
    Ok(status(&checked))
}

/// Checks every file; `None` if somebody pressed Ctrl-C.
fn check(inputs: Inputs, least: Severity, io: &mut Io) -> Option<Checked> {
    let waits_for_input = inputs.candidates.iter().any(Candidate::is_standard_input);
    // A line that moves would get in the way of somebody who types a program.
    let progress = (!waits_for_input).then(|| Progress::begin("Checking", inputs.candidates.len()));
    let mut checked = Checked {
        unreadable: inputs.unreadable,
        ..Checked::default()
    };
    for (part, candidate) in inputs.candidates.into_iter().enumerate() {
        if let Some(progress) = &progress {
            progress.at(part, &report::printable(&input::name(&candidate.path)));
        }
        match io.read(&candidate.path) {
            Ok(text) => {
                let diagnostics = examine(&text, io.cancel());
                if is_of_no_interest(&candidate, &diagnostics) {
                    checked.passed_over += 1;
                } else {
                    checked.files += 1;
                    checked.keep(candidate, text, diagnostics, least);
                }
            }
            Err(reason) => checked.unreadable.push((candidate.path, reason)),
        }
        if io.cancel().is_cancelled() {
            return None;
        }
    }
    Some(checked)
}

impl Checked {
    /// Keeps a file if there is something to say about it.
    fn keep(
        &mut self,
        file: Candidate,
        text: Vec<u8>,
        mut found: Vec<Diagnostic>,
        least: Severity,
    ) {
        found.retain(|diagnostic| diagnostic.severity <= least);
        if !found.is_empty() {
            self.findings.push(Findings::new(file.path, text, found));
        }
    }
}

/// Whether a file from a folder is none that Gradus reads, and does not pretend
/// to be one.
fn is_of_no_interest(candidate: &Candidate, found: &[Diagnostic]) -> bool {
    let is_other =
        |found: &Diagnostic| [codes::NOT_A_PROGRAM, codes::ENCODING].contains(&found.code);
    candidate.origin == Origin::InFolder
        && input::may_be_anything(&candidate.path)
        && found.iter().any(is_other)
}

/// What there is to say about a file that holds `text`.
fn examine(text: &[u8], cancel: &Cancel) -> Vec<Diagnostic> {
    match language::of(text) {
        language::File::Ladder(bytes) => about_ladder(bytes, cancel),
        language::File::Spec(text) => grafcet::read(text).diagnostics,
    }
}

/// What the text of a ladder reveals, and what its conditions do.
fn about_ladder(bytes: &[u8], cancel: &Cancel) -> Vec<Diagnostic> {
    let budget = Budget {
        cancel: cancel.clone(),
        ..Budget::default()
    };
    let Reading {
        program,
        mut diagnostics,
    } = ladder::read(bytes);
    let conditions = recovery::conditions::conditions(&program, &budget);
    let found = recovery::findings::findings(&program, &conditions, &budget);
    diagnostics.extend(found);
    diagnostics.sort_by_key(|diagnostic| (diagnostic.span, diagnostic.code));
    diagnostics
}

fn status(checked: &Checked) -> Status {
    if !checked.unreadable.is_empty() {
        Status::Usage
    } else if count(checked, Severity::Error) > 0 {
        Status::ProblemsFound
    } else {
        Status::Done
    }
}

/// What is said beside the answer: files that could not be read, and the sum.
fn aside(checked: &Checked, paint: Paint) -> String {
    let mut text = String::new();
    for (path, reason) in &checked.unreadable {
        text += &report::unreadable(path, &reason.diagnostic(), paint);
    }
    let found: Vec<_> = [
        (Severity::Error, "error"),
        (Severity::Warning, "warning"),
        (Severity::Information, "remark"),
        (Severity::Hint, "hint"),
    ]
    .into_iter()
    .map(|(severity, noun)| (count(checked, severity), noun))
    .filter(|(number, _)| *number > 0)
    .map(|(number, noun)| numbered(number, noun))
    .collect();
    let found = if found.is_empty() {
        "nothing found".to_owned()
    } else {
        found.join(", ")
    };
    text += &format!("{} checked: {found}", numbered(checked.files, "file"));
    if checked.passed_over > 0 {
        let passed_over = numbered(checked.passed_over, "other file");
        text += &format!("; {passed_over} passed over");
    }
    if !checked.unreadable.is_empty() {
        text += &format!("; {} not readable", checked.unreadable.len());
    }
    text + "\n"
}

fn count(checked: &Checked, severity: Severity) -> usize {
    let counts = checked.findings.iter().map(|found| found.count(severity));
    counts.sum()
}
