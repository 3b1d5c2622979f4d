//! Ladder programs: one model, a reader and a writer per format, the scan.
//!
//! [`read`] looks at what a file holds, never at its name alone, and turns its
//! bytes into a [`Program`] and diagnostics. It does not fail: a file that is
//! no ladder gives an empty program and a diagnostic that says what it is.
//! Nothing downstream asks which format a program came from.
//!
//! A program is an ordered list of rungs in routines. A rung is a [`Network`]:
//! power flows from the left rail through contacts and boxes to coils and
//! boxes. Every element knows the bytes that it was read from.
//!
//! Whoever reads a text again and again while it is edited keeps an
//! [`Edition`] of it: [`reread`] costs what the change costs.

pub mod flow;
pub mod model;

mod ascii;
mod edition;
mod plcopen;
mod reading;
mod rockwell;
pub mod scan;
mod shift;
pub mod text;
mod xml;

pub use edition::{Edition, reread};
pub use model::*;
pub use reading::{Reading, read};
pub use rockwell::{Instruction, instruction, instructions};
