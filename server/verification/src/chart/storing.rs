//! Stored actions: outputs that take a value at an event and keep it.

use grafcet::evolution::{Effect, On, Stored, Term};
use proof::{Gates, Signal};

use super::Pass;
use super::reading::operand;
use super::state::State;
use crate::refusal::Refusal;
use crate::value::{Value, applied};

impl Pass<'_> {
    /// Performs what the events of this scan cause, in the steps that were
    /// active when they came.
    pub(super) fn on_events(&mut self, state: &mut State) -> Result<(), Refusal> {
        let active = state.active.clone();
        self.perform(state, |pass, action| match action.on {
            On::Event(edge) => pass.netlist.and(active[action.step], pass.edges[edge]),
            On::Activation | On::Deactivation => Signal::FALSE,
        })
    }

    /// Performs what a change of the situation causes: what ends gives way to
    /// what begins.
    pub(super) fn on_change(
        &mut self,
        state: &mut State,
        before: &[Signal],
    ) -> Result<(), Refusal> {
        let active = state.active.clone();
        self.perform(state, |pass, action| match action.on {
            On::Deactivation => pass.netlist.and(before[action.step], !active[action.step]),
            On::Activation | On::Event(_) => Signal::FALSE,
        })?;
        self.perform(state, |pass, action| match action.on {
            On::Activation => pass.netlist.and(active[action.step], !before[action.step]),
            On::Deactivation | On::Event(_) => Signal::FALSE,
        })
    }

    /// Performs the actions that are due. All conditions are looked at before
    /// anything is written.
    fn perform(
        &mut self,
        state: &mut State,
        due: impl Fn(&mut Self, &Stored) -> Signal,
    ) -> Result<(), Refusal> {
        let net = self.net;
        let mut all = Vec::new();
        for action in &net.stored {
            let due = due(self, action);
            if due != Signal::FALSE {
                let holds = self.holds(&action.condition, state);
                all.push((action, self.netlist.and(due, holds)));
            }
        }
        for (action, due) in all {
            self.look()?;
            let value = match &action.effect {
                Effect::Set => Value::constant(true.into()),
                Effect::Reset => Value::constant(false.into()),
                Effect::Assign(term) => self.term(term, state),
            };
            self.write(action.variable, &value, due, state);
        }
        Ok(())
    }

    fn term(&mut self, term: &Term, state: &State) -> Value {
        if let Some(only) = term.copied() {
            return operand(only, state);
        }
        let operands: Vec<Value> = term.operands().map(|it| operand(it, state)).collect();
        let operands: Vec<&Value> = operands.iter().collect();
        let sum = applied(&mut self.netlist, &operands, |values| {
            let mut values = values.iter().copied();
            term.sum(|| values.next().unwrap_or_default())
        });
        sum.unwrap_or_else(|| self.unknown())
    }

    fn write(&mut self, at: usize, value: &Value, when: Signal, state: &mut State) {
        if !self.net.is_continuous[at] {
            let before = state.values[at].clone();
            state.values[at] = self.either(when, value, &before);
            return;
        }
        let on = match (value.on(&mut self.netlist), value) {
            (Some(on), _) => on,
            (None, Value::Unknown(_)) => {
                let name = format!("{} as stored", self.net.variables[at]);
                let source = crate::inputs::Source::Opaque(name.clone().into());
                self.inputs.free(&mut self.netlist, &name, source)
            }
            (None, _) => Signal::FALSE,
        };
        state.kept[at] = self.netlist.ite(when, on, state.kept[at]);
    }
}
