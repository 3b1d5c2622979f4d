//! `gradus generate`: other forms of a spec's grafcet.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::ValueEnum;
use grafcet::Grafcet;
use ladder::Format;

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

Exit status: 1 if the text of the spec has errors; what was understood is written
all the same. 2 if a file cannot be read or written, or would take the place of a
ladder or a spec.

Examples:
  gradus generate tank.grafcet --to dot | dot -Tsvg -o tank.svg
  gradus generate tank.grafcet --to json -o tank.json";

/// Write other forms of a spec: JSON or dot.
#[derive(Debug, clap::Args)]
#[command(after_long_help = DETAILS)]
pub struct Args {
    /// The spec; `-` is standard input.
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
}

impl Form {
    fn of(self, grafcet: &Grafcet) -> String {
        match self {
            Self::Json => format!("{:#}\n", generate::to_json(grafcet)),
            Self::Dot => generate::to_dot(grafcet),
        }
    }
}

/// Writes the form that was asked for.
pub fn run(args: &Args, io: &mut Io) -> std::io::Result<Status> {
    let Some((grafcet, status)) = read(&args.spec, io)? else {
        return Ok(Status::Usage);
    };
    let text = args.to.of(&grafcet);
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

/// The grafcet of the spec at `path`, and how a command ends that has made
/// something of it. `None` if there is none; the user has been told why.
fn read(path: &Path, io: &mut Io) -> std::io::Result<Option<(Grafcet, Status)>> {
    let name = printable(&input::name(path));
    let Some(bytes) = program::bytes(path, io)? else {
        return Ok(None);
    };
    let language::File::Spec(text) = language::of(&bytes) else {
        let why = "this is no spec; `gradus convert` makes one of a ladder";
        io.complain(&format!("{name}: {why}"));
        return Ok(None);
    };
    let reading = grafcet::read(text);
    let status = match program::tell_errors(&name, &reading.diagnostics, io)? {
        0 => Status::Done,
        _ => Status::ProblemsFound,
    };
    Ok(Some((reading.spec.grafcet, status)))
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
