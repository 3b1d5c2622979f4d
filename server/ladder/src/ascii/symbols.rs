//! What stands in the rows: elements, wires and words.

use std::cmp::Reverse;
use std::ops::Range;

use source::{Diagnostic, Span, codes};

use super::boxes::DrawnBox;
use super::grid::{Grid, Row};

/// What a character of the drawing is part of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Mark {
    Blank,
    /// `-`
    Dash,
    /// `|`
    Bar,
    /// `+`
    Plus,
    /// An element, a box or a word.
    Solid,
}

/// Something that power flows through or into.
#[derive(Clone, Debug)]
pub(super) struct Symbol {
    pub(super) row: usize,
    pub(super) columns: Range<usize>,
    pub(super) kind: SymbolKind,
}

#[derive(Clone, Debug)]
pub(super) enum SymbolKind {
    /// `[ ]` and what stands between its brackets.
    Contact(String),
    /// `( )` and what stands between its parentheses.
    Coil(String),
    /// `>>` and the label.
    Jump(String),
    /// `<RETURN>` and the word.
    Return(String),
    Box(DrawnBox),
}

/// A word beside the elements: a name, a number, a label.
#[derive(Clone, Debug)]
pub(super) struct Word {
    pub(super) columns: Range<usize>,
    pub(super) text: String,
    pub(super) span: Span,
    /// Whether an element has taken it as its operand.
    pub(super) taken: bool,
}

/// The rows taken apart.
#[derive(Clone, Debug, Default)]
pub(super) struct Drawing {
    pub(super) marks: Vec<Vec<Mark>>,
    pub(super) symbols: Vec<Symbol>,
    /// The words of each row, from the left.
    pub(super) words: Vec<Vec<Word>>,
    /// Rows that hold a label and nothing else: the row, the label, its place.
    pub(super) labels: Vec<(usize, String, Span)>,
}

impl Drawing {
    pub(super) fn mark(&self, row: usize, column: usize) -> Mark {
        let row = self.marks.get(row);
        row.and_then(|row| row.get(column))
            .copied()
            .unwrap_or(Mark::Blank)
    }

    /// Takes the word of a row that shares most columns with `columns`.
    pub(super) fn take_word(
        &mut self,
        row: usize,
        columns: Range<usize>,
    ) -> Option<(String, Span)> {
        let words = self.words.get_mut(row)?;
        let first = words.partition_point(|word| word.columns.end <= columns.start);
        let shared = |word: &Word| {
            let end = word.columns.end.min(columns.end);
            end.saturating_sub(word.columns.start.max(columns.start))
        };
        let best = words[first..]
            .iter_mut()
            .take_while(|word| word.columns.start < columns.end)
            .filter(|word| !word.taken)
            .min_by_key(|word| Reverse(shared(word)))?;
        best.taken = true;
        Some((best.text.clone(), best.span))
    }
}

/// The label that a line consists of: `MAIN:`.
pub(super) fn label(line: &str) -> Option<&str> {
    let name = line.trim().strip_suffix(':')?;
    let is_word = !name.is_empty() && name.chars().all(|c| c.is_alphanumeric() || c == '_');
    is_word.then_some(name)
}

