//! Stored actions: outputs that take a value at an event and keep it.

use logic::Datum;

use super::net::{Effect, Net, On, State, Stored};

/// Performs the stored actions that `is_due` picks. All conditions are looked
/// at before anything is written. Then values are assigned, bits set, bits
/// reset, each in the order of the text: of a set and a reset at one moment
/// the reset counts.
pub(super) fn perform(
    net: &Net,
    state: &mut State,
    edges: &[bool],
    now: u64,
    is_due: impl Fn(&Stored) -> bool,
) {
    let due: Vec<&Stored> = {
        let view = state.view(edges, now);
        let due = net.stored.iter().filter(|action| is_due(action));
        due.filter(|action| action.condition.holds(&view)).collect()
    };
    for action in due {
        let value = match &action.effect {
            Effect::Set => true.into(),
            Effect::Reset => false.into(),
            Effect::Assign(term) => term.value(&state.view(edges, now)),
        };
        write(net, state, action.variable, value);
    }
}

/// Performs what the events of this scan cause, in the steps that were active
/// when they came.
pub(super) fn on_events(net: &Net, state: &mut State, edges: &[bool], now: u64) {
    let active = state.active.clone();
    perform(net, state, edges, now, |action| match action.on {
        On::Event(edge) => active[action.step] && edges[edge],
        _ => false,
    });
}

/// Performs what a change of the situation causes: what is done on
/// deactivation first, since what ends gives way to what begins.
pub(super) fn on_change(net: &Net, state: &mut State, edges: &[bool], now: u64, before: &[bool]) {
    let active = state.active.clone();
    perform(net, state, edges, now, |action| {
        action.on == On::Deactivation && before[action.step] && !active[action.step]
    });
    perform(net, state, edges, now, |action| {
        action.on == On::Activation && !before[action.step] && active[action.step]
    });
}

fn write(net: &Net, state: &mut State, variable: usize, value: Datum) {
    if net.is_continuous[variable] {
        state.kept[variable] = value.is_on();
    } else {
        state.values[variable] = value;
    }
}
