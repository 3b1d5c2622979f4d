//! What the expert accepted, and what a word on the command line accepts.

use std::collections::{BTreeMap, BTreeSet};

use grafcet::{Decision, Verdict};
use logic::{AtomId, Name};

use crate::Analysis;
use crate::successions::{Evidence, Kind, Succession};

/// Which suggestions to accept at once.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Accept {
    /// None: the product form.
    None,
    /// What is written or handed over.
    Handovers,
    /// What was seen to happen in one scan while no more than one input changes
    /// at a time; see [`crate::successions::Witness`].
    Witnessed,
    /// Every suggestion.
    All,
    /// These: from, and what follows it.
    These(Vec<(Name, Vec<Name>)>),
}

/// Decisions that accept what `accept` says, added to those already made. What
/// was accepted, rejected or decided before stays as it is.
pub fn decide(analysis: &Analysis, made: &[Decision], accept: &Accept) -> Vec<Decision> {
    let mut decisions = made.to_vec();
    let mut decided: BTreeSet<(Name, Name)> = made.iter().flat_map(pairs).collect();
    let mut add = |from: &Name, to: Vec<Name>| {
        let new: Vec<Name> = to
            .into_iter()
            .filter(|to| decided.insert((from.clone(), to.clone())))
            .collect();
        if !new.is_empty() {
            decisions.push(Decision::from(Verdict::Accept {
                from: from.clone(),
                to: new,
            }));
        }
    };
    match accept {
        Accept::None => {}
        Accept::These(list) => {
            for (from, to) in list {
                add(from, to.clone());
            }
        }
        Accept::Handovers | Accept::Witnessed | Accept::All => {
            // A register's arcs are read off its writes and need no decision.
            let wanted = |succession: &&Succession| match (accept, succession.evidence) {
                (_, Evidence::Written) => false,
                (Accept::Handovers, evidence) => evidence == Evidence::Handover,
                (Accept::Witnessed, evidence) => {
                    let witness = succession.witness.as_ref();
                    evidence <= Evidence::Witnessed && witness.is_some_and(|it| it.is_calm)
                }
                (_, _) => true,
            };
            for (from, to) in together(analysis.successions().iter().filter(wanted)) {
                add(&from, to);
            }
        }
    }
    decisions
}

fn pairs(decision: &Decision) -> Vec<(Name, Name)> {
    match &decision.verdict {
        Verdict::Accept { from, to } => to.iter().map(|to| (from.clone(), to.clone())).collect(),
        Verdict::Reject { from, to } => vec![(from.clone(), to.clone())],
        _ => Vec::new(),
    }
}

/// Successions as decisions have them: those proposed as AND from one state in
/// one, all others each in its own, in the order of the states.
fn together<'s>(list: impl Iterator<Item = &'s Succession>) -> Vec<(Name, Vec<Name>)> {
    let mut order: Vec<Name> = Vec::new();
    let mut followers: BTreeMap<Name, (Vec<Name>, Vec<Name>)> = BTreeMap::new();
    for succession in list {
        if !followers.contains_key(&succession.from) {
            order.push(succession.from.clone());
        }
        let (and, or) = followers.entry(succession.from.clone()).or_default();
        match succession.kind {
            Kind::And => and.push(succession.to.clone()),
            Kind::Or => or.push(succession.to.clone()),
        }
    }
    let mut decisions = Vec::new();
    for from in order {
        let Some((and, or)) = followers.remove(&from) else {
            continue;
        };
        if !and.is_empty() {
            decisions.push((from.clone(), and));
        }
        decisions.extend(or.into_iter().map(|to| (from.clone(), vec![to])));
    }
    decisions
}

/// The decisions about states that the ladder has, by their atoms.
#[derive(Clone, Debug, Default)]
pub struct Accepted {
    /// The accepted followers of a state: each a list of states that start
    /// together, most often of one.
    pub(super) followers: BTreeMap<AtomId, Vec<Vec<AtomId>>>,
    /// States in which a sequence starts.
    pub(super) initial: BTreeSet<AtomId>,
    /// States whose branch ends by itself.
    pub(super) ends: BTreeSet<AtomId>,
    /// Arcs of registers that were rejected, as their states are spelt.
    pub(super) rejected: BTreeSet<(Name, Name)>,
}

impl Accepted {
    /// Reads `decisions` against the states of a ladder.
    pub fn new(analysis: &Analysis, decisions: &[Decision]) -> Self {
        let mut accepted = Self::default();
        for decision in decisions {
            let atom = |name: &Name| analysis.states().find(name).map(|state| state.atom);
            match &decision.verdict {
                Verdict::Accept { from, to } => {
                    let from = atom(from);
                    let to: Vec<AtomId> = to.iter().filter_map(atom).collect();
                    if let Some(from) = from
                        && !to.is_empty()
                    {
                        accepted.followers.entry(from).or_default().push(to);
                    }
                }
                Verdict::Reject { from, to } => {
                    accepted.rejected.insert((from.clone(), to.clone()));
                }
                Verdict::Initial(name) => accepted.initial.extend(atom(name)),
                Verdict::End(name) => accepted.ends.extend(atom(name)),
                Verdict::Keep(_) => {}
            }
        }
        accepted
    }

    /// States that take part in some accepted succession.
    pub(super) fn members(&self) -> BTreeSet<AtomId> {
        self.followers
            .iter()
            .flat_map(|(from, to)| std::iter::once(*from).chain(to.iter().flatten().copied()))
            .collect()
    }
}
