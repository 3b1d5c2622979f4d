//! Branches that an AND divergence opens, and where they meet again.

use std::collections::{BTreeMap, BTreeSet};

use logic::{AtomId, Name};

/// Identifies a branch of a sequence.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(super) struct BranchId(pub(super) usize);

impl BranchId {
    /// What is outside all divergences.
    pub(super) const ROOT: Self = Self(0);
}

/// A part of a sequence in which one step is active at a time.
#[derive(Clone, Debug)]
pub(super) struct Branch {
    /// States of other branches that run at the same time: not to be started
    /// from here.
    pub(super) foreign: BTreeSet<AtomId>,
    /// States in which this branch meets others: it waits for them in the
    /// step named.
    pub(super) joins: BTreeMap<AtomId, Name>,
    /// Where the branch goes when its last state has ended.
    pub(super) end: Name,
    /// States at which the branches around this one diverged.
    pub(super) diverged: BTreeSet<AtomId>,
}

/// Divergences inside each other; beyond this a drawing says nothing.
const DEEPEST: usize = 6;

impl Branch {
    /// The whole sequence: it ends in its initial step.
    pub(super) fn root(start: Name) -> Self {
        Self {
            foreign: BTreeSet::new(),
            joins: BTreeMap::new(),
            end: start,
            diverged: BTreeSet::new(),
        }
    }

    /// Whether a state may not open further branches inside this one: it, or
    /// too many others, have done so around it.
    pub(super) fn is_full(&self, state: AtomId) -> bool {
        self.diverged.contains(&state) || self.diverged.len() >= DEEPEST
    }
}

/// How the branches of one divergence lie to each other.
#[derive(Clone, Debug)]
pub(super) struct Divergence {
    /// States that only one branch leads to, by branch.
    pub(super) own: Vec<BTreeSet<AtomId>>,
    /// States that several branches lead to, entered first: where they meet.
    pub(super) meeting: BTreeSet<AtomId>,
    /// Branches that lead there.
    pub(super) joining: BTreeSet<usize>,
    /// The state at which they part.
    origin: AtomId,
}

impl Divergence {
    /// Sorts the states that each branch can reach.
    pub(super) fn new(
        origin: AtomId,
        reach: &[BTreeSet<AtomId>],
        followers: &BTreeMap<AtomId, Vec<Vec<AtomId>>>,
    ) -> Self {
        let mut count: BTreeMap<AtomId, usize> = BTreeMap::new();
        for atom in reach.iter().flatten() {
            *count.entry(*atom).or_default() += 1;
        }
        let own: Vec<BTreeSet<AtomId>> = reach
            .iter()
            .map(|states| states.iter().copied().filter(|a| count[a] == 1).collect())
            .collect();
        let mut meeting = BTreeSet::new();
        let mut joining = BTreeSet::new();
        for (at, states) in own.iter().enumerate() {
            let next = states
                .iter()
                .filter_map(|state| followers.get(state))
                .flatten()
                .flatten();
            for to in next.filter(|to| count.get(to).is_some_and(|n| *n > 1)) {
                meeting.insert(*to);
                joining.insert(at);
            }
        }
        // One branch alone joins nothing: the others never arrive.
        if joining.len() < 2 {
            meeting.clear();
            joining.clear();
        }
        Self {
            own,
            meeting,
            joining,
            origin,
        }
    }

    /// Branch `at` of the divergence inside `outer`, ending in `end`.
    pub(super) fn branch(&self, at: usize, outer: &Branch, end: Name) -> Branch {
        let others = self
            .own
            .iter()
            .enumerate()
            .filter(|(other, _)| *other != at);
        let mut foreign = outer.foreign.clone();
        foreign.extend(others.flat_map(|(_, states)| states.iter().copied()));
        let joins = if self.joining.contains(&at) {
            self.meeting
                .iter()
                .map(|atom| (*atom, end.clone()))
                .collect()
        } else {
            foreign.extend(&self.meeting);
            BTreeMap::new()
        };
        Branch {
            foreign,
            joins,
            end,
            diverged: self.diverged_inside(outer),
        }
    }

    /// The branch after the meeting, while the branches that do not join
    /// still run.
    pub(super) fn after_join(&self, outer: &Branch, end: Name) -> Branch {
        let running = self.own.iter().enumerate();
        let running = running.filter(|(at, _)| !self.joining.contains(at));
        let mut foreign = outer.foreign.clone();
        foreign.extend(running.flat_map(|(_, states)| states.iter().copied()));
        Branch {
            foreign,
            joins: outer.joins.clone(),
            end,
            diverged: self.diverged_inside(outer),
        }
    }

    fn diverged_inside(&self, outer: &Branch) -> BTreeSet<AtomId> {
        let mut diverged = outer.diverged.clone();
        diverged.insert(self.origin);
        diverged
    }
}
