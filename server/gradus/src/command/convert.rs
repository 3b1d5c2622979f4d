//! `gradus convert`: a ladder and the expert's decisions become the spec beside
//! it.
//!
//! The spec is the only state of a conversion. The command reads what it says,
//! adds the decisions that are asked for, and makes it say what the ladder and
//! all decisions give; what a person wrote by hand stays.

use std::io::Write;
use std::path::{Path, PathBuf};

use recovery::Analysis;
use source::Severity;

use crate::diff;
use crate::io::{Io, is_standard_input};
use crate::program::{self, Ladder};
use crate::report::{self, Findings, printable};
use crate::sights;
use crate::status::Status;

mod accept;
mod conversion;
mod interview;
mod json;
mod named;
mod outcome;
mod spec_file;
mod text;
mod verdict;

use accept::Wanted;
use conversion::Conversion;
use outcome::Outcome;
use spec_file::{SpecFile, State};

/// Millions of small steps that a search is worth whose result nobody looks
/// through before it is accepted.
const THOROUGH: u64 = 5_000;

const DETAILS: &str = "\
The spec holds the decisions: what was accepted, rejected, and where a sequence
starts. So running the command again goes on where it stopped, and without
--accept nothing new is accepted. Rules, comments and declarations that a person
changed stay as they are; where they depart from what the ladder gives, a warning
says so. The file is replaced in one step, and only if something changes. A file
that is no spec is never replaced.

Accepting:
  none       nothing; without any decision every state is a small grafcet of two
             steps, or said as its rungs have it where two steps would not do the
             same; so the spec does what the ladder does, and where it may not,
             the summary says which rungs are why
  handover   every pair of which the end of the one is the start of the other
  witnessed  every pair that a sequence of inputs shows, in plants that obey the
             environment rules of the spec and change one input at a time: no
             person is needed where the ladder says enough; the verdict tells
  all        every suggestion, also those that are merely possible
  LIST       v1->v2,v1->h   these pairs, suggested or not, rejected before or not
             v1->v2&h&m     these states start together
The arcs of step registers are exact and need no accepting.

Last, the spec is verified with a small effort: whether it does what the ladder
does after every scan, and if not, when both rest. `gradus verify` tells more.

The summary goes to standard output. With `-o -` and --dry-run the spec, or its
change, is the answer, and the summary goes to standard error.

