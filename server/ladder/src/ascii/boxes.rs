//! Boxes: a frame of `+`, `-` and `|` with a type and pins written inside.

use std::ops::Range;

use super::grid::Grid;

/// A box as drawn.
#[derive(Clone, Debug)]
pub(super) struct DrawnBox {
    /// Rows of its frame, both edges included.
    pub(super) rows: Range<usize>,
    /// Columns of its frame, both walls included.
    pub(super) columns: Range<usize>,
    /// What it is: the first row inside.
    pub(super) name: String,
    /// Pins at the left wall: row and name.
    pub(super) left: Vec<(usize, String)>,
    /// Pins at the right wall.
    pub(super) right: Vec<(usize, String)>,
}

/// All boxes, from the top. A frame without a word in it is a loop of wires.
pub(super) fn find(grid: &Grid) -> Vec<DrawnBox> {
    let mut boxes = Vec::new();
    for (top, row) in grid.rows().enumerate() {
        let mut left = None;
        for column in 0..row.width() {
            match row.at(column) {
                '+' => {
                    if let Some(left) = left.filter(|left| left + 1 < column) {
                        boxes.extend(framed(grid, top, left, column));
                    }
                    left = Some(column);
                }
                '-' => {}
                _ => left = None,
            }
        }
    }
    boxes
}

/// The box whose upper edge runs from `left` to `right`, if it is one.
fn framed(grid: &Grid, top: usize, left: usize, right: usize) -> Option<DrawnBox> {
    let walls = |row: usize| (grid.at(row, left), grid.at(row, right));
    let mut bottom = top + 1;
    while walls(bottom) == ('|', '|') {
        bottom += 1;
    }
    let edge = |row: usize| (left + 1..right).all(|column| grid.at(row, column) == '-');
    if bottom == top + 1 || walls(bottom) != ('+', '+') || !edge(bottom) {
        return None;
    }
    let mut found = DrawnBox {
        rows: top..bottom + 1,
        columns: left..right + 1,
        name: String::new(),
        left: Vec::new(),
        right: Vec::new(),
    };
    for row in top + 1..bottom {
        let inside = grid.row(row)?.text(left + 1..right);
        if found.name.is_empty() {
            found.name = inside.trim().to_owned();
        } else {
            add_pins(&mut found, row, &inside);
        }
    }
    found.name.contains(char::is_alphabetic).then_some(found)
}

/// Two words are a pin at each wall; one is a pin at the nearer wall.
fn add_pins(found: &mut DrawnBox, row: usize, inside: &str) {
    let words: Vec<&str> = inside.split_whitespace().collect();
    let before = inside.len() - inside.trim_start().len();
    let after = inside.len() - inside.trim_end().len();
    match words[..] {
        [] => {}
        [only] if before <= after => found.left.push((row, only.to_owned())),
        [only] => found.right.push((row, only.to_owned())),
        [first, .., last] => {
            found.left.push((row, first.to_owned()));
            found.right.push((row, last.to_owned()));
        }
    }
}
