//! Breaks a rung that is too long for one line.
//!
//! ```text
//! rung "Title":
//!     a * b * (
//!         c
//!         + d
//!     )
//!     -> v1, v2
//! ```
//!
//! Lines break before operators, the outermost first, so that a line that
//! begins with `+` is an alternative and one that begins with `*` a further
//! condition.

use std::ops::Range;

use logic::notation::{Token, TokenKind};

use super::piece::width;
use super::{INDENT, WIDTH};
use crate::text::spacing::joined;
use crate::text::statement::Keyword;

/// The lines of a rung whose arrow is its token number `arrow`.
pub(super) fn broken(text: &str, code: &[Token], gaps: &[bool], arrow: usize) -> Vec<String> {
    let breaker = Breaker { text, code, gaps };
    let colon = code
        .iter()
        .position(|token| token.kind == TokenKind::Colon)
        .map_or(code.len(), |at| at + 1);
    let mut lines = vec![joined(text, code.get(..colon).unwrap_or(code), gaps)];
    breaker.condition(colon..arrow, INDENT, &mut lines);
    breaker.outputs(arrow..code.len(), &mut lines);
    lines
}

struct Breaker<'t> {
    text: &'t str,
    code: &'t [Token],
    gaps: &'t [bool],
}

impl Breaker<'_> {
    fn kind(&self, at: usize) -> Option<TokenKind> {
        self.code.get(at).map(|token| token.kind)
    }

    /// The tokens of a range on one line.
    fn line(&self, range: Range<usize>, indent: usize) -> String {
        let tokens = self.code.get(range.clone()).unwrap_or_default();
        let gaps = self.gaps.get(range).unwrap_or_default();
        let mut line = " ".repeat(indent);
        let Some((first, others)) = tokens.split_first() else {
            return line;
        };
        let word = first.text(self.text);
        let (begin, gap) = match first.kind {
            // A keyword at the beginning of a line would begin a statement.
            TokenKind::Name if Keyword::of(word).is_some() => (format!("\"{word}\""), false),
            TokenKind::Star | TokenKind::Plus => (word.to_owned(), true),
            _ => (word.to_owned(), false),
        };
        line.push_str(&begin);
        let gaps = gaps.get(1..).unwrap_or_default();
        if gap || gaps.first() == Some(&true) {
            line.push(' ');
        }
        line.push_str(&joined(self.text, others, gaps));
        line
    }

    fn condition(&self, range: Range<usize>, indent: usize, lines: &mut Vec<String>) {
        let whole = self.line(range.clone(), indent);
        if width(&whole) <= WIDTH {
            lines.push(whole);
            return;
        }
        let operators = self.outermost(range.clone());
        if operators.is_empty() {
            return self.enclosed(range, whole, indent, lines);
        }
        // Factors of an alternative stand further in than the alternative.
        let is_part = matches!(
            self.kind(range.start),
            Some(TokenKind::Plus | TokenKind::Star)
        );
        let others = if is_part { indent + INDENT } else { indent };
        let mut start = range.start;
        for end in operators.into_iter().chain([range.end]) {
            let indent = if start == range.start { indent } else { others };
            self.condition(start..end, indent, lines);
            start = end;
        }
    }

    /// The places of the operators that bind loosest, outside parentheses.
    fn outermost(&self, range: Range<usize>) -> Vec<usize> {
        let (mut sums, mut products) = (Vec::new(), Vec::new());
        let mut depth = 0_usize;
        for at in range.clone() {
            match self.kind(at) {
                Some(TokenKind::Open) => depth += 1,
                Some(TokenKind::Close) => depth = depth.saturating_sub(1),
                Some(TokenKind::Plus) if depth == 0 && at > range.start => sums.push(at),
                Some(TokenKind::Star) if depth == 0 && at > range.start => products.push(at),
                _ => {}
            }
        }
        if sums.is_empty() { products } else { sums }
    }

    /// Something in parentheses, with `+`, `*`, `/` or `rise` before it.
    fn enclosed(&self, range: Range<usize>, whole: String, indent: usize, lines: &mut Vec<String>) {
        let open = range
            .clone()
            .find(|at| self.kind(*at) == Some(TokenKind::Open));
        let last = range.end.saturating_sub(1);
        match open {
            Some(open) if self.kind(last) == Some(TokenKind::Close) && open + 1 < last => {
                lines.push(self.line(range.start..open + 1, indent));
                self.condition(open + 1..last, indent + INDENT, lines);
                lines.push(self.line(last..range.end, indent));
            }
            _ => lines.push(whole),
        }
    }

    fn outputs(&self, range: Range<usize>, lines: &mut Vec<String>) {
        if range.is_empty() {
            return;
        }
        let whole = self.line(range.clone(), INDENT);
        if width(&whole) <= WIDTH {
            lines.push(whole);
            return;
        }
        let mut indent = INDENT;
        let mut start = range.start;
        let mut depth = 0_usize;
        for at in range.clone() {
            match self.kind(at) {
                Some(TokenKind::Open) => depth += 1,
                Some(TokenKind::Close) => depth = depth.saturating_sub(1),
                Some(TokenKind::Comma) if depth == 0 => {
                    lines.push(self.line(start..at + 1, indent));
                    start = at + 1;
                    // Below the first output, behind its arrow.
                    indent = INDENT + 3;
                }
                _ => {}
            }
        }
        lines.push(self.line(start..range.end, indent));
    }
}
