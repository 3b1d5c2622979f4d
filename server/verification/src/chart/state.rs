//! What changes while a grafcet runs: its latches, and what they hold now.

use grafcet::evolution::Condition;
use proof::{Gates, Signal};

use super::{Domains, Pass};
use crate::domain::{Domain, Kept};
use crate::inputs::Source;
use crate::refusal::Refusal;
use crate::value::Value;

/// The situation and the values at one moment of a scan.
#[derive(Clone, Debug)]
pub(super) struct State {
    /// By step.
    pub(super) active: Vec<Signal>,
    /// By step, whether it was activated in this scan.
    pub(super) fresh: Vec<Signal>,
    /// By variable.
    pub(super) values: Vec<Value>,
    /// What stored actions have made of outputs with continuous actions.
    pub(super) kept: Vec<Signal>,
    /// What each edge looked at when it looked last.
    pub(super) looked_at: Vec<Signal>,
    /// By forcing order, whether its part obeys it.
    pub(super) obeyed: Vec<Signal>,
}

/// The latches, in the order of the parts of a [`State`].
pub(super) struct Latches {
    first: Signal,
    active: Vec<Signal>,
    kept: Vec<(usize, Signal)>,
    looked_at: Vec<Signal>,
    obeyed: Vec<Signal>,
    /// A variable, a latch of it, and what it stands for.
    values: Vec<(usize, Kept, Signal)>,
    /// A step, the time, and whether it had passed.
    elapsed: Vec<(usize, u64, Signal)>,
}

impl Latches {
    /// On in the first scan.
    pub(super) fn first(&self) -> Signal {
        self.first
    }
}

impl Pass<'_> {
    /// The state as a scan finds it.
    pub(super) fn begin(
        &mut self,
        initial: &[bool],
        domains: &Domains,
    ) -> Result<(State, Latches), Refusal> {
        let net = self.net;
        let first = self.netlist.latch("first scan of the grafcet", true);
        self.netlist.set_next(first, Signal::FALSE);
        let steps = net.steps.iter().zip(initial);
        let active = steps.map(|(step, on)| self.netlist.latch(step.name.clone(), *on));
        let active: Vec<Signal> = active.collect();
        let looked_at = (1..=net.edges.len()).map(|at| {
            self.netlist
                .latch(format!("edge {at} of the grafcet"), false)
        });
        let looked_at: Vec<Signal> = looked_at.collect();
        let obeyed = (1..=net.orders.len()).map(|at| {
            self.netlist
                .latch(format!("order {at} of the grafcet"), false)
        });
        let obeyed: Vec<Signal> = obeyed.collect();
        let mut latches = Latches {
            first,
            active: active.clone(),
            kept: Vec::new(),
            looked_at: looked_at.clone(),
            obeyed: obeyed.clone(),
            values: Vec::new(),
            elapsed: Vec::new(),
        };
        let mut kept = vec![Signal::FALSE; net.variables.len()];
        for action in &net.stored {
            let at = action.variable;
            if net.is_continuous[at] && kept[at] == Signal::FALSE {
                let name = format!("{} as stored", net.variables[at]);
                kept[at] = self.netlist.latch(name, false);
                latches.kept.push((at, kept[at]));
            }
        }
        let mut values = Vec::with_capacity(net.variables.len());
        for (at, domain) in domains.iter().enumerate() {
            self.look()?;
            values.push(match net.is_own[at] {
                true => self.stored_value(at, domain, &mut latches.values),
                false => self.read_from_outside(at),
            });
        }
        self.begin_times(&mut latches.elapsed);
        let state = State {
            fresh: vec![first; active.len()],
            active,
            values,
            kept,
            looked_at,
            obeyed,
        };
        Ok((state, latches))
    }

    fn stored_value(
        &mut self,
        at: usize,
        domain: &Domain,
        latches: &mut Vec<(usize, Kept, Signal)>,
    ) -> Value {
        let name = &self.net.variables[at];
        let Some((value, own)) = domain.begin(&mut self.netlist, name) else {
            return self.unknown();
        };
        latches.extend(own.into_iter().map(|(kept, latch)| (at, kept, latch)));
        value
    }

    /// The times that conditions ask for. What has passed while the step stayed
    /// active has passed for good, and a longer time after a shorter one.
    fn begin_times(&mut self, latches: &mut Vec<(usize, u64, Signal)>) {
        let net = self.net;
        let mut times = Vec::new();
        for transition in &net.transitions {
            times_in(&transition.receptivity, &mut times);
        }
        net.edges
            .iter()
            .for_each(|edge| times_in(&edge.of, &mut times));
        net.stored
            .iter()
            .for_each(|it| times_in(&it.condition, &mut times));
        net.orders
            .iter()
            .for_each(|it| times_in(&it.condition, &mut times));
        let acts = net.continuous.iter().flatten().flat_map(|it| &it.acts);
        acts.for_each(|(_, condition)| times_in(condition, &mut times));
        times.sort_unstable();
        times.dedup();
        let mut longer: Option<(usize, Signal)> = None;
        for (step, time_ms) in times.into_iter().rev() {
            let name = &net.steps[step].name;
            let text = format!("{time_ms}ms/{name}");
            let source = Source::Elapsed {
                step: name.clone(),
                time_ms,
            };
            let latch = self.netlist.latch(format!("{text} before"), false);
            let passes = self.inputs.free(&mut self.netlist, &text, source);
            let mut passed = self.netlist.or(passes, latch);
            if let Some((same, after)) = longer
                && same == step
            {
                passed = self.netlist.or(passed, after);
            }
            longer = Some((step, passed));
            self.elapsed.insert((step, time_ms), passed);
            latches.push((step, time_ms, latch));
        }
    }

    /// What the state is becomes what the next scan finds.
    pub(super) fn end(&mut self, state: &State, latches: &Latches) {
        let net = &mut self.netlist;
        let all = [
            (&latches.active, &state.active),
            (&latches.looked_at, &state.looked_at),
            (&latches.obeyed, &state.obeyed),
        ];
        for (latches, next) in all {
            for (latch, next) in latches.iter().zip(next) {
                net.set_next(*latch, *next);
            }
        }
        for (at, latch) in &latches.kept {
            net.set_next(*latch, state.kept[*at]);
        }
        for (at, kept, latch) in &latches.values {
            let next = kept.next(&state.values[*at], net);
            net.set_next(*latch, next);
        }
        for (step, time, latch) in &latches.elapsed {
            let passed = self.elapsed[&(*step, *time)];
            let stayed = net.and(state.active[*step], !state.fresh[*step]);
            let next = net.and(stayed, passed);
            net.set_next(*latch, next);
        }
    }

    /// A number that is not followed from here on.
    pub(super) fn unknown(&mut self) -> Value {
        self.unknowns += 1;
        Value::Unknown(self.unknowns)
    }
}

fn times_in(condition: &Condition, times: &mut Vec<(usize, u64)>) {
    match condition {
        // No time at all has passed at once.
        Condition::Elapsed { time: 1.., step } => {
            if let Condition::Elapsed { time, .. } = condition {
                times.push((*step, *time));
            }
        }
        Condition::Not(inner) => times_in(inner, times),
        Condition::All(parts) | Condition::Any(parts) => {
            parts.iter().for_each(|part| times_in(part, times));
        }
        _ => {}
    }
}
