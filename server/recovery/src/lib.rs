//! From a ladder to its grafcet.
//!
//! ```text
//! Program -> Conditions -> States, Registers -> Successions -> (expert) -> Grafcet
//! ```
//!
//! [`conditions`] says of every coil what starts, keeps and ends it;
//! [`states`] which coils hold the states of the process, [`registers`] which
//! numbers count its steps; [`successions`] which state may follow which.
//!
//! [`simulation`] runs a ladder, a grafcet, or both side by side on a scenario.

mod analysis;
pub mod conditions;
pub mod conversion;
pub mod findings;
pub mod groups;
mod moments;
mod order;
pub mod registers;
pub mod simulation;
pub mod states;
pub mod successions;

pub use analysis::{Analysis, Anew, analyse, analyse_after};
pub use moments::AtRest;
