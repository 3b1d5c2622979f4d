//! The requests of the protocol, one file each.

pub mod content;
pub mod definition;
pub mod highlight;
pub mod hover;
pub mod references;
