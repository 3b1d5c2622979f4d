//! Timers and counters: what their type says, with time and counts left free.
//!
//! A timer's input, its output and what it remembers are followed exactly. When
//! its time is up is an input of the translation, of which only that is known
//! which holds for any passing of time: an on-delay cannot have run out in the
//! scan that starts it, and what has run out stays so while it is on. With a
//! preset that the program changes, or a member that it writes itself, not even
//! that is supposed.

use ladder::{Counter, CounterKind, Timer, TimerKind};
use logic::{Datum, Name};
use proof::{Gates, Signal};

use super::flow::Arrived;
use super::store::Store;
use crate::refusal::Refusal;
use crate::value::Value;

/// What a timer or counter shows, before it is solved.
struct Face<'n> {
    name: &'n str,
    /// The preset, if it is constant and nothing else interferes.
    preset: Option<i64>,
}

impl<'n> Face<'n> {
    fn of(name: &'n str, is_preset_read: bool, own: &[&str], store: &Store<'_>) -> Self {
        let member = |member: &str| format!("{name}.{member}");
        let preset = member("PRE");
        let is_alone = !is_preset_read
            && store.is_given(&preset)
            && !store.is_written(&preset)
            && !store.is_mixed(name)
            && !own.iter().any(|it| store.is_written_by_hand(&member(it)))
            && store.initially(&member("ACC")).integer() == 0
            && !own.iter().any(|it| store.initially(&member(it)).is_on());
        Self {
            name,
            preset: is_alone.then(|| store.initially(&preset).integer()),
        }
    }

    fn member(&self, member: &str) -> Name {
        format!("{}.{member}", self.name).into()
    }

    fn is_on(&self, member: &str, store: &mut Store<'_>) -> Result<Signal, Refusal> {
        store.is_on(&self.member(member))
    }

    fn write(
        &self,
        member: &str,
        value: Signal,
        when: Signal,
        store: &mut Store<'_>,
    ) -> Result<(), Refusal> {
        store.write(&self.member(member), &Value::bit(value), when)
    }

    /// Numbers that time and counts move: they are not followed.
    fn lose(&self, members: &[&str], when: Signal, store: &mut Store<'_>) -> Result<(), Refusal> {
        for member in members {
            let unknown = store.unknown();
            store.write(&self.member(member), &unknown, when)?;
        }
        Ok(())
    }
}

/// Solves a timer whose input has this power.
pub(super) fn timer(
    timer: &Timer,
    input: Signal,
    reset: Signal,
    when: Signal,
    store: &mut Store<'_>,
) -> Result<(), Refusal> {
    let own = ["EN", "TT", "DN", "ACC"];
    let face = Face::of(
        &timer.instance.name,
        timer.preset_from.is_some(),
        &own,
        store,
    );
    let before = |member: &str, store: &mut Store<'_>| {
        let on = face.is_on(member, store)?;
        Ok::<Signal, Refusal>(store.net.and(on, !reset))
    };
    let was_enabled = before("EN", store)?;
    let was_timing = before("TT", store)?;
    let was_done = before("DN", store)?;
    let up = match face.preset {
        Some(..=0) => Signal::TRUE,
        _ => store.event(&timer.instance.name, "runs out"),
    };
    let is_known = matches!(face.preset, Some(1..));
    let net = &mut store.net;
    let (timing, done) = match timer.kind {
        TimerKind::OnDelay => {
            let has_run = match is_known {
                true => {
                    let up = net.or(up, was_done);
                    net.and(was_enabled, up)
                }
                false => up,
            };
            let done = net.and(input, has_run);
            (net.and(input, !done), done)
        }
        TimerKind::OffDelay => {
            let runs = net.or(was_enabled, was_timing);
            let has_run = match is_known {
                true => net.and(!was_enabled, up),
                false => up,
            };
            let runs = net.and(runs, !has_run);
            let timing = net.and(!input, runs);
            (timing, net.or(input, timing))
        }
        TimerKind::Pulse => {
            let starts = net.and(input, !was_enabled);
            let begins = net.and(starts, !was_timing);
            let goes_on = net.and(was_timing, !up);
            let timing = match is_known {
                true => net.or(goes_on, begins),
                false => {
                    let begins = net.and(begins, !up);
                    net.or(goes_on, begins)
                }
            };
            (timing, timing)
        }
        TimerKind::Retentive => {
            let has_run = match is_known {
                true => net.and(was_enabled, up),
                false => up,
            };
            let now = net.and(input, has_run);
            let done = net.or(was_done, now);
            (net.and(input, !done), done)
        }
    };
    if timer.preset_from.is_some() {
        face.lose(&["PRE"], when, store)?;
    }
    face.lose(&["ACC"], when, store)?;
    face.write("EN", input, when, store)?;
    face.write("TT", timing, when, store)?;
    face.write("DN", done, when, store)
}

/// Solves a counter whose counting input has this power.
pub(super) fn counter(
    counter: &Counter,
    power: Signal,
    inputs: &Arrived<'_>,
    when: Signal,
    store: &mut Store<'_>,
) -> Result<(), Refusal> {
    let own = ["CU", "DN", "ACC"];
    let face = Face::of(
        &counter.instance.name,
        counter.preset_from.is_some(),
        &own,
        store,
    );
    let rises = |pin: &str, signal: Signal, store: &mut Store<'_>| {
        let before = face.is_on(pin, store)?;
        face.write(pin, signal, when, store)?;
        Ok::<Signal, Refusal>(store.net.and(signal, !before))
    };
    let up = match counter.kind {
        CounterKind::Up | CounterKind::Circular => rises("CU", power, store)?,
        CounterKind::Down => rises("CD", power, store)?,
        CounterKind::UpDown => {
            let down = inputs.pin("CD", store).unwrap_or(Signal::FALSE);
            rises("CD", down, store)?;
            rises("CU", power, store)?
        }
    };
    let either = |names: [&str; 2], store: &mut Store<'_>| {
        let signals: Vec<Signal> = names
            .iter()
            .filter_map(|it| inputs.pin(it, store))
            .collect();
        store.net.any(&signals)
    };
    let reset = either(["R", "RESET"], store);
    let load = either(["LD", "LOAD"], store);
    let event = store.event(&counter.instance.name, "is at its preset");
    let was_done = face.is_on("DN", store)?;
    let net = &mut store.net;
    let done = match (counter.kind, face.preset) {
        (CounterKind::Up, Some(preset @ 1..)) => {
            let counted = match preset {
                1 => up,
                _ => net.and(up, event),
            };
            let counted = net.or(was_done, counted);
            let done = net.or(counted, load);
            net.and(done, !reset)
        }
        _ => event,
    };
    let is_low = store.event(&counter.instance.name, "is at 0");
    if counter.preset_from.is_some() {
        face.lose(&["PRE"], when, store)?;
    }
    face.lose(&["ACC"], when, store)?;
    face.write("DN", done, when, store)?;
    face.write("QD", is_low, when, store)
}

/// Resets a timer or counter (`RES`) while powered.
pub(super) fn reset(name: &str, power: Signal, store: &mut Store<'_>) -> Result<(), Refusal> {
    let member = |member: &str| format!("{name}.{member}");
    store.write(&member("ACC"), &Value::constant(Datum::Integer(0)), power)?;
    for bit in ["EN", "TT", "DN", "CU", "CD"] {
        store.write(&member(bit), &Value::bit(Signal::FALSE), power)?;
    }
    Ok(())
}
