//! What a ladder's conditions reveal about it: the diagnostics of its meaning.
//!
//! Each finding is a file with one function; what the text of a file reveals
//! is said by its reader.

mod constant;
mod double_coil;
mod interlock;
mod latches;
mod order;
mod oscillator;
mod too_large;
mod unwritten;
mod words;

use ladder::{Element, ElementKind, Program, Rung};
use logic::{Budget, Name};
use petgraph::graph::NodeIndex;
use source::{Diagnostic, Span};

use crate::conditions::{Conditions, Place, Write};

/// A ladder and what is known of it.
struct Subject<'s> {
    program: &'s Program,
    conditions: &'s Conditions,
    budget: &'s Budget,
}

/// Everything that the conditions of `program` reveal, in the order of the
/// places.
pub fn findings(program: &Program, conditions: &Conditions, budget: &Budget) -> Vec<Diagnostic> {
    let subject = Subject {
        program,
        conditions,
        budget,
    };
    let mut found = conditions.execution.diagnostics.clone();
    for find in [
        constant::find,
        double_coil::find,
        interlock::find,
        latches::find,
        order::find,
        oscillator::find,
        too_large::find,
        unwritten::find,
        words::find,
    ] {
        found.extend(find(&subject));
    }
    found.sort_by_key(|diagnostic| (diagnostic.span, diagnostic.code));
    found
}

impl Subject<'_> {
    fn rung(&self, place: Place) -> Option<&Rung> {
        let routine = self.program.routines.get(place.routine)?;
        routine.rungs.get(place.rung)
    }

    fn element(&self, place: Place) -> Option<(&Rung, &Element)> {
        let rung = self.rung(place)?;
        let exists = place.element < rung.network.len();
        exists.then(|| (rung, rung.network.element(NodeIndex::new(place.element))))
    }

    /// The variable of the contact at a place, and where it is named.
    fn contact(&self, place: Place) -> Option<(&Name, Span)> {
        let (rung, element) = self.element(place)?;
        match &element.kind {
            ElementKind::Contact(contact) => {
                let operand = &contact.operand;
                Some((&operand.name, rung.place(operand.within)))
            }
            _ => None,
        }
    }

    /// The variable's name at the element that writes it, else the element.
    fn target_span(&self, write: &Write) -> Span {
        let Some((rung, element)) = self.element(write.place) else {
            return Span::default();
        };
        match &element.kind {
            ElementKind::Coil(coil) => rung.place(coil.operand.within),
            ElementKind::Assign(assignment) => rung.place(assignment.target.within),
            _ => rung.place(element.within),
        }
    }

    /// A rung as people name it: its routine and number.
    fn rung_name(&self, place: Place) -> String {
        let scope = self.program.routines.get(place.routine);
        let scope = scope.map_or("", |routine| &*routine.scope);
        let number = self.rung(place).map_or(0, |rung| rung.number);
        format!("rung {number} of {scope}")
    }
}
