//! From a grafcet to what a machine runs.
//!
//! Nothing here can fail. What the text should have declared and did not is
//! taken as far as it makes sense: an unknown name is a variable that is 0
//! until somebody sets it, an unknown step is never active, an unknown part
//! holds nothing.

use std::collections::{HashMap, HashSet};

use logic::notation::milliseconds;
use logic::{Atom, Datum, Expr, Name};

use super::condition::{Condition, Edge};
use super::net::{
    Effect, Expansion, Imposed, Kind, Net, On, Order, Part, Step, Stored, Transition,
};
use super::publishing;
use super::term::{Operand, Term};
use crate::{Action, ActionKind, Grafcet, PartKind, Situation, StepKind, Trigger};

/// The grafcet ready to run, its instances written out, unless `look` has an
/// error meanwhile.
pub(super) fn compile<E>(
    grafcet: &Grafcet,
    mut look: impl FnMut() -> Result<(), E>,
) -> Result<Net, E> {
    let grafcet = &grafcet.instantiated();
    look()?;
    let mut compiler = Compiler::new(grafcet);
    look()?;
    compiler.parts();
    let is_continuous = |it: &&Action| matches!(it.kind, ActionKind::Continuous { .. });
    for (part, (_, chart)) in grafcet.charts().enumerate() {
        for transition in &chart.transitions {
            look()?;
            compiler.transition(transition, part.checked_sub(1));
        }
        for action in chart.actions.iter().filter(|it| !is_continuous(it)) {
            look()?;
            compiler.action(action);
        }
    }
    compiler.net.sampled_first = compiler.net.edges.len();
    for action in grafcet.actions().filter(is_continuous) {
        look()?;
        compiler.action(action);
    }
    compiler
        .net
        .stored
        .sort_by_key(|action| action.effect.rank());
    let Compiler {
        mut net, outputs, ..
    } = compiler;
    look()?;
    publishing::arrange(&mut net, outputs);
    net.is_own = net.is_continuous.clone();
    for action in &net.stored {
        net.is_own[action.variable] = true;
    }
    for output in &net.outputs {
        net.is_own[*output] = true;
    }
    Ok(net)
}

struct Compiler<'g> {
    grafcet: &'g Grafcet,
    part_names: HashMap<&'g Name, usize>,
    steps: HashMap<&'g str, &'g crate::Step>,
    /// What is declared, and whether as an output.
    declared: HashMap<&'g Name, bool>,
    published: HashSet<usize>,
    outputs: publishing::Outputs,
    net: Net,
}

impl<'g> Compiler<'g> {
    fn new(grafcet: &'g Grafcet) -> Self {
        let mut part_names = HashMap::new();
        for (at, part) in grafcet.parts.iter().enumerate() {
            part_names.entry(&part.name).or_insert(at);
        }
        let mut steps = HashMap::new();
        for step in grafcet.steps() {
            steps.entry(&*step.name).or_insert(step);
        }
        let mut declared = HashMap::new();
        for variable in grafcet.variables() {
            declared.insert(&variable.name, false);
        }
        for output in &grafcet.outputs {
            declared.insert(&output.name, true);
        }
        let mut compiler = Self {
            grafcet,
            part_names,
            steps,
            declared,
            published: HashSet::new(),
            outputs: publishing::Outputs::default(),
            net: Net::default(),
        };
        for step in grafcet.steps() {
            compiler.step(step);
        }
        for at in 0..compiler.net.steps.len() {
            compiler.net.steps[at].kind = compiler.kind(at);
        }
        for variable in grafcet.variables() {
            let at = compiler.variable(&variable.name);
            if let Some(address) = &variable.address {
                let address = address.to_ascii_uppercase();
                compiler.net.addresses.entry(address).or_insert(at);
            }
        }
        for output in &grafcet.outputs {
            compiler.publish(&output.name);
        }
        compiler
    }

    /// Adds a step, as if it were a plain one.
    fn step(&mut self, step: &crate::Step) {
        let net = &mut self.net;
        if net.step_names.contains_key(&step.name) {
            return;
        }
        net.step_names.insert(step.name.clone(), net.steps.len());
        net.steps.push(Step {
            name: step.name.clone(),
            is_initial: step.initial,
            kind: Kind::Plain,
        });
    }

    /// What the step at this place really is.
    fn kind(&self, at: usize) -> Kind {
        let name = &self.net.steps[at].name;
        match self.steps.get(&**name).map(|step| &step.kind) {
            Some(StepKind::Macro(_)) => self.macro_step(name).map_or(Kind::Plain, Kind::Macro),
            Some(StepKind::Enclosing(parts)) => {
                let parts = parts.iter().filter_map(|part| self.part_names.get(part));
                Kind::Enclosing(parts.copied().collect())
            }
            Some(StepKind::Plain) | None => Kind::Plain,
        }
    }

