use std::fmt::{self, Display, Formatter};

use logic::Name;

/// Why a program cannot be translated.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Refusal {
    /// A jump leads backwards: how often rungs are solved in a scan is not known.
    BackwardJump(Name),
    /// Calls and jumps unfold into too many visits of rungs.
    TooManyVisits,
    /// Definitions of blocks are solved in an order that is not that of their
    /// units.
    MixedDefinitions,
    /// A variable is written under a name that cannot be told: the text of it.
    UnknownTarget(Name),
    /// An index stands within an index: the text.
    NestedIndex(Name),
    /// A term is also the name of a variable: the text.
    AmbiguousTerm(Name),
    /// A rule without `@` speaks of what the ladder writes: the rule, the name.
    RuleAboutOutput(Name, Name),
    /// A rule or property speaks of the time of a step: its label.
    RuleAboutTime(Name),
    /// A rule or property speaks of a number that is not followed: its label.
    RuleAboutNumber(Name),
    /// The grafcet may find no stable situation, or it is not known that it
    /// always does.
    NotStable,
    /// The values of the variables do not settle within the limits.
    TooManyValues,
    /// More gates, or more work to find the values of its numbers, than the limits
    /// allow.
    TooLarge,
    /// Somebody asked to stop.
    Cancelled,
}

impl Display for Refusal {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::BackwardJump(label) => write!(
                f,
                "a jump leads backwards to `{label}`, so how often rungs are solved in a scan is not known"
            ),
            Self::TooManyVisits => f.write_str("calls and jumps unfold into too many rungs"),
            Self::MixedDefinitions => {
                f.write_str("the routines of block definitions are mixed up with each other")
            }
            Self::UnknownTarget(name) => {
                write!(f, "`{name}` is written, and its index is not followed")
            }
            Self::NestedIndex(name) => write!(f, "`{name}` has an index within an index"),
            Self::AmbiguousTerm(name) => write!(f, "`{name}` is a term and a variable"),
            Self::RuleAboutOutput(rule, name) => write!(
                f,
                "the rule `{rule}` speaks of `{name}`, which the ladder writes; a rule about outputs says with `@` what the plant does next"
            ),
            Self::RuleAboutTime(rule) => {
                write!(
                    f,
                    "`{rule}` speaks of the time of a step, which is not followed"
                )
            }
            Self::RuleAboutNumber(rule) => {
                write!(f, "`{rule}` speaks of a number that is not followed")
            }
            Self::NotStable => f.write_str("it may find no stable situation"),
            Self::TooManyValues => f.write_str("the values of its numbers do not settle"),
            Self::TooLarge => f.write_str("it is too large for the effort that is allowed"),
            Self::Cancelled => f.write_str("stopped"),
        }
    }
}

impl std::error::Error for Refusal {}
