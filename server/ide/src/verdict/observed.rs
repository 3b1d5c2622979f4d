//! What was seen at the plant, as scenarios tell it.

use std::collections::HashMap;

use ::verification::Trace;
use grafcet::EnvironmentRule;
use logic::{Datum, Name};
use recovery::simulation::{Simulation, Values};

use super::rule::{Obeyed, obeyed};

/// The scans of a scenario, one after the other: what the inputs were, and what
/// the ladder made of them.
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

    /// In how many scans the rule tells something and is obeyed; `None` if it is
    /// broken in one. Inputs that the scenario does not name are off.
    pub(super) fn obeys(&self, rule: &EnvironmentRule, inputs: &[(Name, Datum)]) -> Option<usize> {
        let mut told = 0;
        for pair in self.scans.windows(2) {
            let value = |scan: &HashMap<Name, bool>, name: &str| {
                let is_input = || inputs.iter().any(|(it, _)| **it == *name);
                scan.get(name).copied().or(is_input().then_some(false))
            };
            let (before, now) = (
                |name: &str| value(&pair[0], name),
                |name: &str| value(&pair[1], name),
            );
            match obeyed(rule, &before, &now) {
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
        let mut scans = self.scans.iter().skip(1);
        trace.steps.iter().all(|step| {
            let Some(scan) = scans.next() else {
                return false;
            };
            let mut inputs = step.inputs.iter();
            inputs.all(|(name, value)| scan.get(name).copied().unwrap_or(false) == value.is_on())
        })
    }
}
