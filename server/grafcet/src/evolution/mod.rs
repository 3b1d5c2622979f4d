//! The evolution: how a grafcet runs (IEC 60848, 4.5).
//!
//! A [`Machine`] holds a grafcet's situation and variables. It is given values
//! of inputs, told how much time has passed, and evolves until it is stable:
//! all transitions that can be cleared are cleared at once, again and again,
//! until none is left. Then it publishes its continuous actions.
//!
//! ```text
//! inputs -> events, edges -> evolution, evolution, ... -> stable -> outputs
//! ```
//!
//! The standard leaves some questions open, and an interpreter must answer
//! them all. Each answer, its reason and its test stand in `docs/evolution.md`.
//!
//! * [`machine`] is the scan: what happens in which order.
//! * [`net`] is the grafcet with numbers in place of names, which [`compile`]
//!   makes; [`condition`] and [`term`] are its expressions.
//! * [`firing`] is one evolution, [`hierarchy`] what macro-steps, enclosures
//!   and forcing orders make of it, [`storing`] and [`publishing`] what the
//!   two kinds of actions do.

mod compile;
mod condition;
mod firing;
mod hierarchy;
mod machine;
mod net;
mod publishing;
mod storing;
mod term;
mod unstable;

pub use condition::{Condition, Edge};
pub use machine::{Evolution, Machine};
pub use net::{
    Continuous, Effect, Expansion, Imposed, Kind, Net, On, Order, Part, Step, Stored, Transition,
};
pub use term::{Operand, Term};
pub use unstable::Unstable;
