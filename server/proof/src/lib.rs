//! Transition systems, and engines that prove two of them equal or find the
//! shortest sequence of inputs under which they differ.
//!
//! A ladder, a grafcet, a property: each is translated by others into a
//! [`Netlist`], gates and latches with inputs, outputs, constraints (what the
//! environment never does) and properties (what must never happen). Here
//! nobody knows what the latches stand for.
//!
//! ```
//! use proof::{Gates, Limits, Netlist, Verdict, check, compare};
//!
//! // A seal-in, written twice: where both buttons are pressed they differ.
//! let side = |stop_wins: bool| {
//!     let mut netlist = Netlist::default();
//!     let (start, stop) = (netlist.input("start"), netlist.input("stop"));
//!     let motor = netlist.latch("motor", false);
//!     let next = match stop_wins {
//!         true => { let held = netlist.or(start, motor); netlist.and(held, !stop) }
//!         false => { let held = netlist.and(motor, !stop); netlist.or(start, held) }
//!     };
//!     netlist.set_next(motor, next);
//!     netlist.output("motor", next);
//!     netlist
//! };
//! let mut both = compare(&side(true), &side(false)).netlist;
//! let report = check(&both, &Limits::default());
//! let Verdict::Different(difference) = report.verdict else { panic!("they differ") };
//! assert_eq!(difference.trace.inputs, [[true, true]]);
//!
//! // With an environment that never presses both, they are equivalent.
//! let (start, stop) = (both.input("start"), both.input("stop"));
//! let pressed = both.and(start, stop);
//! both.constrain(!pressed);
//! assert!(matches!(check(&both, &Limits::default()).verdict, Verdict::Equivalent));
//! ```
//!
//! The parts, from the ground up:
//!
//! * [`Signal`], [`Gates`] and [`Netlist`]: how a transition system is built,
//!   from gates or from the expressions and functions of `logic`.
//!   [`Netlist::place`] copies gates, [`compare`] puts two netlists side by
//!   side, [`Netlist::cone`] cuts out what some properties depend on.
//! * [`Trace`], [`replay`] and [`violation`]: a sequence of inputs and what it
//!   does.
//! * [`check`]: all engines, one [`Report`]. [`Limits`] bound its work and
//!   memory; there is no clock, so the answer is the same on every machine.
//! * [`seek`]: a shortest trace for each property by itself.
//! * [`blif`] and [`aiger`]: the same netlist for tools of others.
//!
//! `docs/proof.md` tells how the engines work and where they come from.

mod aside;
mod bounded;
mod check;
mod classes;
mod compare;
mod components;
mod cone;
mod correspondence;
mod deadlock;
mod diagrams;
mod enumeration;
mod explore;
mod export;
mod express;
mod frame;
mod gates;
mod graph;
mod induction;
mod lanes;
mod limits;
mod netlist;
mod observers;
mod place;
mod plain;
mod random;
mod reach;
mod relation;
mod report;
mod runs;
mod seek;
mod signal;
mod simplify;
mod solver;
mod supposed;
mod trace;

pub use aside::free_aside;
pub use check::check;
pub use compare::{Comparison, compare};
pub use cone::{Cone, Touched};
pub use deadlock::deadlock;
pub use export::{aiger, blif};
pub use gates::Gates;
pub use limits::{Limits, Why};
pub use netlist::{Initial, Input, Latch, Netlist, Output};
pub use place::Placed;
pub use report::{Difference, Proof, Report, Status, Verdict};
pub use seek::{Search, Sought, seek};
pub use signal::Signal;
pub use simplify::simplified;
pub use supposed::Supposed;
pub use trace::{Replay, Trace, replay, violation};

#[cfg(test)]
mod tests;
// The tests share the judge's systems with those outside, who know the crate by
// this name.
#[cfg(test)]
extern crate self as proof;
