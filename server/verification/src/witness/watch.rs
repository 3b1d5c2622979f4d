//! The program with signals that say what states do.

use std::collections::HashMap;

use ladder::scan::Machine;
use logic::{Name, Relation};
use proof::{Gates, Limits, Netlist, Signal, Sought, Trace, seek};

use super::pairs::{Held, Pairs};
use crate::inputs::{Inputs, Source};
use crate::program::Followed;
use crate::system::System;
use crate::value::Value;

/// Something that is looked for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Ask {
    /// One state ends and another begins in the same scan.
    AtOnce { from: Name, to: Name },
    /// One state ends and another begins, the one or the other a scan earlier.
    InTurn { from: Name, to: Name },
    /// One state ends, then none is on in its group until another begins.
    Delayed { from: Name, to: Name },
    /// One state ends and two others begin in the same scan.
    Together { from: Name, to: [Name; 2] },
}

/// What a state does in a scan.
#[derive(Clone, Copy)]
struct Doing {
    now: Signal,
    ends: Signal,
    begins: Signal,
}

/// A program that is watched.
pub(super) struct Watch<'w> {
    followed: &'w Followed,
    /// What its inputs stand for.
    pub inputs: Inputs,
    netlist: Netlist,
    /// The inputs that a plant gives, by their places.
    calm: Vec<usize>,
    doing: HashMap<Name, Doing>,
    /// By states: that it was the last that ended, and none is on since.
    idle: HashMap<Name, Signal>,
}

impl<'w> Watch<'w> {
    /// Watches the states of `pairs` in a system that holds nothing but the
    /// ladder and the rules of the environment.
    pub fn new(
        machine: &Machine<'_>,
        followed: &'w Followed,
        system: System,
        pairs: &Pairs,
    ) -> Self {
        let inputs = system.evolved.inputs;
        let is_given = |source: &Source| source.is_given();
        let places = inputs.sources.iter().enumerate();
        let calm = places.filter(|(_, source)| is_given(source));
        let mut watch = Self {
            followed,
            calm: calm.map(|(at, _)| at).collect(),
            inputs,
            netlist: system.frame.netlist,
            doing: HashMap::new(),
            idle: HashMap::new(),
        };
        // In the order of the pairs, for the order decides the netlist.
        let in_groups = pairs.groups.iter().flatten();
        for name in in_groups.chain(pairs.list.iter().flat_map(|(from, to)| [from, to])) {
            if let Some(held) = pairs.held.get(name)
                && !watch.doing.contains_key(name)
            {
                watch.watch(name, held, machine);
            }
        }
        for group in &pairs.groups {
            watch.group(group);
        }
        watch
    }

    fn watch(&mut self, name: &Name, held: &Held, machine: &Machine<'_>) {
        let net = &mut self.netlist;
        let value = self.followed.output(&held.variable, net);
        let now = value.and_then(|it| match held.value {
            None => it.on(net),
            Some(state) => it.compares(net, Relation::Equal, &Value::constant(state.into())),
        });
        let Some(now) = now else {
            return;
        };
        let initial = machine.value(&self.followed.resolved(&held.variable));
        let was = net.delayed(format!("{name} before"), now, held.is_on(initial));
        let ends = net.and(was, !now);
        let begins = net.and(!was, now);
        self.doing.insert(name.clone(), Doing { now, ends, begins });
    }

    fn group(&mut self, states: &[Name]) {
        let doing = states.iter().map(|name| self.doing.get(name).copied());
        // A state that is not followed may be on at any time.
        let Some(doing) = doing.collect::<Option<Vec<Doing>>>() else {
            return;
        };
        let net = &mut self.netlist;
        let on: Vec<Signal> = doing.iter().map(|it| it.now).collect();
        let none = !net.any(&on);
        for (name, doing) in states.iter().zip(doing) {
            let was = net.latch(format!("{name} was the last"), false);
            let last = net.or(doing.ends, was);
            let next = net.and(last, none);
            net.set_next(was, next);
            self.idle.insert(name.clone(), was);
        }
    }

    /// The signal of what is looked for; `None` if it cannot be followed.
    fn signal(&mut self, ask: &Ask) -> Option<Signal> {
        let doing = |name: &Name| self.doing.get(name).copied();
        let parts = match ask {
            Ask::AtOnce { from, to } => vec![doing(from)?.ends, doing(to)?.begins],
            Ask::InTurn { from, to } => {
                let (from, to) = (doing(from)?, doing(to)?);
                return Some(self.in_turn(from, to));
            }
            Ask::Delayed { from, to } => {
                vec![self.idle.get(from).copied()?, doing(to)?.begins]
            }
            Ask::Together { from, to: [a, b] } => {
                vec![doing(from)?.ends, doing(a)?.begins, doing(b)?.begins]
            }
        };
        Some(self.netlist.all(&parts))
    }

    /// Whether no more than one input of the plant changes from scan to scan.
    pub fn is_calm(&self, trace: &Trace) -> bool {
        let mut before: &[bool] = &[];
        trace.inputs.iter().all(|row| {
            let changes = |at: &&usize| {
                let was = before.get(**at).copied().unwrap_or_default();
                row.get(**at).is_some_and(|is| *is != was)
            };
            let changed = self.calm.iter().filter(changes).count();
            before = row;
            changed <= 1
        })
    }

    fn in_turn(&mut self, from: Doing, to: Doing) -> Signal {
        let net = &mut self.netlist;
        let ended = net.delayed("ended before", from.ends, false);
        let begun = net.delayed("begun before", to.begins, false);
        let first_ended = net.and(ended, to.begins);
        let still_on = net.and(begun, to.now);
        let first_begun = net.and(still_on, from.ends);
        net.or(first_ended, first_begun)
    }

    /// Looks for all of these, in a plant in which no more than one input changes
    /// from scan to scan if that is asked.
    pub fn search(&mut self, asked: &[Ask], is_calm: bool, limits: &Limits) -> Vec<Sought> {
        let signals: Vec<Option<Signal>> = asked.iter().map(|ask| self.signal(ask)).collect();
        let mut netlist = self.netlist.clone();
        for signal in &signals {
            netlist.never("looked for", signal.unwrap_or(Signal::FALSE));
        }
        let calm: &[usize] = if is_calm { &self.calm } else { &[] };
        let found = seek(&netlist, calm, limits).properties;
        let found = found.into_iter().zip(signals);
        // What is not followed is not found, but nobody knows that it never is.
        let known = found.map(|(sought, signal)| match signal {
            Some(_) => sought,
            None => Sought::Open(0),
        });
        known.collect()
    }
}
