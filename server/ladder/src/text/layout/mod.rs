//! The canonical layout of a `.ladder` text.
//!
//! Only blanks and line breaks change: every token and every comment stays, in
//! its order. (Three spellings give way to one: a keyword is written small,
//! `:=` before an initial value becomes `=`, and a variable called as a keyword
//! gets quotes where a line begins with it.) So the program read
//! from the new text is the one read from the old, and laying out twice is
//! laying out once.
//!
//! A statement that breaks the grammar is left as it is, byte for byte, since
//! nobody knows yet what it is going to be.

mod broken;
mod columns;
mod line_ends;
mod piece;

use source::Span;

use super::statement::cut;
use line_ends::LineEnd;
use piece::{Piece, piece};

/// Lines are broken where they would be longer than this, in characters.
/// Comments do not count.
const WIDTH: usize = 100;

/// How far continuation lines are indented.
const INDENT: usize = 4;

/// A text in its canonical layout.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Formatted {
    /// The whole text.
    pub text: String,
    /// Places in the old text, in bytes, of the statements that break the
    /// grammar and were left as they are.
    pub left: Vec<Span>,
}

/// Lays a `.ladder` text out.
///
/// Keywords, names, addresses and descriptions of declarations that follow
/// each other without a blank line stand in columns, and so do the arrows of
/// rungs. Line ends are those that prevail in the text, CRLF or LF; a byte
/// order mark stays.
pub fn format(text: &str) -> Formatted {
    let (mark, body) = match text.strip_prefix(BYTE_ORDER_MARK) {
        Some(body) => (BYTE_ORDER_MARK, body),
        None => ("", text),
    };
    let items = cut(body);
    let pieces: Vec<Piece> = items.iter().map(|item| piece(body, item)).collect();
    let left = pieces.iter().filter_map(|piece| match piece {
        Piece::Left { span, .. } => Some(Span::new(
            mark.len() + span.range().start,
            mark.len() + span.range().end,
        )),
        _ => None,
    });
    let left = left.collect();
    let line_end = LineEnd::prevailing(body, &pieces);

    let mut laid = String::with_capacity(text.len());
    laid.push_str(mark);
    let mut blank = true;
    let mut pending_blank = false;
    for line in columns::lines(pieces) {
        if line.is_empty() {
            pending_blank = !blank;
            continue;
        }
        if std::mem::take(&mut pending_blank) {
            laid.push_str(line_end.text());
        }
        blank = false;
        laid.push_str(&line);
        laid.push_str(line_end.text());
    }
    Formatted { text: laid, left }
}

const BYTE_ORDER_MARK: &str = "\u{feff}";