JSON:
  {\"file\", \"spec\", \"state\", \"steps\", \"transitions\", \"actions\",
    \"states\": [{\"state\", \"accepted\": [{\"to\": [], \"new\"}], \"written\": [],
      \"open\": [{\"to\", \"evidence\", \"kind\"}], \"rejected\": [], \"initial\"}],
    \"two_step\": [], \"as_rungs\": [], \"unreached\": [], \"in_definitions\": [],
    \"inexact\": [{\"name\", \"rungs\": [], \"reason\"}], \"sequence\", \"reason\",
    \"verdict\", \"settled\", \"diagnostics\": [], \"text\"}
  `verdict` is equivalent, different or unknown, null where the spec has no outputs;
  `settled` is equivalent where it is different after single scans and equal when
  both sides rest, else null.
  `state` is new, changed, unchanged, would_change or printed. `states` are those
  about which something is decided, written or open; `two_step` those that no
  accepted pair ties to a sequence, `as_rungs` those of them that two steps could
  not say, `inexact` variables that the spec does not say exactly and why,
  `unreached` those to which nothing accepted
  leads from where their sequence starts, `in_definitions` those of blocks that the
  file defines, which are not drawn. `diagnostics` are as in `gradus check`, about
  the spec. `text` is the spec with `-o -`, else null.

Exit status: 1 if the text of the ladder or of the spec has errors. Rules that
depart from the ladder are warnings: they may be meant. 2 if a file cannot be
read or written, is no spec, or a state is not in the ladder.

Examples:
  gradus convert tank.ladder --accept handover
  gradus convert tank.ladder --accept 'v1->v2&h&m,v2->v3' --initial v1
  gradus convert tank.ladder --interactive
  gradus convert line3.L5X -o - | less";

/// Write or update the spec beside a ladder.
#[derive(Debug, clap::Args)]
#[command(after_long_help = DETAILS)]
pub struct Args {
    /// The ladder; `-` is standard input, whose spec goes to standard output
    /// unless -o names a file.
    #[arg(value_name = "FILE")]
    file: PathBuf,

    /// The spec to write or update; `-` makes a new one on standard output.
    /// Without it, it is FILE with the ending .grafcet.
    #[arg(short, long, value_name = "SPEC")]
    output: Option<PathBuf>,

    /// What to accept: none, handover, witnessed, all, or a list of pairs.
    #[arg(long, value_name = "WHAT", value_parser = accept::parse)]
    accept: Option<Wanted>,

    /// How long to search for sequences of inputs, in millions of small steps: a
    /// thousand are some ten seconds. Without it 5000 for `--accept witnessed`, 200
    /// for --interactive.
    #[arg(long, value_name = "MILLIONS")]
    effort: Option<u64>,

    /// A state in which its sequence starts; may be given several times.
    #[arg(long, value_name = "STATE")]
    initial: Vec<String>,

    /// Ask about every open suggestion, state by state. Every answer is saved at
    /// once.
    #[arg(long, conflicts_with_all = ["dry_run", "json"])]
    interactive: bool,

    /// Write nothing; show what would change.
    #[arg(long)]
    dry_run: bool,

    /// Replace rules and actions that depart from the ladder by what it gives.
    /// Decisions, environment rules and properties stay, and so do rules with a
    /// `keep`.
    #[arg(long)]
    renew: bool,

    /// Answer in JSON.
    #[arg(long)]
    json: bool,
}

impl Args {
    /// Where the spec is; `None` for standard output.
    fn spec_path(&self) -> Option<PathBuf> {
        match &self.output {
            Some(path) => (!is_standard_input(path)).then(|| path.clone()),
            None if is_standard_input(&self.file) => None,
            None => Some(self.file.with_extension("grafcet")),
        }
    }
}

/// Converts, asks if that is wanted, and writes the spec.
pub fn run(args: &Args, io: &mut Io) -> std::io::Result<Status> {
    if let Some(reason) = misuse(args, io) {
        io.complain(reason);
        return Ok(Status::Usage);
    }
    let Some(ladder) = program::read(&args.file, io)? else {
        return Ok(Status::Usage);
    };
    let Some(file) = open(args, io)? else {
        return Ok(Status::Usage);
    };
    let budget = program::budget(io);
    let Some(analysis) = program::analyse(&ladder, &budget) else {
        return Ok(Status::Interrupted);
    };
    // Whoever decides by evidence should have all there is.
    let takes_witnessed = args.accept == Some(Wanted::Witnessed);
    let analysis = if args.interactive || takes_witnessed {
        let environment = grafcet::read(&file.text).spec.environment;
        let usual = if takes_witnessed {
            THOROUGH
        } else {
            sights::EFFORT
        };
        let effort = args.effort.unwrap_or(usual);
        let (seeing, note) = sights::seeing(&ladder, analysis, &environment, effort, io);
        if let Some(note) = note {
            io.aside(&format!("{}: {note}\n", printable(&ladder.name())))?;
        }
        seeing
    } else {
        analysis
    };
    if io.cancel().is_cancelled() {
        return Ok(Status::Interrupted);
    }
    let mut conversion = Conversion::begin(&analysis, file, &budget);
    if let Err(reason) = decide(args, &analysis, &mut conversion) {
        io.complain(&reason);
        return Ok(Status::Usage);
    }
    if args.interactive {
        let status = interview::hold(&mut conversion, io)?;
        if status != Status::Done {
            return Ok(status);
        }
    }
    finish(args, &ladder, conversion, io)
}

/// What makes no sense before anything is read.
fn misuse(args: &Args, io: &Io) -> Option<&'static str> {
    if args.interactive && args.spec_path().is_none() {
        return Some("--interactive keeps the answers in a file; name it with -o");
    }
    if args.interactive && !io.can_ask() {
        return Some(
            "--interactive needs a terminal to ask at; --accept takes a list without asking",
        );
    }
    None
}

