//! Rockwell: L5X (XML), L5K (text) and bare neutral text.

use crate::reading::{Reading, Source};

pub(crate) fn looks_like_l5k(_text: &str) -> bool {
    false
}
pub(crate) fn looks_like_neutral_text(_text: &str) -> bool {
    false
}
pub(crate) fn read_l5x(_source: Source<'_>) -> Reading {
    todo!()
}
pub(crate) fn read_l5k(_source: Source<'_>) -> Reading {
    todo!()
}
pub(crate) fn read_neutral_text(_source: Source<'_>) -> Reading {
    todo!()
}
