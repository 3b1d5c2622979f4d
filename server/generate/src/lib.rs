//! Other forms of a grafcet: JSON for programs, dot for pictures.
//!
//! Each form is one pure function of the model, so that the same grafcet gives
//! the same text on every run and machine. What a form cannot say is written
//! out in terms of what it can: instances of reusable grafcets become partial
//! grafcets, delays and limits become conditions.

mod dot;
mod json;

pub use dot::to_dot;
pub use json::{action_kind, to_json};