/// The spec as it is now. `None` if it must not be touched; the user has been
/// told why.
fn open(args: &Args, io: &mut Io) -> std::io::Result<Option<SpecFile>> {
    let Some(path) = args.spec_path() else {
        return Ok(Some(SpecFile::on_standard_output()));
    };
    match SpecFile::open(&path) {
        Ok(file) => Ok(Some(file)),
        Err(refusal) => {
            let paint = io.aside_paint();
            io.aside(&refusal.text(&path, paint))?;
            Ok(None)
        }
    }
}

/// Adds the decisions that the command line asks for. The error says which
/// cannot be.
fn decide(args: &Args, analysis: &Analysis, conversion: &mut Conversion<'_>) -> Result<(), String> {
    let mut decisions = conversion.decisions.clone();
    if let Some(wanted) = &args.accept {
        decisions = accept::apply(wanted, analysis, decisions)?;
    }
    named::start_in(&args.initial, analysis, &mut decisions)?;
    conversion.decisions = decisions;
    if args.renew {
        conversion.renew();
    }
    Ok(())
}

/// Writes the spec, or shows it, and says what came of it.
fn finish(
    args: &Args,
    ladder: &Ladder,
    mut conversion: Conversion<'_>,
    io: &mut Io,
) -> std::io::Result<Status> {
    let (old, new) = {
        let _progress = program::progress("Converting", ladder);
        (conversion.file.text.clone(), conversion.text())
    };
    if io.cancel().is_cancelled() {
        return Ok(Status::Interrupted);
    }
    let outcome = Outcome::of(&conversion, &new);
    let would_change = args.dry_run && !conversion.file.says(&new);
    if !args.dry_run
        && let Err(failure) = conversion.file.save(&new)
    {
        io.complain(&failure);
        return Ok(Status::Usage);
    }
    let state = match conversion.file.state() {
        State::Unchanged if would_change => State::WouldChange,
        state => state,
    };
    let findings = findings(&conversion, &new);
    let status = ladder.status().max(status(&findings));
    let verdict = {
        let _progress = program::progress("Verifying", ladder);
        let effort = match args.accept {
            Some(Wanted::Witnessed) => verdict::THOROUGH,
            _ => verdict::EFFORT,
        };
        verdict::of(&ladder.program, &new, effort, io.cancel())
    };
    if args.json {
        let json = json::json(ladder, &outcome, state, &findings, &new, &verdict);
        writeln!(io.answer(), "{json:#}")?;
        return Ok(status);
    }
    let name = conversion.file.name();
    let paint = io.answer_paint();
    let summary = |paint| {
        let mut told = text::summary(&outcome, &name, state, paint);
        told += &format!("{}: {}\n", printable(&name), verdict.sentence);
        if verdict.word.is_some_and(|word| word != "equivalent") {
            told += &text::inexact(&outcome);
        }
        told
    };
    if args.dry_run && conversion.file.path.is_some() {
        let diff = diff::unified(&printable(&name), &old, &new, paint);
        io.answer().write_all(diff.as_bytes())?;
        let summary = summary(io.aside_paint());
        io.aside(&summary)?;
    } else if conversion.file.path.is_none() {
        io.answer().write_all(new.as_bytes())?;
        let summary = summary(io.aside_paint());
        io.aside(&summary)?;
    } else {
        io.answer().write_all(summary(paint).as_bytes())?;
    }
    let paint = io.aside_paint();
    io.aside(&report::text(&findings, paint))?;
    Ok(status)
}

/// What there is to say about the spec that holds `text`.
fn findings(conversion: &Conversion<'_>, text: &str) -> Findings {
    let path = Path::new(&conversion.file.name()).to_owned();
    let found = conversion.findings(text);
    Findings::new(path, text.as_bytes().to_vec(), found)
}

fn status(findings: &Findings) -> Status {
    if findings.count(Severity::Error) > 0 {
        Status::ProblemsFound
    } else {
        Status::Done
    }
}
