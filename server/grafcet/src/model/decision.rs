use logic::Name;

/// What the expert decided about the states of a ladder.
///
/// States are named as the ladder spells them. A decision is kept as a comment
/// line of the spec, so that the spec alone resumes a conversion.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Decision {
    /// The decision.
    pub verdict: Verdict,
    /// Why.
    pub comment: Option<Name>,
}

/// A decision.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Verdict {
    /// These states follow this one. Several start together: an AND
    /// divergence.
    Accept {
        /// The state before.
        from: Name,
        /// The states after it.
        to: Vec<Name>,
    },
    /// This state does not follow that one.
    Reject {
        /// The state before.
        from: Name,
        /// The state that does not follow.
        to: Name,
    },
    /// The sequence starts in this state.
    Initial(Name),
    /// This rule stays as it is, whatever the ladder gives.
    Keep(Name),
    /// The branch that ends in this state ends by itself and joins no other.
    End(Name),
}

impl Verdict {
    /// The word that begins its line.
    pub fn word(&self) -> &'static str {
        match self {
            Self::Accept { .. } => "accept",
            Self::Reject { .. } => "reject",
            Self::Initial(_) => "initial",
            Self::Keep(_) => "keep",
            Self::End(_) => "end",
        }
    }
}

impl From<Verdict> for Decision {
    fn from(verdict: Verdict) -> Self {
        Self {
            verdict,
            comment: None,
        }
    }
}
