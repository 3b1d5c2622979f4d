//! Comments `(* *)` and pragmas `{ }`: what a drawing holds beside ladders.

use source::{Diagnostic, Span, codes};

use crate::reading::Source;

/// A comment or pragma.
#[derive(Clone, Debug)]
pub(super) struct Note {
    /// Its bytes in the text, delimiters included.
    pub(super) start: usize,
    pub(super) end: usize,
    /// The text of a comment; pragmas speak to other tools.
    pub(super) comment: Option<String>,
}

/// All notes in their order. One that does not end reaches to the end of the
/// text.
pub(super) fn notes(source: Source<'_>) -> (Vec<Note>, Vec<Diagnostic>) {
    let text = source.text;
    let mut notes = Vec::new();
    let mut diagnostics = Vec::new();
    let mut at = 0;
    while let Some(found) = text[at..].find(['(', '{']) {
        let start = at + found;
        let is_comment = text[start..].starts_with("(*");
        if !is_comment && text[start..].starts_with('(') {
            at = start + 1;
            continue;
        }
        let end = if is_comment {
            text[start + 2..].find("*)").map(|end| start + 2 + end + 2)
        } else {
            pragma_end(text, start)
        };
        if end.is_none() {
            diagnostics.push(unended(source.span(start, start + 1), is_comment));
        }
        let comment = is_comment.then(|| {
            let inner = &text[start + 2..end.map_or(text.len(), |end| end - 2)];
            inner.trim_matches(|c: char| c == '*' || c == '-' || c.is_whitespace())
        });
        at = end.unwrap_or(text.len());
        notes.push(Note {
            start,
            end: at,
            comment: comment.map(str::to_owned),
        });
    }
    (notes, diagnostics)
}

/// The end of the pragma that begins at `start`. Pragmas nest, also where
/// the inner braces are written `\{` and `\}`.
fn pragma_end(text: &str, start: usize) -> Option<usize> {
    let mut depth = 0usize;
    for (at, byte) in text.bytes().enumerate().skip(start) {
        match byte {
            b'{' => depth += 1,
            b'}' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return Some(at + 1);
        }
    }
    None
}

fn unended(span: Span, is_comment: bool) -> Diagnostic {
    let (what, end) = if is_comment {
        ("comment", "*)")
    } else {
        ("pragma", "}")
    };
    Diagnostic::new(
        codes::CUT_SHORT,
        span,
        format!("the {what} that begins here does not end"),
    )
    .help(format!(
        "end it with `{end}`; all behind it was taken as part of it"
    ))
}
