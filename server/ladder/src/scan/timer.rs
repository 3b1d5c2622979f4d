//! Timers with real time.

use std::collections::HashMap;

use logic::Name;

use super::Datum;
use super::state::State;
use crate::{Timer, TimerKind};

/// When each timer was solved last, in milliseconds of the machine's clock. A
/// timer that is passed over measures the time when it is solved again.
#[derive(Clone, Debug, Default)]
pub(super) struct Clock {
    pub(super) now: u64,
    solved: HashMap<Name, u64>,
}

impl Clock {
    /// Time since the instance was solved last; 0 the first time.
    fn since(&mut self, instance: &Name) -> i64 {
        let before = self.solved.insert(instance.clone(), self.now);
        let passed = before.map_or(0, |before| self.now.saturating_sub(before));
        i64::try_from(passed).unwrap_or(i64::MAX)
    }
}

/// Names the members that a timer shows, and presets it.
pub(super) fn prepare(timer: &Timer, state: &mut State) {
    let name = &timer.instance.name;
    let member = |member: &str| -> Name { format!("{name}.{member}").into() };
    state.add_alias(member("IN"), member("EN"));
    state.add_alias(member("Q"), member("DN"));
    state.add_alias(member("ET"), member("ACC"));
    state.add_alias(member("PT"), member("PRE"));
    state.add_alias(timer.output.clone(), member("DN"));
    if let Some(preset) = timer.preset_ms {
        let preset = i64::try_from(preset).unwrap_or(i64::MAX);
        state.write(&member("PRE"), Datum::Integer(preset));
    }
}

/// Solves a timer: `input` is the power it gets, `reset` a reset input's.
pub(super) fn solve(timer: &Timer, input: bool, reset: bool, clock: &mut Clock, state: &mut State) {
    let name = &timer.instance.name;
    let passed = clock.since(name);
    state.copy_preset(timer.preset_from.as_ref(), name);
    let mut face = Face::read(name, state);
    if reset {
        face = Face {
            preset: face.preset,
            ..Face::default()
        };
    }
    match timer.kind {
        TimerKind::OnDelay => face.on_delay(input, passed),
        TimerKind::OffDelay => face.off_delay(input, passed),
        TimerKind::Pulse => face.pulse(input, passed),
        TimerKind::Retentive => face.retentive(input, passed),
    }
    face.enabled = input;
    face.write(name, state);
}

/// What a timer shows.
#[derive(Clone, Copy, Debug, Default)]
struct Face {
    enabled: bool,
    timing: bool,
    done: bool,
    elapsed: i64,
    preset: i64,
}

impl Face {
    fn read(name: &str, state: &State) -> Self {
        let member = |member: &str| state.read(&format!("{name}.{member}"));
        Self {
            enabled: member("EN").is_on(),
            timing: member("TT").is_on(),
            done: member("DN").is_on(),
            elapsed: member("ACC").integer(),
            preset: member("PRE").integer(),
        }
    }

    fn write(&self, name: &str, state: &mut State) {
        let mut member = |member: &str, value: Datum| {
            state.write(&format!("{name}.{member}"), value);
        };
        member("EN", self.enabled.into());
        member("TT", self.timing.into());
        member("DN", self.done.into());
        member("ACC", self.elapsed.into());
    }

    fn let_pass(&mut self, passed: i64) {
        self.elapsed = self.elapsed.saturating_add(passed).min(self.preset);
    }

    fn has_run_out(&self) -> bool {
        self.elapsed >= self.preset
    }

    fn on_delay(&mut self, input: bool, passed: i64) {
        if !input || !self.enabled {
            self.elapsed = 0;
        } else {
            self.let_pass(passed);
        }
        self.done = input && self.has_run_out();
        self.timing = input && !self.done;
    }

    fn off_delay(&mut self, input: bool, passed: i64) {
        if input {
            self.elapsed = 0;
            self.timing = false;
            self.done = true;
            return;
        }
        if self.enabled {
            self.elapsed = 0;
            self.timing = true;
        } else if self.timing {
            self.let_pass(passed);
        }
        self.timing &= !self.has_run_out();
        self.done = self.timing;
    }

    fn pulse(&mut self, input: bool, passed: i64) {
        if self.timing {
            self.let_pass(passed);
        } else if input && !self.enabled {
            self.elapsed = 0;
            self.timing = true;
        } else if !input {
            self.elapsed = 0;
        }
        self.timing &= !self.has_run_out();
        self.done = self.timing;
        if !self.timing && !input {
            self.elapsed = 0;
        }
    }

    fn retentive(&mut self, input: bool, passed: i64) {
        if input && self.enabled && !self.has_run_out() {
            self.let_pass(passed);
        }
        self.done |= input && self.has_run_out();
        self.timing = input && !self.done;
    }
}
