//! AND or OR: whether followers of one state start together.

use std::collections::BTreeMap;

use logic::{AtomId, Budget, Function};

use super::{Evidence, Kind};
use crate::states::{State, States};

/// The kind proposed for each suggestion, in their order.
///
/// Followers of a state are gathered greedily, strongest evidence first: one
/// joins the company of those that it can start together with, for the same
/// cause, and that it does not lock out. The cause is a product of what ends
/// the state: valves and a mixer that all start when the tank is full have
/// one in common; what starts because the tank is empty again has another.
/// Who starts in company is AND, who starts alone, or excludes one of the
/// company, is OR.
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
                let pair = [(*to, condition.as_ref()), (*other, meanwhile.as_ref())];
                together(*from, pair, states, budget)
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
    from: AtomId,
    pair: [(AtomId, Option<&Function>); 2],
    states: &States,
    budget: &Budget,
) -> bool {
    let [(a, Some(starts_a)), (b, Some(starts_b))] = pair else {
        return false;
    };
    let (Some(from), Some(a), Some(b)) = (states.state(from), states.state(a), states.state(b))
    else {
        return false;
    };
    let locks = |by: &State, other: &State| other.interlocks.contains(&by.atom);
    !locks(a, b)
        && !locks(b, a)
        && starts_a.meets(starts_b, budget) == Ok(true)
        && have_a_common_cause(from, starts_a, starts_b, budget)
}

/// Whether both conditions imply one product of what ends the state.
fn have_a_common_cause(from: &State, a: &Function, b: &Function, budget: &Budget) -> bool {
    let Ok(causes) = from.deactivation.products(budget) else {
        return false;
    };
    causes.iter().any(|cause| {
        cause.iter().all(|literal| {
            let literal = Function::literal(literal.atom, literal.positive);
            a.implies(&literal, budget) == Ok(true) && b.implies(&literal, budget) == Ok(true)
        })
    })
}
