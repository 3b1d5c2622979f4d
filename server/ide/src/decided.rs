//! What the expert decided about pairs of states.

use std::collections::{HashMap, HashSet};

use grafcet::Verdict;
use logic::Name;

use crate::Spec;

/// How a pair of states stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Standing {
    /// Nothing is decided.
    Open,
    /// The one follows the other.
    Accepted,
    /// It does not.
    Rejected,
}

/// What a spec says of pairs of states.
#[derive(Clone, Debug, Default)]
pub struct Decided {
    pairs: HashMap<(Name, Name), Standing>,
    initial: HashSet<Name>,
}

impl Decided {
    /// The decisions of a spec.
    pub fn of(spec: &Spec) -> Self {
        let mut decided = Self::default();
        for decision in &spec.reading.spec.decisions {
            match &decision.verdict {
                Verdict::Accept { from, to } => {
                    for to in to {
                        let pair = (from.clone(), to.clone());
                        decided.pairs.insert(pair, Standing::Accepted);
                    }
                }
                Verdict::Reject { from, to } => {
                    let pair = (from.clone(), to.clone());
                    decided.pairs.insert(pair, Standing::Rejected);
                }
                Verdict::Initial(name) => {
                    decided.initial.insert(name.clone());
                }
                Verdict::Keep(_) | Verdict::End(_) => {}
            }
        }
        decided
    }

    /// How the pair of a state and one after it stands.
    pub fn standing(&self, from: &Name, to: &Name) -> Standing {
        let pair = (from.clone(), to.clone());
        self.pairs.get(&pair).copied().unwrap_or(Standing::Open)
    }

    /// Whether a sequence starts in the state.
    pub fn is_initial(&self, state: &Name) -> bool {
        self.initial.contains(state)
    }
}
