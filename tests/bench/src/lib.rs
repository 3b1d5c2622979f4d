//! What Gradus costs, in ratios to something that runs beside it.
//!
//! A time alone says more about the machine than about the program. Here every
//! number is a ratio of two times taken in the same run, round by round in
//! turn: a reader against a bare pass over the same XML, one rule against the
//! other, a large program against a small one, one library of decision
//! diagrams against another.
//!
//! `cargo run --release -p gradus-bench` prints the table that
//! `docs/benchmarks.md` explains. The Criterion benches beside it watch single
//! parts over time. This crate measures; it tests nothing but its own
//! generators and that both libraries of diagrams agree.

pub mod abc;
pub mod circuit;
pub mod diagrams;
pub mod guards;
pub mod measure;
pub mod memory;
pub mod pair;
pub mod plant;
pub mod questions;
pub mod real;
pub mod sequencer;
pub mod whole;
pub mod xml;
