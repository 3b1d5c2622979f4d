//! Whether a grafcet does what its ladder does.
//!
//! * [`program`] makes a transition system of a ladder, [`chart`] one of a
//!   grafcet beside it. Both follow the interpreters of `ladder::scan` and
//!   `grafcet::evolution`, scan by scan, with signals in place of values, and are
//!   judged by them. [`inputs`] tells what is free in each scan: what the plant
//!   gives, when timers run out, and what is not followed.
//!
//! What cannot be translated as it is meant is not translated: a [`Refusal`]
//! says why. What is left free, since time or numbers without bounds decide it,
//! is told by its [`inputs::Source`].

pub mod chart;
mod compared;
mod frame;
pub mod inputs;
pub mod program;
mod refusal;
mod rules;
mod run;
mod rungs;
mod trace;
mod value;
mod verify;

pub use refusal::Refusal;
pub use rungs::{RungOf, rungs_of};
pub use trace::{Step, Trace};
pub use verify::{Difference, Reason, Timing, Verdict, Verification, What, verify};
