//! One evolution: everything that can be cleared is cleared, at once.

use super::hierarchy;
use super::net::{Net, State};
use super::storing;

/// What one evolution did.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Fired {
    /// The transitions that were cleared.
    pub(super) transitions: Vec<usize>,
    /// Whether anything is different after it.
    pub(super) has_effect: bool,
}

/// Samples the edges at these places: which of them occur, compared with what
/// they looked at when they were sampled last. Before the first scan all of it
/// was 0.
pub(super) fn sample(
    net: &Net,
    state: &mut State,
    places: impl IntoIterator<Item = usize>,
    occurring: &mut [bool],
    now: u64,
) {
    for at in places {
        let edge = &net.edges[at];
        let is_on = edge.of.holds(&state.view(occurring, now));
        let was_on = std::mem::replace(&mut state.looked_at[at], is_on);
        occurring[at] = match edge.is_falling {
            true => was_on && !is_on,
            false => is_on && !was_on,
        };
    }
}

/// Clears all transitions that can be, together, each judged by the situation
/// and the values before any of them is cleared.
pub(super) fn evolve(net: &Net, state: &mut State, edges: &[bool], now: u64) -> Fired {
    let view = state.view(edges, now);
    let all = net.transitions.iter().enumerate();
    let transitions: Vec<usize> = all
        .filter(|(_, transition)| {
            let mut from = transition.from.iter().flatten();
            let is_enabled = transition.from.is_some() && from.all(|step| state.active[*step]);
            is_enabled
                && !hierarchy::is_held(net, state, transition)
                && transition.receptivity.holds(&view)
        })
        .map(|(at, _)| at)
        .collect();
    let before = state.clone();
    for at in &transitions {
        for step in net.transitions[*at].from.iter().flatten() {
            state.active[*step] = false;
        }
    }
    // After all deactivations: a step that is both stays active.
    for at in &transitions {
        for step in &net.transitions[*at].to {
            state.active[*step] = true;
        }
    }
    hierarchy::settle(net, state, &before.active, edges, now);
    tell(net, state, &before.active, edges, now);
    Fired {
        transitions,
        has_effect: !state.is_same(&before),
    }
}

/// Lets the clocks of steps and the stored actions know that the situation has
/// changed from `before` to what it is now.
pub(super) fn tell(net: &Net, state: &mut State, before: &[bool], edges: &[bool], now: u64) {
    if state.active == before {
        return;
    }
    for (at, is_active) in state.active.iter().enumerate() {
        if *is_active && !before[at] {
            state.since[at] = now;
        }
    }
    storing::on_change(net, state, edges, now, before);
}
