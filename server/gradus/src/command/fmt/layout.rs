//! Which layout a text has, and the bytes around it that are no part of it.
//!
//! Formatters work on text with plain line ends. What a file has beyond that, a
//! byte order mark, CRLF line ends, is taken off before and put back after.

use source::{Diagnostic, Span};

const BYTE_ORDER_MARK: &str = "\u{feff}";

/// What a formatter gives.
pub struct Formatted {
    /// The canonical text.
    pub text: String,
    /// Findings about the text that was given.
    pub diagnostics: Vec<Diagnostic>,
}

/// A kind of text that has a canonical layout.
struct Layout {
    /// Whether a file is of this kind, by its content.
    recognises: fn(&[u8]) -> bool,
    /// The layout.
    format: fn(&str) -> Formatted,
}

/// All kinds of text that have one.
const LAYOUTS: &[Layout] = &[];

/// A file's text before and after.
pub struct LaidOut {
    /// As it is.
    pub old: String,
    /// As it should be.
    pub new: String,
    /// Findings; their places count bytes of the file.
    pub diagnostics: Vec<Diagnostic>,
}

/// Lays out the file that holds `bytes`; `None` if it is of no kind that has a
/// layout.
pub fn of(bytes: &[u8]) -> Option<LaidOut> {
    let layout = LAYOUTS.iter().find(|layout| (layout.recognises)(bytes))?;
    let old = std::str::from_utf8(bytes).ok()?;
    Some(lay_out(old, layout.format))
}

fn lay_out(old: &str, format: fn(&str) -> Formatted) -> LaidOut {
    let (mark, body) = match old.strip_prefix(BYTE_ORDER_MARK) {
        Some(body) => (BYTE_ORDER_MARK, body),
        None => ("", old),
    };
    let formatted = format(body);
    let text = if ends_lines_with_crlf(body) {
        formatted.text.replace("\r\n", "\n").replace('\n', "\r\n")
    } else {
        formatted.text
    };
    let mut diagnostics = formatted.diagnostics;
    for diagnostic in &mut diagnostics {
        shift(diagnostic, mark.len());
    }
    LaidOut {
        old: old.to_owned(),
        new: format!("{mark}{text}"),
        diagnostics,
    }
}

/// Whether the first line ends so.
fn ends_lines_with_crlf(text: &str) -> bool {
    text.split_inclusive('\n')
        .next()
        .is_some_and(|line| line.ends_with("\r\n"))
}

/// Moves the places of a finding behind a byte order mark.
fn shift(diagnostic: &mut Diagnostic, by: usize) {
    let spans = std::iter::once(&mut diagnostic.span)
        .chain(
            diagnostic
                .related
                .iter_mut()
                .map(|related| &mut related.span),
        )
        .chain(
            diagnostic
                .fix
                .iter_mut()
                .flat_map(|fix| fix.edits.iter_mut().map(|edit| &mut edit.span)),
        );
    for span in spans {
        *span = Span::new(span.start as usize + by, span.end as usize + by);
    }
}

#[cfg(test)]
mod tests {
    use source::codes;

    use super::*;

    /// A layout that closes up the blanks in every line.
    fn close_up(text: &str) -> Formatted {
        let lines = text.lines().map(|line| line.replace(' ', "") + "\n");
        Formatted {
            text: lines.collect(),
            diagnostics: vec![Diagnostic::new(
                codes::LADDER_SYNTAX,
                Span::new(0, 1),
                "odd",
            )],
        }
    }

    #[test]
    fn byte_order_mark_and_line_ends_stay() {
        assert_eq!(lay_out("a b\r\nc\r\n", close_up).new, "ab\r\nc\r\n");
        assert_eq!(lay_out("\u{feff}a b\n", close_up).new, "\u{feff}ab\n");
    }

    #[test]
    fn findings_keep_their_place_in_the_file() {
        let laid_out = lay_out("\u{feff}a", close_up);
        assert_eq!(laid_out.diagnostics[0].span, Span::new(3, 4));
    }
}
