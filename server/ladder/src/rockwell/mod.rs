//! Rockwell: L5X (XML), L5K (text) and bare neutral text.
//!
//! All three hold rungs in the same neutral text, `XIC(a)OTE(b);`, so there is
//! one way from a rung to the model and three ways to find the rungs:
//!
//! ```text
//! l5x ─┐
//! l5k ─┼─> Project ─> program ─> neutral, names, rung ─> Program
//! listing (bare text) ─┘
//! ```
//!
//! [`project`] is what the formats have in common; [`neutral`] is the grammar of
//! rungs; [`catalogue`] knows the instructions; [`names`] gives each variable one
//! name; [`rung`] draws networks, [`instruction`], [`values`] and [`boxes`] what
//! stands on them.

mod boxes;
mod catalogue;
mod data;
mod declarations;
mod instruction;
mod l5k;
mod l5x;
mod listing;
mod names;
mod neutral;
mod operand;
mod passage;
mod program;
mod project;
mod reference;
mod rung;
mod values;
mod xml;

pub use reference::{Instruction, instruction, instructions};

use crate::reading::{Reading, Source};

pub(crate) fn looks_like_l5k(text: &str) -> bool {
    l5k::looks_like_it(text)
}

pub(crate) fn looks_like_neutral_text(text: &str) -> bool {
    listing::looks_like_it(text)
}

pub(crate) fn read_l5x(source: Source<'_>) -> Reading {
    l5x::read(source)
}

pub(crate) fn read_l5k(source: Source<'_>) -> Reading {
    l5k::read(source)
}

pub(crate) fn read_neutral_text(source: Source<'_>) -> Reading {
    listing::read(source)
}
