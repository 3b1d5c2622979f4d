//! Handover: the condition that ends one state is what starts the other.

use std::collections::BTreeSet;
use std::sync::Arc;

use logic::{AtomId, Budget, Function, Stop};

use super::common::ByCommon;
use super::compared::Compared;
use super::facets::{Form, ending};
use super::shared::ByLiteral;
use crate::conditions::Conditions;
use crate::states::{State, States};

/// A handover and the condition under which it happens, over everything but
/// the two states.
#[derive(Clone, Debug)]
pub(super) struct Handover {
    pub(super) from: AtomId,
    pub(super) to: AtomId,
    pub(super) condition: Function,
}

/// All handovers between states. The plain form of their conditions is tried
/// first: in it a chain with transition bits shows which bit ends the one and
/// starts the other. Only where that finds nothing are the bits resolved.
pub(super) fn handovers(
    states: &States,
    conditions: &Conditions,
    compared: &mut Compared<'_>,
    budget: &Budget,
) -> Vec<Handover> {
    let list = &states.states;
    let mut indexes = [Form::Plain, Form::Resolved].map(|form| Index::new(form, list, budget));
    let mut followed = neighbours(states);
    let mut found = Vec::new();
    for (to, from) in list.iter().zip(&mut followed) {
        if budget.cancel.is_cancelled() {
            break;
        }
        if !to.is_comparable() {
            continue;
        }
        for index in &mut indexes {
            index.add_sharing(to, from, budget);
        }
        for &at in &*from {
            let from = &list[at];
            if from.atom == to.atom || !from.is_comparable() {
                continue;
            }
            let condition = compared.handed_over(from, to, || {
                handed_over(from, to, states, conditions, budget)
            });
            if let Some(condition) = condition {
                found.push(Handover {
                    from: from.atom,
                    to: to.atom,
                    condition,
                });
            }
        }
    }
    found
}

/// Finds the states whose ending may have to do with a start.
struct Index {
    form: Form,
    by_literal: ByLiteral,
    by_common: ByCommon,
}

impl Index {
    fn new(form: Form, states: &[Arc<State>], budget: &Budget) -> Self {
        let by_literal = ByLiteral::new(states.iter().map(|it| &*it.facet(form).ends_by));
        Self {
            form,
            by_common: ByCommon::new(form, states, by_literal.common(), budget),
            by_literal,
        }
    }

    fn add_sharing(&mut self, to: &State, found: &mut BTreeSet<usize>, budget: &Budget) {
        found.extend(self.by_literal.sharing(&to.facet(self.form).starts_by));
        found.extend(self.by_common.sharing(to, budget));
    }
}

/// For each state the places of those that it names in its condition, or that
/// name it: setting one on and the other off changes what their conditions
/// share.
fn neighbours(states: &States) -> Vec<BTreeSet<usize>> {
    let mut neighbours = vec![BTreeSet::new(); states.states.len()];
    for (at, state) in states.states.iter().enumerate() {
        for form in [Form::Plain, Form::Resolved] {
            for other in form.next(state).support() {
                if let Some(other) = states.place(*other) {
                    neighbours[at].insert(other);
                    neighbours[other].insert(at);
                }
            }
        }
    }
    neighbours
}

/// The condition under which `from` hands over to `to`, auxiliary coils
/// resolved, if it does and that can be told within the budget.
pub(crate) fn handed_over(
    from: &State,
    to: &State,
    states: &States,
    conditions: &Conditions,
    budget: &Budget,
) -> Option<Function> {
    if locks_out(from, to) && locks_out(to, from) {
        return None;
    }
    let plain = handover(from, to, Form::Plain, budget).ok().flatten();
    if let Some(condition) = plain {
        let resolved = states.auxiliaries.resolve(&condition, conditions, budget);
        return Some(resolved.restrict(from.atom, true).restrict(to.atom, false));
    }
    // Resolved conditions name the plant's inputs, and two states far apart
    // may well look at the same one. There the follower must need the state
    // it follows, as a transition bit does.
    let needs = || to.turns_on.restrict(from.atom, false).is_false();
    if needs()
        && let Ok(Some(condition)) = handover(from, to, Form::Resolved, budget)
    {
        return Some(condition);
    }
    released(from, to, budget).ok().flatten()
}

/// With `from` on and `to` off, what starts `to` implies what ends `from`, or
/// the reverse, and both can happen (semantics, section 3). Where the two are
/// started by different variables, `from` is taken not to be started again at
/// that same moment.
fn handover(
    from: &State,
    to: &State,
    form: Form,
    budget: &Budget,
) -> Result<Option<Function>, Stop> {
    let situation =
        |function: &Function| function.restrict(from.atom, true).restrict(to.atom, false);
    let starts = situation(to.starts(form));
    let ends = situation(&ending(from, Some(to.atom), form));
    let again = from.starts(form).restrict(to.atom, false);
    let apart = started_apart(from.starts(form), to.starts(form));
    let quiet = if apart {
        again.not()
    } else {
        Function::constant(true)
    };
    let starts_now = starts.and(&quiet, budget)?;
    let ends_now = ends.and(&quiet, budget)?;
    let both = starts_now.and(&ends_now, budget)?;
    if both.is_false()
        || !(starts_now.implies(&ends, budget)? || ends_now.implies(&starts, budget)?)
    {
        return Ok(None);
    }
    // Where `from` is started again the condition may say anything: that
    // moment is set aside, which keeps the printed condition short.
    if !apart {
        return Ok(Some(both));
    }
    let upper = both.or(&again, budget)?;
    both.simplified_within(&upper, budget).map(Some)
}

/// Whether two states are started by different variables.
pub(crate) fn started_apart(first: &Function, second: &Function) -> bool {
    first.support().iter().all(|atom| !second.depends_on(*atom))
}

fn locks_out(by: &State, state: &State) -> bool {
    state.interlocks.contains(&by.atom)
}

/// The handover of a relay sequence: `to` needs `from` to start, and once on
/// ends it.
fn released(from: &State, to: &State, budget: &Budget) -> Result<Option<Function>, Stop> {
    budget.check()?;
    let starts = to.turns_on.restrict(from.atom, true);
    let needs = to.turns_on.restrict(from.atom, false).is_false();
    let ends = from
        .next
        .restrict(to.atom, true)
        .restrict(from.atom, true)
        .is_false();
    Ok((needs && ends && !starts.is_false()).then_some(starts))
}
