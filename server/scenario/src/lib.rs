//! Scenarios: what is done to a plant's inputs, and what must come of it.
//!
//! ```text
//! scenario "Filled, and nothing else"
//! for tank.ladder
//!
//! on s        => on v1        // somebody presses start
//! off s, on ls1
//! on ls2      => off v1, on m
//! wait 5s     => only
//! ```
//!
//! A [`Scenario`] is such a text as data: [`read`] makes one, and [`write`]
//! makes the text again; [`format`] lays out a text as a person left it. This
//! crate knows neither ladders nor grafcets: who runs a scenario on them says
//! what came of it.

mod format;
mod lines;
mod model;
mod parse;
mod read;
mod write;

pub use format::{Formatted, format};
pub use model::{
    Change, DEFAULT_CYCLE_MS, Expectation, FileName, Passing, Scenario, Step, Test, Timing,
};
pub use parse::{WORDS, spelled};
pub use read::{Reading, is_scenario, read};
pub use write::{done, expectation, expected, write};
