//! Whether a grafcet does what its ladder does.
//!
//! * [`program`] makes a transition system of a ladder, [`chart`] one of a
//!   grafcet beside it. Both follow the interpreters of `ladder::scan` and
//!   `grafcet::evolution`, scan by scan, with signals in place of values, and are
//!   judged by them. [`inputs`] tells what is free in each scan: what the plant
//!   gives, when timers run out, and what is not followed.
//!
//! * [`verify`] asks whether the two do the same, and gives a [`Verification`].
//!   What the engines of `proof` find is run by the interpreters before it is
//!   told, as a [`Trace`]. [`rungs_of`] names the rungs that decide.
//! * [`alone`] gives one side as a netlist for other tools.
//!
//! What cannot be translated as it is meant is not translated: a [`Refusal`]
//! says why. What is left free, since time or numbers without bounds decide it,
//! is told by its [`inputs::Source`].

pub mod alone;
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
