//! Cutting a text into statements.
//!
//! A statement is a line. It goes on in the next line where it cannot be
//! complete: after a comma, `*` or `+`, and after a word that begins a list
//! and stands alone. It never runs into a blank line or into a line that
//! begins a statement of its own, so that what a person is just typing spoils
//! no line but its own.

use logic::notation::{Lexer, TokenKind};

use super::syntax::Line;
use super::words::{DECISION, is_leading};

const BYTE_ORDER_MARK: &str = "\u{feff}";

/// The lines of `text`, grouped into statements.
pub(crate) fn statements(text: &str) -> Vec<Vec<Line>> {
    let mut lines = lines(text).into_iter().peekable();
    let mut statements = Vec::new();
    while let Some(first) = lines.next() {
        let mut statement = vec![first];
        // Comment lines stand inside the statement if it goes on after them.
        let mut comments = Vec::new();
        while goes_on(text, &statement) {
            while let Some(comment) = lines.next_if(|line| is_comment_line(text, line)) {
                comments.push(comment);
            }
            let more = |line: &Line| !line.tokens.is_empty() && !begins_statement(text, line);
            let Some(next) = lines.next_if(more) else {
                break;
            };
            statement.append(&mut comments);
            statement.push(next);
        }
        statements.push(statement);
        statements.extend(comments.into_iter().map(|line| vec![line]));
    }
    statements
}

/// A comment that is no decision, on a line by itself.
fn is_comment_line(text: &str, line: &Line) -> bool {
    line.tokens.is_empty()
        && line
            .comment
            .is_some_and(|comment| !comment.text(text).starts_with(DECISION))
}

fn goes_on(text: &str, statement: &[Line]) -> bool {
    let [.., line] = statement else {
        return false;
    };
    let Some(last) = line.tokens.last() else {
        return false;
    };
    match last.kind {
        TokenKind::Comma | TokenKind::Star | TokenKind::Plus => true,
        TokenKind::Name => {
            let alone = statement.len() == 1 && line.tokens.len() == 1;
            alone && is_leading(last.text(text))
        }
        _ => false,
    }
}

fn begins_statement(text: &str, line: &Line) -> bool {
    let kind = |at: usize| line.tokens.get(at).map(|token| token.kind);
    let Some(first) = line.tokens.first() else {
        return false;
    };
    let is_word = |kind| {
        matches!(
            kind,
            Some(TokenKind::Name | TokenKind::Quoted | TokenKind::Number)
        )
    };
    if is_word(Some(first.kind)) && kind(1) == Some(TokenKind::Colon) {
        return true;
    }
    let leading = first.kind == TokenKind::Name && is_leading(first.text(text));
    leading && (line.tokens.len() == 1 || is_word(kind(1)) || kind(1) == Some(TokenKind::Comma))
}

fn lines(text: &str) -> Vec<Line> {
    let mut lexer = Lexer::new(text);
    let mut lines = Vec::new();
    let mut line = Line {
        start: if text.starts_with(BYTE_ORDER_MARK) {
            BYTE_ORDER_MARK.len()
        } else {
            0
        },
        end: text.len(),
        next: text.len(),
        tokens: Vec::new(),
        comment: None,
    };
    while let Some(token) = lexer.take() {
        match token.kind {
            TokenKind::LineEnd => {
                let range = token.span.range();
                line.end = range.start;
                line.next = range.end;
                lines.push(line);
                line = Line {
                    start: range.end,
                    end: text.len(),
                    next: text.len(),
                    tokens: Vec::new(),
                    comment: None,
                };
            }
            TokenKind::Comment => line.comment = Some(token),
            _ => line.tokens.push(token),
        }
    }
    // What follows the last line end is a line only if it holds something.
    if line.start < text.len() {
        lines.push(line);
    }
    lines
}
