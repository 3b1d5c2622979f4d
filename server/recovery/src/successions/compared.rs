//! Which pairs of states have been compared, and with what result.

use std::sync::Arc;

use logic::{AtomId, Function};
use rustc_hash::{FxHashMap, FxHashSet};

use super::Kind;
use crate::states::{State, States};

/// Results of comparing pairs of states: the one that ends, the one that
/// begins.
type Results = FxHashMap<(AtomId, AtomId), Option<Function>>;

/// Pairs that have been compared, to be kept when the program changes.
#[derive(Clone, Debug, Default)]
pub struct Comparisons {
    states: FxHashMap<AtomId, Arc<State>>,
    handovers: Results,
    possible: Results,
    kinds: FxHashMap<AtomId, (Vec<Follower>, Vec<Kind>)>,
    /// How many pairs were compared, and not kept from before a change.
    pub anew: usize,
}

/// A state that follows another, and when.
pub(super) type Follower = (AtomId, Option<Function>);

/// Compares pairs, but those of which both states are what they were.
pub(super) struct Compared<'c> {
    earlier: Option<&'c Comparisons>,
    unchanged: FxHashSet<AtomId>,
    now: Comparisons,
}

impl<'c> Compared<'c> {
    pub(super) fn new(states: &States, earlier: Option<&'c Comparisons>) -> Self {
        let list = || states.states.iter();
        let is_same = |state: &&Arc<State>| {
            let was = earlier.and_then(|earlier| earlier.states.get(&state.atom));
            was.is_some_and(|was| Arc::ptr_eq(was, state))
        };
        Self {
            earlier,
            unchanged: list().filter(is_same).map(|state| state.atom).collect(),
            now: Comparisons {
                states: list().map(|it| (it.atom, Arc::clone(it))).collect(),
                ..Comparisons::default()
            },
        }
    }

    /// The condition under which `from` hands over to `to`.
    pub(super) fn handed_over(
        &mut self,
        from: &State,
        to: &State,
        compare: impl FnOnce() -> Option<Function>,
    ) -> Option<Function> {
        self.result(
            |it| &it.handovers,
            |it| &mut it.handovers,
            from,
            to,
            compare,
        )
    }

    /// The condition under which `from` may end while `to` is on.
    pub(super) fn possible(
        &mut self,
        from: &State,
        to: &State,
        compare: impl FnOnce() -> Option<Function>,
    ) -> Option<Function> {
        self.result(|it| &it.possible, |it| &mut it.possible, from, to, compare)
    }

    fn result(
        &mut self,
        known: impl Fn(&Comparisons) -> &Results,
        kept: impl Fn(&mut Comparisons) -> &mut Results,
        from: &State,
        to: &State,
        compare: impl FnOnce() -> Option<Function>,
    ) -> Option<Function> {
        let pair = (from.atom, to.atom);
        let before = self
            .earlier
            .filter(|_| self.unchanged.contains(&pair.0) && self.unchanged.contains(&pair.1))
            .and_then(|earlier| known(earlier).get(&pair));
        let result = match before {
            Some(result) => result.clone(),
            None => {
                self.now.anew += 1;
                compare()
            }
        };
        kept(&mut self.now).insert(pair, result.clone());
        result
    }

    /// How the followers of `from` stand to each other.
    pub(super) fn kinds(
        &mut self,
        from: AtomId,
        followers: Vec<Follower>,
        judge: impl FnOnce(&[Follower]) -> Vec<Kind>,
    ) -> Vec<Kind> {
        let is_same = |state: &AtomId| self.unchanged.contains(state);
        let before = self
            .earlier
            .filter(|_| is_same(&from) && followers.iter().all(|(to, _)| is_same(to)))
            .and_then(|earlier| earlier.kinds.get(&from))
            .filter(|(were, _)| *were == followers);
        let kinds = match before {
            Some((_, kinds)) => kinds.clone(),
            None => judge(&followers),
        };
        self.now.kinds.insert(from, (followers, kinds.clone()));
        kinds
    }

    /// What was compared, to be kept.
    pub(super) fn finish(self) -> Comparisons {
        self.now
    }
}
