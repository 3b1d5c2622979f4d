//! Whether a grafcet does what its ladder does.
//!
//! ```
//! use proof::Limits;
//! use verification::{Timing, Verdict, verify};
//!
//! let program = "input start\ninput stop\noutput motor\nrung: (start + motor) * /stop -> motor\n";
//! let spec = "\
//! Step X0, Xrun
//! Transition t1, t2
//! Input start, stop
//! Output motor
//! Marking X0
//! Transitions:
//! t1: X0*start |- @Xrun
//! t2: Xrun*stop |- @X0
//! Steps:
//! Xrun: |- motor
//! ";
//! let ladder = ladder::read(program.as_bytes()).program;
//! let limits = Limits::default();
//! // Both buttons at once: the grafcet runs in a circle, where the ladder stops.
//! let found = verify(&ladder, &grafcet::read(spec).spec, Timing::Scan, &limits)?;
//! let Verdict::Different(difference) = found.verdict else { panic!("they differ") };
//! assert_eq!(difference.trace.steps.len(), 1);
//!
//! let spec = spec.replace("X0*start", "X0*start*/stop");
//! let found = verify(&ladder, &grafcet::read(&spec).spec, Timing::Scan, &limits)?;
//! assert_eq!(found.verdict, Verdict::Equivalent);
//! # Ok::<(), verification::Refusal>(())
//! ```
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
//! * [`witness`] searches for sequences of inputs that show which state follows
//!   which.
//! * [`alone`] gives one side as a netlist for other tools.
//!
//! What cannot be translated as it is meant is not translated: a [`Refusal`]
//! says why. What is left free, since time or numbers without bounds decide it,
//! is told by its [`inputs::Source`].

pub mod alone;
mod answer;
pub mod chart;
mod compared;
mod domain;
mod frame;
pub mod inputs;
pub mod program;
mod ranges;
mod ready;
mod refusal;
mod rules;
mod run;
mod rungs;
mod system;
mod trace;
mod value;
mod verify;
pub mod witness;
mod word;

pub use answer::{Difference, Reason, Timing, Verdict, Verification, What};
pub use refusal::Refusal;
pub use rungs::{RungOf, rungs_of};
pub use trace::{Step, Trace};
pub use verify::verify;
