//! `gradus check`: what is wrong or odd in ladders, specs and scenarios.

use std::collections::BTreeMap;
use std::io::Write;
use std::path::{Path, PathBuf};

use clap::ValueEnum;
use ladder::Reading;
use logic::Budget;
use recovery::Analysis;
use source::{Diagnostic, Severity, codes};

use crate::colour::Paint;
use crate::file::Unreadable;
use crate::input::{self, Candidate, Inputs, Origin, numbered};
use crate::io::Io;
use crate::program;
use crate::progress::Progress;
use crate::report::{self, Findings};
use crate::status::Status;
use crate::subject;
use ide::language;

pub mod against;
mod obeyed;

use against::{about_spec, ladder_beside};
use obeyed::Obeyed;

const DETAILS: &str = "\
A folder stands for the files below it that end in .ladder, .l5x, .l5k, .xml,
.txt, .grafcet or .scenario; those of the endings .xml and .txt that hold no
ladder are passed over.

A spec is checked against the ladder beside it, a file of the same name with one
of the endings above, or against the one that --against names: rules that depart
from what the ladder gives, states and decisions that it does not know.

A scenario is run on the ladder and the spec that its `for` line names, or on
those beside it, or on the only ladder in its folder and its spec; what it
expects and does not get is an error. Where there is nothing to run, only its text
is checked.

Codes that a gradus.toml beside a file, or in the nearest folder above it, lists in
`diagnostics.ignore` are neither reported nor counted for that file. What is wrong
in the gradus.toml is reported too.

Exit status: 1 if there is a finding of severity error, 2 if a file cannot be read;
the other files are checked all the same.

