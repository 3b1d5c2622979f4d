//! Names of steps and transitions: unique, stable, and telling.
//!
//! They are made of the states' names alone, never counted through the file,
//! so that accepting one succession renames nothing else.

use std::collections::HashSet;

use logic::{Atom, Name};

use crate::Analysis;

/// Names given so far; a name means one thing in a spec.
pub(super) struct Names {
    taken: HashSet<Name>,
    labels: HashSet<Name>,
}

impl Names {
    /// With every variable of the program taken, so that no step is called
    /// like one.
    pub(super) fn new(analysis: &Analysis) -> Self {
        let variables = analysis
            .conditions
            .atoms
            .iter()
            .filter_map(|(_, atom)| match atom {
                Atom::Variable(name) => Some(name.clone()),
                _ => None,
            });
        let declared = analysis
            .program
            .declarations
            .iter()
            .map(|it| it.name.clone());
        Self {
            taken: variables.chain(declared).collect(),
            labels: HashSet::new(),
        }
    }

    /// A step called `wanted`, or as near to it as is free.
    pub(super) fn step(&mut self, wanted: &str) -> Name {
        let name = self.free(wanted);
        self.taken.insert(name.clone());
        name
    }

    /// A transition called `wanted`, or as near to it as is free.
    pub(super) fn transition(&mut self, wanted: &str) -> Name {
        let name = self.free(wanted);
        self.labels.insert(name.clone());
        name
    }

    fn free(&self, wanted: &str) -> Name {
        let is_free = |name: &Name| !self.taken.contains(name) && !self.labels.contains(name);
        let first: Name = wanted.into();
        if is_free(&first) {
            return first;
        }
        let numbered = |number: usize| -> Name { format!("{wanted}_{number}").into() };
        (2..).map(numbered).find(is_free).unwrap_or(first)
    }
}

/// The part of a name that tells it from its neighbours: `Index` of
/// `Milling_1.Index`.
pub(super) fn short(name: &str) -> &str {
    name.rsplit('.')
        .next()
        .filter(|tail| !tail.is_empty())
        .unwrap_or(name)
}
