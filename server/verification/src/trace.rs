//! A sequence of inputs, with what came of it on both sides.

use logic::{Cancel, Datum, Name, Stop};
use proof::{Netlist, Signal, Trace as Signals, violation};
use scenario::{Change, Passing, Scenario};
use source::Span;

use crate::Timing;

/// So many gates are evaluated to make a trace simpler.
const MOST_WORK: usize = 200_000_000;

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

/// The trace with no change of an input that is not needed: what violates a
/// property in its last step still does so there, and nothing forbids it.
///
/// It costs a replay for each change; of a long trace only as many are tried as
/// are worth it, and none after a cancel.
pub(crate) fn simplified(
    netlist: &Netlist,
    trace: &Signals,
    bad: &[Signal],
    cancel: &Cancel,
) -> Signals {
    let mut judge = netlist.clone();
    for signal in bad {
        judge.never("violated", *signal);
    }
    let last = trace.scans().saturating_sub(1);
    let is_good = |tried: &Signals| {
        let look = || match cancel.is_cancelled() {
            true => Err(Stop::Cancelled),
            false => Ok(()),
        };
        let seen = violation(&judge, tried, look).ok().flatten();
        let violated = seen.filter(|(at, _)| *at == last);
        violated.is_some_and(|(_, names)| names.iter().any(|name| &**name == "violated"))
    };
    let mut best = trace.clone();
    if !is_good(&best) {
        return best;
    }
    let mut left = MOST_WORK / (netlist.size() * trace.scans()).max(1);
    // Twice: what one change allows may be found only after another.
    for _ in 0..2 {
        for scan in 0..best.inputs.len() {
            for input in 0..best.inputs[scan].len() {
                let before = scan.checked_sub(1).is_some_and(|at| best.inputs[at][input]);
                if best.inputs[scan][input] != before && left > 0 && !cancel.is_cancelled() {
                    left -= 1;
                    let mut tried = best.clone();
                    tried.inputs[scan][input] = before;
                    if is_good(&tried) {
                        best = tried;
                    }
                }
            }
        }
    }
    best
}
