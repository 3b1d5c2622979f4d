//! Which step may follow which (semantics, section 3).
//!
//! For two states P and F the question is whether F follows P: whether what
//! ends P is what starts F. The answers come in ranks of [`Evidence`]; the
//! best come first. [`ranked`] looks at states only, `possible` and `cubes`
//! at every coil, as the paper does. Whether a pair is ever seen to happen takes a
//! search through the sequences of inputs; who made one tells its [`Sights`].

mod common;
mod compared;
mod cubes;
mod facets;
mod handover;
mod kind;
mod possible;
mod shared;
mod witness;

use std::sync::Arc;

use logic::{AtomId, Budget, Function, Name};

use compared::Compared;
pub use compared::Comparisons;
pub use cubes::cubes;
pub(crate) use facets::Facets;
pub(crate) use handover::{handed_over, started_apart};
pub use possible::possible;
pub(crate) use witness::with_sights;
pub use witness::{Sight, Sights, Witness};

use crate::conditions::{Conditions, Variable};
use crate::registers::Register;
use crate::states::States;

/// Why a succession is suggested, strongest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Evidence {
    /// An arc of a step register, read off a write.
    Written,
    /// What ends the one is what starts the other.
    Handover,
    /// Some scan that can be reached ends the one and starts the other.
    Witnessed,
    /// The one can be seen to start after the other has ended, with no state on
    /// in between that would explain it.
    Delayed,
    /// The two conditions share a variable and can hold together.
    Possible,
}

impl Evidence {
    /// The word used in answers.
    pub fn word(self) -> &'static str {
        match self {
            Self::Written => "written",
            Self::Handover => "handover",
            Self::Witnessed => "witnessed",
            Self::Delayed => "delayed",
            Self::Possible => "possible",
        }
    }
}

/// How a succession stands to others from the same state.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kind {
    /// Starts together with other followers.
    And,
    /// Starts instead of other followers.
    Or,
}

impl Kind {
    /// The word used in answers.
    pub fn word(self) -> &'static str {
        match self {
            Self::And => "and",
            Self::Or => "or",
        }
    }
}

/// A suggestion: `to` may follow `from`.
#[derive(Clone, Debug)]
pub struct Succession {
    /// The state that ends.
    pub from: Name,
    /// The state that begins.
    pub to: Name,
    /// Why.
    pub evidence: Evidence,
    /// Together with the other followers of `from`, or instead of them.
    pub kind: Kind,
    /// When: the condition under which the one ends and the other begins.
    pub condition: Option<Function>,
    /// A shortest sequence of inputs in which it happens, if one is known.
    pub witness: Option<Arc<Witness>>,
}

/// The most pairs that are looked at one by one. A program in which more
/// share a condition gives no better answer for looking at all of them.
const MOST_PAIRS: usize = 1_000_000;

/// All suggestions for the states of a program, best first: arcs of step
/// registers, handovers, then what is possible; and the comparisons that were
/// made for it, of which those of `earlier` are kept whose states are what they
/// were. Stops early, with what it has, when cancelled.
pub fn ranked(
    conditions: &Conditions,
    states: &States,
    registers: &[Register],
    earlier: Option<&Comparisons>,
    budget: &Budget,
) -> (Vec<Succession>, Comparisons) {
    let mut found: Vec<Succession> = registers.iter().flat_map(Register::successions).collect();
    let mut compared = Compared::new(states, earlier);
    let handovers = handover::handovers(states, conditions, &mut compared, budget);
    let rest = possible::among_states(states, &handovers, &mut compared, budget);
    let mut by_rung: Vec<(AtomId, AtomId, Evidence, Option<Function>)> = handovers
        .into_iter()
        .map(|h| (h.from, h.to, Evidence::Handover, Some(h.condition)))
        .chain(
            rest.into_iter()
                .map(|(from, to, condition)| (from, to, Evidence::Possible, condition)),
        )
        .collect();
    by_rung.sort_by_key(|(from, to, evidence, _)| (*evidence, *from, *to));
    let kinds = kind::kinds(&by_rung, states, &mut compared, budget);
    found.extend(
        by_rung
            .into_iter()
            .zip(kinds)
            .map(|((from, to, evidence, condition), kind)| Succession {
                from: name(conditions, from),
                to: name(conditions, to),
                evidence,
                kind,
                condition,
                witness: None,
            }),
    );
    (found, compared.finish())
}

/// Every coil whose conditions fit the budget, with its activation and its
/// deactivation: what the paper's rule compares, whether the coil holds a
/// state or not.
fn coils(conditions: &Conditions) -> Vec<(AtomId, Function, Function)> {
    let coil = |variable: &Arc<Variable>| {
        let activation = variable.next.clone().ok()?;
        Some((variable.atom, activation, variable.deactivation().ok()?))
    };
    conditions.variables.iter().filter_map(coil).collect()
}

fn name(conditions: &Conditions, atom: AtomId) -> Name {
    match conditions.atoms.atom(atom) {
        logic::Atom::Variable(name) => name.clone(),
        other => other.to_string().into(),
    }
}
