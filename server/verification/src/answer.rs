//! What is found about a ladder and its spec.

use grafcet::evolution::Unstable;
use logic::Name;
use proof::{Netlist, Why};

use crate::inputs::Source;
use crate::trace::Trace;

/// When outputs are compared.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Timing {
    /// After every scan.
    #[default]
    Scan,
    /// When both sides have come to rest with the same inputs.
    Settled,
}

impl Timing {
    /// Its name: `scan`, `settled`.
    pub fn word(self) -> &'static str {
        match self {
            Self::Scan => "scan",
            Self::Settled => "settled",
        }
    }
}

/// What was found about a ladder and its spec.
#[derive(Clone, Debug)]
pub struct Verification {
    /// When outputs were compared.
    pub timing: Timing,
    /// Whether the two do the same.
    pub verdict: Verdict,
    /// How many environment rules restrict the inputs.
    pub rules: usize,
    /// The outputs that were compared.
    pub outputs: Vec<Name>,
    /// Outputs of the spec that the ladder does not know.
    pub missing: Vec<Name>,
    /// Outputs that the ladder declares and writes, and the spec does not have.
    pub absent: Vec<Name>,
    /// The properties of the spec, each by itself.
    pub properties: Vec<(Name, Verdict)>,
    /// What is left free, since time or numbers that are not followed decide it.
    pub free: Vec<Source>,
    /// The environment rules allow no sequence of more steps than this.
    pub deadlock: Option<usize>,
    /// The question as it was asked at last: the system, and as its properties
    /// that the grafcet is unstable, that both never rest, that each output
    /// differs, and those of the spec. Empty if it is too large to be asked.
    pub question: Netlist,
    /// How many states were counted, where the engine that decided counts them.
    pub states: Option<u128>,
}

/// An answer.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// For every sequence of inputs that the environment allows.
    Equivalent,
    /// There is a sequence after which it is not so.
    Different(Difference),
    /// Not known.
    Unknown {
        /// No sequence of so many steps or fewer shows anything.
        bound: usize,
        /// What came in the way.
        why: Reason,
    },
}

/// What a sequence leads to.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// What happens in the last step.
    pub what: What,
    /// The sequence, as the interpreters ran it.
    pub trace: Trace,
    /// Whether no shorter one shows anything.
    pub is_shortest: bool,
    /// Whether it is over after another step with the same inputs.
    pub is_brief: bool,
}

/// What happens in the last step of a sequence.
#[derive(Clone, Debug, PartialEq)]
pub enum What {
    /// These outputs differ.
    Outputs(Vec<Name>),
    /// The grafcet finds no stable situation.
    Unstable(Unstable),
    /// Something changes in every scan, with the same inputs.
    Restless,
    /// The property is violated.
    Property,
}

/// Why an answer is not known.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Reason {
    /// The limits were reached, or somebody asked to stop.
    Limits(Why),
    /// There is nothing to compare: the spec has no output that the ladder knows.
    Nothing,
    /// These outputs hold numbers that are not followed.
    Numbers(Vec<Name>),
    /// A sequence was found, but the interpreters do not confirm it: it needs
    /// what is left free to be as no time and no count makes it.
    Unconfirmed,
    /// A scan may take more evolutions, or settling more scans, than are
    /// followed.
    Rounds,
}

impl Verification {
    /// Whether all is proved: the outputs, and every property.
    pub fn is_proved(&self) -> bool {
        let all = self.properties.iter().map(|(_, verdict)| verdict);
        std::iter::once(&self.verdict)
            .chain(all)
            .all(|it| *it == Verdict::Equivalent)
    }

    /// Whether somebody asked to stop before all was known.
    pub fn is_cancelled(&self) -> bool {
        let all = self.properties.iter().map(|(_, verdict)| verdict);
        let is_cancelled = |verdict: &Verdict| {
            let why = Reason::Limits(Why::Cancelled);
            matches!(verdict, Verdict::Unknown { why: own, .. } if *own == why)
        };
        std::iter::once(&self.verdict).chain(all).any(is_cancelled)
    }
}
