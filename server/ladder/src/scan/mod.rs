//! The scan: how a controller solves a program.
//!
//! A [`Machine`] holds the values of a program's variables and solves it scan
//! by scan: rungs in the order of execution, elements in the order of their
//! network, every write seen by everything solved after it. Time does not
//! pass by itself; each scan is told how long after the last it comes.
//!
//! [`power`] is the other end of the same idea: one network, with the value
//! of every atom given from outside and nothing written. It is brute force
//! and short on purpose, so that it can judge conditions which were computed
//! in cleverer ways.
//!
//! What is not modelled is not invented: the outputs of unknown boxes and the
//! terms that [`term`] cannot compute are inputs of the machine, listed by
//! [`Machine::unknown`]. Integers have 64 bits whatever their type says.

mod atom;
mod counter;
mod machine;
mod names;
mod power;
mod solve;
mod state;
mod term;
mod timer;
mod unknown;

pub use atom::{memory_atom, own_atom, pin_atom, wire_memory_atom};
pub use logic::Datum;
pub use machine::Machine;
pub use names::{Kind, Names, Stored, bit_of_word, is_plain};
pub use power::{Power, power};
