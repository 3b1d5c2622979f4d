//! `gradus simulate`: a ladder, a spec or both, scan by scan.

use std::io::Write;
use std::path::{Path, PathBuf};

use recovery::simulation::{self, Simulation, Stop};
use scenario::Scenario;
use source::{Diagnostic, LineIndex, Severity};

use crate::command::generate::source_at;
use crate::file;
use crate::input::{self, numbered};
use crate::io::{Io, is_standard_input};
use crate::program;
use crate::report::{self, Findings, printable};
use crate::status::Status;
use crate::subject::Plant;
use ide::language;

mod json;
pub mod summary;
pub mod table;
mod trace;

const DETAILS: &str = "\
The files are told apart by what they hold: a scenario, and the ladder, the spec
or both that it runs on. A scenario alone runs on what its `for` line names, or
on the files of its name beside it, or on the only ladder in its folder and the
spec of that. docs/notation.md tells how one is written.

Ladder and spec get the same inputs and the same time. What the spec reads and
the ladder writes, such as the output of a timer, comes from the ladder. The
table has a line for each scan that changed something and for the last scan of
each step: which outputs are on, which steps are active, in which outputs both
differ. docs/evolution.md tells how a spec is run.

--inputs takes the inputs from a table in CSV instead, whose first row names
them. With a column `time` (in ms, or such as 1.5s) a row lasts until the next,
else each is a scan.

--record writes a scenario with the same inputs that expects what came out: what
the ladder did, or the spec where it runs alone.

JSON:
  {\"scans\": [{\"scan\", \"time\", \"step\", \"line\", \"inputs\": {}, \"ladder\": {},
     \"grafcet\": {\"active\": [], \"outputs\": {}}, \"differ\": [],
     \"expected_failed\": [{\"name\", \"in\", \"relation\", \"expected\", \"value\"}]}],
    \"agree\", \"passed\", \"stopped\": {\"step\", \"line\", \"reason\"}}
  `time` is in ms; `step` counts from 0, `line` is its line in the scenario. Scans
  that are left out were as the one before. `ladder` and `grafcet` are null for
  what does not run, `agree` unless both do. A value is true, false or a number.
  `in` is ladder or grafcet; `relation` is =, <>, <, <=, >, >= or unchanged.
  `stopped` is null if the scenario was run to its end.

Exit status: 1 if an expectation is not met, if ladder and spec differ, if the run
stops early, or if a text has errors; 2 if a file cannot be read or written.

Examples:
  gradus simulate tank.ladder filling.scenario
  gradus simulate tank.ladder tank.grafcet filling.scenario
  gradus simulate tank.ladder --inputs recorded.csv --record tank.scenario";

/// Run a ladder, a spec or both on a scenario, scan by scan.
#[derive(Debug, clap::Args)]
#[command(after_long_help = DETAILS)]
#[command(override_usage = "gradus simulate [OPTIONS] FILE... SCENARIO")]
pub struct Args {
    /// A ladder, a spec or both, and a scenario, in any order; `-` is standard
    /// input.
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,

    /// Take the inputs from a table instead of a scenario.
    #[arg(long, value_name = "CSV")]
    inputs: Option<PathBuf>,

    /// Write a scenario that expects what came out.
    #[arg(long, value_name = "SCENARIO")]
    record: Option<PathBuf>,

    /// Answer in JSON.
    #[arg(long)]
    json: bool,
}

/// A scenario, and where it came from.
struct Source {
    path: PathBuf,
    scenario: Scenario,
    /// Its text and what was found in it; a table has none.
    text: Option<(Vec<u8>, Vec<Diagnostic>)>,
}

impl Source {
    /// The line of a step, from 1.
    fn line_of(&self) -> impl Fn(usize) -> Option<usize> + '_ {
        let text = self
            .text
            .as_ref()
            .map(|(text, _)| (text, LineIndex::new(text)));
        move |step| {
            let (text, lines) = text.as_ref()?;
            let span = self.scenario.steps.get(step)?.span;
            Some(lines.locate(text, span.start as usize).line)
        }
    }
}

/// Runs the scenario and answers.
pub fn run(args: &Args, io: &mut Io) -> std::io::Result<Status> {
    let Some((plant, mut source, mut status)) = gather(args, io)? else {
        return Ok(Status::Usage);
    };
    if !complain_about_text(&mut source, &plant, io)? {
        return Ok(Status::ProblemsFound);
    }
    let subject = plant.subject();
    let simulation = simulation::simulate(&source.scenario, subject, io.cancel());
    if let Some((_, Stop::Cancelled)) = simulation.stopped {
        return Ok(Status::Interrupted);
    }
    if let Some(path) = &args.record
        && !record(path, &source.scenario, &simulation, &plant, io)?
    {
        return Ok(Status::Usage);
    }
    let paint = io.answer_paint();
    if args.json {
        let answer = json::json(&source.scenario, &simulation, subject, source.line_of());
        writeln!(io.answer(), "{answer:#}")?;
    } else if !args.record.as_deref().is_some_and(is_standard_input) {
        let line_of = source.line_of();
        let table = table::table(&source.scenario, &simulation, subject, line_of, paint);
        io.answer().write_all(table.as_bytes())?;
    }
    let line_of = source.line_of();
    let summary = summary::summary(&source.scenario, &simulation, subject, line_of);
    let name = printable(&input::name(&source.path));
    io.aside(&format!("{name}: {summary}"))?;
    let is_well = simulation.failures().next().is_none() && simulation.agrees();
    if !is_well {
        status = status.max(Status::ProblemsFound);
    }
    Ok(status)
}

