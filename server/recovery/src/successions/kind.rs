//! AND or OR: whether followers of one state start together.

use std::collections::BTreeMap;

use logic::{AtomId, Budget, Function};

use super::{Evidence, Kind};
use crate::states::{State, States};

/// The kind proposed for each suggestion, in their order.
///
/// Followers of a state are gathered greedily, strongest evidence first: one
/// joins the company of those that it can start together with and that it
/// does not lock out. Who starts in company is AND, who starts alone, or
/// excludes one of the company, is OR.
pub(super) fn kinds(
    suggestions: &[(AtomId, AtomId, Evidence, Option<Function>)],
    states: &States,
    budget: &Budget,
) -> Vec<Kind> {
    let mut company: BTreeMap<(AtomId, Evidence), Vec<usize>> = BTreeMap::new();
    for (at, (from, to, evidence, condition)) in suggestions.iter().enumerate() {
        let members = company.entry((*from, *evidence)).or_default();
        let joins = *evidence == Evidence::Handover
            && members.iter().all(|member| {
                let (_, other, _, meanwhile) = &suggestions[*member];
                together(
                    *to,
                    condition.as_ref(),
                    *other,
                    meanwhile.as_ref(),
                    states,
                    budget,
                )
            });
        if joins {
            members.push(at);
        }
    }
    let mut kinds = vec![Kind::Or; suggestions.len()];
    for members in company.values().filter(|members| members.len() > 1) {
        for &at in members {
            kinds[at] = Kind::And;
        }
    }
    kinds
}

fn together(
    a: AtomId,
    starts_a: Option<&Function>,
    b: AtomId,
    starts_b: Option<&Function>,
    states: &States,
    budget: &Budget,
) -> bool {
    let (Some(state_a), Some(state_b)) = (states.state(a), states.state(b)) else {
        return false;
    };
    let locks = |by: &State, other: &State| other.interlocks.contains(&by.atom);
    let (Some(starts_a), Some(starts_b)) = (starts_a, starts_b) else {
        return false;
    };
    !locks(state_a, state_b)
        && !locks(state_b, state_a)
        && starts_a.meets(starts_b, budget) == Ok(true)
}
