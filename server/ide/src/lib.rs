//! What a person is shown of ladders and grafcets, as plain data.
//!
//! Every command and every editor asks here, so that they say the same. An
//! answer holds names, texts and places in bytes; it knows no protocol, no
//! terminal and no file. One thing to be shown is one file with one entry:
//!
//! * [`coils`]: every coil with all that is known of it, in words;
//! * [`said`] and [`legible`]: a condition in the notation, past a size that a
//!   person can read not at all.

mod coil;
mod condition;

pub use coil::{Coil, Drawn, Part, Said, coils, kind_word};
pub use condition::{legible, said};
