use logic::Name;

use crate::Trace;
use crate::limits::Why;

/// What [`crate::check`] found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Report {
    /// The answer for all properties together.
    pub verdict: Verdict,
    /// How each property stands, in the netlist's order: for a
    /// [comparison](crate::compare), each output.
    pub properties: Vec<(Name, Status)>,
}

/// The answer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// No sequence of inputs that the constraints allow violates a property:
    /// two netlists that are compared agree on every output in every scan.
    /// Proved, not sampled.
    Equivalent,
    /// There is such a sequence.
    Different(Difference),
    /// Not known.
    Unknown {
        /// No sequence of so many scans or fewer violates a property.
        clean: usize,
        /// What came in the way.
        why: Why,
    },
}

/// A sequence under which a property is violated, in its last scan and in none
/// before. It was replayed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Difference {
    /// The sequence, for the netlist that was checked.
    pub trace: Trace,
    /// The properties that are violated in its last scan: of a comparison, the
    /// outputs that differ.
    pub properties: Vec<Name>,
    /// No sequence of so many scans or fewer violates a property.
    pub clean: usize,
}

impl Difference {
    /// Whether no shorter sequence violates any property. It is so unless the
    /// limits were reached while shorter ones were still being tried.
    pub fn is_shortest(&self) -> bool {
        self.clean + 1 >= self.trace.scans()
    }
}

/// How one property stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Status {
    /// It can never be violated.
    Holds(Proof),
    /// It is violated in the last scan of the trace.
    Violated,
    /// It is not known whether it can be violated; if there is a trace, it is
    /// not violated there.
    Open,
}

/// How a property was proved.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Proof {
    /// By construction: its gates fold to 0.
    Construction,
    /// By signals that were proved to be equal, all at once, by induction.
    Correspondence,
    /// By induction over so many scans: no sequence of them, wherever it
    /// starts, leads from scans without a violation to one.
    Induction(usize),
    /// By all states that can be reached.
    Reachability {
        /// How many there are of the latches that the property depends on, as
        /// far as they are not known to be equal to others; `None` if there are
        /// more than fit.
        states: Option<u128>,
    },
    /// The environment allows no sequence of more scans than this.
    Deadlock(usize),
}
