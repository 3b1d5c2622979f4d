//! The notation of expressions, one for every text that Gradus reads or
//! writes: `.ladder`, `.grafcet`, `.scenario`, and the answers it prints.
//!
//! ```text
//! expression = product { "+" product }
//! product    = factor { "*" factor }
//! factor     = "/" factor | primary
//! primary    = "0" | "1" | "(" expression ")" | edge | comparison
//!            | time "/" step | name
//! edge       = "rise" "(" expression ")" | "fall" "(" expression ")"
//!            | "^" factor
//! comparison = value ( "=" | "<>" | "<" | "<=" | ">" | ">=" ) ( value | time )
//! value      = name | [ "-" ] number
//! name       = letter { letter | digit | "_" | "." }, a leading "%" allowed,
//!              or anything within double quotes
//! ```
//!
//! `//` begins a comment that ends with the line, so a double complement is
//! written `/(/a)`. [`Lexer`] cuts a text into tokens with their bytes,
//! [`expression`] reads a [`Node`] and never panics; the texts' own grammars
//! build on both. [`write`] prints an [`Expr`](crate::Expr) back.

mod lexer;
mod parser;
mod printer;
mod time;

pub use lexer::{Lexer, Token, TokenKind};
pub use parser::{Node, NodeKind, Problem, expression, one_factor, parse};
pub use printer::{is_literal, quoted, quoted_value, write, write_factor};
pub(crate) use time::unit_in_milliseconds;
pub use time::{milliseconds, time};
