//! Whether a grafcet does what its ladder does.
pub mod chart;
mod compared;
pub mod inputs;
pub mod program;
mod refusal;
mod value;

pub use refusal::Refusal;
