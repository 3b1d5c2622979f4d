//! Writes any program as a `.ladder` text.
//!
//! The text says what the program does, rung by rung, in the canonical layout:
//! a readable form of what lies in XML, and one that can be compared line by
//! line. Reading it gives the conditions of every output back. What the
//! notation has no words for is listed, never left out in silence.

mod branches;
mod cuts;
mod draw;
mod legs;
mod order;
mod output;
mod part;

use logic::notation::{quoted, quoted_value};
use petgraph::graph::NodeIndex;
use source::Span;

use super::layout::format;
use crate::{Class, Declaration, ElementKind, Network, Program, Role, Routine, Rung};
pub use branches::branches;
use cuts::{DEEPEST, TooTangled};
pub use draw::draw;
use legs::{Driven, Leg, legs};

/// A program as text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Written {
    /// The whole text, in the canonical layout.
    pub text: String,
    /// What the text does not say, in the order of the program.
    pub lost: Vec<Lost>,
}

/// Something that the notation has no words for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Lost {
    /// Where it stands in the source of the program.
    pub span: Span,
    /// What it is, as the end of the sentence "the text leaves out ...".
    pub what: String,
}

/// Writes a program.
///
/// Every rung has one statement. A rung whose legs are bridged so often that
/// its condition would be many times longer than the rung becomes a comment.
pub fn write(program: &Program) -> Written {
    let mut text = String::new();
    let mut lost = Vec::new();
    let first_unit = program.routines.first().map(|routine| &routine.unit);
    let mut unit = first_unit.unwrap_or(&program.name).clone();
    if !unit.is_empty() {
        line(&mut text, &format!("program {}", quoted(&unit)));
    }
    if !program.declarations.is_empty() {
        text.push('\n');
    }
    for declaration in program.declarations.iter() {
        line(&mut text, &written_declaration(declaration));
    }
    for (at, routine) in program.routines.iter().enumerate() {
        text.push('\n');
        let begins_unit = at == 0 || routine.unit != unit;
        if routine.unit != unit {
            unit = routine.unit.clone();
            line(&mut text, &format!("program {}", quoted(&unit)));
        }
        if !(begins_unit && is_nameless(routine)) {
            line(&mut text, &written_routine(routine));
        }
        for rung in &routine.rungs {
            write_rung(rung, &mut text, &mut lost);
        }
    }
    for chart in &program.charts {
        lost.push(Lost {
            span: chart.span,
            what: format!("the chart `{}`", chart.scope),
        });
    }
    Written {
        text: format(&text).text,
        lost,
    }
}

fn line(text: &mut String, line: &str) {
    text.push_str(line);
    text.push('\n');
}

/// Whether the rungs of a routine stand right below the `program` line.
fn is_nameless(routine: &Routine) -> bool {
    let name = match &*routine.unit {
        "" => "main",
        unit => unit,
    };
    routine.role == Role::Main && &*routine.name == name && !routine.rungs.is_empty()
}

fn written_routine(routine: &Routine) -> String {
    let name = quoted(&routine.name);
    match routine.role {
        Role::Main => format!("routine {name} main"),
        Role::Called => format!("routine {name}"),
        Role::Definition => format!("routine {name} block"),
    }
}

fn written_declaration(declaration: &Declaration) -> String {
    let keyword = match declaration.class {
        Class::Input => "input",
        Class::Output => "output",
        Class::InOut => "inout",
        Class::Internal => "internal",
        Class::Constant => "constant",
        Class::Unknown => "variable",
    };
    let mut text = format!("{keyword} {}", quoted(&declaration.name));
    match &declaration.address {
        Some(address) if *address == declaration.name => {}
        Some(address) if quoted(address).starts_with('%') => text.push_str(&format!(" {address}")),
        Some(address) => text.push_str(&format!(" at {}", quoted(address))),
        None => {}
    }
    if let Some(data_type) = &declaration.data_type {
        text.push_str(&format!(" : {}", quoted(data_type)));
    }
    if let Some(initial) = &declaration.initial {
        text.push_str(&format!(" = {}", quoted_value(initial)));
    }
    if let Some(description) = &declaration.description {
        let words: Vec<_> = description.split_whitespace().collect();
        text.push_str(&format!(" // {}", words.join(" ")));
    }
    text
}

/// Titles longer than this are comments above the rung.
const LONGEST_TITLE: usize = 60;

