//! What macro-steps, enclosing steps and forcing orders make of a situation.

use grafcet::evolution::{Imposed, Kind, Order, Transition};
use proof::{Gates, Signal};

use super::Pass;
use super::state::State;
use crate::refusal::Refusal;

impl Pass<'_> {
    /// Whether something above it keeps the transition from being cleared: an
    /// order in force, an enclosing step or a macro-step that is not active.
    pub(super) fn is_held(&mut self, transition: &Transition, state: &State) -> Signal {
        let net = self.net;
        let Some(part) = transition.part.and_then(|part| net.parts.get(part)) else {
            return Signal::FALSE;
        };
        let orders = net.orders.iter().zip(&state.obeyed);
        let freezing = orders.filter(|(order, _)| part.frozen_with.contains(&order.part));
        let mut holds: Vec<Signal> = freezing.map(|(_, obeyed)| *obeyed).collect();
        for steps in [&part.enclosed_by, &part.expands] {
            if !steps.is_empty() {
                holds.push(!self.any_active(steps, state));
            }
        }
        self.netlist.any(&holds)
    }

    fn any_active(&mut self, steps: &[usize], state: &State) -> Signal {
        let active: Vec<Signal> = steps.iter().map(|step| state.active[*step]).collect();
        self.netlist.any(&active)
    }

    /// Settles the situation below its enclosing steps and orders, where
    /// `before` is the one that it grew from.
    pub(super) fn settle(&mut self, state: &mut State, before: &[Signal]) -> Result<(), Refusal> {
        let net = self.net;
        let is_plain = net.steps.iter().all(|step| step.kind == Kind::Plain);
        if is_plain
            && net.parts.iter().all(|part| part.enclosed_by.is_empty())
            && net.orders.is_empty()
        {
            return Ok(());
        }
        let mut opened = before.to_vec();
        self.open(state, &mut opened)?;
        self.close(state)?;
        if net.orders.is_empty() {
            return Ok(());
        }
        for _ in 0..=net.parts.len() {
            self.impose(state)?;
            self.open(state, &mut opened)?;
            self.close(state)?;
        }
        Ok(())
    }

    /// Activates what the enclosing steps activate that were not active in
    /// `opened`, which is brought up to date.
    fn open(&mut self, state: &mut State, opened: &mut [Signal]) -> Result<(), Refusal> {
        let net = self.net;
        let is_enclosing =
            |step: &&grafcet::evolution::Step| matches!(step.kind, Kind::Enclosing(_));
        // Each round opens what lies one level further in.
        for _ in 0..net.steps.iter().filter(is_enclosing).count() {
            self.look()?;
            for (at, step) in net.steps.iter().enumerate() {
                let Kind::Enclosing(parts) = &step.kind else {
                    continue;
                };
                let newly = self.netlist.and(state.active[at], !opened[at]);
                opened[at] = self.netlist.or(opened[at], state.active[at]);
                let linked = parts.iter().flat_map(|part| &net.parts[*part].linked);
                for entry in linked.filter_map(|step| net.entry(*step)) {
                    state.active[entry] = self.netlist.or(state.active[entry], newly);
                }
            }
        }
        Ok(())
    }

    /// Deactivates what lies in enclosures none of whose enclosing steps is
    /// active.
    fn close(&mut self, state: &mut State) -> Result<(), Refusal> {
        let net = self.net;
        // Each round closes the parts one level further in.
        for _ in 0..=net.parts.len() {
            let mut closed = false;
            for part in net.parts.iter().filter(|part| !part.enclosed_by.is_empty()) {
                self.look()?;
                let is_open = self.any_active(&part.enclosed_by, state);
                for step in &part.owned {
                    let now = self.netlist.and(state.active[*step], is_open);
                    closed |= now != state.active[*step];
                    state.active[*step] = now;
                }
            }
            if !closed {
                break;
            }
        }
        self.derive(state);
        Ok(())
    }

    /// Brings the variables of macro-steps up to date.
    fn derive(&mut self, state: &mut State) {
        let net = self.net;
        for (at, step) in net.steps.iter().enumerate() {
            if let Kind::Macro(expansion) = &step.kind {
                state.active[at] = self.any_active(&expansion.steps, state);
            }
        }
    }

    /// Lets every part obey the first of the orders for it, and gives those the
    /// situation that begin to obey.
    fn impose(&mut self, state: &mut State) -> Result<(), Refusal> {
        let net = self.net;
        let mut taken = vec![Signal::FALSE; net.parts.len()];
        let mut obeyed = Vec::with_capacity(net.orders.len());
        for order in &net.orders {
            let holds = self.holds(&order.condition, state);
            let is_given = self.netlist.and(state.active[order.step], holds);
            obeyed.push(self.netlist.and(is_given, !taken[order.part]));
            taken[order.part] = self.netlist.or(taken[order.part], is_given);
        }
        let begins: Vec<Signal> = obeyed
            .iter()
            .zip(&state.obeyed)
            .map(|(now, before)| self.netlist.and(*now, !*before))
            .collect();
        for part in 0..net.parts.len() {
            self.look()?;
            let orders = net.orders.iter().zip(&begins);
            for (order, begins) in orders.filter(|(order, _)| order.part == part) {
                self.obey(order, *begins, state);
            }
        }
        state.obeyed = obeyed;
        self.derive(state);
        Ok(())
    }

    fn obey(&mut self, order: &Order, begins: Signal, state: &mut State) {
        let net = self.net;
        let wanted: Vec<usize> = match &order.situation {
            Imposed::Current => return,
            Imposed::Steps(steps) => steps.clone(),
            Imposed::Initial => {
                let all = net.steps.iter().enumerate();
                let initial = all.filter(|(_, step)| step.is_initial);
                initial.filter_map(|(at, _)| net.entry(at)).collect()
            }
        };
        for step in &net.parts[order.part].owned {
            let wanted = Signal::constant(wanted.contains(step));
            let before = state.active[*step];
            state.active[*step] = self.netlist.ite(begins, wanted, before);
        }
    }
}
