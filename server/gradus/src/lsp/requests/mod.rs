//! The requests of the protocol, one file each.

pub mod code_action;
pub mod code_lens;
pub mod command;
pub mod completion;
pub mod content;
pub mod definition;
pub mod folding;
pub mod formatting;
pub mod hierarchy;
pub mod highlight;
pub mod hover;
pub mod inlay_hint;
pub mod inline_completion;
pub mod link;
mod on_verdict;
pub mod references;
pub mod rename;
pub mod selection;
pub mod signature_help;
pub mod simulate;
pub mod symbols;
pub mod tokens;
pub mod verify;
pub mod workspace_diagnostic;
