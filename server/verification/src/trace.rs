//! A sequence of inputs, with what came of it on both sides.

use logic::{Datum, Name};
use scenario::{Change, Passing, Scenario};
use source::Span;

use crate::Timing;

/// What was done and what came of it, step by step.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trace {
    /// What a step is: a scan, or as many as settle.
    pub timing: Timing,
    /// The steps.
    pub steps: Vec<Step>,
}

/// A step of a trace.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// Milliseconds since the step before.
    pub elapsed_ms: u64,
    /// All inputs.
    pub inputs: Vec<(Name, Datum)>,
    /// The outputs that are compared, as the ladder has them; behind them what
    /// else of the ladder the properties speak of.
    pub ladder: Vec<(Name, Datum)>,
    /// The same, as the grafcet has them.
    pub grafcet: Vec<(Name, Datum)>,
    /// The active steps.
    pub active: Vec<Name>,
}

impl Trace {
    /// The same as a scenario, without expectations: each step says which inputs
    /// change.
    pub fn scenario(&self) -> Scenario {
        let longest = self.steps.iter().map(|step| step.elapsed_ms).max();
        let cycle_ms = longest.unwrap_or(0).max(scenario::DEFAULT_CYCLE_MS);
        let takes_time = longest != Some(0);
        let mut before: &[(Name, Datum)] = &[];
        let mut steps = Vec::new();
        for step in &self.steps {
            let was = |name: &Name| {
                before
                    .iter()
                    .find(|(it, _)| it == name)
                    .map_or(Datum::default(), |(_, value)| *value)
            };
            let changed = step.inputs.iter().filter(|(name, value)| {
                let before = was(name);
                before.key() != value.key()
                    && !(before == Datum::default()
                        && !value.is_on()
                        && matches!(value, Datum::Bool(_)))
            });
            let changes = changed.map(|(name, value)| Change {
                name: name.clone(),
                value: *value,
                span: Span::default(),
            });
            steps.push(scenario::Step {
                changes: changes.collect(),
                passing: match takes_time && step.elapsed_ms != cycle_ms {
                    true => Passing::Wait(step.elapsed_ms),
                    false => Passing::Scans(1),
                },
                ..scenario::Step::default()
            });
            before = &step.inputs;
        }
        Scenario {
            timing: match self.timing {
                Timing::Scan => scenario::Timing::Scan,
                Timing::Settled => scenario::Timing::Settled,
            },
            cycle_ms,
            steps,
            ..Scenario::default()
        }
    }
}
