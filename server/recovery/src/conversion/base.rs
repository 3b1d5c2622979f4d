//! Which decisions the rules of a spec follow.
//!
//! Mostly those that the spec holds. But a person may write a decision by hand,
//! change one or take one out, and leave it to the next conversion to bring the
//! rules up to it. The rules then still follow the decisions of before. Taken
//! for rules that somebody changed they would all stay, beside the new ones.
//!
//! The chart tells what they follow: a state follows another where a path leads
//! from a step of the one to a step of the other through steps that stand for
//! no state. Of the two readings, that the rules follow the decisions as they
//! stand or as the chart shows them, the one counts that explains more of the
//! rules.

use std::collections::{BTreeMap, BTreeSet};

use grafcet::{Chart, Decision, Spec, Step, Transition, Verdict};
use logic::{Budget, Name};

use crate::Analysis;

/// What the ladder gave when the rules of `existing` were made.
pub(super) fn base(analysis: &Analysis, existing: &Spec, budget: &Budget) -> Spec {
    let held = super::spec(analysis, &existing.decisions, budget);
    let shown = shown_decisions(analysis, existing);
    if shown == existing.decisions {
        return held;
    }
    let shown = super::spec(analysis, &shown, budget);
    let chart = &existing.grafcet.chart;
    let distance = |spec: &Spec| distance(&spec.grafcet.chart, chart);
    if distance(&shown) < distance(&held) {
        shown
    } else {
        held
    }
}

/// The rules and steps that only one of two charts has.
fn distance(a: &Chart, b: &Chart) -> usize {
    let steps = |chart: &Chart| -> BTreeSet<(Name, bool)> {
        let steps = chart.steps.iter();
        steps
            .map(|step| (step.name.clone(), step.initial))
            .collect()
    };
    let rules = |chart: &Chart| -> BTreeSet<(Name, Vec<Name>, Vec<Name>)> {
        let rule = |it: &Transition| (it.name.clone(), sorted(&it.from), sorted(&it.to));
        chart.transitions.iter().map(rule).collect()
    };
    steps(a).symmetric_difference(&steps(b)).count()
        + rules(a).symmetric_difference(&rules(b)).count()
}

fn sorted(names: &[Name]) -> Vec<Name> {
    let mut names = names.to_vec();
    names.sort();
    names
}

/// The decisions of `existing`, less those that its chart does not show, and
/// with those that it shows without them.
fn shown_decisions(analysis: &Analysis, existing: &Spec) -> Vec<Decision> {
    let shown = Shown::new(&existing.grafcet.chart);
    let is_bit = |name: &Name| analysis.states().find(name).is_some();
    let mut decisions = Vec::new();
    let mut accepted: BTreeSet<(Name, Name)> = BTreeSet::new();
    let mut initial: BTreeSet<Name> = BTreeSet::new();
    for decision in &existing.decisions {
        let mut decision = decision.clone();
        let stays = match &mut decision.verdict {
            Verdict::Accept { from, to } if is_bit(from) => {
                to.retain(|to| shown.follows(from, to) || shown.returns(from, to));
                accepted.extend(to.iter().map(|to| (from.clone(), to.clone())));
                !to.is_empty()
            }
            // The arcs of a register are there unless they are rejected, also
            // those that lead to its initial step.
            Verdict::Reject { from, to } if !is_bit(from) => {
                !shown.follows(from, to) && !shown.returns(from, to)
            }
            Verdict::Reject { from, to } => !shown.follows(from, to),
            Verdict::Initial(name) if is_bit(name) => {
                initial.insert(name.clone());
                shown.initial.contains(name)
            }
            _ => true,
        };
        if stays {
            decisions.push(decision);
        }
    }
    for (from, company) in &shown.companies {
        let missing: Vec<Name> = company
            .iter()
            .filter(|to| is_bit(from) && is_bit(to))
            .filter(|to| accepted.insert((from.clone(), (*to).clone())))
            .cloned()
            .collect();
        if !missing.is_empty() {
            let (from, to) = (from.clone(), missing);
            decisions.push(Verdict::Accept { from, to }.into());
        }
    }
    for name in shown.initial.difference(&initial) {
        if is_bit(name) {
            decisions.push(Verdict::Initial(name.clone()).into());
        }
    }
    decisions
}

