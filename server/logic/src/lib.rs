//! Boolean expressions, their notation, and the functions they denote.
//!
//! Three views of one thing:
//!
//! * [`Expr`] is an expression as somebody wrote it: `(s + v1) * /ls2`.
//! * [`notation`] reads and prints expressions, with the operators of the
//!   rule-based specification: `*` and, `+` or, `/` not.
//! * [`Function`] is what an expression means: a reduced ordered binary
//!   decision diagram over the atoms it depends on, and no others. Two
//!   expressions that mean the same give equal functions.
//!
//! Where something is run instead of reasoned about, a variable's value is a
//! [`Datum`].
//!
//! Every operation on functions takes a [`Budget`]: past it the answer is
//! [`Stop::TooLarge`], never a long wait. The crate knows no ladder.

mod atoms;
mod budget;
mod datum;
mod expr;
mod function;
pub mod notation;
mod products;

pub use atoms::{AtomId, Atoms};
pub use budget::{Budget, Cancel, Stop};
pub use datum::{Datum, duration};
pub use expr::{Atom, Comparison, Expr, Name, Relation};
pub use function::{Function, Literal};
pub use products::Product;
