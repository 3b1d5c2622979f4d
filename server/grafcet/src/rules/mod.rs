//! The rule text: what a `.grafcet` file says, and how.
//!
//! The notation of the rule-based specification, extended until every grafcet
//! of the [model](crate::model) can be written:
//!
//! ```text
//! Grafcet Neutralization
//!
//! Step X0
//! Step Xv1 for v1                 // Fill the tank
//! Transition t1, t2
//! Input s %I0                     // Start button
//! Input ls2
//! Output v1 %Q0
//! Marking X0
//!
//! Transitions:
//! t1: X0*s |- @Xv1
//! t2: Xv1*ls2 |- @X0
//!
//! Steps:
//! Xv1: |- v1
//!
//! Environment:
//! e1: s |- /ls2                   // whenever the left holds, the right does
//!
//! Never:
//! n1: v1*ls2
//!
//! //! accept v1 -> v2 & h
//! ```
//!
//! A statement is a line. Left of `|-`, the leading names of steps are the
//! steps before the transition, and everything from the first factor that is
//! not such a name on is the receptivity; a step's variable that would come
//! first in a receptivity is put in parentheses: `X1*(X7)*m`.
//!
//! [`read`] gives the [`Spec`](crate::Spec) with the [places](Places) of its
//! names; [`write`] gives the canonical text of a spec; [`rewrite`] makes an
//! existing text say something else; [`format`] lays one out. All four share
//! one list of statements, in which every line of a text is kept.

mod check;
mod clauses;
mod decisions;
mod format;
mod lines;
mod lists;
mod next_scan;
mod parse;
mod places;
mod read;
mod rewrite;
mod spell;
mod syntax;
mod words;
mod write;

pub use decisions::decision_text;
pub use format::{Formatted, format};
pub use places::{Mention, Places, Role, RulePlace, SectionPlace};
pub use read::{Reading, read};
pub use rewrite::rewrite;
pub use spell::{action_rule, action_text, spelled, spelled_state, transition_rule};
pub use write::write;