/// What a chart shows of states that follow each other.
struct Shown {
    /// The followers of a state, those together that start together.
    companies: Vec<(Name, Vec<Name>)>,
    /// States that follow each other.
    pairs: BTreeSet<(Name, Name)>,
    /// The same where the second is initial: the end of a sequence leads there
    /// too, without anybody having accepted it.
    returns: BTreeSet<(Name, Name)>,
    /// States of initial steps.
    initial: BTreeSet<Name>,
}

impl Shown {
    fn new(chart: &Chart) -> Self {
        let steps: BTreeMap<&Name, &Step> = chart.steps.iter().map(|it| (&it.name, it)).collect();
        let mut leaving: BTreeMap<&Name, Vec<&Transition>> = BTreeMap::new();
        for transition in &chart.transitions {
            for from in &transition.from {
                leaving.entry(from).or_default().push(transition);
            }
        }
        let walk = Walk { steps, leaving };
        let mut shown = Self {
            companies: Vec::new(),
            pairs: BTreeSet::new(),
            returns: BTreeSet::new(),
            initial: BTreeSet::new(),
        };
        for step in &chart.steps {
            let Some(state) = &step.state else { continue };
            if step.initial {
                shown.initial.insert(state.clone());
            }
            for transition in walk.leaving(&step.name) {
                shown.add(state, transition, &walk);
            }
        }
        shown
    }

    fn follows(&self, from: &Name, to: &Name) -> bool {
        self.pairs.contains(&(from.clone(), to.clone()))
    }

    fn returns(&self, from: &Name, to: &Name) -> bool {
        self.returns.contains(&(from.clone(), to.clone()))
    }

    /// Adds what follows `state` through `transition`: of each branch the first
    /// in company with those of the others, the rest each for itself.
    fn add(&mut self, state: &Name, transition: &Transition, walk: &Walk<'_>) {
        let mut company = Vec::new();
        let mut alone = Vec::new();
        for branch in &transition.to {
            let mut is_first = true;
            for step in walk.next_states(branch) {
                let Some(next) = step.state.clone().filter(|next| next != state) else {
                    continue;
                };
                let pair = (state.clone(), next.clone());
                if step.initial {
                    self.returns.insert(pair);
                    continue;
                }
                self.pairs.insert(pair);
                match is_first {
                    true => company.push(next),
                    false => alone.push(next),
                }
                is_first = false;
            }
        }
        self.companies.push((state.clone(), company));
        let alone = alone.into_iter().map(|next| (state.clone(), vec![next]));
        self.companies.extend(alone);
    }
}

struct Walk<'c> {
    steps: BTreeMap<&'c Name, &'c Step>,
    leaving: BTreeMap<&'c Name, Vec<&'c Transition>>,
}

impl<'c> Walk<'c> {
    fn leaving(&self, step: &Name) -> &[&'c Transition] {
        self.leaving.get(step).map_or(&[], Vec::as_slice)
    }

    /// The first steps with a state on every way on from the step called
    /// `start`, itself included. No way goes through an initial step: there a
    /// sequence begins anew.
    fn next_states(&self, start: &Name) -> Vec<&'c Step> {
        let mut found = Vec::new();
        let mut seen: BTreeSet<&Name> = BTreeSet::new();
        let mut open = vec![start];
        while let Some(name) = open.pop() {
            let Some((name, step)) = self.steps.get_key_value(name) else {
                continue;
            };
            if !seen.insert(name) {
                continue;
            }
            if step.state.is_some() {
                found.push(*step);
            } else if !step.initial {
                let next = self.leaving(name).iter().rev();
                open.extend(next.flat_map(|transition| transition.to.iter().rev()));
            }
        }
        found
    }
}
