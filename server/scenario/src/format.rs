use logic::notation::{Token, TokenKind};

use crate::lines::{Line, lines};
use crate::parse::{Statement, statement};

/// A text in canonical layout.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Formatted {
    /// The text.
    pub text: String,
    /// Lines that break the grammar, left as they are.
    pub left: usize,
}

/// The arrow of a longer line does not move those of its neighbours.
const WIDEST: usize = 40;

/// A line of the result.
#[derive(Default)]
struct Laid {
    /// What is done; for a line without an arrow all of it.
    left: String,
    /// What is expected, with the arrow.
    right: Option<String>,
    comment: Option<String>,
    is_step: bool,
}

impl Laid {
    fn is_blank(&self) -> bool {
        self.left.is_empty() && self.right.is_none() && self.comment.is_none()
    }
}

/// Lays a scenario out: one blank between words, arrows of neighbouring steps
/// in a column, one blank line at most. Nothing else changes, no comment is
/// lost, and laying out twice is laying out once. A line that breaks the
/// grammar stays byte for byte.
pub fn format(text: &str) -> Formatted {
    let mut left = 0;
    let mut laid: Vec<Laid> = Vec::new();
    for line in lines(text) {
        let next = match line.tokens.is_empty() {
            true => Laid {
                comment: line.comment.map(|it| it.text(text).trim_end().to_owned()),
                ..Laid::default()
            },
            false => lay(text, &line).unwrap_or_else(|| {
                left += 1;
                Laid {
                    left: text.get(line.span.range()).unwrap_or_default().to_owned(),
                    ..Laid::default()
                }
            }),
        };
        if !(next.is_blank() && laid.last().is_none_or(Laid::is_blank)) {
            laid.push(next);
        }
    }
    while laid.last().is_some_and(Laid::is_blank) {
        laid.pop();
    }
    let mut out = String::new();
    if text.starts_with('\u{feff}') {
        out.push('\u{feff}');
    }
    let line_end = line_end(text);
    for (line, column) in laid.iter().zip(columns(&laid)) {
        out += &line.left;
        if let Some(right) = &line.right {
            let width = line.left.chars().count();
            out += &" ".repeat(column.saturating_sub(width));
            out += " ";
            out += right;
        }
        if let Some(comment) = &line.comment {
            if !line.left.is_empty() {
                out += "  ";
            }
            out += comment;
        }
        out += line_end;
    }
    Formatted { text: out, left }
}

/// The line end that prevails.
fn line_end(text: &str) -> &'static str {
    let all = text.matches('\n').count();
    let with_return = text.matches("\r\n").count();
    if 2 * with_return > all { "\r\n" } else { "\n" }
}

/// Where the arrow of each line stands: in one column for steps without
/// another line between them.
fn columns(laid: &[Laid]) -> Vec<usize> {
    let mut columns = Vec::with_capacity(laid.len());
    for steps in laid.chunk_by(|one, next| one.is_step && next.is_step) {
        let with_arrow = steps.iter().filter(|line| line.right.is_some());
        let widths = with_arrow.map(|line| line.left.chars().count());
        let column = widths.filter(|width| *width <= WIDEST).max().unwrap_or(0);
        columns.resize(columns.len() + steps.len(), column);
    }
    columns
}

fn lay(text: &str, line: &Line) -> Option<Laid> {
    let statement = statement(text, line).ok()?;
    let is_arrow = |token: &Token| token.kind == TokenKind::DoubleArrow;
    let arrow = line.tokens.iter().position(is_arrow);
    let (left, right) = line.tokens.split_at(arrow.unwrap_or(line.tokens.len()));
    // An arrow that nothing follows says nothing.
    let right = (right.len() > 1).then(|| spaced(text, right));
    Some(Laid {
        left: spaced(text, left),
        right,
        comment: line.comment.map(|it| it.text(text).trim_end().to_owned()),
        is_step: matches!(statement, Statement::Step(_)),
    })
}

/// Tokens with a blank between them, but not before a comma, nor behind a
/// sign.
fn spaced(text: &str, tokens: &[Token]) -> String {
    let mut out = String::new();
    for (at, token) in tokens.iter().enumerate() {
        let after_sign = at > 0 && tokens[at - 1].kind == TokenKind::Minus;
        if at > 0 && token.kind != TokenKind::Comma && !after_sign {
            out.push(' ');
        }
        out += token.text(text);
    }
    out
}