fn write_rung(rung: &Rung, text: &mut String, lost: &mut Vec<Lost>) {
    let network = &rung.network;
    let mut comment = rung.comment.as_deref().unwrap_or_default().trim().lines();
    let mut head = "rung".to_owned();
    let mut first = comment.next().map(str::trim);
    if let Some(title) = first
        && !title.is_empty()
        && title.chars().count() <= LONGEST_TITLE
        && !title.contains(['"', '\r'])
    {
        head.push_str(&format!(" \"{title}\""));
        first = None;
    }
    for above in first.into_iter().chain(comment) {
        let words: Vec<_> = above.split_whitespace().collect();
        line(text, format!("// {}", words.join(" ")).trim_end());
    }
    let label = network
        .elements()
        .nth(1)
        .and_then(|(_, first)| match &first.kind {
            ElementKind::Label(label) => Some(label),
            _ => None,
        });
    if let Some(label) = label {
        head.push_str(&format!(" label {}", quoted(&label.name)));
    }
    leave_out(rung, lost);
    let body = match legs(network).and_then(|legs| {
        lost.extend(order::changed(rung, &legs));
        body(rung, &legs, lost)
    }) {
        Ok(body) => body,
        Err(TooTangled) => {
            lost.push(Lost {
                span: rung.span,
                what: "a rung whose legs are bridged too often to be written".to_owned(),
            });
            line(
                text,
                &format!("// {head}: a rung that is too tangled to be written"),
            );
            return;
        }
    };
    line(text, &format!("{head}: {body}"));
}

/// `CONDITION -> OUTPUTS`
fn body(rung: &Rung, legs: &[Leg], lost: &mut Vec<Lost>) -> Result<String, TooTangled> {
    let Some(whole) = legs.first() else {
        return Ok(String::new());
    };
    if !whole.drives.is_empty() {
        return leg(rung, legs, whole, 0, lost);
    }
    Ok(match whole.condition.is_always() {
        true => String::new(),
        false => part::text(&whole.condition, &|at| rung.network.element(at)),
    })
}

fn leg(
    rung: &Rung,
    legs: &[Leg],
    this: &Leg,
    depth: usize,
    lost: &mut Vec<Lost>,
) -> Result<String, TooTangled> {
    if depth > DEEPEST {
        return Err(TooTangled);
    }
    let mut outputs = Vec::new();
    for driven in &this.drives {
        match driven {
            Driven::Output(at) => {
                let element = rung.network.element(*at);
                let (output, left_out) = output::output(&element.kind);
                outputs.push(output);
                lost.extend(left_out.into_iter().map(|what| Lost {
                    span: rung.place(element.within),
                    what,
                }));
            }
            Driven::Leg(number) => {
                if let Some(inner) = legs.get(*number) {
                    let inner = leg(rung, legs, inner, depth + 1, lost)?;
                    outputs.push(format!("({inner})"));
                }
            }
        }
    }
    let condition = part::text(&this.condition, &|at| rung.network.element(at));
    Ok(format!("{condition} -> {}", outputs.join(", ")))
}

/// Lists what every rung leaves out: storage bits, labels inside, further
/// inputs of boxes, contacts that lead nowhere.
fn leave_out(rung: &Rung, lost: &mut Vec<Lost>) {
    let network = &rung.network;
    let has_outputs = network
        .elements()
        .any(|(_, element)| cuts::is_output(&element.kind));
    for (at, element) in network.elements() {
        let mut lose = |what: String| {
            lost.push(Lost {
                span: rung.place(element.within),
                what,
            });
        };
        match &element.kind {
            ElementKind::OneShot(shot) => {
                if let Some(memory) = &shot.memory {
                    lose(format!("the storage bit `{}`", memory.name));
                }
            }
            ElementKind::Label(label) if at.index() != 1 => {
                lose(format!("the label `{}` inside the rung", label.name));
            }
            ElementKind::Contact(_) | ElementKind::Comparison(_)
                if has_outputs && network.leaving(at).is_empty() =>
            {
                lose("a contact that leads nowhere".to_owned());
            }
            ElementKind::Timer(_) | ElementKind::Counter(_) | ElementKind::Block(_)
                if has_further_inputs(network, at) =>
            {
                lose("what is wired to further pins of the box".to_owned());
            }
            _ => {}
        }
    }
}

fn has_further_inputs(network: &Network, at: NodeIndex) -> bool {
    let ports = cuts::power_ports(network, at);
    let wires = network.arriving(at);
    wires
        .iter()
        .any(|(_, wire)| !ports.contains(&Some(wire.to.clone())))
}
