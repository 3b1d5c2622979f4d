//! `gradus generate`: other forms of a spec's grafcet, and of ladders as
//! netlists.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::ValueEnum;
use grafcet::Spec;
use ladder::Format;
use proof::{Limits, Netlist, aiger, blif};
use verification::{Refusal, alone};

use crate::file;
use crate::input;
use crate::io::{Io, is_standard_input};
use crate::program;
use crate::report::printable;
use crate::status::Status;
use ide::language;

const DETAILS: &str = "\
JSON:
  {\"name\", \"steps\": [{\"name\", \"initial\", \"state\", \"macro\"}],
    \"transitions\": [{\"name\", \"from\": [], \"to\": [], \"receptivity\"}],
    \"actions\": [{\"step\", \"kind\", \"output\", \"condition\"}],
    \"inputs\": [], \"outputs\": []}
  `state` is the coil or the register value that a step stands for as the ladder
  spells it (`v1`, `X.3`, `Seq=10`), null for an auxiliary step; `macro` is the
  expansion of a macro-step, else null. `kind` of an action is continuous, set,
  reset, assign, the last three also with -on-deactivation or -on-event, or
  force. Instances of reusable grafcets are written out.

dot is the language of Graphviz.

blif and aiger are netlists of gates and latches for ABC, Yosys and model checkers:
what a scan computes, of a spec or of a ladder. docs/verify.md tells how they are
made; `gradus verify --export` writes both sides and the question.

Exit status: 1 if the text has errors; what was understood is written all the
same. 2 if a file cannot be read or written, would take the place of a ladder or a
spec, or cannot be made a netlist of.

Examples:
  gradus generate tank.grafcet --to dot | dot -Tsvg -o tank.svg
  gradus generate tank.grafcet --to json -o tank.json
  gradus generate tank.ladder --to blif -o tank.blif";

/// Write other forms of a spec, JSON, dot or a netlist, and ladders as netlists.
#[derive(Debug, clap::Args)]
#[command(after_long_help = DETAILS)]
pub struct Args {
    /// The spec, or for a netlist the ladder; `-` is standard input.
    #[arg(value_name = "SPEC")]
    spec: PathBuf,

    /// The form.
    #[arg(long, value_name = "FORM")]
    to: Form,

    /// Where to write it; without it, and for `-`, standard output.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Form {
    /// For programs.
    Json,
    /// For pictures, by Graphviz.
    Dot,
    /// A netlist for ABC, Yosys and others.
    Blif,
    /// A netlist for model checkers, as text.
    Aiger,
}

/// What there is to write.
enum Subject {
    Spec(Box<Spec>),
    Ladder(program::Ladder),
}

impl Form {
    fn of(self, subject: &Subject, limits: &Limits) -> Result<String, Refusal> {
        let netlist = || match subject {
            Subject::Spec(spec) => alone::of_spec(spec, limits),
            Subject::Ladder(ladder) => alone::of_ladder(&ladder.program, limits),
        };
        Ok(match (self, subject) {
            (Self::Json, Subject::Spec(spec)) => {
                format!("{:#}\n", generate::to_json(&spec.grafcet))
            }
            (Self::Dot, Subject::Spec(spec)) => generate::to_dot(&spec.grafcet),
            (Self::Aiger, _) => aiger::ascii(&netlist()?),
            _ => written(&netlist()?, subject),
        })
    }

    fn takes_ladders(self) -> bool {
        matches!(self, Self::Blif | Self::Aiger)
    }
}

fn written(netlist: &Netlist, subject: &Subject) -> String {
    let name = match subject {
        Subject::Spec(spec) => spec.grafcet.name.clone(),
        Subject::Ladder(ladder) => Some(ladder.program.name.clone()),
    };
    let name = name.filter(|name| !name.is_empty());
    blif::text(netlist, name.as_deref().unwrap_or("gradus"))
}

/// Writes the form that was asked for.
pub fn run(args: &Args, io: &mut Io) -> std::io::Result<Status> {
    let Some((subject, status)) = read(args, io)? else {
        return Ok(Status::Usage);
    };
    let limits = Limits {
        cancel: io.cancel().clone(),
        ..Limits::default()
    };
    let text = match args.to.of(&subject, &limits) {
        Ok(text) => text,
        Err(Refusal::Cancelled) => return Ok(Status::Interrupted),
        Err(refusal) => {
            let name = printable(&input::name(&args.spec));
            let reason = printable(&refusal.to_string());
            io.complain(&format!("{name}: cannot be made a netlist: {reason}"));
            return Ok(Status::Usage);
        }
    };
    let Some(path) = args.output.as_deref().filter(|it| !is_standard_input(it)) else {
        io.answer().write_all(text.as_bytes())?;
        return Ok(status);
    };
    let name = printable(&input::name(path));
    if let Some(source) = source_at(path) {
        io.complain(&format!("{name}: this is a {source}, and is left as it is"));
        return Ok(Status::Usage);
    }
    match file::replace(path, text.as_bytes()) {
        Ok(()) => {
            io.aside(&format!("{name}: written\n"))?;
            Ok(status)
        }
        Err(error) => {
            io.complain(&format!("{name}: cannot be written: {error}"));
            Ok(Status::Usage)
        }
    }
}

/// What the file holds, and how a command ends that has made something of it.
/// `None` if it is of no use; the user has been told why.
fn read(args: &Args, io: &mut Io) -> std::io::Result<Option<(Subject, Status)>> {
    let path = &args.spec;
    let name = printable(&input::name(path));
    let Some(bytes) = program::bytes(path, io)? else {
        return Ok(None);
    };
    let language::File::Spec(text) = language::of(&bytes) else {
        if args.to.takes_ladders() {
            let ladder = program::of_bytes(path, bytes, io)?;
            return Ok(ladder.map(|it| {
                let status = it.status();
                (Subject::Ladder(it), status)
            }));
        }
        let why = "this is no spec; `gradus convert` makes one of a ladder";
        io.complain(&format!("{name}: {why}"));
        return Ok(None);
    };
    let reading = grafcet::read(text);
    let status = match program::tell_errors(&name, &reading.diagnostics, io)? {
        0 => Status::Done,
        _ => Status::ProblemsFound,
    };
    Ok(Some((Subject::Spec(Box::new(reading.spec)), status)))
}

/// What the file at `path` holds that nothing brings back, if it holds such a
/// thing: a ladder, a spec or a scenario.
pub fn source_at(path: &Path) -> Option<&'static str> {
    let bytes = file::read(path).ok()?;
    match language::of(&bytes) {
        language::File::Spec(_) => Some("spec"),
        language::File::Scenario(_) => Some("scenario"),
        language::File::Ladder(bytes) => {
            let is_known = ladder::read(bytes).program.format != Format::Unknown;
            is_known.then_some("ladder")
        }
    }
}
