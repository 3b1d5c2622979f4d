//! Expressions with numbers in place of names.

use logic::{Datum, Relation};

use super::term::Operand;

/// An expression of the grafcet, ready to be evaluated.
#[derive(Clone, Debug, PartialEq)]
pub enum Condition {
    /// Always or never.
    Constant(bool),
    /// A variable is on.
    Variable(usize),
    /// A step is active.
    Step(usize),
    /// Two values compare so.
    Comparison {
        /// The left value.
        left: Operand,
        /// How they compare.
        relation: Relation,
        /// The right value.
        right: Operand,
    },
    /// An edge, by its place among the grafcet's edges.
    Edge(usize),
    /// A step has been active for so many milliseconds.
    Elapsed {
        /// Milliseconds.
        time: u64,
        /// The step.
        step: usize,
    },
    /// The opposite.
    Not(Box<Condition>),
    /// All hold.
    All(Vec<Condition>),
    /// One of them holds.
    Any(Vec<Condition>),
}

/// An edge in some expression: what it looks at, and which way.
#[derive(Clone, Debug, PartialEq)]
pub struct Edge {
    /// What it looks at.
    pub of: Condition,
    /// Whether it occurs when that ceases to hold.
    pub is_falling: bool,
}

/// What an expression sees.
#[derive(Clone, Copy, Debug)]
pub(super) struct View<'m> {
    pub(super) active: &'m [bool],
    pub(super) since: &'m [u64],
    pub(super) values: &'m [Datum],
    /// Which edges occur; those that are not in it do not.
    pub(super) edges: &'m [bool],
    pub(super) now: u64,
}

impl View<'_> {
    pub(super) fn is_active(&self, step: usize) -> bool {
        self.active.get(step).copied().unwrap_or(false)
    }

    pub(super) fn value(&self, variable: usize) -> Datum {
        self.values.get(variable).copied().unwrap_or_default()
    }
}

impl Condition {
    pub(super) fn holds(&self, view: &View<'_>) -> bool {
        match self {
            Self::Constant(value) => *value,
            Self::Variable(at) => view.value(*at).is_on(),
            Self::Step(at) => view.is_active(*at),
            Self::Comparison {
                left,
                relation,
                right,
            } => left.value(view).compares(*relation, right.value(view)),
            Self::Edge(at) => view.edges.get(*at).copied().unwrap_or(false),
            Self::Elapsed { time, step } => {
                let since = view.since.get(*step).copied().unwrap_or(view.now);
                view.is_active(*step) && view.now.saturating_sub(since) >= *time
            }
            Self::Not(inner) => !inner.holds(view),
            Self::All(parts) => parts.iter().all(|part| part.holds(view)),
            Self::Any(parts) => parts.iter().any(|part| part.holds(view)),
        }
    }

    /// Calls `visit` with every variable that is read, by edges too.
    pub(super) fn each_variable(&self, edges: &[Edge], visit: &mut impl FnMut(usize)) {
        match self {
            Self::Edge(at) => {
                if let Some(edge) = edges.get(*at) {
                    edge.of.each_variable(edges, visit);
                }
            }
            Self::Variable(at) => visit(*at),
            Self::Comparison { left, right, .. } => {
                for side in [left, right] {
                    if let Operand::Variable(at) = side {
                        visit(*at);
                    }
                }
            }
            Self::Not(inner) => inner.each_variable(edges, visit),
            Self::All(parts) | Self::Any(parts) => {
                parts
                    .iter()
                    .for_each(|part| part.each_variable(edges, visit));
            }
            Self::Constant(_) | Self::Step(_) | Self::Elapsed { .. } => {}
        }
    }
}
