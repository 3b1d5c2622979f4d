//! What a person is shown of ladders and grafcets, as plain data.
//!
//! Every command and every editor asks here, so that they say the same. An
//! answer holds names, texts and places in bytes; it knows no protocol, no
//! terminal and no file. What is looked at is a [`Ladder`] and the [`Spec`]
//! beside it. One thing to be shown is one file with one entry:
//!
//! * [`coils`]: every coil with all that is known of it, in words;
//! * [`said`] and [`legible`]: a condition in the notation, past a size that a
//!   person can read not at all;
//! * [`language`]: whether a text is a ladder or a spec;
//! * [`decide`]: what a new decision does to those made before;
//! * [`changed`]: the smallest edits from one text to another.

mod changed;
mod coil;
mod completion;
mod condition;
pub mod decide;
mod decided;
mod describe;
mod hover;
mod ladder;
pub mod language;
mod layout;
mod names;
mod next;
mod rename;
mod section;
mod signature;
mod spec;
mod statement;

pub use changed::{changed, edited};
pub use coil::{Coil, Drawn, Part, Said, coil, coils, kind_word};
pub use completion::{
    Completion, CompletionKind, Completions, complete_in_ladder, complete_in_spec,
};
pub use condition::{legible, said};
pub use decided::{Decided, Standing};
pub use hover::{Block, Hover, hover_in_ladder, hover_in_spec, hover_of_variable};
pub use ladder::Ladder;
pub use layout::{Extent, lay_out_ladder, lay_out_spec};
pub use names::{Mention, Names, Usage, element};
pub use next::{Next, NextKind, next, next_at};
pub use rename::{
    Refusal, Renamable, Renaming, renamable_in_ladder, renamable_in_spec, rename_in_ladder,
    rename_in_spec,
};
pub use signature::{Signature, signature};
pub use spec::Spec;
