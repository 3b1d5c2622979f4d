//! `gradus verify`: whether a spec does what its ladder does.

use std::io::Write;
use std::path::{Path, PathBuf};

use grafcet::Spec;
use proof::{Limits, aiger, blif};
use verification::{Verdict, Verification, verify};

use crate::command::generate::source_at;
use crate::file;
use crate::input;
use crate::io::{Io, is_standard_input};
use crate::program;
use crate::progress::Progress;
use crate::report::printable;
use crate::settings::Timing;
use crate::status::Status;
use ide::language;

mod json;
pub mod text;

const DETAILS: &str = "\
Ladder and spec run side by side on the same inputs, and their outputs must be
equal: for every sequence of inputs that the environment rules of the spec allow,
of any length. That is proved, not sampled. The verdict is

  equivalent  they are
  different   with the shortest sequence of inputs after which an output differs;
              both were run on it before it is told
  unknown     neither was found within the limits; it is told how far there is
              no difference

The properties under `Never:` are asked by themselves, with the same verdicts.

Timing:
  scan     outputs are compared after every scan
  settled  each input is held until both sides rest, then outputs are compared;
           ladders with transition bits of their own move a scan late and agree
           with their grafcet only there

When a timer runs out is left free, as far as its type allows, and so are boxes
and numbers that cannot be followed: what is proved holds whatever they do. A
ladder that cannot be translated exactly is refused, with the reason.

--trace writes the shortest difference as a scenario: `gradus simulate` runs it.
--export writes the question for other tools: BLIF, or AIGER where the file ends
in .aig or .aag; one output for each that is compared and for each property, which
is 1 where they differ or it is violated.

