use std::collections::{HashMap, HashSet};

use logic::Name;
use source::Diagnostic;

use super::places::{Places, places};
use super::syntax::{Document, Item, Kind, Statement};
use super::words::Word;
use super::{check, parse};
use crate::{Chart, Part, Spec};

/// What reading a text gives: always a spec, and what there is to say.
#[derive(Clone, Debug)]
pub struct Reading {
    /// The spec, holding all that could be understood.
    pub spec: Spec,
    /// Where its names and rules stand.
    pub places: Places,
    /// Findings about the text, in the order of their places.
    pub diagnostics: Vec<Diagnostic>,
}

/// Reads a rule text.
///
/// Never fails: what cannot be understood is reported and left out of the
/// spec, and reading goes on with the next line. Of two declarations or rules
/// of one name the first counts. Places are bytes of `text`, so give it whole,
/// with its byte order mark.
pub fn read(text: &str) -> Reading {
    let document = parse::parse(text);
    let steps = document.step_names();
    let spec = spec(&document, &steps);
    Reading {
        places: places(&document, &steps, &spec),
        diagnostics: check::diagnostics(&document, &steps, &spec),
        spec,
    }
}

/// What the statements say, where `steps` are the names of steps.
pub(crate) fn spec(document: &Document<'_>, steps: &HashSet<Name>) -> Spec {
    let mut builder = Builder::default();
    for statement in &document.statements {
        builder.add(statement, steps);
    }
    builder.finish()
}

#[derive(Default)]
struct Builder {
    spec: Spec,
    parts: HashMap<Name, usize>,
    taken: Taken,
    initial: HashSet<Name>,
    linked: HashSet<Name>,
}

/// Names that count already.
#[derive(Default)]
struct Taken {
    declared: HashSet<Name>,
    instances: HashSet<Name>,
    transitions: HashSet<Name>,
    environment: HashSet<Name>,
    never: HashSet<Name>,
}

impl Builder {
    fn add(&mut self, statement: &Statement, steps: &HashSet<Name>) {
        match &statement.kind {
            Kind::Grafcet(name) => {
                self.spec.grafcet.name.get_or_insert_with(|| name.clone());
            }
            Kind::List(word, entries) => {
                for entry in entries {
                    self.declare(statement, *word, &entry.item);
                }
            }
            Kind::Part(name, kind) => {
                let parts = &mut self.spec.grafcet.parts;
                self.parts.entry(name.clone()).or_insert_with(|| {
                    parts.push(Part {
                        name: name.clone(),
                        kind: kind.clone(),
                        chart: Chart::default(),
                    });
                    parts.len() - 1
                });
            }
            Kind::Transition(rule) if self.taken.transitions.insert(rule.name.clone()) => {
                let transition = rule.meaning(steps);
                self.chart(statement).transitions.push(transition);
            }
            Kind::Action(action) => self.chart(statement).actions.push(action.clone()),
            Kind::Environment(rule) if self.taken.environment.insert(rule.name.clone()) => {
                self.spec.environment.push(rule.clone());
            }
            Kind::Never(rule) if self.taken.never.insert(rule.name.clone()) => {
                self.spec.never.push(rule.clone());
            }
            Kind::Decision(decision) => self.spec.decisions.push(decision.clone()),
            _ => {}
        }
    }

    fn declare(&mut self, statement: &Statement, word: Word, item: &Item) {
        match item {
            Item::Step(step) if self.taken.declared.insert(item.name().clone()) => {
                self.chart(statement).steps.push(step.clone());
            }
            Item::Variable(variable) if self.taken.declared.insert(item.name().clone()) => {
                let grafcet = &mut self.spec.grafcet;
                let list = match word {
                    Word::Input => &mut grafcet.inputs,
                    Word::Output => &mut grafcet.outputs,
                    _ => &mut grafcet.internals,
                };
                list.push(variable.clone());
            }
            Item::Instance(instance) if self.taken.instances.insert(item.name().clone()) => {
                self.spec.grafcet.instances.push(instance.clone());
            }
            Item::Name(name) if word == Word::Marking => {
                self.initial.insert(name.clone());
            }
            Item::Name(name) if word == Word::Activation => {
                self.linked.insert(name.clone());
            }
            _ => {}
        }
    }

    /// The chart that a statement speaks of.
    fn chart(&mut self, statement: &Statement) -> &mut Chart {
        let grafcet = &mut self.spec.grafcet;
        let at = statement
            .part
            .as_ref()
            .and_then(|part| self.parts.get(part));
        match at.and_then(|at| grafcet.parts.get_mut(*at)) {
            Some(part) => &mut part.chart,
            None => &mut grafcet.chart,
        }
    }

    fn finish(mut self) -> Spec {
        let grafcet = &mut self.spec.grafcet;
        let charts = grafcet.parts.iter_mut().map(|part| &mut part.chart);
        for chart in std::iter::once(&mut grafcet.chart).chain(charts) {
            for step in &mut chart.steps {
                step.initial = self.initial.contains(&step.name);
                step.activation_link = self.linked.contains(&step.name);
            }
        }
        self.spec
    }
}
