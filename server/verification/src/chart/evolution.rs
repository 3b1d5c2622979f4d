//! A scan: edges, events, evolutions, outputs.

use proof::{Gates, Signal};

use super::Pass;
use super::state::{Latches, State};
use crate::refusal::Refusal;
use crate::value::Value;

impl Pass<'_> {
    /// Follows a scan. The signal says whether the situation would still change
    /// after so many evolutions.
    pub(super) fn scan(
        &mut self,
        state: &mut State,
        latches: &Latches,
        evolutions: usize,
    ) -> Result<Signal, Refusal> {
        let net = self.net;
        self.look()?;
        self.sample(0..net.sampled_first, state);
        self.on_events(state)?;
        let situation = state.active.clone();
        // The initial situation is activated by the first scan.
        let before = situation
            .iter()
            .map(|on| self.netlist.and(*on, !latches.first()));
        let before: Vec<Signal> = before.collect();
        self.settle(state, &situation)?;
        self.tell(state, &before)?;
        let first = self.evolve(state)?;
        // What changes nothing and clears nothing is stable, though another
        // evolution would see no edges any more.
        let goes_on = match net.sampled_first {
            0 => Signal::TRUE,
            _ => first,
        };
        // Edges are true in the first evolution only.
        self.edges.fill(Signal::FALSE);
        for _ in 1..evolutions {
            let before = state.clone();
            let changes = self.evolve(state)?;
            self.keep_unless(goes_on, state, &before);
            if changes == Signal::FALSE {
                break;
            }
        }
        let mut further = state.clone();
        let changes = self.evolve(&mut further)?;
        self.publish(state)?;
        Ok(self.netlist.and(goes_on, changes))
    }

    /// Which edges at these places occur, compared with what they looked at
    /// when they were sampled last.
    fn sample(&mut self, places: impl IntoIterator<Item = usize>, state: &mut State) {
        let net = self.net;
        for at in places {
            let edge = &net.edges[at];
            let now = self.holds(&edge.of, state);
            let before = std::mem::replace(&mut state.looked_at[at], now);
            self.edges[at] = match edge.is_falling {
                true => self.netlist.and(before, !now),
                false => self.netlist.and(now, !before),
            };
        }
    }

    /// Clears all transitions that can be, together. Whether the situation is
    /// another then or, with edges, whether any was cleared.
    fn evolve(&mut self, state: &mut State) -> Result<Signal, Refusal> {
        let net = self.net;
        let mut clears = Vec::with_capacity(net.transitions.len());
        for transition in &net.transitions {
            self.look()?;
            let Some(from) = &transition.from else {
                clears.push(Signal::FALSE);
                continue;
            };
            let from: Vec<Signal> = from.iter().map(|step| state.active[*step]).collect();
            let is_enabled = self.netlist.all(&from);
            let is_held = self.is_held(transition, state);
            let holds = self.holds(&transition.receptivity, state);
            let all = [is_enabled, !is_held, holds];
            clears.push(self.netlist.all(&all));
        }
        self.look()?;
        let before = state.active.clone();
        let mut left = vec![Vec::new(); before.len()];
        let mut entered = vec![Vec::new(); before.len()];
        for (transition, clears) in net.transitions.iter().zip(&clears) {
            for step in transition.from.iter().flatten() {
                left[*step].push(*clears);
            }
            for step in &transition.to {
                entered[*step].push(*clears);
            }
        }
        for (at, active) in state.active.iter_mut().enumerate() {
            // A step that is both left and entered stays active.
            let left = self.netlist.any(&left[at]);
            let entered = self.netlist.any(&entered[at]);
            let stays = self.netlist.and(*active, !left);
            *active = self.netlist.or(stays, entered);
        }
        let obeyed = state.obeyed.clone();
        self.settle(state, &before)?;
        self.tell(state, &before)?;
        let mut differ = match self.edges.iter().any(|edge| *edge != Signal::FALSE) {
            true => clears,
            false => Vec::new(),
        };
        let all = [(&before, &state.active), (&obeyed, &state.obeyed)];
        for (before, after) in all {
            self.look()?;
            for (before, after) in before.iter().zip(after) {
                differ.push(self.netlist.xor(*before, *after));
            }
        }
        Ok(self.netlist.any(&differ))
    }

    /// Lets the clocks of steps and the stored actions know that the situation
    /// has changed.
    fn tell(&mut self, state: &mut State, before: &[Signal]) -> Result<(), Refusal> {
        for (at, before) in before.iter().enumerate() {
            let begins = self.netlist.and(state.active[at], !*before);
            state.fresh[at] = self.netlist.or(state.fresh[at], begins);
        }
        self.on_change(state, before)
    }

    /// The state where the condition holds, else what it was before.
    fn keep_unless(&mut self, condition: Signal, state: &mut State, before: &State) {
        if condition == Signal::TRUE {
            return;
        }
        let pairs = [
            (&mut state.active, &before.active),
            (&mut state.fresh, &before.fresh),
            (&mut state.kept, &before.kept),
            (&mut state.obeyed, &before.obeyed),
        ];
        for (now, before) in pairs {
            for (now, before) in now.iter_mut().zip(before) {
                *now = self.netlist.ite(condition, *now, *before);
            }
        }
        for at in 0..state.values.len() {
            let (now, before) = (state.values[at].clone(), &before.values[at]);
            state.values[at] = self.either(condition, &now, before);
        }
    }

    /// `then` where the condition holds, else `otherwise`.
    pub(super) fn either(&mut self, condition: Signal, then: &Value, otherwise: &Value) -> Value {
        let chosen = crate::value::chosen(&mut self.netlist, condition, then, otherwise);
        match chosen {
            Some(value) if value.cases().len() <= crate::value::MOST_VALUES => value,
            _ => self.unknown(),
        }
    }

    /// Publishes every output that has continuous actions.
    fn publish(&mut self, state: &mut State) -> Result<(), Refusal> {
        let net = self.net;
        self.edges.fill(Signal::FALSE);
        for circle in &net.continuous {
            self.look()?;
            let places = circle
                .iter()
                .flat_map(|output| output.edges.iter().copied());
            let places: Vec<usize> = places.collect();
            self.sample(places, state);
            let mut values = Vec::new();
            for output in circle {
                let acts = output.acts.iter().map(|(step, condition)| {
                    let holds = self.holds(condition, state);
                    self.netlist.and(state.active[*step], holds)
                });
                let acts: Vec<Signal> = acts.collect();
                values.push(self.netlist.any(&acts));
            }
            for (output, acts) in circle.iter().zip(values) {
                let at = output.variable;
                let on = self.netlist.or(acts, state.kept[at]);
                state.values[at] = Value::bit(on);
            }
        }
        Ok(())
    }
}