JSON:
  {\"verdict\", \"timing\", \"what\": {\"kind\", \"outputs\": [], \"cycle\": [[]]},
    \"shortest\", \"brief\", \"bound\", \"why\", \"states\", \"deadlock\",
    \"trace\": [{\"elapsed\", \"inputs\": {}, \"ladder\": {}, \"grafcet\": {\"active\": [],
      \"outputs\": {}}}],
    \"outputs\": [], \"not_in_ladder\": [], \"not_in_spec\": [], \"free\": [],
    \"rungs\": [{\"output\", \"scope\", \"rung\", \"comment\", \"depends_on\"}],
    \"properties\": [{\"name\", \"verdict\", \"what\", \"shortest\", \"brief\", \"bound\",
      \"why\", \"trace\": []}]}
  `kind` is outputs, unstable, restless or property; `what` is null unless the
  verdict is different. `trace` has an entry for each step, the first difference
  last, and is empty otherwise; `elapsed` is in ms. `brief` says that the
  difference is over after another step with the same inputs. `bound` is the
  number of steps without a difference of an unknown verdict, else null, and `why`
  its reason. `deadlock` is the number of steps after which the environment rules
  allow nothing more, if they do so. `rungs` are those that write the outputs that
  differ, `depends_on` how many others can tell on them.

Exit status: 0 if all is proved; 1 if anything is different or unknown, or if a
text has errors; 2 if a file cannot be read or written, or the ladder is refused.

Examples:
  gradus verify tank.ladder tank.grafcet
  gradus verify line3.L5X line3.grafcet --timing settled --trace late.scenario
  gradus verify tank.ladder tank.grafcet --export both.aig";

/// Prove that a spec does what its ladder does, or show where it does not.
#[derive(Debug, clap::Args)]
#[command(after_long_help = DETAILS)]
pub struct Args {
    /// The ladder; `-` is standard input.
    #[arg(value_name = "LADDER")]
    ladder: PathBuf,

    /// The spec; without it, the one beside the ladder.
    #[arg(value_name = "SPEC")]
    spec: Option<PathBuf>,

    /// When outputs are compared.
    #[arg(long, default_value = "scan")]
    timing: Timing,

    /// Write the shortest difference as a scenario.
    #[arg(long, value_name = "SCENARIO")]
    trace: Option<PathBuf>,

    /// Write the question for other tools: .blif, .aig or .aag.
    #[arg(long, value_name = "FILE")]
    export: Option<PathBuf>,

    /// How much work may be done, in millions of small steps; a thousand are some
    /// ten seconds.
    #[arg(long, value_name = "MILLIONS", default_value_t = 5_000)]
    effort: u64,

    /// The longest sequence of inputs that is tried.
    #[arg(long, value_name = "STEPS", default_value_t = 10_000)]
    depth: usize,

    /// Answer in JSON.
    #[arg(long)]
    json: bool,
}

/// A ladder and its spec, as they were read.
struct Pair {
    ladder: program::Ladder,
    spec: Spec,
    spec_path: PathBuf,
    status: Status,
}

/// Verifies and answers.
pub fn run(args: &Args, io: &mut Io) -> std::io::Result<Status> {
    let Some(pair) = read(args, io)? else {
        return Ok(Status::Usage);
    };
    let program = &*pair.ladder.program;
    let limits = limits(args, io);
    let found = {
        let _progress = Progress::of_one("Verifying", &printable(&pair.ladder.name()));
        verify(program, &pair.spec, args.timing.into(), &limits)
    };
    let found = match found {
        Ok(found) => found,
        Err(verification::Refusal::Cancelled) => return Ok(Status::Interrupted),
        Err(refusal) => {
            let name = printable(&pair.ladder.name());
            io.complain(&format!(
                "{name}: cannot be verified: {}",
                printable(&refusal.to_string())
            ));
            return Ok(Status::Usage);
        }
    };
    if found.is_cancelled() {
        return Ok(Status::Interrupted);
    }
    if args.json {
        let answer = json::json(&found, program);
        writeln!(io.answer(), "{answer:#}")?;
    } else {
        let paint = io.answer_paint();
        io.answer()
            .write_all(text::text(&found, program, paint).as_bytes())?;
    }
    if let Some(path) = &args.trace
        && !write_trace(path, &found, &pair, io)?
    {
        return Ok(Status::Usage);
    }
    if let Some(path) = &args.export
        && !export(path, &found, io)?
    {
        return Ok(Status::Usage);
    }
    Ok(match found.is_proved() {
        true => pair.status,
        false => pair.status.max(Status::ProblemsFound),
    })
}

fn limits(args: &Args, io: &Io) -> Limits {
    Limits {
        steps: args.effort.saturating_mul(1_000_000),
        scans: args.depth,
        cancel: io.cancel().clone(),
        ..Limits::default()
    }
}

/// Reads both files. `None` if one is missing; the user has been told.
fn read(args: &Args, io: &mut Io) -> std::io::Result<Option<Pair>> {
    let Some(ladder) = program::read(&args.ladder, io)? else {
        return Ok(None);
    };
    let spec_path = match &args.spec {
        Some(path) => path.clone(),
        None if is_standard_input(&args.ladder) => {
            io.complain("name the spec too: there is none beside standard input");
            return Ok(None);
        }
        None => args.ladder.with_extension("grafcet"),
    };
    let name = printable(&input::name(&spec_path));
    let Some(bytes) = program::bytes(&spec_path, io)? else {
        return Ok(None);
    };
    let language::File::Spec(text) = language::of(&bytes) else {
        io.complain(&format!(
            "{name}: this is no spec; `gradus convert` makes one of a ladder"
        ));
        return Ok(None);
    };
    let reading = grafcet::read(text);
    let mut status = ladder.status();
    if program::tell_errors(&name, &reading.diagnostics, io)? > 0 {
        status = status.max(Status::ProblemsFound);
    }
    Ok(Some(Pair {
        ladder,
        spec: reading.spec,
        spec_path,
        status,
    }))
}

/// Writes the first difference as a scenario; whether that could be done.
fn write_trace(
    path: &Path,
    found: &Verification,
    pair: &Pair,
    io: &mut Io,
) -> std::io::Result<bool> {
    let all = found.properties.iter().map(|(_, verdict)| verdict);
    let mut all = std::iter::once(&found.verdict).chain(all);
    let trace = all.find_map(|verdict| match verdict {
        Verdict::Different(difference) => Some(&difference.trace),
        _ => None,
    });
    let name = printable(&input::name(path));
    let Some(trace) = trace else {
        io.aside(&format!(
            "{name}: not written: there is no difference to show\n"
        ))?;
        return Ok(true);
    };
    let mut scenario = trace.scenario();
    let folder = path.parent();
    let paths = [&pair.ladder.path, &pair.spec_path].into_iter();
    let beside = paths.filter(|it| it.parent() == folder && !is_standard_input(it));
    scenario.files = beside
        .filter_map(|it| it.file_name()?.to_str())
        .map(|name| scenario::FileName {
            path: name.into(),
            span: source::Span::default(),
        })
        .collect();
    save(path, scenario::write(&scenario).as_bytes(), "scenario", io)
}

/// Writes the question for other tools; whether that could be done.
fn export(path: &Path, found: &Verification, io: &mut Io) -> std::io::Result<bool> {
    let question = &found.question;
    let ending = path
        .extension()
        .and_then(|it| it.to_str())
        .unwrap_or_default();
    let bytes = match ending {
        "aig" => aiger::binary(question),
        "aag" => aiger::ascii(question).into_bytes(),
        _ => blif::text(question, "verify").into_bytes(),
    };
    save(path, &bytes, "", io)
}

/// Writes a file that is no source of anybody's; whether that could be done.
fn save(path: &Path, bytes: &[u8], allowed: &str, io: &mut Io) -> std::io::Result<bool> {
    if is_standard_input(path) {
        io.answer().write_all(bytes)?;
        return Ok(true);
    }
    let name = printable(&input::name(path));
    if let Some(source) = source_at(path).filter(|it| *it != allowed) {
        io.complain(&format!("{name}: this is a {source}, and is left as it is"));
        return Ok(false);
    }
    match file::replace(path, bytes) {
        Ok(()) => {
            io.aside(&format!("{name}: written\n"))?;
            Ok(true)
        }
        Err(error) => {
            io.complain(&format!("{name}: cannot be written: {error}"));
            Ok(false)
        }
    }
}