    /// The expansion that the step of this name stands for, if it is a
    /// macro-step that has one.
    fn expansion_of(&self, step: &str) -> Option<(usize, &'g Name, &'g Name)> {
        let StepKind::Macro(name) = &self.steps.get(step)?.kind else {
            return None;
        };
        let part = *self.part_names.get(name)?;
        match &self.grafcet.parts.get(part)?.kind {
            PartKind::Expansion { entry, exit } => Some((part, entry, exit)),
            _ => None,
        }
    }

    fn macro_step(&self, name: &str) -> Option<Expansion> {
        let (part, entry, exit) = self.expansion_of(name)?;
        Some(Expansion {
            entry: self.innermost(entry, |(_, entry, _)| entry),
            exit: self.innermost(exit, |(_, _, exit)| exit),
            steps: self.owned(part),
        })
    }

    /// The step that holds activity for `step`: an entry or exit that is a
    /// macro-step itself has an entry or exit of its own.
    fn innermost(
        &self,
        step: &Name,
        way: impl Fn((usize, &'g Name, &'g Name)) -> &'g Name,
    ) -> Option<usize> {
        let mut step = step;
        let mut passed = HashSet::new();
        while let Some(expansion) = self.expansion_of(step) {
            if !passed.insert(step.clone()) {
                return None;
            }
            step = way(expansion);
        }
        self.net.step_names.get(step).copied()
    }

    /// The steps of a part that hold activity, those of expansions included.
    fn owned(&self, part: usize) -> Vec<usize> {
        let mut owned = Vec::new();
        let mut seen = HashSet::from([part]);
        let mut open = vec![part];
        while let Some(part) = open.pop() {
            let chart = self.grafcet.parts.get(part).map(|part| &part.chart);
            for step in chart.into_iter().flat_map(|chart| &chart.steps) {
                match self.expansion_of(&step.name) {
                    Some((inner, ..)) if seen.insert(inner) => open.push(inner),
                    Some(_) => {}
                    None => owned.extend(self.net.step_names.get(&step.name)),
                }
            }
        }
        owned.sort_unstable();
        owned
    }

    fn parts(&mut self) {
        let mut parts: Vec<Part> = (0..self.grafcet.parts.len())
            .map(|at| Part {
                owned: self.owned(at),
                linked: self.linked(at),
                frozen_with: self.frozen_with(at),
                ..Part::default()
            })
            .collect();
        for (at, step) in self.net.steps.iter().enumerate() {
            if let Some((part, ..)) = self.expansion_of(&step.name) {
                parts[part].expands.push(at);
            }
            if let Kind::Enclosing(enclosed) = &step.kind {
                for part in enclosed {
                    parts[*part].enclosed_by.push(at);
                }
            }
        }
        self.net.parts = parts;
    }

    fn linked(&self, part: usize) -> Vec<usize> {
        let steps = self.grafcet.parts[part].chart.steps.iter();
        steps
            .filter(|step| step.activation_link)
            .filter_map(|step| self.net.step_names.get(&step.name).copied())
            .collect()
    }

    fn frozen_with(&self, part: usize) -> Vec<usize> {
        let mut found = vec![part];
        let mut next = 0;
        while let Some(&inner) = found.get(next) {
            next += 1;
            for (at, outer) in self.grafcet.parts.iter().enumerate() {
                let mut steps = outer.chart.steps.iter();
                let holds = steps.any(|step| {
                    let expansion = self.expansion_of(&step.name);
                    expansion.is_some_and(|(expanded, ..)| expanded == inner)
                });
                if holds && !found.contains(&at) {
                    found.push(at);
                }
            }
        }
        found
    }

    fn transition(&mut self, transition: &crate::Transition, part: Option<usize>) {
        let from: Option<Vec<usize>> = transition
            .from
            .iter()
            .map(|step| self.net.exit(*self.net.step_names.get(step)?))
            .collect();
        let to = transition.to.iter();
        let to = to.filter_map(|step| self.net.entry(*self.net.step_names.get(step)?));
        let to = to.collect();
        let receptivity = self.condition(&transition.receptivity);
        self.net.transitions.push(Transition {
            name: transition.name.clone(),
            from,
            to,
            receptivity,
            part,
        });
    }

