//! Bringing an existing spec up to new decisions without losing what people
//! did to it.
//!
//! Three specs meet: what the ladder gave for the decisions so far (the
//! *base*), what the file says now, and what the ladder gives for the new
//! decisions. Where the file still says what the base says, the new spec takes
//! its place. Where it says something else, somebody edited it, or the ladder
//! has changed since: the file's word stands, and a [`Departure`] tells what
//! the ladder gives instead. Nothing else is remembered anywhere, so the file
//! is the whole state of a conversion.

use std::collections::{BTreeMap, BTreeSet};

use grafcet::{Action, ActionKind, Decision, Effect, Grafcet, Spec, Step, Transition, Verdict};
use logic::{Atoms, Budget, Expr, Function, Name};

use super::base::base;
use crate::Analysis;

/// A spec brought up to date.
#[derive(Clone, Debug)]
pub struct Update {
    /// What the file shall hold.
    pub spec: Spec,
    /// Where it differs from what the ladder gives.
    pub departures: Vec<Departure>,
}

/// A place where a spec says something else than the ladder.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Departure {
    /// A transition differs; the ladder gives this one, or none.
    Transition {
        /// The transition's name.
        name: Name,
        /// What the ladder gives.
        ladder: Option<Transition>,
    },
    /// The ladder gives a transition between steps of the spec that the spec
    /// does not have.
    MissingTransition(Transition),
    /// An action differs; the ladder gives this one, or none.
    Action {
        /// The action that the spec has.
        spec: Action,
        /// What the ladder gives.
        ladder: Option<Action>,
    },
    /// The ladder gives an action that the spec does not have.
    MissingAction(Action),
}

/// Brings `existing` up to `decisions`; see the module's page.
pub fn update(
    analysis: &Analysis,
    existing: &Spec,
    decisions: &[Decision],
    budget: &Budget,
) -> Update {
    if existing.grafcet == Grafcet::default() {
        // Nothing that could be kept, and nothing that could depart.
        return Update {
            spec: Spec {
                grafcet: super::spec(analysis, decisions, budget).grafcet,
                decisions: decisions.to_vec(),
                ..existing.clone()
            },
            departures: Vec::new(),
        };
    }
    let base = base(analysis, existing, budget);
    let new = if base.decisions == decisions {
        base.clone()
    } else {
        super::spec(analysis, decisions, budget)
    };
    let mut merge = Merge {
        base: &base.grafcet,
        file: &existing.grafcet,
        new: &new.grafcet,
        merged: new.grafcet.clone(),
        departures: Vec::new(),
        budget,
    };
    merge.steps();
    merge.transitions();
    merge.actions();
    merge.interface();
    let kept: BTreeSet<&Name> = decisions
        .iter()
        .filter_map(|decision| match &decision.verdict {
            Verdict::Keep(name) => Some(name),
            _ => None,
        })
        .collect();
    let departures = merge
        .departures
        .into_iter()
        .filter(|departure| !kept.contains(departure.label()))
        .collect();
    Update {
        spec: Spec {
            grafcet: merge.merged,
            environment: existing.environment.clone(),
            never: existing.never.clone(),
            decisions: decisions.to_vec(),
        },
        departures,
    }
}

impl Departure {
    /// The label of the rule that it speaks of: a transition's name, or the
    /// step of an action.
    pub fn label(&self) -> &Name {
        match self {
            Self::Transition { name, .. } => name,
            Self::MissingTransition(transition) => &transition.name,
            Self::Action { spec, .. } => &spec.step,
            Self::MissingAction(action) => &action.step,
        }
    }

    /// What the ladder gives, written into `spec` in place of what it has.
    pub fn renew(&self, spec: &mut Spec) {
        let chart = &mut spec.grafcet.chart;
        match self {
            Self::Transition { name, ladder } => {
                let place = chart.transitions.iter().position(|it| it.name == *name);
                replace(&mut chart.transitions, place, ladder.clone());
            }
            Self::MissingTransition(transition) => chart.transitions.push(transition.clone()),
            Self::Action { spec, ladder } => {
                let place = chart.actions.iter().position(|it| it == spec);
                replace(&mut chart.actions, place, ladder.clone());
            }
            Self::MissingAction(action) => chart.actions.push(action.clone()),
        }
    }
}

/// Puts `by` in the place of what stands `at` a place of `list`, or adds it.
fn replace<T>(list: &mut Vec<T>, at: Option<usize>, by: Option<T>) {
    match at {
        Some(at) => drop(list.splice(at..=at, by)),
        None => list.extend(by),
    }
}

