//! `gradus conditions`: what starts, keeps and ends every coil.

use std::io::Write;
use std::path::PathBuf;

use logic::Budget;
use recovery::Analysis;

use crate::colour::Paint;
use crate::input::numbered;
use crate::io::Io;
use crate::program::{self, Ladder};
use crate::report::printable;
use crate::status::Status;

mod json;
mod text;

use ide::Coil;

const DETAILS: &str = "\
A condition is an irredundant sum of products over the coil, other coils and
inputs: `*` and, `+` or, `/` not. For a coil Q whose rung gives it the value g:

  activation    g, the value after the scan
  turns on      g with Q off: what starts it
  stays on      g with Q on: what keeps it
  deactivation  not g with Q on: what ends it (`turns off`)

Where a coil is written in several places these are of all of them together. An
interlock is a normally closed contact of another coil that holds a state. What
an unknown box does is opaque: a variable of its own. The resolved form has the
conditions of auxiliary coils, such as transition bits, in their place.

A condition `supposes` a variable at rest that is written between contacts which
see it, in one rung or several: these see different values in a scan in which it
changes, and the condition says what happens in all others.

JSON:
  {\"file\", \"format\", \"rungs\": [{\"scope\", \"rung\", \"coil\", \"address\",
    \"description\", \"kind\", \"persistent\", \"activation\", \"turns_on\", \"stays_on\",
    \"deactivation\", \"interlocks\": [], \"opaque\": [],
    \"at_rest\": [{\"name\", \"scope\", \"rung\"}], \"guard\", \"solved\",
    \"resolved\": {\"activation\", \"turns_on\", \"stays_on\", \"deactivation\"},
    \"too_large\", \"span\": {\"start\", \"end\"}, \"coil_span\": {\"start\", \"end\"}}]}
  One entry for every coil that is drawn, in the order of the source. `kind` is
  plain, negated, set, reset, rising or falling. `guard` is the power at this
  coil alone, `solved` when its rung is solved at all. `resolved` is null where
  it says nothing new. `at_rest` has what the conditions suppose to be so, each
  with the first rung that writes it in between, null if that is not known. A
  condition past the budget is null and `too_large` true. `span` is the rung,
  `coil_span` the coil, in bytes of the file.

Exit status: 1 if the text of the ladder has errors; what was understood is
answered all the same.

Examples:
  gradus conditions line3.L5X
  gradus conditions --coil v2 --coil %Q3 tank.ladder
  gradus conditions --json line3.L5X | jq '.rungs[] | select(.persistent).coil'";

/// Show what starts, keeps and ends every coil.
#[derive(Debug, clap::Args)]
#[command(after_long_help = DETAILS)]
pub struct Args {
    /// The ladder; `-` is standard input.
    #[arg(value_name = "FILE")]
    file: PathBuf,

    /// Only this coil, by its name or address; may be given several times.
    #[arg(long, value_name = "NAME")]
    coil: Vec<String>,

    /// Only coils of the rung with this number.
    #[arg(long, value_name = "NUMBER")]
    rung: Option<u32>,

    /// The most nodes that a decision diagram may have.
    #[arg(long, value_name = "NODES", default_value_t = Budget::default().nodes)]
    budget: usize,

    /// Answer in JSON.
    #[arg(long)]
    json: bool,
}

/// Answers about the coils that were asked for.
pub fn run(args: &Args, io: &mut Io) -> std::io::Result<Status> {
    let Some(ladder) = program::read(&args.file, io)? else {
        return Ok(Status::Usage);
    };
    let budget = within(args.budget, io);
    let Some(analysis) = program::analyse(&ladder, &budget) else {
        return Ok(Status::Interrupted);
    };
    let mut coils = {
        let _progress = program::progress("Wording", &ladder);
        ide::coils(&analysis, &budget)
    };
    if let Some(missing) = narrow(&mut coils, args) {
        io.complain(&format!("{}: {missing}", printable(&ladder.name())));
        return Ok(Status::Usage);
    }
    if budget.cancel.is_cancelled() {
        return Ok(Status::Interrupted);
    }
    if args.json {
        writeln!(io.answer(), "{:#}", json::json(&ladder, &coils))?;
        return Ok(ladder.status());
    }
    let paint = io.answer_paint();
    for coil in &coils {
        io.answer().write_all(text::block(coil, paint).as_bytes())?;
    }
    io.aside(&sum(&ladder, &coils))?;
    Ok(ladder.status())
}

/// What the command says of all coils, without colours.
pub fn plain_text(analysis: &Analysis, budget: &Budget) -> String {
    let coils = ide::coils(analysis, budget);
    let blocks = coils.iter().map(|coil| text::block(coil, Paint::PLAIN));
    blocks.collect()
}

/// The budget with `nodes`, and as many products as the usual one has in
/// proportion.
fn within(nodes: usize, io: &Io) -> Budget {
    let usual = Budget::default();
    let nodes_a_product = usual.nodes / usual.products;
    Budget {
        nodes,
        products: nodes.div_ceil(nodes_a_product),
        cancel: io.cancel().clone(),
    }
}

/// Keeps the coils that were asked for. What was asked for and is not there is
/// the answer.
fn narrow(coils: &mut Vec<Coil<'_>>, args: &Args) -> Option<String> {
    for name in &args.coil {
        if !coils.iter().any(|coil| coil.is_called(name)) {
            return Some(format!("there is no coil `{}`", printable(name)));
        }
    }
    if let Some(number) = args.rung {
        for coil in coils.iter_mut() {
            coil.writes.retain(|write| write.rung.number == number);
        }
        coils.retain(|coil| !coil.writes.is_empty());
        if coils.is_empty() {
            return Some(format!("no rung with the number {number} has a coil"));
        }
    }
    let is_wanted =
        |coil: &Coil<'_>| args.coil.is_empty() || args.coil.iter().any(|name| coil.is_called(name));
    coils.retain(is_wanted);
    None
}

fn sum(ladder: &Ladder, coils: &[Coil<'_>]) -> String {
    let holding = coils.iter().filter(|coil| coil.persistent).count();
    let name = printable(&ladder.name());
    let verb = if holding == 1 { "holds" } else { "hold" };
    format!(
        "{name}: {}, {holding} {verb} a value\n",
        numbered(coils.len(), "coil")
    )
}
