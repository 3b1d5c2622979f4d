use std::collections::HashMap;

use tower_lsp::ls_types::{Position, Range, TextEdit};

/// A text with its cursors taken out.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Marked {
    /// The text without `$0` and `$1`.
    pub text: String,
    /// The bytes where they stood.
    pub cursors: Vec<usize>,
}

impl Marked {
    /// Takes the cursors `$0`, `$1` and so on, of one digit each, out of `text`.
    pub fn of(text: &str) -> Self {
        let mut plain = String::new();
        let mut cursors = Vec::new();
        let mut rest = text;
        while let Some(at) = rest.find('$') {
            let behind = &rest[at + 1..];
            plain += &rest[..at];
            rest = match behind.strip_prefix(|c: char| c.is_ascii_digit()) {
                Some(behind) => {
                    cursors.push(plain.len());
                    behind
                }
                None => {
                    plain.push('$');
                    behind
                }
            };
        }
        plain += rest;
        Self {
            text: plain,
            cursors,
        }
    }

    /// The position of a cursor, columns in bytes or in UTF-16 code units.
    pub fn position(&self, cursor: usize, counts_bytes: bool) -> Position {
        position(&self.text, self.cursors[cursor], counts_bytes)
    }
}

/// The text around the one cursor of `text`, and the cursor's position in
/// UTF-16 code units.
pub fn at_cursor(text: &str) -> (String, Position) {
    let marked = Marked::of(text);
    let position = marked.position(0, false);
    (marked.text, position)
}

/// What a range of `text` selects, columns in UTF-16 code units.
pub fn selected(text: &str, range: Range) -> &str {
    let at = |position| {
        let mut offsets = text.char_indices().map(|(at, _)| at).chain([text.len()]);
        let found = offsets.find(|&at| self::position(text, at, false) == position);
        found.expect("a position of the text")
    };
    &text[at(range.start)..at(range.end)]
}

/// `text` after edits, as a client makes them: all count on the old text, and
/// none may reach into another.
pub fn edited(text: &str, edits: &[TextEdit], counts_bytes: bool) -> String {
    let mut offsets: Vec<usize> = text.char_indices().map(|(at, _)| at).collect();
    offsets.push(text.len());
    let places: HashMap<Position, usize> = offsets
        .into_iter()
        .rev()
        .map(|at| (position(text, at, counts_bytes), at))
        .collect();
    let mut spans: Vec<(usize, usize, &str)> = edits
        .iter()
        .map(|edit| {
            let at = |position| places[&position];
            (at(edit.range.start), at(edit.range.end), &*edit.new_text)
        })
        .collect();
    spans.sort_by_key(|(start, end, _)| (*start, *end));
    let mut out = String::new();
    let mut done = 0;
    for (start, end, new) in spans {
        assert!(done <= start, "edits reach into each other: {edits:?}");
        out += &text[done..start];
        out += new;
        done = end;
    }
    out + &text[done..]
}

fn position(text: &str, offset: usize, counts_bytes: bool) -> Position {
    let before = &text[..offset];
    let mut line = 0;
    let mut start = 0;
    let bytes = before.as_bytes();
    for (at, byte) in bytes.iter().enumerate() {
        let ends = match byte {
            b'\n' => true,
            b'\r' => text.as_bytes().get(at + 1) != Some(&b'\n'),
            _ => false,
        };
        if ends {
            line += 1;
            start = at + 1;
        }
    }
    let column = match counts_bytes {
        true => offset - start,
        false => before[start..].encode_utf16().count(),
    };
    Position::new(line, u32::try_from(column).expect("a short line"))
}
