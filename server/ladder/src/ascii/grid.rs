//! The text as rows and columns, each character with its place in the file.

use std::ops::Range;

use source::Span;

use super::notes::Note;
use crate::reading::Source;

/// Columns between tab stops.
const TAB: usize = 8;

/// Most columns of all rows together that are read. A tab takes one byte of a
/// file and up to eight columns of a drawing, and no drawing is so large.
pub(super) const MOST_COLUMNS: usize = 1 << 24;

/// A character at a column.
#[derive(Clone, Copy, Debug)]
struct Cell {
    character: char,
    /// Its first byte in the file, byte order mark included.
    at: u32,
    /// The byte behind it.
    end: u32,
}

/// A line.
#[derive(Clone, Debug, Default)]
pub(super) struct Row {
    cells: Vec<Cell>,
}

/// A drawing's characters, with notes blanked out.
#[derive(Clone, Debug)]
pub(super) struct Grid {
    rows: Vec<Row>,
    end: usize,
    /// The place in the file from which on nothing is read, if the drawing
    /// is too large.
    pub(super) cut: Option<usize>,
}

impl Grid {
    pub(super) fn new(source: Source<'_>, notes: &[Note]) -> Self {
        let mut rows = vec![Row::default()];
        let mut notes = notes.iter().peekable();
        let mut after_return = false;
        let mut columns = 0;
        let mut cut = None;
        for (at, character) in source.text.char_indices() {
            while notes.next_if(|note| note.end <= at).is_some() {}
            let noted = notes.peek().is_some_and(|note| note.start <= at);
            let line_feed_of_pair = after_return && character == '\n';
            after_return = character == '\r';
            if line_feed_of_pair {
                continue;
            }
            if matches!(character, '\n' | '\r') {
                rows.push(Row::default());
                continue;
            }
            let Some(row) = rows.last_mut() else { break };
            let width = match character {
                '\t' => TAB - row.cells.len() % TAB,
                _ => 1,
            };
            columns += width;
            if columns > MOST_COLUMNS {
                cut = Some(source.base + at);
                break;
            }
            let Span { start: at, end } = source.span(at, at + character.len_utf8());
            let character = match character {
                _ if noted => ' ',
                c if c.is_whitespace() || c == '\u{feff}' => ' ',
                c => c,
            };
            let cell = Cell { character, at, end };
            row.cells.extend(std::iter::repeat_n(cell, width));
        }
        Self {
            rows,
            end: source.base + source.text.len(),
            cut,
        }
    }

    pub(super) fn rows(&self) -> impl Iterator<Item = &Row> {
        self.rows.iter()
    }

    pub(super) fn row(&self, row: usize) -> Option<&Row> {
        self.rows.get(row)
    }

    pub(super) fn height(&self) -> usize {
        self.rows.len()
    }

    /// The character at a place; blank outside of the drawing.
    pub(super) fn at(&self, row: usize, column: usize) -> char {
        self.rows.get(row).map_or(' ', |row| row.at(column))
    }

    /// The bytes of some columns of a row.
    pub(super) fn span(&self, row: usize, columns: Range<usize>) -> Span {
        let Some(row) = self.rows.get(row) else {
            return Span::at(self.end);
        };
        let last = columns.end.checked_sub(1).and_then(|at| row.cells.get(at));
        match (row.cells.get(columns.start), last) {
            (Some(first), Some(last)) => Span {
                start: first.at,
                end: last.end,
            },
            _ => Span::at(self.end),
        }
    }

    /// The bytes of a row from its first mark to its last.
    pub(super) fn row_span(&self, row: usize) -> Option<Span> {
        let cells = &self.rows.get(row)?.cells;
        let is_mark = |cell: &Cell| cell.character != ' ';
        let first = cells.iter().position(is_mark)?;
        let last = cells.iter().rposition(is_mark)?;
        Some(self.span(row, first..last + 1))
    }
}

impl Row {
    pub(super) fn width(&self) -> usize {
        self.cells.len()
    }

    pub(super) fn at(&self, column: usize) -> char {
        self.cells.get(column).map_or(' ', |cell| cell.character)
    }

    /// The characters of some columns.
    pub(super) fn text(&self, columns: Range<usize>) -> String {
        columns.map(|column| self.at(column)).collect()
    }

    /// The row without blanks at its ends, if there is anything on it.
    pub(super) fn text_from_first_mark(&self) -> Option<String> {
        let text = self.text(0..self.width());
        let trimmed = text.trim();
        (!trimmed.is_empty()).then(|| trimmed.to_owned())
    }
}
