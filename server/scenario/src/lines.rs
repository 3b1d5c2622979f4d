//! Cutting a text into lines.

use logic::notation::{Lexer, Token, TokenKind};
use source::Span;

const BYTE_ORDER_MARK: char = '\u{feff}';

/// A line of the text. Every statement is one.
#[derive(Clone, Debug)]
pub(crate) struct Line {
    /// The line without its end.
    pub(crate) span: Span,
    /// Its tokens, the comment left out.
    pub(crate) tokens: Vec<Token>,
    pub(crate) comment: Option<Token>,
}

impl Line {
    /// From the first token to the last.
    pub(crate) fn statement_span(&self) -> Span {
        match (self.tokens.first(), self.tokens.last()) {
            (Some(first), Some(last)) => first.span.cover(last.span),
            _ => self.span,
        }
    }

    /// What the comment says.
    pub(crate) fn said<'t>(&self, text: &'t str) -> Option<&'t str> {
        let comment = self.comment?.text(text);
        let said = comment.trim_start_matches('/').trim();
        (!said.is_empty()).then_some(said)
    }
}

pub(crate) fn lines(text: &str) -> Vec<Line> {
    let mut lines = Vec::new();
    let mut start = match text.starts_with(BYTE_ORDER_MARK) {
        true => BYTE_ORDER_MARK.len_utf8(),
        false => 0,
    };
    let (mut tokens, mut comment) = (Vec::new(), None);
    let mut lexer = Lexer::new(text);
    while let Some(token) = lexer.take() {
        match token.kind {
            TokenKind::Comment => comment = Some(token),
            TokenKind::LineEnd => {
                let range = token.span.range();
                lines.push(Line {
                    span: Span::new(start, range.start),
                    tokens: std::mem::take(&mut tokens),
                    comment: comment.take(),
                });
                start = range.end;
            }
            _ => tokens.push(token),
        }
    }
    if start < text.len() {
        lines.push(Line {
            span: Span::new(start, text.len()),
            tokens,
            comment,
        });
    }
    lines
}
