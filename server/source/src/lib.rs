//! Places in a text, and what there is to say about them.
//!
//! Everything that Gradus reads, a ladder in XML, a rung in text, a rule of a
//! spec, remembers the bytes it came from. A [`Span`] is such a place; a
//! [`Diagnostic`] says something about one, with a stable [`Code`] whose page
//! `gradus explain` prints. [`LineIndex`] turns byte offsets into the line and
//! column that a person or an editor counts.
//!
//! This crate knows neither ladders nor grafcets: it is the ground the others
//! stand on.

mod code;
mod diagnostic;
mod line;
mod span;

pub use code::{Code, codes};
pub use diagnostic::{Diagnostic, Edit, Fix, Related, Severity};
pub use line::{LineColumn, LineIndex};
pub use span::Span;
