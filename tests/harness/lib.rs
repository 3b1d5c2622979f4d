//! What the end-to-end tests share: running the built executable as its users
//! do, and knowing where things lie; and what tests of several packages need,
//! such as a thread with a small stack.
//!
//! The tests themselves are targets of the package `gradus`, because Cargo
//! builds the executable for them and says where it is. They hand its path to
//! [`Gradus`].

mod corpus;
mod gradus;
pub mod lsp;
mod repository;
mod small_stack;
#[cfg(unix)]
mod terminal;

pub use corpus::corpus;
pub use gradus::{Ended, Gradus};
pub use repository::{path, update_is_asked_for};
pub use small_stack::on_a_small_stack;
#[cfg(unix)]
pub use terminal::Terminal;