/// Takes the rows apart.
pub(super) fn drawing(
    grid: &Grid,
    boxes: Vec<DrawnBox>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Drawing {
    let mut drawing = Drawing {
        marks: grid
            .rows()
            .map(|row| vec![Mark::Blank; row.width()])
            .collect(),
        words: vec![Vec::new(); grid.height()],
        ..Drawing::default()
    };
    for found in boxes {
        for row in found.rows.clone() {
            for column in found.columns.clone() {
                if let Some(mark) = drawing.marks[row].get_mut(column) {
                    *mark = Mark::Solid;
                }
            }
        }
        let first_pins = [found.left.first(), found.right.first()];
        let row = first_pins.iter().flatten().map(|(row, _)| *row).min();
        drawing.symbols.push(Symbol {
            row: row.unwrap_or(found.rows.start),
            columns: found.columns.clone(),
            kind: SymbolKind::Box(found),
        });
    }
    for (at, row) in grid.rows().enumerate() {
        let line = row.text_from_first_mark().unwrap_or_default();
        match (label(&line), grid.row_span(at)) {
            (Some(name), Some(span)) => {
                let span = Span::new(span.start as usize, span.end as usize - 1);
                drawing.labels.push((at, name.to_owned(), span));
            }
            _ => take_apart(grid, at, row, &mut drawing, diagnostics),
        }
    }
    drawing
        .symbols
        .sort_by_key(|symbol| (symbol.row, symbol.columns.start));
    drawing
}

fn take_apart(
    grid: &Grid,
    at: usize,
    row: &Row,
    drawing: &mut Drawing,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let mut column = 0;
    while column < row.width() {
        if drawing.marks[at][column] == Mark::Solid {
            column += 1;
            continue;
        }
        let start = column;
        let (end, found) = piece(row, start);
        let end = end.clamp(start + 1, row.width());
        column = end;
        let columns = start..end;
        let mark = match found {
            Piece::Mark(mark) => mark,
            Piece::Symbol(kind) => {
                drawing.symbols.push(Symbol {
                    row: at,
                    columns: columns.clone(),
                    kind,
                });
                Mark::Solid
            }
            Piece::Word => {
                drawing.words[at].push(Word {
                    columns: columns.clone(),
                    text: row.text(columns.clone()),
                    span: grid.span(at, columns.clone()),
                    taken: false,
                });
                Mark::Solid
            }
            Piece::Unclosed(close) => {
                diagnostics.push(
                    Diagnostic::new(
                        codes::LADDER_SYNTAX,
                        grid.span(at, columns.clone()),
                        format!("the element that begins here does not end with `{close}`"),
                    )
                    .help("draw contacts as `[ ]` and coils as `( )`, on one line"),
                );
                Mark::Solid
            }
        };
        for place in columns {
            drawing.marks[at][place] = mark;
        }
    }
}

enum Piece {
    Mark(Mark),
    Symbol(SymbolKind),
    Word,
    Unclosed(char),
}

/// Most characters between the brackets of an element: `[<>]`, `[ / ]`,
/// `<RETURN>`.
const WIDEST: usize = 8;

/// What begins at a column, and the column where it ends.
fn piece(row: &Row, start: usize) -> (usize, Piece) {
    let before = start.checked_sub(1).map_or(' ', |column| row.at(column));
    let next = row.at(start + 1);
    let after_wire = matches!(before, '-' | '+' | '|');
    match row.at(start) {
        ' ' => (start + 1, Piece::Mark(Mark::Blank)),
        '[' => enclosed(row, start, ']', SymbolKind::Contact),
        '(' => enclosed(row, start, ')', SymbolKind::Coil),
        '|' if before == '-' && is_relay_contact(row, start) => {
            let sign = next.to_string().trim().to_owned();
            (start + 3, Piece::Symbol(SymbolKind::Contact(sign)))
        }
        '>' if next == '>' && after_wire => {
            let first = (start + 2..row.width()).find(|&at| row.at(at) != ' ');
            let end = first.map_or(start + 2, |first| word_end(row, first));
            let label = row.text(start + 2..end).trim().to_owned();
            (end, Piece::Symbol(SymbolKind::Jump(label)))
        }
        '<' if after_wire => match closing(row, start + 1, '>', WIDEST) {
            Some(close) => {
                let word = row.text(start + 1..close).trim().to_owned();
                (close + 1, Piece::Symbol(SymbolKind::Return(word)))
            }
            None => (start + 1, Piece::Unclosed('>')),
        },
        '|' => (start + 1, Piece::Mark(Mark::Bar)),
        '-' | '+' if before == ' ' && next.is_ascii_digit() => (word_end(row, start), Piece::Word),
        '-' => (start + 1, Piece::Mark(Mark::Dash)),
        '+' => (start + 1, Piece::Mark(Mark::Plus)),
        _ => (word_end(row, start), Piece::Word),
    }
}

/// `-| |-`, as relay diagrams are often typed.
fn is_relay_contact(row: &Row, start: usize) -> bool {
    matches!(row.at(start + 1), ' ' | '/' | 'P' | 'N')
        && row.at(start + 2) == '|'
        && matches!(row.at(start + 3), '-' | '+')
}

fn enclosed(
    row: &Row,
    start: usize,
    close: char,
    kind: impl Fn(String) -> SymbolKind,
) -> (usize, Piece) {
    match closing(row, start + 1, close, WIDEST) {
        Some(end) => {
            let sign = row.text(start + 1..end).trim().to_owned();
            (end + 1, Piece::Symbol(kind(sign)))
        }
        None => (start + 1, Piece::Unclosed(close)),
    }
}

/// The column of the closing sign, at most `widest` columns on.
fn closing(row: &Row, from: usize, close: char, widest: usize) -> Option<usize> {
    let end = from
        .saturating_add(widest)
        .saturating_add(1)
        .min(row.width());
    (from..end)
        .take_while(|&column| !matches!(row.at(column), '[' | '(' | '|'))
        .find(|&column| row.at(column) == close)
}

/// Where the word that begins at `start` ends. An index in brackets belongs
/// to it, and so does a sign before a letter or digit.
fn word_end(row: &Row, start: usize) -> usize {
    let mut column = start + 1;
    while column < row.width() {
        match row.at(column) {
            ' ' | '|' | '(' => break,
            '-' | '+' if !row.at(column + 1).is_alphanumeric() => break,
            '[' => match closing(row, column + 1, ']', usize::MAX) {
                Some(close) => column = close,
                None => break,
            },
            _ => {}
        }
        column += 1;
    }
    column
}
