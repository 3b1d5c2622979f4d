//! Lays out each piece of a text by itself, up to what its neighbours decide.

use logic::notation::{Token, TokenKind};
use source::Span;

use super::broken::broken;
use super::{INDENT, WIDTH};
use crate::text::read::understand;
use crate::text::spacing::{Mode, gaps, joined};
use crate::text::statement::{Item, Keyword, Statement, is_code};

/// A piece of the text, laid out as far as it can be alone.
#[derive(Clone, Debug)]
pub(super) enum Piece {
    /// An empty line.
    Blank,
    /// A comment with a line of its own.
    Comment(String),
    /// A declaration, column by column: keyword, name, address, type, initial
    /// value; then what stands behind.
    Declaration([String; COLUMNS], Option<String>),
    /// A rung on one line: what stands left of the arrow, the arrow and what
    /// it drives, and the comment behind.
    Rung(String, String, Option<String>),
    /// Lines that no neighbour changes.
    Lines(Vec<String>),
    /// A statement left as it is.
    Left {
        /// Its lines, whole, without the last line end.
        text: String,
        /// Where it stands.
        span: Span,
    },
}

/// Number of columns of a declaration.
pub(super) const COLUMNS: usize = 5;

/// Lays out one item of `text`.
pub(super) fn piece(text: &str, item: &Item) -> Piece {
    let statement = match item {
        Item::Blank => return Piece::Blank,
        Item::Comment(comment) => return Piece::Comment(comment_line(text, *comment)),
        Item::Statement(statement) => statement,
    };
    let (_, problems) = understand(text, statement);
    if !problems.is_empty() {
        return Piece::Left {
            text: whole_lines(text, statement).to_owned(),
            span: statement.span(),
        };
    }
    let mut piece = laid_out(text, statement);
    let first_line = match &mut piece {
        Piece::Declaration(columns, _) => columns.first_mut(),
        Piece::Rung(left, ..) => Some(left),
        Piece::Lines(lines) => lines.first_mut(),
        Piece::Blank | Piece::Comment(_) | Piece::Left { .. } => None,
    };
    // Keywords are written small. Capital ones have as many bytes.
    let keyword = statement.tokens.first().map_or(0, |token| token.span.len());
    if let Some(word) = first_line.and_then(|line| line.get_mut(..keyword)) {
        word.make_ascii_lowercase();
    }
    piece
}

fn laid_out(text: &str, statement: &Statement) -> Piece {
    if statement.holds_a_comment() {
        return Piece::Lines(as_broken_by_hand(text, statement));
    }
    let behind = statement.behind.map(|comment| comment_line(text, comment));
    let code: Vec<Token> = statement.tokens.iter().copied().filter(is_code).collect();
    match statement.keyword {
        Some(Keyword::Declaration(_)) => Piece::Declaration(columns(text, &code), behind),
        Some(Keyword::Rung) => rung(text, &code, behind),
        _ => Piece::Lines(vec![with_comment(
            joined(text, &code, &gaps(&code, Mode::Condition)),
            behind.as_deref(),
        )]),
    }
}

/// A line with the comment behind it, if there is one.
pub(super) fn with_comment(mut line: String, comment: Option<&str>) -> String {
    if let Some(comment) = comment {
        line.push_str("  ");
        line.push_str(comment);
    }
    line
}

/// Number of characters.
pub(super) fn width(text: &str) -> usize {
    text.chars().count()
}

fn comment_line(text: &str, comment: Token) -> String {
    comment.text(text).trim_end().to_owned()
}

fn columns(text: &str, code: &[Token]) -> [String; COLUMNS] {
    let mut columns = [const { String::new() }; COLUMNS];
    let mut at = 0;
    for (place, token) in code.iter().enumerate() {
        let word = match token.kind {
            TokenKind::Colon => {
                at = 3;
                ":"
            }
            TokenKind::Equal | TokenKind::Assign => {
                at = 4;
                "="
            }
            _ => {
                at = at.max(place.min(2));
                token.text(text)
            }
        };
        let Some(column) = columns.get_mut(at) else {
            continue;
        };
        let sign_before = place > 0 && code[place - 1].kind == TokenKind::Minus;
        if !column.is_empty() && !sign_before {
            column.push(' ');
        }
        column.push_str(word);
    }
    columns
}

fn rung(text: &str, code: &[Token], behind: Option<String>) -> Piece {
    let gaps = gaps(code, Mode::Condition);
    let arrow = code
        .iter()
        .position(|token| token.kind == TokenKind::Arrow)
        .unwrap_or(code.len());
    let (before, after) = code.split_at(arrow);
    let left = joined(text, before, &gaps);
    let right = joined(text, after, gaps.get(arrow..).unwrap_or_default());
    if width(&left) + 1 + width(&right) <= WIDTH {
        return Piece::Rung(left, right, behind);
    }
    let mut lines = broken(text, code, &gaps, arrow);
    if let Some(last) = lines.pop() {
        lines.push(with_comment(last, behind.as_deref()));
    }
    Piece::Lines(lines)
}

/// Statements with comments inside keep their line breaks: only their author
/// knows what each comment belongs to.
fn as_broken_by_hand(text: &str, statement: &Statement) -> Vec<String> {
    let code: Vec<Token> = statement.tokens.iter().copied().filter(is_code).collect();
    let gaps = gaps(&code, Mode::Condition);
    let mut gaps = gaps.into_iter();
    let mut lines = Vec::new();
    let mut line = String::new();
    let indent = |lines: &[String]| match lines {
        [] => String::new(),
        _ => " ".repeat(INDENT),
    };
    for token in &statement.tokens {
        match token.kind {
            TokenKind::LineEnd => {
                lines.push(std::mem::take(&mut line));
                continue;
            }
            TokenKind::Comment if line.is_empty() => {
                line = indent(&lines) + &comment_line(text, *token);
                continue;
            }
            TokenKind::Comment => {
                line = with_comment(line, Some(&comment_line(text, *token)));
                continue;
            }
            _ => {}
        }
        let gap = gaps.next().unwrap_or(true);
        if line.is_empty() {
            line = indent(&lines);
        } else if gap {
            line.push(' ');
        }
        line.push_str(token.text(text));
    }
    let behind = statement.behind.map(|comment| comment_line(text, comment));
    lines.push(with_comment(line, behind.as_deref()));
    lines
}

/// The lines that a statement stands on, from the first byte of the first to
/// the last byte of the last, without its line end.
fn whole_lines<'t>(text: &'t str, statement: &Statement) -> &'t str {
    let is_end = |byte: &u8| matches!(byte, b'\r' | b'\n');
    let span = statement.span().range();
    let bytes = text.as_bytes();
    let before = bytes.get(..span.start).unwrap_or_default();
    let start = before.iter().rposition(is_end).map_or(0, |at| at + 1);
    let after = bytes.get(span.end..).unwrap_or_default();
    let end = after
        .iter()
        .position(is_end)
        .map_or(bytes.len(), |at| span.end + at);
    text.get(start..end).unwrap_or_default()
}
