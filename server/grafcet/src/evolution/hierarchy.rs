//! What macro-steps, enclosing steps and forcing orders make of a situation
//! (IEC 60848, clause 7).

use super::net::{Imposed, Kind, Net, Order, Part, State, Transition};

/// Whether something above it keeps the transition from being cleared: an
/// order in force, an enclosing step or a macro-step that is not active.
pub(super) fn is_held(net: &Net, state: &State, transition: &Transition) -> bool {
    let Some(part) = transition.part.and_then(|part| net.parts.get(part)) else {
        return false;
    };
    let is_frozen = |part: &usize| state.obeyed[*part].is_some();
    let none_active =
        |steps: &[usize]| !steps.is_empty() && !steps.iter().any(|step| state.active[*step]);
    part.frozen_with.iter().any(is_frozen)
        || none_active(&part.enclosed_by)
        || none_active(&part.expands)
}

/// Settles the situation below its enclosing steps and orders, where `before`
/// is the one that it grew from: what newly active enclosing steps activate,
/// what orders impose, what ends with its enclosing step, and the variables of
/// macro-steps.
pub(super) fn settle(net: &Net, state: &mut State, before: &[bool], edges: &[bool], now: u64) {
    let mut opened = before.to_vec();
    open(net, state, &mut opened);
    close(net, state);
    // Each round at least one more part obeys, unless orders force those who
    // give them; then the next evolution sees the situation as it is.
    for _ in 0..=net.parts.len() {
        if !impose(net, state, edges, now) {
            break;
        }
        open(net, state, &mut opened);
        close(net, state);
    }
}

/// The situation at the start.
pub(super) fn begin(net: &Net, state: &mut State) {
    for (at, step) in net.steps.iter().enumerate() {
        if let (true, Some(entry)) = (step.is_initial, net.entry(at)) {
            state.active[entry] = true;
        }
    }
    // Where an initial enclosing step encloses a part without initial steps,
    // that part starts as any activation would start it.
    for _ in 0..=net.parts.len() {
        for part in &net.parts {
            let is_open = part.enclosed_by.iter().any(|step| state.active[*step]);
            if is_open && !part.owned.iter().any(|step| state.active[*step]) {
                link(net, state, part);
            }
        }
    }
    close(net, state);
}

/// Activates the steps of `part` that the activation of its enclosing step
/// activates.
fn link(net: &Net, state: &mut State, part: &Part) {
    for step in &part.linked {
        if let Some(entry) = net.entry(*step) {
            state.active[entry] = true;
        }
    }
}

/// Activates what the enclosing steps activate that were not active in
/// `opened`, which is brought up to date.
fn open(net: &Net, state: &mut State, opened: &mut [bool]) {
    loop {
        let newly = net.steps.iter().enumerate().find_map(|(at, step)| {
            let Kind::Enclosing(parts) = &step.kind else {
                return None;
            };
            (state.active[at] && !opened[at]).then_some((at, parts))
        });
        let Some((at, parts)) = newly else {
            return;
        };
        opened[at] = true;
        for part in parts {
            link(net, state, &net.parts[*part]);
        }
    }
}

/// Deactivates what lies in enclosures none of whose enclosing steps is
/// active.
fn close(net: &Net, state: &mut State) {
    loop {
        let mut closed = false;
        for part in &net.parts {
            let is_open = part.enclosed_by.is_empty()
                || part.enclosed_by.iter().any(|step| state.active[*step]);
            if is_open {
                continue;
            }
            for step in &part.owned {
                closed |= std::mem::replace(&mut state.active[*step], false);
            }
        }
        if !closed {
            break;
        }
    }
    derive(net, state);
}

/// Brings the variables of macro-steps up to date.
fn derive(net: &Net, state: &mut State) {
    for (at, step) in net.steps.iter().enumerate() {
        if let Kind::Macro(expansion) = &step.kind {
            let mut inside = expansion.steps.iter();
            state.active[at] = inside.any(|step| state.active[*step]);
        }
    }
}

/// Lets every part obey the first of the orders for it, and gives those the
/// situation that begin to obey. Whether any order began or ended.
fn impose(net: &Net, state: &mut State, edges: &[bool], now: u64) -> bool {
    let mut obeyed = vec![None; net.parts.len()];
    {
        let view = state.view(edges, now);
        for (at, order) in net.orders.iter().enumerate() {
            let is_given = view.is_active(order.step) && order.condition.holds(&view);
            if is_given && obeyed[order.part].is_none() {
                obeyed[order.part] = Some(at);
            }
        }
    }
    if obeyed == state.obeyed {
        return false;
    }
    for (part, order) in obeyed.iter().enumerate() {
        if let Some(at) = order
            && state.obeyed[part] != *order
        {
            obey(net, state, &net.orders[*at]);
        }
    }
    state.obeyed = obeyed;
    derive(net, state);
    true
}

fn obey(net: &Net, state: &mut State, order: &Order) {
    let owned = &net.parts[order.part].owned;
    let wanted: Vec<usize> = match &order.situation {
        Imposed::Current => return,
        Imposed::Steps(steps) => steps.clone(),
        Imposed::Initial => {
            let all = net.steps.iter().enumerate();
            let initial = all.filter(|(_, step)| step.is_initial);
            initial.filter_map(|(at, _)| net.entry(at)).collect()
        }
    };
    for step in owned {
        state.active[*step] = wanted.contains(step);
    }
}
