use std::collections::BTreeSet;
use std::sync::Arc;

use logic::AtomId;

use super::{State, StoredOutput};

/// Takes out of `states` the memories that only repeat other states: a latch,
/// or a sealed coil, whose conditions are functions of other states alone.
///
/// A memory that repeats another repeater stays a state, so that what is
/// taken out is always explained by what is left.
pub(super) fn take_repeaters(states: &mut Vec<Arc<State>>) -> Vec<StoredOutput> {
    let all: BTreeSet<AtomId> = states.iter().map(|state| state.atom).collect();
    let repeats = |state: &State, others: &BTreeSet<AtomId>| {
        let mut support = state
            .turns_on
            .support()
            .iter()
            .chain(state.deactivation.support());
        support.all(|atom| *atom != state.atom && others.contains(atom))
    };
    let repeaters: BTreeSet<AtomId> = states
        .iter()
        .filter(|state| repeats(state, &all))
        .map(|state| state.atom)
        .collect();
    let explaining: BTreeSet<AtomId> = all.difference(&repeaters).copied().collect();
    let mut stored = Vec::new();
    states.retain(|state| {
        if !repeats(state, &explaining) {
            return true;
        }
        stored.push(StoredOutput {
            name: state.name.clone(),
            atom: state.atom,
            set: state.turns_on.clone(),
            reset: state.deactivation.clone(),
        });
        false
    });
    stored
}
