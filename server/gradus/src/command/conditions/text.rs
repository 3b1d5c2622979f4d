//! Coils for people: a block each.

use ladder::CoilKind;

use crate::colour::Paint;
use crate::condition::broken;
use crate::report::printable;
use ide::{Coil, Drawn, Part, Said};

/// The column at which conditions begin.
const COLUMN: usize = 14;

const TOO_LARGE: &str = "too large; --budget allows more nodes";

/// What there is to say about a coil, followed by an empty line.
pub fn block(coil: &Coil<'_>, paint: Paint) -> String {
    let mut out = paint.bold(&printable(coil.name));
    if let Some(address) = coil.address {
        out += &format!("  {}", printable(address));
    }
    if let Some(description) = &coil.description {
        out += &format!("  {}", printable(description));
    }
    out.push('\n');
    for write in &coil.writes {
        out += &place(write, coil);
    }
    if coil.part != Part::TooLarge {
        out += &format!("  {}\n", part(coil.part));
    }
    conditions(&mut out, coil.conditions.as_ref(), coil.part, paint);
    if !coil.interlocks.is_empty() {
        field(&mut out, "interlocks", &coil.interlocks.join(", "), paint);
    }
    if !coil.opaque.is_empty() {
        field(&mut out, "opaque", &coil.opaque.join(", "), paint);
    }
    for (nth, at_rest) in coil.at_rest.iter().enumerate() {
        let name = if nth == 0 { "supposes" } else { "" };
        field(&mut out, name, &at_rest.in_words(), paint);
    }
    if let Some(resolved) = &coil.resolved {
        out += "  with auxiliary coils resolved\n";
        conditions(&mut out, Some(resolved), coil.part, paint);
    }
    out.push('\n');
    out
}

/// `  rung 3 of Main: set coil, when a*b`.
fn place(write: &Drawn<'_>, coil: &Coil<'_>) -> String {
    let kind = match write.kind {
        CoilKind::Plain => "coil",
        CoilKind::Negated => "negated coil",
        CoilKind::Set => "set coil",
        CoilKind::Reset => "reset coil",
        CoilKind::Rising => "coil of a rise",
        CoilKind::Falling => "coil of a fall",
    };
    let scope = printable(&write.routine.scope);
    let of = if scope.is_empty() { "" } else { " of " };
    let mut line = format!("  rung {}{of}{scope}: {kind}", write.rung.number);
    if coil.writes.len() > 1 || write.kind != CoilKind::Plain {
        let guard = write.guard.as_deref().unwrap_or(TOO_LARGE);
        let start = line.chars().count() + ", when ".len();
        line += &format!(", when {}", broken(&printable(guard), start));
    }
    match write.solved.as_deref() {
        Some("1") => {}
        Some("0") => line += "; never solved",
        Some(solved) => line += &format!("; solved when {}", printable(solved)),
        None => line += &format!("; when it is solved is {TOO_LARGE}"),
    }
    line + "\n"
}

fn part(part: Part) -> &'static str {
    match part {
        Part::State => "holds a state",
        Part::Repeats => "stored output: states set and reset it",
        Part::Keeps => "keeps its value, but never both starts and ends",
        Part::KeptWhenSkipped => "keeps its value while its rung is skipped",
        Part::Oscillates => "falls in itself",
        Part::Auxiliary => "auxiliary: carries a condition to other rungs",
        Part::Follows => "follows its condition",
        Part::TooLarge => TOO_LARGE,
    }
}

fn conditions(out: &mut String, said: Option<&Said>, part: Part, paint: Paint) {
    let Some(said) = said else {
        field(out, "conditions", TOO_LARGE, paint);
        return;
    };
    if matches!(part, Part::Follows | Part::Auxiliary) {
        field(out, "on while", &said.activation, paint);
        return;
    }
    field(out, "turns on", &said.turns_on, paint);
    field(out, "stays on", &said.stays_on, paint);
    field(out, "turns off", &said.deactivation, paint);
}

fn field(out: &mut String, name: &str, text: &str, paint: Paint) {
    let name = format!("  {name:<width$}", width = COLUMN - 2);
    let text = broken(&printable(text), COLUMN);
    out.push_str(&format!("{}{text}\n", paint.faint(&name)));
}
