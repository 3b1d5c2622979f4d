//! `gradus suggest`: which state may follow which, best first.

use std::io::Write;
use std::path::PathBuf;

use clap::ValueEnum;
use logic::{Budget, Name};
use recovery::Analysis;
use recovery::successions::{self, Succession};

use crate::io::Io;
use crate::program;
use crate::report::printable;
use crate::sights;
use crate::status::Status;

mod json;
mod text;

const DETAILS: &str = "\
What a suggestion rests on, strongest first:

  written    an arc of a step register, read off a write; exact
  handover   what ends the one state is what starts the other
  witnessed  a scan was found that ends the one and starts the other
  delayed    the other was seen to start some scans after the one had ended, with
             no state on in between that would explain it
  possible   what ends the one and what starts the other share a variable and can
             hold together

A follower is of kind `and` when it starts together with others, in one scan and
without locking them out; of kind `or` when it starts instead of them. The
condition says when the one ends and the other begins.

The line below a suggestion is a witness: the shortest sequence of inputs from the
first scan in which it happens, as a scenario says it. Sequences are searched in
which no more than one input changes from scan to scan, then all others: what takes
several at once is mostly a coincidence; it comes after the rest, and is only named. With a spec beside the ladder,
or named by --spec, only plants that obey its environment rules are looked at: this
is what keeps out what no plant does. A handover that was shown never to happen
there is merely possible. What is not decided with --effort stays as it is.

Methods:
  ranked     states only, best first
  possible   every coil with every other, by the last of the rules above
  cubes      the rule of the published method, literally, for comparison: it
             depends on the order of variables and its time doubles with every
             variable that two conditions share

JSON:
  {\"states\": [], \"suggestions\": [{\"from\", \"to\", \"evidence\", \"kind\", \"condition\",
    \"witness\": [{\"inputs\": {}, \"elapsed\", \"on\": []}], \"ended\", \"calm\"}],
    \"sequence\", \"reason\", \"rules\", \"searched\",
    \"groups\": [{\"states\": [], \"sequence\", \"reason\", \"modes\": [[]]}]}
  `states` are the coils and register values that took part. `evidence` is
  written, handover, witnessed, delayed or possible; `kind` is and or or.
  `condition` is null where it is too long to be read (more than 40 products) and
  for cubes. `witness` has an entry for each scan, empty if no sequence is known:
  the inputs that change, the time since the scan before in ms, and the states
  that are on then. The first state ends in the scan that `ended` counts to, from
  1; `calm` says that no more than one input changes at a time. `rules` is the
  number of environment rules, `searched` whether every pair was found or shown
  never to happen; null without a search.
  A group is a set of rungs that depend on each other; `modes` are sets of
  states that replace each other in any order, such as opened and closed.

Exit status: 0 also where there is no sequence: that is an answer. 1 if the text
of the ladder has errors.

Examples:
  gradus suggest line3.L5X
  gradus suggest tank.ladder --spec plant.grafcet --effort 2000
  gradus suggest --method cubes --json tank.ladder | jq '.suggestions | length'";

/// Suggest which state follows which, best first.
#[derive(Debug, clap::Args)]
#[command(after_long_help = DETAILS)]
pub struct Args {
    /// The ladder; `-` is standard input.
    #[arg(value_name = "FILE")]
    file: PathBuf,

    /// How to look for suggestions.
    #[arg(long, default_value = "ranked")]
    method: Method,

    /// The spec whose environment rules the plant obeys; without it, the one
    /// beside the ladder, if there is one.
    #[arg(long, value_name = "SPEC")]
    spec: Option<PathBuf>,

    /// How long to search for sequences of inputs, in millions of small steps; a
    /// thousand are some ten seconds, 0 is no search.
    #[arg(long, value_name = "MILLIONS", default_value_t = sights::EFFORT)]
    effort: u64,

    /// Answer in JSON.
    #[arg(long)]
    json: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Method {
    /// By the evidence for it; states only.
    Ranked,
    /// Whatever can be; every coil takes part.
    Possible,
    /// The published rule; every coil takes part.
    Cubes,
}

/// What was found, by whatever method.
struct Found<'a> {
    states: Vec<Name>,
    suggestions: Vec<Succession>,
    analysis: &'a Analysis,
}

/// Answers which state may follow which.
pub fn run(args: &Args, io: &mut Io) -> std::io::Result<Status> {
    let Some(ladder) = program::read(&args.file, io)? else {
        return Ok(Status::Usage);
    };
    let Some(environment) = sights::environment(&args.file, args.spec.as_ref(), io)? else {
        return Ok(Status::Usage);
    };
    let budget = program::budget(io);
    let Some(analysis) = program::analyse(&ladder, &budget) else {
        return Ok(Status::Interrupted);
    };
    let (analysis, note) = match args.method {
        Method::Ranked => sights::seeing(&ladder, analysis, &environment, args.effort, io),
        Method::Possible | Method::Cubes => (analysis, None),
    };
    let paint = io.answer_paint();
    let answer = {
        let _progress = program::progress("Comparing", &ladder);
        let found = find(args.method, &analysis, &budget);
        match args.method {
            _ if args.json => format!("{:#}\n", json::json(&found, &budget)),
            Method::Ranked => text::by_group(&found, &budget, paint),
            Method::Possible | Method::Cubes => text::by_coil(&found, &budget, paint),
        }
    };
    if budget.cancel.is_cancelled() {
        return Ok(Status::Interrupted);
    }
    io.answer().write_all(answer.as_bytes())?;
    if let Some(note) = note {
        let name = printable(&ladder.name());
        io.aside(&format!("{name}: {note}\n"))?;
    }
    Ok(ladder.status())
}

fn find<'a>(method: Method, analysis: &'a Analysis, budget: &Budget) -> Found<'a> {
    let conditions = &analysis.conditions;
    let (states, suggestions) = match method {
        Method::Ranked => (states(analysis), analysis.successions().to_vec()),
        Method::Possible => (coils(analysis), successions::possible(conditions, budget)),
        Method::Cubes => (coils(analysis), successions::cubes(conditions, budget)),
    };
    Found {
        states,
        suggestions,
        analysis,
    }
}

/// The states, those of registers last.
fn states(analysis: &Analysis) -> Vec<Name> {
    let bits = analysis
        .states()
        .states
        .iter()
        .map(|state| state.name.clone());
    let values = analysis.registers.iter().flat_map(|register| {
        let values = register.states.iter();
        values.map(|state| register.state_name(state.value))
    });
    bits.chain(values).collect()
}

/// Every coil: the published method lets all rungs take part.
fn coils(analysis: &Analysis) -> Vec<Name> {
    let variables = analysis.conditions.variables.iter();
    variables.map(|variable| variable.name.clone()).collect()
}