struct Merge<'m> {
    base: &'m Grafcet,
    file: &'m Grafcet,
    new: &'m Grafcet,
    merged: Grafcet,
    departures: Vec<Departure>,
    budget: &'m Budget,
}

impl Merge<'_> {
    /// Steps of the file that differ from the base stay as they are; those of
    /// the base that the file lacks come back: a state of the ladder has a
    /// step.
    fn steps(&mut self) {
        let base = by_name(&self.base.chart.steps, |step| &step.name);
        let mut places = places(&self.merged.chart.steps, |step| &step.name);
        for step in &self.file.chart.steps {
            if base.get(&step.name).is_some_and(|it| same_step(it, step)) {
                continue;
            }
            match places.get(&step.name) {
                Some(&at) => self.merged.chart.steps[at] = step.clone(),
                None => {
                    places.insert(step.name.clone(), self.merged.chart.steps.len());
                    self.merged.chart.steps.push(step.clone());
                }
            }
        }
        self.merged.parts = self.file.parts.clone();
        self.merged.instances = self.file.instances.clone();
    }

    fn transitions(&mut self) {
        let base = by_name(&self.base.chart.transitions, |it| &it.name);
        let new = by_name(&self.new.chart.transitions, |it| &it.name);
        let file = by_name(&self.file.chart.transitions, |it| &it.name);
        let steps: BTreeSet<&Name> = self.file.chart.steps.iter().map(|s| &s.name).collect();
        let mut places = places(&self.merged.chart.transitions, |it| &it.name);
        for transition in &self.file.chart.transitions {
            let name = &transition.name;
            let untouched = base
                .get(name)
                .is_some_and(|it| self.same_transition(it, transition));
            let given = new.get(name).copied();
            let agrees = given.is_some_and(|it| self.same_transition(it, transition));
            if untouched && !agrees {
                continue;
            }
            if !agrees {
                self.departures.push(Departure::Transition {
                    name: name.clone(),
                    ladder: given.cloned(),
                });
            }
            // The file's own wording and comment stay.
            match places.get(name) {
                Some(&at) => self.merged.chart.transitions[at] = transition.clone(),
                None => {
                    places.insert(name.clone(), self.merged.chart.transitions.len());
                    self.merged.chart.transitions.push(transition.clone());
                }
            }
        }
        let removed: BTreeSet<&Name> = self
            .base
            .chart
            .transitions
            .iter()
            .filter(|it| !file.contains_key(&it.name) && new.contains_key(&it.name))
            .filter(|it| {
                it.from
                    .iter()
                    .chain(&it.to)
                    .all(|step| steps.contains(step))
            })
            .map(|it| &it.name)
            .collect();
        let (gone, left) = std::mem::take(&mut self.merged.chart.transitions)
            .into_iter()
            .partition(|it| removed.contains(&it.name));
        self.merged.chart.transitions = left;
        let gone: Vec<Transition> = gone;
        self.departures
            .extend(gone.into_iter().map(Departure::MissingTransition));
    }

    fn actions(&mut self) {
        let base = by_key(&self.base.chart.actions);
        let new = by_key(&self.new.chart.actions);
        let file = by_key(&self.file.chart.actions);
        let known: BTreeSet<&Name> = self
            .file
            .variables()
            .map(|variable| &variable.name)
            .chain(self.file.chart.steps.iter().map(|step| &step.name))
            .collect();
        for (key, own) in &file {
            let before = base.get(key).map_or(&[][..], Vec::as_slice);
            let given = new.get(key).map_or(&[][..], Vec::as_slice);
            let untouched = self.apart(own, before) == (Vec::new(), Vec::new());
            let (odd, missing) = self.apart(own, given);
            if untouched && !(odd.is_empty() && missing.is_empty()) {
                continue;
            }
            let mut missing = missing.into_iter();
            for spec in odd {
                self.departures.push(Departure::Action {
                    spec: spec.clone(),
                    ladder: missing.next().cloned(),
                });
            }
            self.departures
                .extend(missing.cloned().map(Departure::MissingAction));
            // The file's own wording stays, and its place if it has one.
            let actions = &mut self.merged.chart.actions;
            let is_of_key = |it: &Action| ActionKey::of(it) == *key;
            let at = actions.iter().position(is_of_key).unwrap_or(actions.len());
            actions.retain(|it| !is_of_key(it));
            actions.splice(at..at, own.iter().copied().cloned());
        }
        let removed = |action: &Action| {
            let key = ActionKey::of(action);
            !file.contains_key(&key)
                && base.contains_key(&key)
                && known.contains(&action.step)
                && known.contains(&action.output)
        };
        let (gone, left): (Vec<Action>, Vec<Action>) =
            std::mem::take(&mut self.merged.chart.actions)
                .into_iter()
                .partition(removed);
        self.merged.chart.actions = left;
        self.departures
            .extend(gone.into_iter().map(Departure::MissingAction));
    }

    /// Variables keep what the file says of them; those declared by hand stay.
    fn interface(&mut self) {
        if self.file.name.is_some() {
            self.merged.name = self.file.name.clone();
        }
        let base: BTreeSet<&Name> = self.base.variables().map(|v| &v.name).collect();
        let merged: BTreeSet<Name> = self.merged.variables().map(|v| v.name.clone()).collect();
        let own: BTreeMap<&Name, _> = self.file.variables().map(|v| (&v.name, v)).collect();
        let lists = [
            (&mut self.merged.inputs, &self.file.inputs),
            (&mut self.merged.outputs, &self.file.outputs),
            (&mut self.merged.internals, &self.file.internals),
        ];
        for (list, from_file) in lists {
            for variable in list.iter_mut() {
                if let Some(own) = own.get(&variable.name) {
                    *variable = (*own).clone();
                }
            }
            list.extend(
                from_file
                    .iter()
                    .filter(|v| !base.contains(&v.name) && !merged.contains(&v.name))
                    .cloned(),
            );
        }
    }

    fn same_transition(&self, a: &Transition, b: &Transition) -> bool {
        let set = |names: &[Name]| names.iter().cloned().collect::<BTreeSet<_>>();
        set(&a.from) == set(&b.from)
            && set(&a.to) == set(&b.to)
            && same_meaning(&a.receptivity, &b.receptivity, self.budget)
    }

    /// What of each list the other does not have.
    fn apart<'l>(&self, a: &[&'l Action], b: &[&'l Action]) -> (Vec<&'l Action>, Vec<&'l Action>) {
        let mut left = b.to_vec();
        let mut only_a = Vec::new();
        for &action in a {
            match left.iter().position(|it| self.same_action(it, action)) {
                Some(at) => drop(left.remove(at)),
                None => only_a.push(action),
            }
        }
        (only_a, left)
    }

    fn same_action(&self, a: &Action, b: &Action) -> bool {
        a.kind == b.kind
            && match (&a.condition, &b.condition) {
                (Some(a), Some(b)) => same_meaning(a, b, self.budget),
                (None, None) => true,
                _ => false,
            }
    }
}

