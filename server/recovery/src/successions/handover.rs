//! Handover: the condition that ends one state is what starts the other.

use logic::{AtomId, Budget, Function, Stop};

use super::shared::ByLiteral;
use crate::states::{State, States};

/// A handover and the condition under which it happens, over everything but
/// the two states.
#[derive(Clone, Debug)]
pub(super) struct Handover {
    pub(super) from: AtomId,
    pub(super) to: AtomId,
    pub(super) condition: Function,
}

/// All handovers between states.
pub(super) fn handovers(states: &States, budget: &Budget) -> Vec<Handover> {
    let list = &states.states;
    let ends = ByLiteral::new(list.iter().map(|state| &state.deactivation), budget);
    let released_by = |to: &State| {
        list.iter()
            .enumerate()
            .filter(|(_, from)| to.turns_on.depends_on(from.atom))
            .filter(|(_, from)| from.deactivation.depends_on(to.atom))
            .map(|(at, _)| at)
            .collect::<Vec<_>>()
    };
    let mut found = Vec::new();
    for to in list {
        if budget.cancel.is_cancelled() {
            break;
        }
        let mut from = ends.sharing(&to.turns_on, budget);
        // Only predecessors that start it by a contact can be released by it.
        let near = to
            .turns_on
            .support()
            .iter()
            .filter(|a| states.state(**a).is_some());
        if near.count() > 0 {
            from.extend(released_by(to));
        }
        for at in from {
            let from = &list[at];
            if from.atom == to.atom {
                continue;
            }
            if let Ok(Some(condition)) = handover(from, to, budget) {
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

/// The condition under which `from` hands over to `to`, if it does and that
/// can be told within the budget.
pub(crate) fn handed_over(from: &State, to: &State, budget: &Budget) -> Option<Function> {
    handover(from, to, budget).ok().flatten()
}

/// The condition under which `from` hands over to `to`, if it does.
///
/// With `from` on and `to` off, what starts `to` implies what ends `from`, or
/// the reverse, and both can happen. Where the two are started by different
/// variables, `from` is taken not to be started again at that same moment.
/// The second form of a handover is the relay sequence, in which `to` is
/// started by `from` and releases it: there `from` ends because `to` is on.
fn handover(from: &State, to: &State, budget: &Budget) -> Result<Option<Function>, Stop> {
    if locks_out(from, to) && locks_out(to, from) {
        return Ok(None);
    }
    let situation =
        |function: &Function| function.restrict(from.atom, true).restrict(to.atom, false);
    let starts = situation(&to.turns_on);
    let ends = situation(&ending(from, to, budget)?);
    let again = situation_off(from, to);
    let starts_apart = from
        .turns_on
        .support()
        .iter()
        .all(|atom| !to.turns_on.depends_on(*atom));
    let quiet = if starts_apart {
        again.not()
    } else {
        Function::constant(true)
    };
    let starts_now = starts.and(&quiet, budget)?;
    let ends_now = ends.and(&quiet, budget)?;
    let both = starts_now.and(&ends_now, budget)?;
    if !both.is_false()
        && (starts_now.implies(&ends, budget)? || ends_now.implies(&starts, budget)?)
    {
        // Where `from` is started again the condition may say anything: that
        // moment is set aside, which keeps the printed condition short.
        return Ok(Some(simplest(&both, &again, starts_apart, budget)?));
    }
    released(from, to, &starts, budget)
}

/// What starts `from` again, seen with `to` off.
fn situation_off(from: &State, to: &State) -> Function {
    from.turns_on.restrict(to.atom, false)
}

/// What ends `from`, with the normally closed contacts of states that lock it
/// out set aside (the paper, section 3.2), but not those of `to`.
fn ending(from: &State, to: &State, budget: &Budget) -> Result<Function, Stop> {
    budget.check()?;
    let aside = from.interlocks.iter().filter(|other| **other != to.atom);
    let next = aside.fold(from.next.clone(), |next, other| {
        let open = next.restrict(*other, false);
        // A contact whose opening alone ends the state is no interlock but
        // the way the state ends: a relay sequence is written so.
        if open.restrict(from.atom, true).is_true() {
            next
        } else {
            open
        }
    });
    Ok(next.restrict(from.atom, true).not())
}

fn locks_out(by: &State, state: &State) -> bool {
    state.interlocks.contains(&by.atom)
}

/// The handover of a relay sequence: `to` needs `from` to start, and once on
/// ends it.
fn released(
    from: &State,
    to: &State,
    starts: &Function,
    budget: &Budget,
) -> Result<Option<Function>, Stop> {
    let needs = to.turns_on.restrict(from.atom, false).is_false();
    let ends = from
        .next
        .restrict(to.atom, true)
        .restrict(from.atom, true)
        .is_false();
    budget.check()?;
    Ok((needs && ends && !starts.is_false()).then(|| starts.clone()))
}

/// `both`, free to say anything where `again` holds, if that is set aside.
fn simplest(
    both: &Function,
    again: &Function,
    set_aside: bool,
    budget: &Budget,
) -> Result<Function, Stop> {
    if !set_aside {
        return Ok(both.clone());
    }
    let upper = both.or(again, budget)?;
    let products = both.products_within(&upper, budget)?;
    products
        .iter()
        .try_fold(Function::constant(false), |sum, product| {
            let term = product
                .iter()
                .try_fold(Function::constant(true), |term, l| {
                    term.and(&Function::literal(l.atom, l.positive), budget)
                })?;
            sum.or(&term, budget)
        })
}
