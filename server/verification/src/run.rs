//! Ladder and grafcet run side by side by their interpreters.
//!
//! What the proof engines find is told only after it has happened here.

use grafcet::evolution::{self, Unstable};
use ladder::{Program, scan};
use logic::{Atom, Cancel, Datum, Expr, Name, Relation};
use proof::Trace as Signals;

use crate::Timing;
use crate::inputs::{Inputs, Source};
use crate::program::Followed;
use crate::trace::{Step, Trace};

/// With `settled` timing, what has not come to rest after so many scans never
/// will.
const MOST_SETTLING: usize = 1_000;

/// How a run ended.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum End {
    /// All steps were taken; in the last these outputs differ.
    Steps(Vec<Name>),
    /// The grafcet found no stable situation.
    Unstable(Unstable),
    /// In `settled` timing: something changed in every scan.
    Restless,
    /// Somebody asked to stop.
    Cancelled,
}

/// Both, and what is compared.
pub(crate) struct Run<'r> {
    ladder: scan::Machine<'r>,
    grafcet: evolution::Machine,
    followed: &'r Followed,
    outputs: &'r [Name],
    /// What is shown of the ladder besides.
    watched: &'r [Name],
    /// What the grafcet reads from the ladder.
    read: Vec<Name>,
    timing: Timing,
    before: Vec<(Name, bool)>,
    cancel: &'r Cancel,
}