    fn action(&mut self, action: &Action) {
        let Some(&step) = self.net.step_names.get(&action.step) else {
            return;
        };
        let first_edge = self.net.edges.len();
        let condition = self.all_of(action.whole_condition().as_ref());
        let edges = first_edge..self.net.edges.len();
        if let ActionKind::Forcing(situation) = &action.kind {
            self.order(action, step, condition, situation);
            return;
        }
        let Operand::Variable(variable) = self.operand_called(&action.output) else {
            return;
        };
        self.publish(&action.output);
        match &action.kind {
            ActionKind::Stored { effect, on } => {
                let on = match on {
                    Trigger::Activation => On::Activation,
                    Trigger::Deactivation => On::Deactivation,
                    Trigger::Event(event) => On::Event(self.edge(event, false)),
                };
                let effect = match effect {
                    crate::Effect::Set => Effect::Set,
                    crate::Effect::Reset => Effect::Reset,
                    crate::Effect::Assign(term) => {
                        Effect::Assign(Term::read(term, |name| self.operand_called(name)))
                    }
                };
                self.net.stored.push(Stored {
                    step,
                    on,
                    condition,
                    variable,
                    effect,
                });
            }
            _ => self.outputs.add(variable, step, condition, edges),
        }
    }

    fn order(&mut self, action: &Action, step: usize, condition: Condition, to: &Situation) {
        let Some(&part) = self.part_names.get(&action.output) else {
            return;
        };
        let situation = match to {
            Situation::Current => Imposed::Current,
            Situation::Initial => Imposed::Initial,
            Situation::Steps(steps) => {
                let known = steps.iter();
                let known = known.filter_map(|step| self.net.step_names.get(step));
                Imposed::Steps(known.filter_map(|step| self.net.entry(*step)).collect())
            }
        };
        self.net.orders.push(Order {
            step,
            condition,
            part,
            situation,
        });
    }

    fn all_of(&mut self, condition: Option<&Expr>) -> Condition {
        condition.map_or(Condition::Constant(true), |expr| self.condition(expr))
    }

    fn condition(&mut self, expr: &Expr) -> Condition {
        match expr {
            Expr::Constant(value) => Condition::Constant(*value),
            Expr::Not(inner) => Condition::Not(Box::new(self.condition(inner))),
            Expr::And(parts) => {
                Condition::All(parts.iter().map(|part| self.condition(part)).collect())
            }
            Expr::Or(parts) => {
                Condition::Any(parts.iter().map(|part| self.condition(part)).collect())
            }
            Expr::Atom(Atom::Variable(name)) => match self.operand_called(name) {
                Operand::Step(at) => Condition::Step(at),
                Operand::Variable(at) => Condition::Variable(at),
                Operand::Constant(value) => Condition::Constant(value.is_on()),
            },
            Expr::Atom(Atom::Comparison(comparison)) => Condition::Comparison {
                left: self.operand(&comparison.left),
                relation: comparison.relation,
                right: self.operand(&comparison.right),
            },
            Expr::Atom(Atom::Rise(inner)) => Condition::Edge(self.edge(inner, false)),
            Expr::Atom(Atom::Fall(inner)) => Condition::Edge(self.edge(inner, true)),
            Expr::Atom(Atom::Elapsed { time, step }) => {
                match (milliseconds(time), self.net.step_names.get(step)) {
                    (Some(time), Some(&step)) => Condition::Elapsed { time, step },
                    _ => Condition::Constant(false),
                }
            }
        }
    }

    fn edge(&mut self, of: &Expr, is_falling: bool) -> usize {
        let of = self.condition(of);
        self.net.edges.push(Edge { of, is_falling });
        self.net.edges.len() - 1
    }

    /// A side of a comparison: a number, else what bears the name.
    fn operand(&mut self, text: &str) -> Operand {
        match Datum::constant(text) {
            Some(value) => Operand::Constant(value),
            None => self.operand_called(text),
        }
    }

    fn operand_called(&mut self, name: &str) -> Operand {
        match self.net.step_names.get(name) {
            Some(step) => Operand::Step(*step),
            None => Operand::Variable(self.variable(name)),
        }
    }

    /// The variable called `name`, added if there is none yet.
    fn variable(&mut self, name: &str) -> usize {
        if let Some(at) = self.net.variable(name) {
            return at;
        }
        let at = self.net.variables.len();
        self.net.variables.push(name.into());
        self.net.variable_names.insert(name.into(), at);
        at
    }

    /// Counts what is declared as an output, or is written and not declared,
    /// among the outputs.
    fn publish(&mut self, name: &Name) {
        let is_output = self.declared.get(name).copied().unwrap_or(true);
        let at = self.variable(name);
        if is_output && self.published.insert(at) {
            self.net.outputs.push(at);
        }
    }
}
