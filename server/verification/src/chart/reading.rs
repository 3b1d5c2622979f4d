//! What conditions see.

use grafcet::evolution::{Condition, Operand};
use logic::{Datum, Expr, Name, Relation};
use proof::{Gates, Signal};

use super::Pass;
use super::state::State;
use crate::inputs::Source;
use crate::ranges::Ranged;
use crate::value::Value;

impl Pass<'_> {
    /// A variable that the grafcet does not write: the ladder's, if the ladder
    /// knows it, else an input.
    pub(super) fn read_from_outside(&mut self, at: usize) -> Value {
        let name: &Name = &self.net.variables[at];
        if let Some(ladder) = self.ladder.filter(|it| it.looks_at(name))
            && let Some(value) = ladder.output(name, &mut self.netlist)
        {
            return value;
        }
        let Some(numbers) = self.numbers.get(name) else {
            return Value::bit(self.inputs.bit(&mut self.netlist, name));
        };
        let kind = self.ladder.and_then(|it| it.kind(name));
        let mut compared: Vec<Datum> = numbers.iter().copied().flatten().collect();
        compared.push(Datum::Integer(0));
        let value = self.inputs.number(&mut self.netlist, name, kind, &compared);
        if !numbers.contains(&None) {
            return value;
        }
        self.unknowns += 1;
        let ranged = Ranged { value, compared };
        self.ranges.insert(self.unknowns, ranged);
        Value::Unknown(self.unknowns)
    }

    /// Whether a condition holds at this moment, with the edges that occur now.
    pub(super) fn holds(&mut self, condition: &Condition, state: &State) -> Signal {
        match condition {
            Condition::Constant(value) => Signal::constant(*value),
            Condition::Step(at) => state.active[*at],
            Condition::Variable(at) => {
                let value = &state.values[*at];
                let on = self.ranges.on(value, &mut self.netlist);
                match (on, value) {
                    (Some(on), _) => on,
                    (None, Value::Unknown(number)) => {
                        let text = self.net.variables[*at].to_string();
                        self.opaque(&text, vec![*number])
                    }
                    (None, _) => Signal::FALSE,
                }
            }
            Condition::Comparison {
                left,
                relation,
                right,
            } => self.compares(left, *relation, right, state),
            Condition::Edge(at) => self.edges[*at],
            Condition::Elapsed { time, step } => match self.elapsed.get(&(*step, *time)) {
                Some(passed) => {
                    let stayed = self.netlist.and(*passed, !state.fresh[*step]);
                    self.netlist.and(state.active[*step], stayed)
                }
                // No time at all has passed at once.
                None => state.active[*step],
            },
            Condition::Not(inner) => !self.holds(inner, state),
            Condition::All(parts) => {
                let parts: Vec<Signal> = parts.iter().map(|it| self.holds(it, state)).collect();
                self.netlist.all(&parts)
            }
            Condition::Any(parts) => {
                let parts: Vec<Signal> = parts.iter().map(|it| self.holds(it, state)).collect();
                self.netlist.any(&parts)
            }
        }
    }

    fn compares(
        &mut self,
        left: &Operand,
        relation: Relation,
        right: &Operand,
        state: &State,
    ) -> Signal {
        let sides = [operand(left, state), operand(right, state)];
        let net = &mut self.netlist;
        let holds = self.ranges.compares(net, [&sides[0], &sides[1]], relation);
        if let Some(holds) = holds {
            return holds;
        }
        let mut unknowns: Vec<usize> = sides
            .iter()
            .filter_map(|side| match side {
                Value::Unknown(number) => Some(*number),
                Value::Known(_) => None,
                // What it is at this moment.
                Value::Word(_) => {
                    self.unknowns += 1;
                    Some(self.unknowns)
                }
            })
            .collect();
        unknowns.sort_unstable();
        unknowns.dedup();
        let [left, right] = [left, right].map(|side| self.spelled(side));
        match Expr::comparison(&left, relation, &right) {
            Expr::Constant(value) => Signal::constant(value),
            Expr::Not(inner) => !self.opaque(&inner.to_string(), unknowns),
            atom => self.opaque(&atom.to_string(), unknowns),
        }
    }

    fn spelled(&self, operand: &Operand) -> Name {
        match operand {
            Operand::Constant(value) => value.to_string().into(),
            Operand::Variable(at) => self.net.variables[*at].clone(),
            Operand::Step(at) => self.net.steps[*at].name.clone(),
        }
    }

    /// Something of which only the text is known, and the unknown numbers that
    /// it depends on: the ladder's, if it asks for the same.
    fn opaque(&mut self, text: &str, unknowns: Vec<usize>) -> Signal {
        if let Some(known) = self.ladder.and_then(|it| it.free(text, &unknowns)) {
            return known;
        }
        let unknowns: Vec<String> = unknowns.iter().map(usize::to_string).collect();
        let name = format!("{text} of the grafcet #{}", unknowns.join(" #"));
        let source = Source::Opaque(text.into());
        self.inputs.free(&mut self.netlist, &name, source)
    }
}

/// The value of an operand.
pub(super) fn operand(operand: &Operand, state: &State) -> Value {
    match operand {
        Operand::Constant(value) => Value::constant(*value),
        Operand::Variable(at) => state.values[*at].clone(),
        Operand::Step(at) => Value::bit(state.active[*at]),
    }
}
