//! The order-free form of the paper's rule.
//!
//! The paper's Algorithms 2 to 5 ask whether some assignment of the shared
//! variables is part of a path of both diagrams; the answer depends on the
//! order of variables. What the rule means does not: *the deactivation of P
//! and the activation of F share a variable and can hold together*. That is
//! one conjunction of two diagrams.

use logic::{AtomId, Budget, Function};
use rustc_hash::FxHashSet;

use super::compared::Compared;
use super::handover::Handover;
use super::shared::{ByAtom, COMMON};
use super::{Evidence, Kind, MOST_PAIRS, Succession, coils, name};
use crate::conditions::Conditions;
use crate::states::{State, States};

/// Every pair of coils for which the rule holds, whatever they hold: the
/// paper lets all rungs take part.
pub fn possible(conditions: &Conditions, budget: &Budget) -> Vec<Succession> {
    let coils = coils(conditions);
    let starts = ByAtom::new(coils.iter().map(|(_, activation, _)| activation));
    let mut found = Vec::new();
    let mut tried = 0;
    for (from, _, deactivation) in &coils {
        if budget.cancel.is_cancelled() {
            break;
        }
        for at in starts.sharing(deactivation, usize::MAX) {
            let (to, activation, _) = &coils[at];
            tried += 1;
            if from == to || tried > MOST_PAIRS {
                continue;
            }
            if let Ok(both) = deactivation.and(activation, budget)
                && !both.is_false()
            {
                found.push(Succession {
                    from: name(conditions, *from),
                    to: name(conditions, *to),
                    evidence: Evidence::Possible,
                    kind: Kind::Or,
                    condition: Some(both),
                    witness: None,
                });
            }
        }
    }
    found
}

/// What is possible between states and is no handover already.
pub(super) fn among_states(
    states: &States,
    handovers: &[Handover],
    compared: &mut Compared<'_>,
    budget: &Budget,
) -> Vec<(AtomId, AtomId, Option<Function>)> {
    let known: FxHashSet<(AtomId, AtomId)> = handovers.iter().map(|h| (h.from, h.to)).collect();
    let comparable: Vec<&State> = states
        .states
        .iter()
        .map(|state| &**state)
        .filter(|state| state.is_comparable())
        .collect();
    let starts = ByAtom::new(comparable.iter().map(|state| &state.next));
    let mut found = Vec::new();
    for from in &comparable {
        if budget.cancel.is_cancelled() {
            break;
        }
        for at in starts.sharing(&from.deactivation, COMMON) {
            let to = comparable[at];
            if from.atom == to.atom || known.contains(&(from.atom, to.atom)) {
                continue;
            }
            let both = compared.possible(from, to, || {
                let both = from.deactivation.and(&to.next, budget).ok();
                both.filter(|both| !both.is_false())
            });
            if both.is_some() {
                found.push((from.atom, to.atom, both));
            }
        }
    }
    found
}
