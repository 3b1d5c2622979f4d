use logic::{Datum, Name, Relation};
use source::Span;

/// The time from one scan to the next where a scenario does not say it.
pub const DEFAULT_CYCLE_MS: u64 = 10;

/// What is done to a plant's inputs step by step, and what must come of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Scenario {
    /// What it is about.
    pub title: Option<Name>,
    /// The files that it runs on, seen from where it lies.
    pub files: Vec<FileName>,
    /// How long a step lasts.
    pub timing: Timing,
    /// Milliseconds from one scan to the next.
    pub cycle_ms: u64,
    /// Its steps, in their order.
    pub steps: Vec<Step>,
}

impl Default for Scenario {
    fn default() -> Self {
        Self {
            title: None,
            files: Vec::new(),
            timing: Timing::Scan,
            cycle_ms: DEFAULT_CYCLE_MS,
            steps: Vec::new(),
        }
    }
}

/// A file that a scenario names.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileName {
    /// The path as it is written.
    pub path: Name,
    /// Where.
    pub span: Span,
}

/// When a step is over and its expectations are looked at.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Timing {
    /// After its scans.
    #[default]
    Scan,
    /// When further scans that take no time would change nothing: inputs are
    /// slower than scans.
    Settled,
}

/// One step: changes, scans, expectations.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Step {
    /// What changes before its first scan; inputs it does not name stay.
    pub changes: Vec<Change>,
    /// What passes then.
    pub passing: Passing,
    /// What must hold after it.
    pub expected: Vec<Expectation>,
    /// Whether no output may have changed but those that are expected.
    pub only: bool,
    /// What a person says of it.
    pub comment: Option<Name>,
    /// Its line, without the comment.
    pub span: Span,
}

/// An input takes a value.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// The input.
    pub name: Name,
    /// Its value from now on.
    pub value: Datum,
    /// Where the name stands.
    pub span: Span,
}

/// What passes in a step after its changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Passing {
    /// So many scans, at least one, each as long as a cycle.
    Scans(u32),
    /// Scans until so many milliseconds have passed.
    Wait(u64),
}

impl Default for Passing {
    fn default() -> Self {
        Self::Scans(1)
    }
}

/// Something that must hold after a step.
#[derive(Clone, Debug, PartialEq)]
pub struct Expectation {
    /// The output, internal variable or step.
    pub name: Name,
    /// What is asked of it.
    pub test: Test,
    /// Where it stands.
    pub span: Span,
    /// Where in it the name stands.
    pub named: Span,
}

/// What is asked of a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Test {
    /// It is anything but 0.
    On,
    /// It is 0.
    Off,
    /// It compares so with a number.
    Compares(Relation, Datum),
}

impl Test {
    /// Whether `value` passes.
    pub fn holds(self, value: Datum) -> bool {
        match self {
            Self::On => value.is_on(),
            Self::Off => !value.is_on(),
            Self::Compares(relation, other) => value.compares(relation, other),
        }
    }
}
