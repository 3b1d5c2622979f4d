//! The requests of the protocol, one file each.

pub mod completion;
pub mod content;
pub mod formatting;
pub mod hover;
pub mod inline_completion;
pub mod rename;
pub mod signature_help;