impl<'r> Run<'r> {
    /// Both before their first scan.
    pub(crate) fn new(
        program: &'r Program,
        machine: evolution::Machine,
        followed: &'r Followed,
        [outputs, watched]: [&'r [Name]; 2],
        timing: Timing,
        cancel: &'r Cancel,
    ) -> Self {
        let read = machine.free().filter(|name| followed.knows(name)).cloned();
        Self {
            read: read.collect(),
            ladder: scan::Machine::new(program),
            grafcet: machine,
            followed,
            outputs,
            watched,
            timing,
            before: Vec::new(),
            cancel,
        }
    }

    /// Runs what the engines found. Times are chosen so that timers run out when
    /// they should, where there are such times.
    pub(crate) fn trace(&mut self, inputs: &Inputs, signals: &Signals) -> (Trace, End) {
        let mut trace = Trace {
            timing: self.timing,
            steps: Vec::new(),
        };
        for row in &signals.inputs {
            let elapsed_ms = self.elapsed(inputs, row);
            let values = inputs.values(row);
            for (name, value) in &values {
                self.ladder.set_input(name, *value);
                self.grafcet.set_input(name, *value);
            }
            let end = self.step(elapsed_ms);
            trace.steps.push(self.shown(elapsed_ms, values));
            if let Err(end) = end {
                return (trace, end);
            }
        }
        (trace, End::Steps(self.differences()))
    }

    /// The outputs that still differ after another step that changes no input
    /// and takes no time; none if it does not come to an end.
    pub(crate) fn after_another(&mut self) -> Vec<Name> {
        match self.step(0) {
            Ok(()) => self.differences(),
            Err(_) => Vec::new(),
        }
    }

    fn step(&mut self, elapsed_ms: u64) -> Result<(), End> {
        self.before = self.ladder_bits();
        self.scan(elapsed_ms)?;
        if self.timing == Timing::Scan {
            return Ok(());
        }
        for _ in 0..MOST_SETTLING {
            let before = (self.ladder.clone(), self.grafcet.clone());
            self.scan(0)?;
            if self.ladder.is_as_in(&before.0) && self.grafcet.is_as_in(&before.1) {
                return Ok(());
            }
        }
        Err(End::Restless)
    }

    fn scan(&mut self, elapsed_ms: u64) -> Result<(), End> {
        if self.cancel.is_cancelled() {
            return Err(End::Cancelled);
        }
        self.ladder.scan(elapsed_ms);
        for name in &self.read {
            let value = self.ladder.value(&self.followed.resolved(name));
            self.grafcet.set_input(name, value);
        }
        self.grafcet.scan(elapsed_ms).map_err(End::Unstable)
    }

    /// How much time must pass before this scan: enough for what must have run
    /// out.
    fn elapsed(&self, inputs: &Inputs, row: &[bool]) -> u64 {
        let mut wanted = 0;
        for (source, on) in inputs.sources.iter().zip(row) {
            let left = match source {
                Source::Event(of) => {
                    let member = |member: &str| self.ladder.value(&format!("{of}.{member}"));
                    let left = member("PRE").integer() - member("ACC").integer();
                    let is_timing = member("TT").is_on();
                    is_timing.then(|| u64::try_from(left).unwrap_or(0))
                }
                Source::Elapsed { step, time_ms } if self.grafcet.is_active(step) => {
                    Some(time_ms.saturating_sub(self.grafcet.active_ms(step)))
                }
                _ => None,
            };
            if let (true, Some(left)) = (*on, left) {
                wanted = wanted.max(left);
            }
        }
        wanted
    }

    fn differences(&self) -> Vec<Name> {
        let differs = |name: &&Name| {
            let ladder = self.ladder.value(&self.followed.resolved(name));
            let grafcet = self.grafcet.value(name);
            ladder.key() != grafcet.key() && !ladder.compares(Relation::Equal, grafcet)
        };
        self.outputs.iter().filter(differs).cloned().collect()
    }

    fn ladder_bits(&self) -> Vec<(Name, bool)> {
        let names = self.followed.variables();
        names
            .map(|name| (name.clone(), self.ladder.is_on(name)))
            .collect()
    }

    fn shown(&self, elapsed_ms: u64, inputs: Vec<(Name, Datum)>) -> Step {
        let ladder = |name: &Name| {
            (
                name.clone(),
                self.ladder.value(&self.followed.resolved(name)),
            )
        };
        let grafcet = |name: &Name| (name.clone(), self.grafcet.value(name));
        Step {
            elapsed_ms,
            inputs,
            ladder: self
                .outputs
                .iter()
                .chain(self.watched)
                .map(ladder)
                .collect(),
            grafcet: self.outputs.iter().map(grafcet).collect(),
            active: self.grafcet.active().cloned().collect(),
        }
    }

    /// Whether an expression holds now, of the ladder's values where it knows
    /// the name, else of the grafcet's. An edge looks back to the step before.
    pub(crate) fn holds(&self, expr: &Expr) -> bool {
        match expr {
            Expr::Constant(value) => *value,
            Expr::Not(inner) => !self.holds(inner),
            Expr::And(parts) => parts.iter().all(|part| self.holds(part)),
            Expr::Or(parts) => parts.iter().any(|part| self.holds(part)),
            Expr::Atom(Atom::Variable(name)) => self.value(name).is_on(),
            Expr::Atom(Atom::Comparison(it)) => {
                let value = |side: &Name| Datum::constant(side).unwrap_or_else(|| self.value(side));
                value(&it.left).compares(it.relation, value(&it.right))
            }
            Expr::Atom(Atom::Rise(inner)) => self.holds(inner) && !self.held(inner),
            Expr::Atom(Atom::Fall(inner)) => !self.holds(inner) && self.held(inner),
            Expr::Atom(Atom::Elapsed { .. }) => false,
        }
    }

    /// Whether an expression of bits held before the last step.
    fn held(&self, expr: &Expr) -> bool {
        match expr {
            Expr::Constant(value) => *value,
            Expr::Not(inner) => !self.held(inner),
            Expr::And(parts) => parts.iter().all(|part| self.held(part)),
            Expr::Or(parts) => parts.iter().any(|part| self.held(part)),
            Expr::Atom(Atom::Variable(name)) => {
                let name = self.followed.resolved(name);
                self.before.iter().any(|(it, on)| *it == name && *on)
            }
            Expr::Atom(_) => false,
        }
    }

    fn value(&self, name: &Name) -> Datum {
        match self.followed.knows(name) {
            true => self.ladder.value(&self.followed.resolved(name)),
            false => self.grafcet.value(name),
        }
    }
}
