//! The requests of the protocol, one file each.

pub mod code_action;
pub mod code_lens;
pub mod command;
pub mod content;
pub mod definition;
pub mod folding;
pub mod hierarchy;
pub mod highlight;
pub mod hover;
pub mod inlay_hint;
pub mod link;
pub mod references;
pub mod selection;
pub mod symbols;
pub mod tokens;
