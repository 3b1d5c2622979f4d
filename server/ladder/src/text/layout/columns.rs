//! Aligns what stands in neighbouring lines: the columns of declarations and
//! the arrows of rungs. A blank line ends a block; comments do not.

use super::WIDTH;
use super::piece::{COLUMNS, Piece, width, with_comment};

/// Arrows are aligned where no condition is longer than another by more than
/// this: an arrow far from its condition is harder to read than one out of
/// line.
const MOST_BLANKS: usize = 24;

/// All lines of a text.
pub(super) fn lines(pieces: Vec<Piece>) -> Vec<String> {
    let mut lines = Vec::new();
    let mut rest = pieces.as_slice();
    while let Some(first) = rest.first() {
        let is_same: fn(&Piece) -> bool = match first {
            Piece::Declaration(..) => {
                |piece| matches!(piece, Piece::Declaration(..) | Piece::Comment(_))
            }
            Piece::Rung(..) => |piece| matches!(piece, Piece::Rung(..) | Piece::Comment(_)),
            _ => |_| false,
        };
        let many = rest
            .iter()
            .take_while(|piece| is_same(piece))
            .count()
            .max(1);
        let (block, others) = rest.split_at(many);
        rest = others;
        match first {
            Piece::Declaration(..) => declarations(block, &mut lines),
            Piece::Rung(..) => rungs(block, &mut lines),
            Piece::Blank => lines.push(String::new()),
            Piece::Comment(comment) => lines.push(comment.clone()),
            Piece::Lines(all) => lines.extend(all.iter().cloned()),
            Piece::Left { text, .. } => lines.push(text.clone()),
        }
    }
    lines
}

fn declarations(block: &[Piece], lines: &mut Vec<String>) {
    let mut widths = [0; COLUMNS];
    for piece in block {
        if let Piece::Declaration(columns, _) = piece {
            for (widest, column) in widths.iter_mut().zip(columns) {
                *widest = width(column).max(*widest);
            }
        }
    }
    for piece in block {
        match piece {
            Piece::Declaration(columns, behind) => {
                let mut line = String::new();
                for (column, widest) in columns.iter().zip(widths).filter(|(_, widest)| *widest > 0)
                {
                    if !line.is_empty() {
                        line.push(' ');
                    }
                    line.push_str(column);
                    line.extend(std::iter::repeat_n(' ', widest - width(column)));
                }
                if behind.is_none() {
                    line.truncate(line.trim_end().len());
                }
                lines.push(with_comment(line, behind.as_deref()));
            }
            Piece::Comment(comment) => lines.push(comment.clone()),
            _ => {}
        }
    }
}

fn rungs(block: &[Piece], lines: &mut Vec<String>) {
    let mut rest = block;
    while !rest.is_empty() {
        let (many, widest) = alike(rest);
        let (run, others) = rest.split_at(many);
        rest = others;
        for piece in run {
            match piece {
                Piece::Rung(left, right, behind) => {
                    let line = rung(left, right, widest);
                    lines.push(with_comment(line, behind.as_deref()));
                }
                Piece::Comment(comment) => lines.push(comment.clone()),
                _ => {}
            }
        }
    }
}

/// How many of the first pieces have conditions of like length, at least one,
/// and the length of the longest.
fn alike(pieces: &[Piece]) -> (usize, usize) {
    let (mut narrowest, mut widest) = (usize::MAX, 0);
    for (at, piece) in pieces.iter().enumerate() {
        let Piece::Rung(left, right, _) = piece else {
            continue;
        };
        if right.is_empty() {
            continue;
        }
        let width = width(left);
        let spread = widest.max(width) - narrowest.min(width);
        if spread > MOST_BLANKS && widest > 0 {
            return (at, widest);
        }
        narrowest = narrowest.min(width);
        widest = widest.max(width);
    }
    (pieces.len(), widest)
}

fn rung(left: &str, right: &str, widest: usize) -> String {
    let mut line = left.to_owned();
    if right.is_empty() {
        return line;
    }
    if widest + 1 + width(right) <= WIDTH {
        let missing = widest.saturating_sub(width(left));
        line.extend(std::iter::repeat_n(' ', missing));
    }
    line.push(' ');
    line.push_str(right);
    line
}
