//! Pairs of conditions that share nothing but what is common to all.
//!
//! A stop button may stand in every rung of a plant. To compare every pair
//! that shares it would take the square of the rungs, and nearly always for
//! nothing. But where all that two conditions share is common, one implies the
//! other exactly if something over common atoms alone lies between them
//! (Craig's interpolation theorem): if the least such condition above the one
//! implies the greatest below the other. A program has only a few different
//! ones, and each pair of these is compared once.

use std::collections::{BTreeSet, HashMap};

use std::sync::Arc;

use logic::{AtomId, Budget, Function, Stop};

use super::facets::Form;
use crate::states::State;

/// What common atoms tell of a condition.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) struct Bounds {
    /// The least condition over common atoms that holds wherever it does.
    above: Function,
    /// The greatest condition over common atoms wherever it holds.
    below: Function,
}

impl Bounds {
    /// The bounds of everything from `least` to `most`: above the one, below
    /// the other. `None` if nothing can lie between it and another, or it never
    /// holds, or the budget does not allow to tell.
    pub(super) fn new(
        least: &Function,
        most: &Function,
        common: &BTreeSet<AtomId>,
        budget: &Budget,
    ) -> Option<Self> {
        if least.is_false() {
            return None;
        }
        let above = least.project(common, budget).ok()?;
        let below = most.not().project(common, budget).ok()?.not();
        (!above.is_true() || !below.is_false()).then_some(Self { above, below })
    }

    fn imply(&self, other: &Self, budget: &Budget) -> bool {
        self.above.implies(&other.below, budget) == Ok(true)
    }
}

/// A condition that ends a state and the one that starts it again, which may
/// be set aside where the two are compared with a third.
#[derive(Clone, Debug)]
pub(super) struct Ending {
    pub(super) ends: Function,
    pub(super) again: Function,
}

/// States by what common atoms tell of their endings.
#[derive(Debug)]
pub(super) struct ByCommon {
    form: Form,
    common: BTreeSet<AtomId>,
    places: HashMap<Bounds, Vec<usize>>,
    /// Answers given before.
    known: HashMap<Bounds, Vec<usize>>,
}

impl ByCommon {
    /// Indexes the endings of states by their place in the list.
    pub(super) fn new(
        form: Form,
        states: &[Arc<State>],
        common: BTreeSet<AtomId>,
        budget: &Budget,
    ) -> Self {
        let mut places: HashMap<Bounds, Vec<usize>> = HashMap::new();
        if !common.is_empty() {
            for (at, state) in states.iter().enumerate() {
                let [ending, _] = state.facet(form).bounds(&common, budget);
                if let Some(bounds) = ending {
                    places.entry(bounds).or_default().push(at);
                }
            }
        }
        Self {
            form,
            common,
            places,
            known: HashMap::new(),
        }
    }

    /// Places of the states whose ending may imply what starts `state`, or be
    /// implied by it, through common atoms alone.
    pub(super) fn sharing(&mut self, state: &State, budget: &Budget) -> &[usize] {
        if self.places.is_empty() {
            return &[];
        }
        let [_, starts] = state.facet(self.form).bounds(&self.common, budget);
        starts.map_or(&[], |bounds| self.meeting(bounds, budget))
    }

    fn meeting(&mut self, starts: Bounds, budget: &Budget) -> &[usize] {
        let places = &self.places;
        self.known.entry(starts).or_insert_with_key(|starts| {
            let meeting = places
                .iter()
                .filter(|(ends, _)| starts.imply(ends, budget) || ends.imply(starts, budget));
            meeting.flat_map(|(_, at)| at).copied().collect()
        })
    }
}

impl Ending {
    /// The ending of what is compared with nothing.
    pub(super) fn never() -> Self {
        Self {
            ends: Function::constant(false),
            again: Function::constant(false),
        }
    }

    pub(super) fn bounds(
        &self,
        common: &BTreeSet<AtomId>,
        budget: &Budget,
    ) -> Result<Option<Bounds>, Stop> {
        let least = self.ends.and_not(&self.again, budget)?;
        let most = self.ends.or(&self.again, budget)?;
        Ok(Bounds::new(&least, &most, common, budget))
    }
}

#[cfg(test)]
mod tests {
    use logic::{Atoms, notation};

    use super::*;

    /// Which of the endings `sharing` finds for a start, where only `stop` is
    /// common.
    fn found(ends: &[&str], starts: &str) -> Vec<usize> {
        let (mut atoms, budget) = (Atoms::new(), Budget::default());
        let stop = atoms.add_variable(&"stop".into());
        let mut function = |text: &str| {
            let expr = notation::parse(text).expect("an expression");
            Function::of(&expr, &mut atoms, &budget).expect("a small function")
        };
        let never = function("0");
        let common = BTreeSet::from([stop]);
        let mut places: HashMap<Bounds, Vec<usize>> = HashMap::new();
        for (at, text) in ends.iter().enumerate() {
            let ending = Ending {
                ends: function(text),
                again: never.clone(),
            };
            if let Ok(Some(bounds)) = ending.bounds(&common, &budget) {
                places.entry(bounds).or_default().push(at);
            }
        }
        let starts = function(starts);
        let bounds = Bounds::new(&starts, &starts, &common, &budget);
        let mut index = ByCommon {
            form: Form::Plain,
            common,
            places,
            known: HashMap::new(),
        };
        bounds.map_or(Vec::new(), |bounds| index.meeting(bounds, &budget).to_vec())
    }

    #[test]
    fn a_stop_button_in_every_rung_joins_no_pair() {
        assert_eq!(found(&["stop + full", "loaded*/stop"], "start*/stop"), []);
    }

    #[test]
    fn what_starts_by_the_common_button_follows_all_that_it_ends() {
        assert_eq!(found(&["stop + full", "loaded*/stop"], "stop*armed"), [0]);
    }

    #[test]
    fn what_starts_whenever_it_may_follows_all_that_ends_while_it_may() {
        assert_eq!(found(&["stop + full", "loaded*/stop"], "/stop + test"), [1]);
    }
}
