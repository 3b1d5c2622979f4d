//! The project's own rung notation, `.ladder`: ladder programs as plain text
//! that can be read, typed and compared line by line.
//!
//! ```text
//! program Neutralization
//!
//! input  s   %I0 // Start button
//! input  ls2 %I2 // Level at ls2
//! output v1  %Q0 // Open valve v1
//!
//! rung "Fill the tank": (s + v1) * /ls2 -> v1
//! ```
//!
//! `docs/notation.md` has the grammar. On the way in, a text is cut into
//! `statement`s, each is parsed by itself (`declaration`, `rung`, `output`,
//! `term`) so that an error costs one statement, and a second pass folds
//! addresses onto names (`names`) and draws the rungs (`network`, `drive`).
//! After an edit `reread` does so for the statements that changed.
//! [`format()`] lays a text out anew without changing what it says, and
//! [`write()`] prints any program, whatever it was read from.

mod boxes;
mod declaration;
mod declare;
mod drive;
mod findings;
mod layout;
mod names;
mod network;
mod output;
mod read;
mod reread;
mod rung;
mod sections;
mod spacing;
mod statement;
mod stretch;
mod syntax;
mod term;
mod write;

pub use layout::{Formatted, format};
pub(crate) use read::read;
pub(crate) use reread::{Traces, reread};
use statement::{Item, Keyword};
pub use write::{Lost, Written, branches, draw, write};

/// Whether a text that is no XML and no other known form is this one: some
/// line begins a rung, or the text begins with a declaration that no foreign
/// word follows, or there are only comments.
pub(crate) fn looks_like_it(text: &str) -> bool {
    let mut lines = text
        .lines()
        .map(str::trim_start)
        .filter(|line| !line.is_empty() && !line.starts_with("//"));
    let Some(first) = lines.next() else {
        return !text.trim().is_empty();
    };
    if begins_rung(first) {
        return true;
    }
    let Some(second) = lines.next() else {
        return is_declaration(first);
    };
    is_declaration(first) && begins_statement(second)
        || begins_rung(second)
        || lines.any(begins_rung)
}

/// `PROGRAM main` may begin an IEC text too, but what follows there does not
/// begin a statement here.
fn begins_statement(line: &str) -> bool {
    let word = line.split(|c: char| !c.is_alphanumeric()).next();
    word.is_some_and(|word| Keyword::of(word).is_some())
}

fn begins_rung(line: &str) -> bool {
    line.strip_prefix("rung").is_some_and(|rest| {
        let rest = rest.trim_start();
        rest.starts_with(':') || rest.starts_with('"') || rest.starts_with("label ")
    })
}

/// Whether the line is a whole statement other than a rung. A sentence that
/// begins with "output" is not.
fn is_declaration(line: &str) -> bool {
    match statement::cut(line).into_iter().next() {
        Some(Item::Statement(statement)) if statement.keyword.is_some() => {
            read::understand(line, &statement).1.is_empty()
        }
        _ => false,
    }
}
