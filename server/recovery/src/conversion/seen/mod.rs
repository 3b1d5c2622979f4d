//! What each rung sees of what others write: of this scan or of the last.
//!
//! Conditions are said over what contacts see, and a contact sees what was
//! written last. The same variable is the value of this scan below the rung
//! that writes it, that of the last scan above, and something between the two
//! among several rungs that do. The rules of a grafcet say which of them they
//! read, so here each is an atom of its own: that of the variable is what it
//! is after the scan, another what it was before. What is between the two is
//! put in as the writes up to there have it.

mod following;

use std::collections::{BTreeSet, HashMap};

use logic::{Atom, AtomId, Atoms, Budget, Function};

use super::unsaid::Unsaid;
use crate::Analysis;
use crate::order::names_in;

/// What own variables become in a scan, over atoms that say of which scan they
/// speak.
#[derive(Debug)]
pub(super) struct Seen {
    /// The atoms of the ladder, and behind them those of the last scan.
    pub(super) atoms: Atoms,
    /// Of a variable the atom of what it was before the scan.
    before: HashMap<AtomId, AtomId>,
    /// The same the other way round.
    of_before: HashMap<AtomId, AtomId>,
    next: HashMap<AtomId, Result<Function, Unsaid>>,
    /// Stands for a step that is active in the first scan only.
    pub(super) first: AtomId,
    /// Variables that are on before the first scan.
    initial: BTreeSet<AtomId>,
}

impl Seen {
    pub(super) fn new(analysis: &Analysis, budget: &Budget) -> Self {
        following::followed(analysis, budget)
    }

    /// What the variable is after the scan; its own atom is what it was
    /// before.
    pub(super) fn next(&self, atom: AtomId) -> Result<&Function, Unsaid> {
        match self.next.get(&atom) {
            Some(Ok(next)) => Ok(next),
            Some(Err(why)) => Err(why.clone()),
            None => Err(Unsaid::Written),
        }
    }

    /// Whether the variable is one that the program's own coils write.
    pub(super) fn is_own(&self, atom: AtomId) -> bool {
        self.before.contains_key(&atom)
    }

    /// The variable of which `atom` says what it was before the scan.
    pub(super) fn of_before(&self, atom: AtomId) -> Option<AtomId> {
        self.of_before.get(&atom).copied()
    }

    /// The atom that says what a variable was before the scan.
    pub(super) fn before(&self, atom: AtomId) -> Option<AtomId> {
        self.before.get(&atom).copied()
    }

    /// Whether the variable is on before the first scan.
    pub(super) fn is_initial(&self, atom: AtomId) -> bool {
        self.initial.contains(&atom)
    }

    /// The own variables in the expression of an edge, with whether it means
    /// what they were before the scan.
    pub(super) fn in_edge(&self, atom: AtomId) -> Vec<(AtomId, bool)> {
        let (Atom::Rise(inner) | Atom::Fall(inner)) = self.atoms.atom(atom) else {
            return Vec::new();
        };
        let ids = names_in(inner).into_iter();
        let ids = ids.filter_map(|name| self.atoms.find_variable(&name));
        ids.filter_map(|id| match self.of_before(id) {
            Some(of) => Some((of, true)),
            None => self.is_own(id).then_some((id, false)),
        })
        .collect()
    }
}
