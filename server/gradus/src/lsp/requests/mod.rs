//! The requests of the protocol, one file each.

pub mod content;
pub mod hover;
