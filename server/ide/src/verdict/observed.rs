//! What was seen at the plant, as scenarios tell it; and what a trace does.

use std::collections::HashMap;

use ::verification::{Step, Trace};
use grafcet::EnvironmentRule;
use logic::{Datum, Name};
use recovery::simulation::{Simulation, Values};

use super::rule::{Obeyed, obeyed};

/// The scans of a run, one after the other: what the inputs were, and what the
/// ladder made of them.
#[derive(Clone, Debug, Default)]
pub struct Observed {
    scans: Vec<HashMap<Name, bool>>,
}

impl Observed {
    /// The scans of a run. Of scans that changed nothing one stands for all.
    pub fn of(simulation: &Simulation) -> Self {
        let named = |values: &Values| {
            let inputs = simulation.inputs.iter().zip(&values.inputs);
            let outputs = simulation.ladder.iter().zip(&values.ladder);
            let all = inputs.chain(outputs);
            all.map(|(name, value)| (name.clone(), value.is_on()))
                .collect()
        };
        let mut scans = vec![named(&simulation.start)];
        let mut last = 0;
        for row in &simulation.rows {
            if row.scan > last + 1
                && let Some(same) = scans.last().cloned()
            {
                scans.push(same);
            }
            last = row.scan;
            scans.push(named(&row.values));
        }
        Self { scans }
    }

    /// The scans of a sequence that shows something. Before it everything is off.
    pub(super) fn of_trace(trace: &Trace) -> Self {
        let named = |step: &Step| -> HashMap<Name, bool> {
            let all = step.inputs.iter().chain(&step.ladder);
            all.map(|(name, value)| (name.clone(), value.is_on()))
                .collect()
        };
        let mut scans: Vec<_> = trace.steps.iter().map(named).collect();
        if let Some(first) = scans.first() {
            let before = first.keys().map(|name| (name.clone(), false)).collect();
            scans.insert(0, before);
        }
        Self { scans }
    }

    /// How many scans there are.
    pub(super) fn len(&self) -> usize {
        self.scans.len().saturating_sub(1)
    }

    /// Whether a variable is on after so many scans.
    pub(super) fn is_on(&self, name: &str, scans: usize) -> bool {
        let scan = self.scans.get(scans);
        scan.and_then(|it| it.get(name)).copied().unwrap_or(false)
    }

    /// What a rule comes to in each scan. Inputs that are not named are off.
    fn obeyed<'o>(
        &'o self,
        rule: &'o EnvironmentRule,
        inputs: &'o [(Name, Datum)],
    ) -> impl Iterator<Item = Obeyed> + 'o {
        let value = move |scan: &HashMap<Name, bool>, name: &str| {
            let is_input = || inputs.iter().any(|(it, _)| **it == *name);
            scan.get(name).copied().or(is_input().then_some(false))
        };
        self.scans.windows(2).map(move |pair| {
            let before = |name: &str| value(&pair[0], name);
            let now = |name: &str| value(&pair[1], name);
            obeyed(rule, &before, &now)
        })
    }

    /// The first scan in which a rule is broken, from 0.
    pub(super) fn breaks(&self, rule: &EnvironmentRule) -> Option<usize> {
        self.obeyed(rule, &[]).position(|it| it == Obeyed::Broken)
    }

    /// In how many scans the rule tells something and is obeyed; `None` if it is
    /// broken in one.
    pub(super) fn obeys(&self, rule: &EnvironmentRule, inputs: &[(Name, Datum)]) -> Option<usize> {
        let mut told = 0;
        for it in self.obeyed(rule, inputs) {
            match it {
                Obeyed::Idle => {}
                Obeyed::Kept => told += 1,
                Obeyed::Broken => return None,
            }
        }
        Some(told)
    }

    /// Whether it goes through the same inputs as a trace, as a scenario does that
    /// was made of it. It tells what somebody looks into, not what was seen.
    pub(super) fn follows(&self, trace: &Trace) -> bool {
        let mut steps = trace.steps.iter().zip(1..);
        self.len() >= trace.steps.len()
            && steps.all(|(step, at)| {
                let mut inputs = step.inputs.iter();
                inputs.all(|(name, value)| self.is_on(name, at) == value.is_on())
            })
    }
}
