//! The machine as a circuit: contacts look at its variables, coils and boxes
//! write them.

use std::collections::HashMap;

use petgraph::graph::{EdgeIndex, NodeIndex};

use super::atom::{memory_atom, own_atom, pin_atom};
use super::power::{Circuit, Inputs, edge_of};
use super::state::State;
use super::timer::Clock;
use super::{Datum, counter, timer};
use crate::{
    Assignment, Coil, CoilKind, Contact, ContactKind, Edge, Element, ElementKind, Network, OneShot,
    Value,
};

/// Where an edge keeps what it saw last.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Memory {
    Element(usize, usize, NodeIndex),
    Wire(usize, usize, EdgeIndex),
}

/// A rung of the machine while it is solved.
pub(super) struct Solving<'m> {
    pub(super) routine: usize,
    pub(super) rung: usize,
    pub(super) network: &'m Network,
    pub(super) state: &'m mut State,
    pub(super) memories: &'m mut HashMap<Memory, bool>,
    pub(super) clock: &'m mut Clock,
}

impl Solving<'_> {
    /// What the memory of an element held; it now holds `now`.
    fn remember(&mut self, at: NodeIndex, now: bool) -> bool {
        let memory = Memory::Element(self.routine, self.rung, at);
        self.memories.insert(memory, now).unwrap_or(false)
    }

    /// The value of an operand that may be a term. A term that cannot be
    /// computed is an input by the name of its text.
    fn operand(&self, text: &str) -> Datum {
        match self.state.compute(text) {
            Some(value) => value,
            None => self.state.read(text),
        }
    }

    fn contact(&mut self, at: NodeIndex, contact: &Contact) -> bool {
        let on = self.state.read(&contact.operand.name).is_on();
        match contact.kind {
            ContactKind::Open => on,
            ContactKind::Closed => !on,
            ContactKind::Rising => edge_of(Edge::Rising, self.remember(at, on), on),
            ContactKind::Falling => edge_of(Edge::Falling, self.remember(at, on), on),
        }
    }

    fn coil(&mut self, at: NodeIndex, coil: &Coil, power: bool) {
        let value = match coil.kind {
            CoilKind::Plain => power,
            CoilKind::Negated => !power,
            CoilKind::Set if power => true,
            CoilKind::Reset if power => false,
            CoilKind::Set | CoilKind::Reset => return,
            CoilKind::Rising => edge_of(Edge::Rising, self.remember(at, power), power),
            CoilKind::Falling => edge_of(Edge::Falling, self.remember(at, power), power),
        };
        self.state.write(&coil.operand.name, value.into());
    }

    fn assign(&mut self, assignment: &Assignment) {
        let target = &assignment.target.name;
        let value = match &assignment.value {
            Value::Constant(number) => Datum::Integer(*number),
            Value::Copy(operand) => self.operand(&operand.name),
            Value::Increment(by) => self.state.read(target).combine(
                Datum::Integer(*by),
                i64::wrapping_add,
                |own, by| own + by,
            ),
            Value::Term { text, .. } => self.operand(text),
        };
        self.state.write(target, value);
    }
}

impl Circuit for Solving<'_> {
    fn conducts(&mut self, at: NodeIndex, element: &Element) -> bool {
        match &element.kind {
            ElementKind::Contact(contact) => self.contact(at, contact),
            ElementKind::Comparison(comparison) => {
                let left = self.operand(&comparison.left.name);
                let right = self.operand(&comparison.right.name);
                left.compares(comparison.relation, right)
            }
            _ => true,
        }
    }

    fn fires(&mut self, at: NodeIndex, shot: &OneShot, power: bool) -> bool {
        let before = match &shot.memory {
            None => self.remember(at, power),
            Some(_) => {
                let memory = memory_atom(self.network, at);
                let before = self.state.read(&memory).is_on();
                self.state.write(&memory, power.into());
                before
            }
        };
        edge_of(shot.edge, before, power)
    }

    fn sees_edge(&mut self, wire: EdgeIndex, edge: Edge, signal: bool) -> bool {
        let memory = Memory::Wire(self.routine, self.rung, wire);
        let before = self.memories.insert(memory, signal).unwrap_or(false);
        edge_of(edge, before, signal)
    }

    fn at_pin(&mut self, at: NodeIndex, pin: &str) -> bool {
        self.state.read(&pin_atom(self.network, at, pin)).is_on()
    }

    fn shapes(&mut self, at: NodeIndex) -> bool {
        self.state.read(&own_atom(self.network, at)).is_on()
    }

    fn act(&mut self, at: NodeIndex, element: &Element, power: bool, inputs: &Inputs<'_>) {
        match &element.kind {
            ElementKind::Coil(coil) => self.coil(at, coil, power),
            ElementKind::Assign(assignment) if power => self.assign(assignment),
            ElementKind::ResetBox(operand) if power => counter::reset(&operand.name, self.state),
            ElementKind::Timer(of) => {
                let reset = inputs.pin("R").or_else(|| inputs.pin("RESET"));
                let reset = reset.unwrap_or(false);
                timer::solve(of, power, reset, self.clock, self.state);
            }
            ElementKind::Counter(of) => counter::solve(of, power, inputs, self.state),
            _ => {}
        }
    }
}
