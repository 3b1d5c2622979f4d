//! Places as the protocol counts them, and as the rest of the program does.
//!
//! Everywhere else a place is a byte of the text. The protocol has lines, and
//! columns in units that client and server agree upon: bytes or UTF-16 code
//! units. Only here is the one turned into the other.

use ropey::Rope;
use source::Span;
use tower_lsp::ls_types::{Position, PositionEncodingKind, Range};

/// What a column counts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Encoding {
    /// Bytes.
    Utf8,
    /// UTF-16 code units: what every client understands.
    #[default]
    Utf16,
}

impl Encoding {
    /// The cheapest that a client offers.
    pub fn choose(offered: Option<&[PositionEncodingKind]>) -> Self {
        match offered {
            Some(kinds) if kinds.contains(&PositionEncodingKind::UTF8) => Self::Utf8,
            _ => Self::Utf16,
        }
    }

    /// Its name in the protocol.
    pub fn kind(self) -> PositionEncodingKind {
        match self {
            Self::Utf8 => PositionEncodingKind::UTF8,
            Self::Utf16 => PositionEncodingKind::UTF16,
        }
    }

    /// The byte of `text` at a position. One past the end of a line or of the
    /// text gives the end; one inside a character its first byte.
    pub fn offset(self, text: &Rope, position: Position) -> usize {
        let line = position.line as usize;
        if line >= text.len_lines() {
            return text.len_bytes();
        }
        let content = text.line(line);
        let mut length = content.len_chars();
        while length > 0 && matches!(content.char(length - 1), '\n' | '\r') {
            length -= 1;
        }
        let content = content.slice(..length);
        let column = position.character as usize;
        let characters = match self {
            Self::Utf8 => content.byte_to_char(column.min(content.len_bytes())),
            Self::Utf16 => content.utf16_cu_to_char(column.min(content.len_utf16_cu())),
        };
        text.line_to_byte(line) + content.char_to_byte(characters)
    }

    /// The position of a byte of `text`.
    pub fn position(self, text: &Rope, offset: usize) -> Position {
        let offset = offset.min(text.len_bytes());
        let line = text.byte_to_line(offset);
        let start = text.line_to_byte(line);
        let column = match self {
            Self::Utf8 => text.char_to_byte(text.byte_to_char(offset)) - start,
            Self::Utf16 => {
                let at = |byte| text.char_to_utf16_cu(text.byte_to_char(byte));
                at(offset) - at(start)
            }
        };
        // A document of more than 4 GiB is refused before.
        Position::new(line as u32, column as u32)
    }

    /// The range of a span.
    pub fn range(self, text: &Rope, span: Span) -> Range {
        let span = span.range();
        Range::new(
            self.position(text, span.start),
            self.position(text, span.end),
        )
    }

    /// The span of a range.
    pub fn span(self, text: &Rope, range: Range) -> Span {
        let start = self.offset(text, range.start);
        Span::new(start, self.offset(text, range.end))
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[track_caller]
    fn check(text: &str, at: usize, utf8: (u32, u32), utf16: (u32, u32)) {
        let rope = Rope::from_str(text);
        for (encoding, (line, column)) in [(Encoding::Utf8, utf8), (Encoding::Utf16, utf16)] {
            let position = Position::new(line, column);
            assert_eq!(encoding.position(&rope, at), position);
            assert_eq!(encoding.offset(&rope, position), at);
        }
    }

    #[test]
    fn columns_count_bytes_or_code_units() {
        check("a\nbc", 3, (1, 1), (1, 1));
        check("\u{e4}b", 2, (0, 2), (0, 1));
        check("\u{1f6d1}b", 4, (0, 4), (0, 2));
        check("\u{feff}b", 3, (0, 3), (0, 1));
    }

    #[test]
    fn a_line_ends_at_any_of_three_line_ends_and_no_other() {
        check("a\r\nb\rc\nd", 3, (1, 0), (1, 0));
        check("a\r\nb\rc\nd", 5, (2, 0), (2, 0));
        check("a\r\nb\rc\nd", 7, (3, 0), (3, 0));
        check("a\u{2028}\u{b}\u{85}b", 7, (0, 7), (0, 4));
    }

    #[test]
    fn what_is_past_the_end_is_the_end() {
        let rope = Rope::from_str("ab\r\nc");
        let offset = |line, column| Encoding::Utf16.offset(&rope, Position::new(line, column));
        assert_eq!(offset(0, 9), 2);
        assert_eq!(offset(1, 9), 5);
        assert_eq!(offset(9, 0), 5);
    }

    proptest! {
        #[test]
        fn every_character_is_found_again(text in "[a\u{e4}\u{1f6d1}\r\n\u{2028}]{0,40}") {
            let rope = Rope::from_str(&text);
            for (at, _) in text.char_indices() {
                // Nobody's caret stands between the two characters of a line end.
                if text[..at].ends_with('\r') && text[at..].starts_with('\n') {
                    continue;
                }
                for encoding in [Encoding::Utf8, Encoding::Utf16] {
                    let position = encoding.position(&rope, at);
                    prop_assert_eq!(encoding.offset(&rope, position), at);
                }
            }
        }
    }
}
