//! The line of the source that a finding is about, with marks under the place.
//!
//! Ladder files are not written for terminals: tabs, Chinese comments, bytes
//! that are no text, and in XML exports a whole program on one line. So marks
//! are placed by the width that characters have on screen, and of a long line
//! only a window around the place is shown. The cost does not depend on the
//! length of the line.

use std::ops::Range;

use source::Span;
use unicode_width::UnicodeWidthChar;

use super::printable::stand_in;

/// Most columns of source that are shown.
const WIDTH: usize = 100;

/// Columns that are kept before the place when a long line is cut.
const BEFORE: usize = 30;

/// Bytes looked at on either side of the place: enough for [`WIDTH`] columns
/// of the longest characters.
const REACH: usize = 4 * WIDTH;

/// A tab moves to the next multiple of this.
const TAB: usize = 4;

/// Stands where a line is cut.
const CUT: &str = "...";

/// A line, or a window of one, and the marks under it.
#[derive(Debug, PartialEq, Eq)]
pub struct Excerpt {
    /// What is shown of the line.
    pub line: String,
    /// Columns before the first mark.
    pub indent: usize,
    /// Number of marks, at least one.
    pub marks: usize,
}

/// A character: its bytes in the file and its columns on screen.
struct Cell {
    start: usize,
    end: usize,
    column: usize,
    width: usize,
    shown: char,
}

/// The line of `text` on which `span` begins, marked from there to the end of
/// the span or of the line.
pub fn excerpt(text: &[u8], span: Span) -> Excerpt {
    let start = (span.start as usize).min(text.len());
    let end = (span.end as usize).clamp(start, text.len());
    let from = line_start(text, start);
    let to = line_end(text, start);
    let cells = cells(text, from.at, to.at);

    let length = cells.last().map_or(0, Cell::right);
    let first = cells.iter().find(|cell| cell.end > start);
    let first = first.map_or(length, |cell| cell.column);
    let last = cells.iter().rfind(|cell| cell.start < end);
    let last = last.map_or(first, Cell::right).max(first + 1);

    let fits = from.is_line_edge && last <= WIDTH;
    let left = if fits {
        0
    } else {
        first.saturating_sub(BEFORE)
    };
    let right = left + WIDTH;
    let window = || {
        let inside = |cell: &&Cell| cell.column >= left && cell.right() <= right;
        cells.iter().filter(inside)
    };
    let shown_from = window().next().map_or(left, |cell| cell.column);
    let before = if left == 0 && from.is_line_edge {
        ""
    } else {
        CUT
    };
    let after = if length <= right && to.is_line_edge {
        ""
    } else {
        CUT
    };
    let shown: String = window().map(draw).collect();
    Excerpt {
        line: format!("{before}{shown}{after}"),
        indent: before.len() + first - shown_from,
        marks: last.min(right).saturating_sub(first).max(1),
    }
}

impl Cell {
    /// The column just after it.
    fn right(&self) -> usize {
        self.column + self.width
    }
}

fn draw(cell: &Cell) -> String {
    match cell.shown {
        '\t' => " ".repeat(cell.width),
        shown => shown.to_string(),
    }
}

/// Where looking at a line began or ended.
struct Bound {
    at: usize,
    /// Whether it is the line's own, rather than as far as one looks.
    is_line_edge: bool,
}

fn line_start(text: &[u8], offset: usize) -> Bound {
    let limit = offset.saturating_sub(REACH);
    let before = text.get(limit..offset).unwrap_or_default();
    match before.iter().rposition(is_line_end) {
        Some(last) => Bound {
            at: limit + last + 1,
            is_line_edge: true,
        },
        None => Bound {
            at: next_character(text, limit),
            is_line_edge: limit == 0,
        },
    }
}

fn line_end(text: &[u8], offset: usize) -> Bound {
    let limit = offset.saturating_add(REACH).min(text.len());
    let after = text.get(offset..limit).unwrap_or_default();
    match after.iter().position(is_line_end) {
        Some(first) => Bound {
            at: offset + first,
            is_line_edge: true,
        },
        None => Bound {
            at: next_character(text, limit),
            is_line_edge: limit == text.len(),
        },
    }
}

fn is_line_end(byte: &u8) -> bool {
    matches!(byte, b'\n' | b'\r')
}

/// The first offset from `offset` on at which a character can begin.
fn next_character(text: &[u8], offset: usize) -> usize {
    let rest = text.get(offset..).unwrap_or_default();
    let continued = rest.iter().take(3).take_while(|&&byte| byte & 0xC0 == 0x80);
    offset + continued.count()
}

/// The characters of `text` from `from` to `to`, all on one line. A byte order
/// mark is none.
fn cells(text: &[u8], from: usize, to: usize) -> Vec<Cell> {
    let mut cells = Vec::new();
    let mut start = from;
    let mut column = 0;
    for chunk in text.get(from..to).unwrap_or_default().utf8_chunks() {
        let valid = chunk.valid().chars();
        let valid = valid.map(|character| (character, character.len_utf8()));
        let length = chunk.invalid().len();
        let invalid = (length > 0).then_some(('\u{fffd}', length));
        for (character, length) in valid.chain(invalid) {
            let cell = cell(character, start..start + length, column);
            start = cell.end;
            column = cell.right();
            if character != '\u{feff}' {
                cells.push(cell);
            }
        }
    }
    cells
}

