//! The requests of the protocol, one file each.

pub mod code_action;
pub mod code_lens;
pub mod command;
pub mod content;
pub mod hover;
pub mod inlay_hint;