JSON:
  {\"diagnostics\": [{\"file\", \"code\", \"severity\", \"message\", \"help\",
    \"span\": {\"start\", \"end\"}, \"line\", \"column\",
    \"related\": [{\"message\", \"span\", \"line\", \"column\"}],
    \"fix\": {\"title\", \"edits\": [{\"span\", \"text\"}]}}]}
  A span counts bytes of the file from 0; line and column count from 1, a column
  being a character. `severity` is error, warning, information or hint. `help`
  and `fix` are null where there is none. JSON and SARIF list hints too.

SARIF is version 2.1.0, with a rule for every code.

Examples:
  gradus check line3.L5X                       one program
  gradus check --severity warning plant/       a whole plant, without remarks and hints
  gradus check --against line3.L5X new.grafcet a spec that lies elsewhere
  gradus check --format sarif . > gradus.sarif for a code-review tool
  gradus check - < pasted.txt                  what somebody pasted";

/// Report what is wrong or odd in ladders, specs and scenarios.
#[derive(Debug, clap::Args)]
#[command(after_long_help = DETAILS)]
pub struct Args {
    /// Files or folders to check; `-` is standard input.
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,

    /// Leave out findings that matter less than this. Without it, text leaves
    /// out hints, which are many in real programs, and only counts them.
    #[arg(long, value_name = "LEAST")]
    severity: Option<Least>,

    /// The same as `--severity hint`: list everything.
    #[arg(long, conflicts_with = "severity")]
    hints: bool,

    /// The ladder that specs are checked against and scenarios run on, instead
    /// of the one beside them.
    #[arg(long, value_name = "LADDER")]
    against: Option<PathBuf>,

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

impl Args {
    fn form(&self) -> Form {
        if self.json { Form::Json } else { self.format }
    }

    /// The least severity that is listed.
    fn least(&self) -> Severity {
        match (self.severity, self.form()) {
            (Some(least), _) => least.into(),
            (None, Form::Text) if !self.hints => Severity::Information,
            (None, _) => Severity::Hint,
        }
    }
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
    /// Files with findings that are listed. Of the others only the number is
    /// kept.
    findings: Vec<Findings>,
    /// All findings by their severity, listed or not.
    counts: BTreeMap<Severity, usize>,
    files: usize,
    passed_over: usize,
    unreadable: Vec<(PathBuf, Unreadable)>,
}

/// Checks every file, then answers.
pub fn run(args: &Args, io: &mut Io) -> std::io::Result<Status> {
    let ladder = match &args.against {
        None => None,
        Some(path) => match program::read(path, io)? {
            Some(ladder) => Some(ladder),
            None => return Ok(Status::Usage),
        },
    };
    let budget = program::budget(io);
    let analysis = ladder
        .as_ref()
        .map(|ladder| recovery::analyse(&ladder.program, &budget));
    let inputs = input::expand(&args.files, input::CHECKED);
    let Some(checked) = check(inputs, args.least(), analysis.as_ref(), &budget, io) else {
        return Ok(Status::Interrupted);
    };
    match args.form() {
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
fn check(
    inputs: Inputs,
    least: Severity,
    against: Option<&Analysis>,
    budget: &Budget,
    io: &mut Io,
) -> Option<Checked> {
    let waits_for_input = inputs.candidates.iter().any(Candidate::is_standard_input);
    // A line that moves would get in the way of somebody who types a program.
    let progress = (!waits_for_input).then(|| Progress::begin("Checking", inputs.candidates.len()));
    let mut checked = Checked {
        unreadable: inputs.unreadable,
        ..Checked::default()
    };
    let mut obeyed = Obeyed::default();
    for (part, candidate) in inputs.candidates.into_iter().enumerate() {
        if let Some(progress) = &progress {
            progress.at(part, &report::printable(&input::name(&candidate.path)));
        }
        match io.read(&candidate.path) {
            Ok(text) => {
                let mut diagnostics = examine(&candidate.path, &text, against, budget);
                if is_of_no_interest(&candidate, &diagnostics) {
                    checked.passed_over += 1;
                } else {
                    checked.files += 1;
                    obeyed.sift(&candidate.path, &mut diagnostics);
                    checked.keep(candidate.path, text, diagnostics, least);
                }
            }
            Err(reason) => checked.unreadable.push((candidate.path, reason)),
        }
        if io.cancel().is_cancelled() {
            return None;
        }
    }
    for (path, file) in obeyed.faulty() {
        checked.keep(path, file.text, file.findings, least);
    }
    Some(checked)
}

impl Checked {
    /// Counts what was found about a file, and keeps what is listed.
    fn keep(&mut self, path: PathBuf, text: Vec<u8>, mut found: Vec<Diagnostic>, least: Severity) {
        for diagnostic in &found {
            *self.counts.entry(diagnostic.severity).or_default() += 1;
        }
        found.retain(|diagnostic| diagnostic.severity <= least);
        if !found.is_empty() {
            self.findings.push(Findings::new(path, text, found));
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

/// What there is to say about the file at `path` that holds `text`; if it is a
/// spec or a scenario, in the light of the ladder `against`, or else of what
/// lies beside it.
fn examine(
    path: &Path,
    text: &[u8],
    against: Option<&Analysis>,
    budget: &Budget,
) -> Vec<Diagnostic> {
    match (language::of(text), against) {
        (language::File::Ladder(bytes), _) => about_ladder(bytes, budget),
        (language::File::Scenario(text), against) => {
            let ladder = against.map(|analysis| &analysis.program);
            subject::about_scenario(path, text, ladder, &budget.cancel)
        }
        (language::File::Spec(text), Some(analysis)) => about_spec(text, Some(analysis), budget),
        (language::File::Spec(text), None) => {
            let beside = ladder_beside(path);
            let analysis = beside
                .as_ref()
                .map(|program| recovery::analyse(program, budget));
            about_spec(text, analysis.as_ref(), budget)
        }
    }
}

/// What the text of a ladder reveals, and what its conditions do.
fn about_ladder(bytes: &[u8], budget: &Budget) -> Vec<Diagnostic> {
    let Reading {
        program,
        mut diagnostics,
    } = ladder::read(bytes);
    let conditions = recovery::conditions::conditions(&program, budget);
    let found = recovery::findings::findings(&program, &conditions, budget);
    diagnostics.extend(found);
    diagnostics.sort_by_key(|diagnostic| (diagnostic.span, diagnostic.code));
    diagnostics.dedup();
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
    match unlisted(checked) {
        0 => {}
        number => text += &format!("; {number} not listed, --hints lists all"),
    }
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
    checked.counts.get(&severity).copied().unwrap_or_default()
}

/// Findings that are counted and not listed.
fn unlisted(checked: &Checked) -> usize {
    let listed = checked.findings.iter().map(|found| found.diagnostics.len());
    checked.counts.values().sum::<usize>() - listed.sum::<usize>()
}
