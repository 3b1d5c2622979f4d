//! Handover: the condition that ends one state is what starts the other.

use logic::{AtomId, Budget, Function, Stop};

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

/// The next value of a state in one of its two forms: as its rungs have it,
/// or with auxiliary coils resolved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Form {
    Plain,
    Resolved,
}

impl Form {
    fn next(self, state: &State) -> &Function {
        match self {
            Self::Plain => &state.plain,
            Self::Resolved => &state.next,
        }
    }

    fn turns_on(self, state: &State) -> Function {
        self.next(state).restrict(state.atom, false)
    }

    fn deactivation(self, state: &State) -> Function {
        self.next(state).restrict(state.atom, true).not()
    }
}

/// A state whose condition has more nodes than this is compared with no
/// other: with a condition of that size, which no person can read, every pair
/// would cost as much as all the rest of the program.
const LARGEST: usize = 2_000;

/// All handovers between states. The plain form of their conditions is tried
/// first: in it a chain with transition bits shows which bit ends the one and
/// starts the other. Only where that finds nothing are the bits resolved.
pub(super) fn handovers(
    states: &States,
    conditions: &Conditions,
    budget: &Budget,
) -> Vec<Handover> {
    let list = &states.states;
    let is_small = |state: &State| state.plain.nodes().max(state.next.nodes()) <= LARGEST;
    let index = |form: Form| {
        // A constant shares no literal with anything.
        let nothing = Function::constant(false);
        let ends: Vec<Function> = list
            .iter()
            .map(|state| {
                if is_small(state) {
                    form.deactivation(state)
                } else {
                    nothing.clone()
                }
            })
            .collect();
        ByLiteral::new(&ends, budget)
    };
    let (plain, resolved) = (index(Form::Plain), index(Form::Resolved));
    let mut found = Vec::new();
    for to in list {
        if budget.cancel.is_cancelled() {
            break;
        }
        if !is_small(to) {
            continue;
        }
        let mut from = plain.sharing(&to.plain_turns_on(), budget);
        from.extend(resolved.sharing(&to.turns_on, budget));
        from.extend(releasable(to, states));
        for at in from {
            let from = &list[at];
            if from.atom == to.atom || !is_small(from) {
                continue;
            }
            if let Some(condition) = handed_over(from, to, states, conditions, budget) {
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

/// Places of the states that stand in what starts `to` and that it ends.
fn releasable(to: &State, states: &States) -> Vec<usize> {
    to.turns_on
        .support()
        .iter()
        .filter_map(|atom| states.place(*atom))
        .filter(|at| states.states[*at].deactivation.depends_on(to.atom))
        .collect()
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
    let starts = situation(&form.turns_on(to));
    let ends = situation(&ending(from, to, form, budget)?);
    let again = form.turns_on(from).restrict(to.atom, false);
    let apart = started_apart(&form.turns_on(from), &form.turns_on(to));
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

/// What ends `from`, with the normally closed contacts of states that lock it
/// out set aside (the paper, section 3.2), but not those of `to`.
fn ending(from: &State, to: &State, form: Form, budget: &Budget) -> Result<Function, Stop> {
    budget.check()?;
    let aside = from.interlocks.iter().filter(|other| **other != to.atom);
    let next = aside.fold(form.next(from).clone(), |next, other| {
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
