//! Which pairs of conditions are worth comparing.

use std::collections::BTreeSet;

use logic::{AtomId, Function};
use rustc_hash::FxHashMap;

/// An atom that more conditions than this depend on does not tell them apart:
/// every pair shares it.
pub(super) const COMMON: usize = 40;

/// An index of functions by the atoms they depend on.
#[derive(Debug, Default)]
pub(super) struct ByAtom {
    users: FxHashMap<AtomId, Vec<usize>>,
}

impl ByAtom {
    /// Indexes functions by their place in the iteration.
    pub(super) fn new<'f>(functions: impl IntoIterator<Item = &'f Function>) -> Self {
        let mut users: FxHashMap<AtomId, Vec<usize>> = FxHashMap::default();
        for (at, function) in functions.into_iter().enumerate() {
            for atom in function.support() {
                users.entry(*atom).or_default().push(at);
            }
        }
        Self { users }
    }

    /// Places of the functions that share an atom with `function`, ascending,
    /// not counting atoms that more than `most` functions depend on: a
    /// condition that is common to all, such as an emergency stop, says
    /// nothing about a sequence.
    pub(super) fn sharing(&self, function: &Function, most: usize) -> BTreeSet<usize> {
        function
            .support()
            .iter()
            .filter_map(|atom| self.users.get(atom))
            .filter(|users| users.len() <= most)
            .flatten()
            .copied()
            .collect()
    }
}

/// An index of functions by the literals they depend on: an atom counts as
/// positive where raising it can raise the function, as negative where it can
/// lower it.
///
/// A function implies another, neither constant, only if they share a literal
/// (Lyndon's interpolation theorem), so that no implication is missed by
/// comparing only functions that do. An emergency stop, a negative literal of
/// all that starts and a positive one of all that ends, joins no pair.
#[derive(Debug, Default)]
pub(super) struct ByLiteral {
    users: FxHashMap<(AtomId, bool), Vec<usize>>,
}

impl ByLiteral {
    /// Indexes functions, given by their literals, by their place in the
    /// iteration.
    pub(super) fn new<'f>(functions: impl IntoIterator<Item = &'f [(AtomId, bool)]>) -> Self {
        let mut users: FxHashMap<(AtomId, bool), Vec<usize>> = FxHashMap::default();
        for (at, literals) in functions.into_iter().enumerate() {
            for literal in literals {
                users.entry(*literal).or_default().push(at);
            }
        }
        Self { users }
    }

    /// Places of the functions that have one of `literals`, not counting those
    /// that are [common](COMMON); a place as often as they share one.
    pub(super) fn sharing(&self, literals: &[(AtomId, bool)]) -> impl Iterator<Item = usize> {
        literals
            .iter()
            .filter_map(|literal| self.users.get(literal))
            .filter(|users| users.len() <= COMMON)
            .flatten()
            .copied()
    }

    /// The atoms of all common literals.
    pub(super) fn common(&self) -> BTreeSet<AtomId> {
        let common = self.users.iter().filter(|(_, users)| users.len() > COMMON);
        common.map(|((atom, _), _)| *atom).collect()
    }
}

/// Diagrams larger than this are not asked for the signs of their atoms: to
/// know them would cost more than comparing a few pairs for nothing.
const LARGE: usize = 300;

/// The literals by which a function depends on its atoms; both of an atom where
/// that would take long to tell.
pub(super) fn literals(function: &Function) -> Vec<(AtomId, bool)> {
    if function.nodes() > LARGE {
        let atoms = function.support().iter();
        return atoms
            .flat_map(|atom| [(*atom, false), (*atom, true)])
            .collect();
    }
    let literals = function.literals().into_iter();
    literals.map(|it| (it.atom, it.positive)).collect()
}
