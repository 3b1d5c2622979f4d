//! Every write of a program, in the order of the scan.

use std::collections::{BTreeSet, HashMap};
use std::sync::Arc;

use ladder::{CoilKind, Program, Value};
use logic::{Atom, AtomId, Function, Name, Stop};
use petgraph::graph::NodeIndex;
use source::Span;

use super::Walk;
use super::rung::Effect;
use super::visits::{Occurrence, conjoined};

/// Where an element stands in its program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Place {
    /// Place of the routine in [`Program::routines`].
    pub routine: usize,
    /// Place of the rung in its routine.
    pub rung: usize,
    /// Place of the element in its network.
    pub element: usize,
}

impl Place {
    /// The routine and the rung.
    pub(crate) fn rung(&self) -> (usize, usize) {
        (self.routine, self.rung)
    }

    /// The bytes of the element at the place; none if it is not in `program`.
    pub fn span(&self, program: &Program) -> Span {
        let routine = program.routines.get(self.routine);
        let rung = routine.and_then(|routine| routine.rungs.get(self.rung));
        let rung = rung.filter(|rung| self.element < rung.network.len());
        rung.map_or(Span::default(), |rung| {
            rung.place(rung.network.element(NodeIndex::new(self.element)).within)
        })
    }
}

/// How a write changes a Boolean variable.
#[derive(Clone, Debug, PartialEq)]
pub enum WriteKind {
    /// A coil.
    Coil(CoilKind),
    /// A bit written through its word by a constant: 1 sets, 0 resets.
    Bit(bool),
    /// A bit copied from the same bit of another word.
    BitOf(AtomId),
    /// Written by a box; the value is unknown.
    Unknown(AtomId),
}

/// One write of a Boolean variable.
#[derive(Clone, Debug, PartialEq)]
pub struct Write {
    /// The variable.
    pub target: AtomId,
    /// How.
    pub kind: WriteKind,
    /// The power at the element, over what its contacts see.
    pub guard: Result<Function, Stop>,
    /// The condition under which the rung is solved at all; true for most.
    pub solved: Result<Function, Stop>,
    /// The condition of the master control zone around it; true for most.
    pub zone: Result<Function, Stop>,
    /// Where.
    pub place: Place,
    /// Coils that stand as normally closed contacts before it.
    pub closed_contacts: Arc<BTreeSet<AtomId>>,
    /// Where contacts of the variable before it see what an earlier write on
    /// the same rung has written: the guard with that in their place, over the
    /// value before the rung.
    pub effective: Option<Result<Function, Stop>>,
}

impl Write {
    /// The same write at another place.
    pub(super) fn moved_to(&self, place: Place) -> Self {
        Self {
            place,
            ..self.clone()
        }
    }
}

/// One write of a number.
#[derive(Clone, Debug)]
pub struct RegisterWrite {
    /// The variable.
    pub target: Name,
    /// What is written.
    pub value: Value,
    /// The power at the element, and that the rung is solved.
    pub guard: Result<Function, Stop>,
    /// Where.
    pub place: Place,
    /// The bytes of the element.
    pub span: Span,
}

/// Tells words and bits apart: a write of a whole word is one of each of its
/// bits that a contact or coil of the program names, and, as a number, one of
/// the word.
pub(super) fn writes(
    occurrences: &[Occurrence],
    program: &Program,
    walk: &mut Walk<'_>,
) -> (Vec<Write>, Vec<RegisterWrite>) {
    let is_coil = |it: &Occurrence| matches!(it.event.effect, Effect::Coil(..));
    let bits = match occurrences.iter().all(is_coil) {
        true => HashMap::new(),
        false => bits_of_words(walk),
    };
    let mut writes = Vec::new();
    let mut register_writes = Vec::new();
    for occurrence in occurrences {
        match occurrence.event.effect {
            Effect::Coil(target, kind) => {
                writes.push(write(occurrence, target, WriteKind::Coil(kind)));
            }
            Effect::Assign(ref assignment) => {
                let name = &assignment.target.name;
                for (bit, atom) in bits.get(name).into_iter().flatten() {
                    let kind = written_bit(&assignment.value, name, *bit, walk);
                    writes.push(write(occurrence, *atom, kind));
                }
                if let Some(atom) = walk.atoms.find_variable(name) {
                    let kind = written_whole(&assignment.value, name, walk);
                    writes.push(write(occurrence, atom, kind));
                }
                register_writes.push(RegisterWrite {
                    target: name.clone(),
                    value: assignment.value.clone(),
                    guard: conjoined(
                        &[
                            &occurrence.event.guard,
                            &occurrence.solved,
                            &occurrence.zone,
                        ],
                        walk.budget,
                    ),
                    place: occurrence.place,
                    span: occurrence.place.span(program),
                });
            }
            Effect::Unknown { ref target, ref by } => {
                let targets: Vec<AtomId> = bits
                    .get(target)
                    .into_iter()
                    .flatten()
                    .map(|(_, atom)| *atom)
                    .chain(walk.atoms.find_variable(target))
                    .collect();
                for atom in targets {
                    let unknown = unknown_value(by, target, walk);
                    writes.push(write(occurrence, atom, WriteKind::Unknown(unknown)));
                }
            }
        }
    }
    (writes, register_writes)
}

fn write(occurrence: &Occurrence, target: AtomId, kind: WriteKind) -> Write {
    let event = &occurrence.event;
    Write {
        target,
        kind,
        guard: event.guard.clone(),
        solved: occurrence.solved.clone(),
        zone: occurrence.zone.clone(),
        place: occurrence.place,
        closed_contacts: Arc::clone(&event.closed_contacts),
        effective: event.effective.clone(),
    }
}

/// The bits that the program names, by their word: `W.3` is bit 3 of `W`.
fn bits_of_words(walk: &Walk<'_>) -> HashMap<Name, Vec<(u32, AtomId)>> {
    let mut bits: HashMap<Name, Vec<(u32, AtomId)>> = HashMap::new();
    for (atom, it) in walk.atoms.iter() {
        let Atom::Variable(name) = it else { continue };
        if let Some((word, bit)) = name.rsplit_once('.')
            && let Ok(bit) = bit.parse()
        {
            bits.entry(word.into()).or_default().push((bit, atom));
        }
    }
    bits
}

fn written_bit(value: &Value, word: &Name, bit: u32, walk: &mut Walk<'_>) -> WriteKind {
    match value {
        Value::Constant(number) => {
            // Bits beyond 63 repeat the sign, as in a longer two's complement.
            WriteKind::Bit(number >> bit.min(63) & 1 == 1)
        }
        Value::Copy(source) => {
            let source = format!("{}.{bit}", source.name).into();
            WriteKind::BitOf(walk.atoms.add_variable(&source))
        }
        Value::Increment(_) | Value::Term { .. } => {
            WriteKind::Unknown(unknown_value(&"value".into(), word, walk))
        }
    }
}

fn written_whole(value: &Value, target: &Name, walk: &mut Walk<'_>) -> WriteKind {
    match value {
        Value::Constant(number) => WriteKind::Bit(*number != 0),
        Value::Copy(source) => WriteKind::BitOf(walk.atoms.add_variable(&source.name)),
        Value::Increment(_) | Value::Term { .. } => {
            WriteKind::Unknown(unknown_value(&"value".into(), target, walk))
        }
    }
}

/// An atom for a value that is not understood.
fn unknown_value(by: &Name, target: &Name, walk: &mut Walk<'_>) -> AtomId {
    let atom = walk.atoms.add_variable(&format!("{by}({target})").into());
    walk.opaque.insert(atom);
    atom
}
