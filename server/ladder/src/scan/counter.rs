//! Counters.

use logic::Name;

use super::Datum;
use super::power::Inputs;
use super::state::State;
use crate::{Counter, CounterKind};

/// Names the members that a counter shows, and presets it.
pub(super) fn prepare(counter: &Counter, state: &mut State) {
    let name = &counter.instance.name;
    let member = |member: &str| -> Name { format!("{name}.{member}").into() };
    state.add_alias(member("Q"), member("DN"));
    state.add_alias(member("QU"), member("DN"));
    state.add_alias(member("CV"), member("ACC"));
    state.add_alias(member("PV"), member("PRE"));
    state.add_alias(counter.output.clone(), member("DN"));
    if let Some(preset) = counter.preset {
        state.write(&member("PRE"), Datum::Integer(preset));
    }
}

/// Solves a counter. `power` is its counting input; a bidirectional counter
/// counts down on its pin `CD`; `R` resets and `LD` loads the preset.
pub(super) fn solve(counter: &Counter, power: bool, inputs: &Inputs<'_>, state: &mut State) {
    let name = &counter.instance.name;
    let member = |member: &str| format!("{name}.{member}");
    state.copy_preset(counter.preset_from.as_ref(), name);
    let preset = state.read(&member("PRE")).integer();
    let mut count = state.read(&member("ACC")).integer();
    let mut rises = |pin: &str, signal: bool| {
        let before = state.read(&member(pin)).is_on();
        state.write(&member(pin), signal.into());
        signal && !before
    };
    let (up, down) = match counter.kind {
        CounterKind::Up | CounterKind::Circular => (rises("CU", power), false),
        CounterKind::Down => (false, rises("CD", power)),
        CounterKind::UpDown => {
            let down = inputs.pin("CD").unwrap_or(false);
            (rises("CU", power), rises("CD", down))
        }
    };
    let at_pin = |pin| inputs.pin(pin).unwrap_or(false);
    // IEC counters stop at 0 on the way down, Rockwell's go on below.
    let stops_at_zero = is_iec(counter);
    if at_pin("R") || at_pin("RESET") {
        count = 0;
    } else if at_pin("LD") || at_pin("LOAD") {
        count = preset;
    } else {
        if up {
            count = count.saturating_add(1);
        }
        if down && !(stops_at_zero && count <= 0) {
            count = count.saturating_sub(1);
        }
    }
    if counter.kind == CounterKind::Circular && count > preset {
        count = 0;
    }
    let done = if counter.kind == CounterKind::Down && is_iec(counter) {
        count <= 0
    } else {
        count >= preset
    };
    state.write(&member("ACC"), Datum::Integer(count));
    state.write(&member("DN"), done.into());
    state.write(&member("QD"), (count <= 0).into());
}

/// Whether the counter is IEC's: its output is called `Q`.
fn is_iec(counter: &Counter) -> bool {
    counter.output.ends_with(".Q") || counter.output.ends_with(".QD")
}

/// Resets a timer or counter (`RES`).
pub(super) fn reset(name: &str, state: &mut State) {
    state.write(&format!("{name}.ACC"), Datum::Integer(0));
    for bit in ["EN", "TT", "DN", "CU", "CD"] {
        state.write(&format!("{name}.{bit}"), Datum::Bool(false));
    }
}