fn cell(character: char, bytes: Range<usize>, column: usize) -> Cell {
    let (shown, width) = match character {
        '\t' => ('\t', TAB - column % TAB),
        other => (stand_in(other), stand_in(other).width().unwrap_or(0)),
    };
    Cell {
        start: bytes.start,
        end: bytes.end,
        column,
        width,
        shown,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Draws the excerpt of the place between `«` and `»`.
    fn draw(marked: &str) -> String {
        let start = marked.find('«').expect("the start of the place");
        let text = marked.replacen('«', "", 1);
        let end = text.find('»').expect("the end of the place");
        let text = text.replacen('»', "", 1);
        let excerpt = excerpt(text.as_bytes(), Span::new(start, end));
        format!(
            "{}\n{}{}",
            excerpt.line,
            " ".repeat(excerpt.indent),
            "^".repeat(excerpt.marks)
        )
    }

    #[test]
    fn the_place_is_marked_on_its_line() {
        assert_eq!(
            draw("a\nrung: «s + v1» -> v1\r\nb"),
            "rung: s + v1 -> v1\n      ^^^^^^"
        );
    }

    #[test]
    fn a_place_without_length_gets_one_mark() {
        assert_eq!(draw("rung: s«» -> v1"), "rung: s -> v1\n       ^");
        assert_eq!(draw("a\n«»"), "\n^");
        assert_eq!(draw("a«»\nb"), "a\n ^");
    }

    #[test]
    fn a_place_of_several_lines_is_marked_to_the_end_of_the_first() {
        assert_eq!(draw("rung:«\n  s»"), "rung:\n     ^");
        assert_eq!(draw("«rung:\n  s»"), "rung:\n^^^^^");
    }

    #[test]
    fn tabs_and_wide_characters_take_the_columns_that_they_take_on_screen() {
        assert_eq!(draw("\tab\t«c»"), "    ab  c\n        ^");
        assert_eq!(draw("液位 «高» x"), "液位 高 x\n     ^^");
        assert_eq!(draw("e\u{301} «x»"), "e\u{301} x\n  ^");
    }

    #[test]
    fn what_a_terminal_would_obey_is_shown_instead() {
        assert_eq!(draw("\x1b[2J «x»"), "␛[2J x\n     ^");
    }

    #[test]
    fn bytes_that_are_no_text_take_one_column() {
        let found = excerpt(b"ab\xff\xffc", Span::new(3, 4));
        assert_eq!(found.line, "ab\u{fffd}\u{fffd}c");
        assert_eq!((found.indent, found.marks), (3, 1));
    }

    #[test]
    fn a_byte_order_mark_takes_no_column() {
        assert_eq!(draw("\u{feff}ab«c»"), "abc\n  ^");
    }

    #[test]
    fn of_a_long_line_a_window_around_the_place_is_shown() {
        let before = "0123456789".repeat(1_000);
        let drawn = draw(&format!("{before}«XIC(Start)»{before}"));
        let (line, marks) = drawn.split_once('\n').expect("two lines");
        assert_eq!(line.len(), CUT.len() + WIDTH + CUT.len());
        assert_eq!(
            &line[marks.find('^').expect("a mark")..][..10],
            "XIC(Start)"
        );
        assert_eq!(marks.trim_start(), "^^^^^^^^^^");
    }

    #[test]
    fn a_place_longer_than_the_window_is_marked_as_far_as_it_is_shown() {
        let drawn = draw(&format!("rung: «{}» -> v1", "x".repeat(500)));
        let (line, marks) = drawn.split_once('\n').expect("two lines");
        assert_eq!(line.len(), marks.len() + CUT.len());
        assert!(marks.ends_with("^^^"));
    }

    #[test]
    fn a_place_past_the_end_is_the_end() {
        assert_eq!(excerpt(b"ab", Span::new(90, 99)).indent, 2);
    }

    proptest::proptest! {
        #[test]
        fn whatever_the_bytes_a_line_that_fits_the_screen_comes_out(
            text in proptest::collection::vec(proptest::num::u8::ANY, 0..2_000),
            start in 0usize..2_100,
            length in 0usize..2_100,
        ) {
            let found = excerpt(&text, Span::new(start, start + length));
            let width = found.line.chars().filter_map(UnicodeWidthChar::width).sum::<usize>();
            proptest::prop_assert!(width <= WIDTH + 2 * CUT.len());
            proptest::prop_assert!(!found.line.chars().any(char::is_control));
            proptest::prop_assert!(found.marks >= 1);
            proptest::prop_assert!(found.indent + found.marks <= WIDTH + CUT.len() + 1);
        }
    }
}
