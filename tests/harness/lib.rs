//! What the end-to-end tests share: running the built executable as its users
//! do, and knowing where things lie.
//!
//! The tests themselves are targets of the package `gradus`, because Cargo
//! builds the executable for them and says where it is. They hand its path to
//! [`Gradus`].

mod corpus;
mod gradus;
pub mod lsp;
mod repository;
#[cfg(unix)]
mod terminal;

pub use corpus::corpus;
pub use gradus::{Ended, Gradus};
pub use repository::{path, update_is_asked_for};
#[cfg(unix)]
pub use terminal::Terminal;