/// Reads all files and tells them apart. `None` if something is missing or
/// cannot be read; the user has been told.
fn gather(args: &Args, io: &mut Io) -> std::io::Result<Option<(Plant, Source, Status)>> {
    let mut plant = Plant::default();
    let mut source = None;
    let mut status = Status::Done;
    for path in args.files.iter().chain(&args.inputs) {
        let name = printable(&input::name(path));
        let Some(bytes) = program::bytes(path, io)? else {
            return Ok(None);
        };
        let next = if args.inputs.as_ref() == Some(path) {
            match trace::read(&bytes) {
                Ok(scenario) => Some(Source {
                    path: path.clone(),
                    scenario,
                    text: None,
                }),
                Err(trouble) => {
                    io.complain(&format!("{name}: {trouble}"));
                    return Ok(None);
                }
            }
        } else if let language::File::Scenario(text) = language::of(&bytes) {
            let reading = scenario::read(text);
            Some(Source {
                path: path.clone(),
                scenario: reading.scenario,
                text: Some((bytes, reading.diagnostics)),
            })
        } else {
            match plant.add(path, &bytes) {
                Ok(found) if program::tell_errors(&name, &found, io)? > 0 => {
                    status = Status::ProblemsFound;
                }
                Ok(_) => {}
                Err(misfit) => {
                    io.complain(&format!("{name}: {}", misfit.sentence()));
                    return Ok(None);
                }
            }
            None
        };
        if next.is_some() && source.is_some() {
            io.complain(&format!("{name}: one scenario is run at a time"));
            return Ok(None);
        }
        source = source.or(next);
    }
    let Some(source) = source else {
        io.complain("none of the files is a scenario; --inputs takes a table instead");
        return Ok(None);
    };
    if plant.is_empty() {
        let (found, trouble) = Plant::of(&source.path, &source.scenario);
        if let Some(trouble) = trouble.first() {
            io.complain(&printable(&trouble.message));
            return Ok(None);
        }
        plant = found;
    }
    if plant.is_empty() {
        io.complain("there is neither a ladder nor a spec to run");
        return Ok(None);
    }
    Ok(Some((plant, source, status)))
}

/// Whether the scenario can be run. If not, the user has been told why: every
/// later step would be tried in a state that nobody meant. Of a table, the
/// inputs that nothing knows are passed over.
fn complain_about_text(source: &mut Source, plant: &Plant, io: &mut Io) -> std::io::Result<bool> {
    let Some((text, found)) = &source.text else {
        let unknown = simulation::unknown(&source.scenario, plant.subject());
        for name in &unknown {
            let word = io.aside_paint().severity(Severity::Warning, "warning");
            let name = printable(name);
            io.aside(&format!(
                "{word}: nothing knows {name}; its column is passed over\n"
            ))?;
        }
        let is_known = |name: &str| !unknown.contains(name);
        source.scenario = trace::without(std::mem::take(&mut source.scenario), is_known);
        return Ok(true);
    };
    let mut found = found.clone();
    found.extend(simulation::unknown_names(&source.scenario, plant.subject()));
    if found.is_empty() {
        return Ok(true);
    }
    found.sort_by_key(|diagnostic| (diagnostic.span, diagnostic.code));
    let findings = Findings::new(source.path.clone(), text.clone(), found);
    let paint = io.aside_paint();
    io.aside(&report::text(&findings, paint))?;
    Ok(false)
}

/// Writes what came out as a scenario; whether that could be done.
fn record(
    path: &Path,
    scenario: &Scenario,
    simulation: &Simulation,
    plant: &Plant,
    io: &mut Io,
) -> std::io::Result<bool> {
    let mut recorded = simulation::recorded(scenario, simulation);
    recorded.files = plant.files_seen_from(path);
    let text = scenario::write(&recorded);
    if is_standard_input(path) {
        io.answer().write_all(text.as_bytes())?;
        return Ok(true);
    }
    let name = printable(&input::name(path));
    if let Some(source) = source_at(path).filter(|source| *source != "scenario") {
        io.complain(&format!("{name}: this is a {source}, and is left as it is"));
        return Ok(false);
    }
    match file::replace(path, text.as_bytes()) {
        Ok(()) => {
            let steps = numbered(recorded.steps.len(), "step");
            io.aside(&format!("{name}: written: {steps}\n"))?;
            Ok(true)
        }
        Err(error) => {
            io.complain(&format!("{name}: cannot be written: {error}"));
            Ok(false)
        }
    }
}
