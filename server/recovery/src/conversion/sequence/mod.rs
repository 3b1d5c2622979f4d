//! Sequences: states merged by the successions that the expert accepted.
//!
//! A succession P -> F becomes P -> D -> F (the paper, section 3.3): the first
//! transition bears what ends P, the second what starts F, and D is a step
//! that waits between. D is left out where leaving P already means starting a
//! follower. Followers that start together open branches; see
//! [`branches`](super::branches) for how these end.

mod alternatives;
mod builder;
mod divergence;
mod drawing;
mod plan;
mod start;

use std::collections::{BTreeMap, BTreeSet, HashMap};

use logic::{AtomId, Budget};
use petgraph::unionfind::UnionFind;

use super::decisions::Accepted;
use super::naming::Names;
use super::wording::Wording;
use crate::Analysis;
use builder::Builder;

pub(super) use plan::Plan;

/// A plan for every set of states that accepted successions tie together, in
/// the order of their first states.
pub(super) fn plans(
    analysis: &Analysis,
    accepted: &Accepted,
    names: &mut Names,
    wording: &mut Wording<'_>,
    budget: &Budget,
) -> Vec<Plan> {
    components(accepted)
        .into_iter()
        .map(|members| {
            let mut builder = Builder::new(analysis, accepted, members, names, budget);
            builder.build();
            for ((state, _), step) in &builder.steps {
                wording.stands_for(*state, step.clone());
            }
            builder.plan
        })
        .collect()
}

fn components(accepted: &Accepted) -> Vec<BTreeSet<AtomId>> {
    let members: Vec<AtomId> = accepted.members().into_iter().collect();
    let place: HashMap<AtomId, usize> = members.iter().copied().zip(0..).collect();
    let mut union = UnionFind::new(members.len());
    for (from, groups) in &accepted.followers {
        for to in groups.iter().flatten() {
            union.union(place[from], place[to]);
        }
    }
    let mut classes: BTreeMap<usize, BTreeSet<AtomId>> = BTreeMap::new();
    for (at, member) in members.iter().enumerate() {
        classes.entry(union.find(at)).or_default().insert(*member);
    }
    let mut components: Vec<_> = classes.into_values().collect();
    components.sort_by_key(|members| members.first().copied());
    components
}