fn same_step(a: &Step, b: &Step) -> bool {
    a.initial == b.initial && a.state == b.state && a.kind == b.kind && a.comment == b.comment
}

/// Whether two expressions denote the same function; past the budget, whether
/// they are written the same.
fn same_meaning(a: &Expr, b: &Expr, budget: &Budget) -> bool {
    if a == b {
        return true;
    }
    let mut atoms = Atoms::new();
    let function = Function::of(a, &mut atoms, budget);
    match (function, Function::of(b, &mut atoms, budget)) {
        (Ok(a), Ok(b)) => a == b,
        _ => false,
    }
}

/// What actions have in common that may be the same one, said differently. A
/// person may write several of one key, which all count.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct ActionKey {
    step: Name,
    output: Name,
    effect: &'static str,
}

impl ActionKey {
    fn of(action: &Action) -> Self {
        Self {
            step: action.step.clone(),
            output: action.output.clone(),
            effect: match &action.kind {
                ActionKind::Continuous { .. } => "continuous",
                ActionKind::Stored { effect, .. } => match effect {
                    Effect::Set => "set",
                    Effect::Reset => "reset",
                    Effect::Assign(_) => "assign",
                },
                ActionKind::Forcing(_) => "forcing",
            },
        }
    }
}

fn by_key(actions: &[Action]) -> BTreeMap<ActionKey, Vec<&Action>> {
    let mut by_key: BTreeMap<ActionKey, Vec<&Action>> = BTreeMap::new();
    for action in actions {
        by_key
            .entry(ActionKey::of(action))
            .or_default()
            .push(action);
    }
    by_key
}

fn by_name<'l, T>(list: &'l [T], name: impl Fn(&'l T) -> &'l Name) -> BTreeMap<&'l Name, &'l T> {
    list.iter().map(|it| (name(it), it)).collect()
}

fn places<T>(list: &[T], name: impl Fn(&T) -> &Name) -> BTreeMap<Name, usize> {
    list.iter().map(name).cloned().zip(0..).collect()
}
