//! What may be kept of the states from before a change.

use std::sync::Arc;

use logic::{AtomId, Function};
use rustc_hash::{FxHashMap, FxHashSet};

use super::{Auxiliaries, State, States, auxiliary};
use crate::conditions::{Conditions, TimerLaw, Variable};

/// What conditions are resolved by, beside auxiliary coils.
#[derive(Clone, Debug, Default)]
pub(super) struct Resolvers {
    timers: FxHashMap<AtomId, TimerLaw>,
    copies: FxHashMap<AtomId, AtomId>,
}

impl Resolvers {
    pub(super) fn of(conditions: &Conditions) -> Self {
        let timers = conditions.timers.iter();
        let copy = |variable: &Arc<Variable>| {
            let source = auxiliary::copied_from(variable)?;
            Some((variable.atom, source))
        };
        Self {
            timers: timers.map(|(atom, law)| (*atom, law.clone())).collect(),
            copies: conditions.variables.iter().filter_map(copy).collect(),
        }
    }
}

/// The states from before a change, and which of them still hold.
pub(super) struct Kept<'k> {
    earlier: Option<&'k States>,
    /// Atoms that are copies of others than before.
    copies: FxHashSet<AtomId>,
    /// Atoms that conditions are resolved by otherwise than before.
    changed: FxHashSet<AtomId>,
}

impl<'k> Kept<'k> {
    pub(super) fn new(earlier: Option<&'k States>, resolvers: &Resolvers) -> Self {
        let (mut copies, mut changed) = (FxHashSet::default(), FxHashSet::default());
        if let Some(earlier) = earlier {
            let was = &earlier.resolvers;
            differing(&was.copies, &resolvers.copies, |a, b| a == b, &mut copies);
            let same = |a: &TimerLaw, b: &TimerLaw| a.kind == b.kind && a.input == b.input;
            differing(&was.timers, &resolvers.timers, same, &mut changed);
            changed.extend(&copies);
        }
        Self {
            earlier,
            copies,
            changed,
        }
    }

    /// Whether a variable holds a state, if that is known from before.
    pub(super) fn holds(&self, variable: &Arc<Variable>) -> Option<bool> {
        let (was, holds) = self.earlier?.holding.get(&variable.atom)?;
        let reads = |atom: &AtomId| self.copies.contains(atom);
        let support = variable.next.as_ref().map_or(&[][..], Function::support);
        (Arc::ptr_eq(was, variable) && !support.iter().any(reads)).then_some(*holds)
    }

    /// From now on conditions are resolved by these coils as well.
    pub(super) fn resolve_by(&mut self, auxiliaries: &Auxiliaries) {
        if let Some(earlier) = self.earlier {
            let was = earlier.auxiliaries.all();
            differing(was, auxiliaries.all(), |a, b| a == b, &mut self.changed);
        }
    }

    /// The state that a variable holds, if it is what it was.
    pub(super) fn state(&self, variable: &Arc<Variable>) -> Option<&'k Arc<State>> {
        let state = self.earlier?.worked_out.get(&variable.atom)?;
        let is_same = Arc::ptr_eq(&state.variable, variable)
            && (self.changed.is_empty()
                || !state.asked.iter().any(|atom| self.changed.contains(atom)));
        is_same.then_some(state)
    }
}

/// Adds the keys under which two tables hold different values.
fn differing<V>(
    a: &FxHashMap<AtomId, V>,
    b: &FxHashMap<AtomId, V>,
    same: impl Fn(&V, &V) -> bool,
    found: &mut FxHashSet<AtomId>,
) {
    let differs = |(atom, one): &(&AtomId, &V)| !b.get(atom).is_some_and(|other| same(one, other));
    found.extend(a.iter().filter(differs).map(|(atom, _)| *atom));
    found.extend(b.keys().filter(|atom| !a.contains_key(atom)));
}
