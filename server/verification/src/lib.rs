//! Whether a grafcet does what its ladder does.
mod compared;
pub mod inputs;
pub mod program;
mod refusal;
mod value;

pub use refusal::Refusal;
