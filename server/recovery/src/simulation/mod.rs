//! A scenario run on a ladder, on a grafcet, or on both side by side.
//!
//! Both get the same inputs and the same time. What the grafcet reads and the
//! ladder writes, the output of a timer say, comes from the ladder's scan:
//! a spec that is kept beside a ladder leaves timers and arithmetic to it.
//!
//! [`simulate`] gives a [`Simulation`], plain data with a row for every scan
//! that changed something and for the last scan of every step. [`findings`]
//! says of it what an editor or `gradus check` shows; [`recorded`] makes a
//! scenario of it that expects what came out.

mod findings;
mod moment;
mod record;
mod run;
mod sides;
mod spelling;

use grafcet::Grafcet;
use grafcet::evolution::Unstable;
use ladder::Program;
use logic::{Datum, Name};
use scenario::Test;

pub use findings::{failed, findings, unknown, unknown_names};
pub use moment::Moment;
pub use record::recorded;
pub use run::{moment, simulate, simulate_within};

/// What a scenario is run on.
#[derive(Clone, Copy, Debug, Default)]
pub struct Subject<'s> {
    /// The ladder.
    pub ladder: Option<&'s Program>,
    /// The grafcet.
    pub grafcet: Option<&'s Grafcet>,
}

/// How far a run may go.
#[derive(Clone, Copy)]
pub struct Extent<'e> {
    /// Scans, at most.
    pub scans: u64,
    /// Whether somebody still waits for what comes of it; asked before every
    /// scan.
    pub wanted: &'e dyn Fn() -> bool,
}

/// What came of a scenario.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Simulation {
    /// The inputs that the scenario changes, in the order in which it first
    /// does.
    pub inputs: Vec<Name>,
    /// What is shown of the ladder: what goes to the plant, or, where the
    /// source does not say what does, all that coils and moves write.
    pub ladder: Vec<Name>,
    /// The outputs of the grafcet.
    pub grafcet: Vec<Name>,
    /// The values before the first scan.
    pub start: Values,
    /// The scans that changed something, and the last one of every step.
    pub rows: Vec<Row>,
    /// Why the run ended before the scenario did, and in which step.
    pub stopped: Option<(usize, Stop)>,
}

/// What is on each side at some moment, in the order of the lists of
/// [`Simulation`]. The list of a side that does not run is empty.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Values {
    /// Values of the inputs.
    pub inputs: Vec<Datum>,
    /// Values of the ladder.
    pub ladder: Vec<Datum>,
    /// The active steps, in the order they are declared.
    pub active: Vec<Name>,
    /// Values of the grafcet's outputs.
    pub grafcet: Vec<Datum>,
}

/// A scan.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The step of the scenario, from 0.
    pub step: usize,
    /// Whether it is the step's last scan, when expectations are looked at.
    pub is_last: bool,
    /// The number of the scan, from 1. Scans between two rows were as the
    /// first of them.
    pub scan: u64,
    /// Milliseconds since the run began.
    pub time_ms: u64,
    /// What came out.
    pub values: Values,
    /// Outputs in which ladder and grafcet differ, by name. With `timing
    /// settled` they are compared at the end of a step only.
    pub differences: Vec<Name>,
    /// What was expected and is not so.
    pub failures: Vec<Failure>,
}

/// Something that was expected and is not so.
#[derive(Clone, Debug, PartialEq)]
pub struct Failure {
    /// Who is wrong.
    pub side: Side,
    /// What was looked at.
    pub name: Name,
    /// What was expected.
    pub wanted: Wanted,
    /// What it was.
    pub value: Datum,
}

/// What was expected.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Wanted {
    /// The expectation of this place in its step.
    Test(usize, Test),
    /// That it keeps the value that it had, since the step says `only`.
    Unchanged(Datum),
}

/// One of the two that run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The ladder.
    Ladder,
    /// The grafcet.
    Grafcet,
}

impl Side {
    /// As sentences name it.
    pub fn word(self) -> &'static str {
        match self {
            Self::Ladder => "ladder",
            Self::Grafcet => "spec",
        }
    }
}

/// Why a run ended early.
#[derive(Clone, Debug, PartialEq)]
pub enum Stop {
    /// The grafcet has no stable situation.
    Unstable(Unstable),
    /// With `timing settled`: something changes in every scan.
    Restless,
    /// The step would take so many scans.
    TooLong(u64),
    /// It has done as many scans as it was allowed.
    Enough(u64),
    /// Somebody wanted no more.
    Cancelled,
}

impl Simulation {
    /// Whether ladder and grafcet never differed, as far as the run went.
    pub fn agrees(&self) -> bool {
        self.stopped.is_none() && self.rows.iter().all(|row| row.differences.is_empty())
    }

    /// All that was expected and was not so, with its row.
    pub fn failures(&self) -> impl Iterator<Item = (&Row, &Failure)> {
        let rows = self.rows.iter();
        rows.flat_map(|row| row.failures.iter().map(move |failure| (row, failure)))
    }
}
