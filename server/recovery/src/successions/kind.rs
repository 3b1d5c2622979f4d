//! AND or OR: whether followers of one state start together.

use logic::{AtomId, Budget, Function};

use super::compared::{Compared, Follower};
use super::{Evidence, Kind};
use crate::states::{State, States};

/// The kind proposed for each suggestion, in their order: they stand together
/// by evidence and by the state that ends.
///
/// Followers of a state are gathered greedily: one joins the company of those
/// that it can start together with, for the same cause, and that it does not
/// lock out. The cause is a product of what ends the state: valves and a mixer
/// that all start when the tank is full have one in common; what starts because
/// the tank is empty again has another. Who starts in company is AND, who
/// starts alone, or excludes one of the company, is OR.
pub(super) fn kinds(
    suggestions: &[(AtomId, AtomId, Evidence, Option<Function>)],
    states: &States,
    compared: &mut Compared<'_>,
    budget: &Budget,
) -> Vec<Kind> {
    let alike = |a: &(AtomId, AtomId, Evidence, _), b: &(AtomId, AtomId, Evidence, _)| {
        (a.0, a.2) == (b.0, b.2)
    };
    let mut kinds = Vec::with_capacity(suggestions.len());
    for of_one in suggestions.chunk_by(alike) {
        let followers = of_one.iter().map(|(_, to, _, when)| (*to, when.clone()));
        match of_one {
            [(from, _, Evidence::Handover, _), _, ..] => {
                let judge = |followers: &[Follower]| judged(*from, followers, states, budget);
                kinds.extend(compared.kinds(*from, followers.collect(), judge));
            }
            _ => kinds.resize(kinds.len() + of_one.len(), Kind::Or),
        }
    }
    kinds
}

fn judged(from: AtomId, followers: &[Follower], states: &States, budget: &Budget) -> Vec<Kind> {
    let mut company: Vec<usize> = Vec::new();
    for (at, (to, when)) in followers.iter().enumerate() {
        let joins = company.iter().all(|&member| {
            let (other, meanwhile) = &followers[member];
            let pair = [(*to, when.as_ref()), (*other, meanwhile.as_ref())];
            together(from, pair, states, budget)
        });
        if joins {
            company.push(at);
        }
    }
    let mut kinds = vec![Kind::Or; followers.len()];
    if company.len() > 1 {
        for at in company {
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
