//! A client of the language server, as strict as the protocol.
//!
//! It speaks to the built executable over its streams, like an editor. Every
//! message is read into the protocol's types; a message that nobody expected
//! fails the test, and so does a server that does not end well.

mod client;
mod cursor;
mod profile;
mod wire;

pub use client::{Client, Refused};
pub use cursor::{Marked, at_cursor, selected};
pub use profile::Profile;
pub use wire::Wire;
