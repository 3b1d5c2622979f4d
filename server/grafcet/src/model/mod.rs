//! A grafcet as data, without places in a text: two specs are equal when they
//! hold the same.
//!
//! Steps, transitions, variables and parts are found by name, and a name means
//! one thing in a whole spec. That is what the rule text demands, and it makes
//! a spec easy to edit: taking a step out renumbers nothing.
//!
//! In an expression, a variable whose name is a step's is that step's
//! variable: true while the step is active (IEC 60848, 4.7).

mod action;
mod chart;
mod compare;
mod decision;
mod environment;
mod graph;
mod instance;
mod meaning;
mod part;
mod same;
mod spec;
mod variable;

pub use action::{Action, ActionKind, Effect, Situation, Trigger};
pub use chart::{Chart, Step, StepKind, Transition};
pub use compare::{Difference, differences};
pub use decision::{Decision, Verdict};
pub use environment::{EnvironmentRule, Property, in_next_scan, is_in_next_scan};
pub use graph::Node;
pub(crate) use instance::renamed_expr;
pub(crate) use meaning::{means_the_same, normal};
pub use part::{Instance, Part, PartKind};
pub(crate) use same::{SaysTheSame, comment_serves};
pub use spec::{Grafcet, Spec};
pub use variable::Variable;
