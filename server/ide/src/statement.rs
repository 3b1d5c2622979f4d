//! Which lines make up the statement at a place, and the tokens before it.
//!
//! Editors ask while somebody types, when little can be parsed; so these look
//! at lines and tokens only, with the rules by which the notations cut a text.

use std::ops::Range;

use logic::notation::{Lexer, Token, TokenKind};
use source::Span;

/// The words that begin a statement of rung notation.
pub(crate) const LADDER_WORDS: [&str; 9] = [
    "program", "routine", "rung", "input", "output", "inout", "internal", "constant", "variable",
];

/// The byte `offset` of a text, or the nearest before it where a character
/// begins: no place that an editor knows lies inside of one.
pub(crate) fn boundary(text: &str, offset: usize) -> usize {
    let mut offset = offset.min(text.len());
    while !text.is_char_boundary(offset) {
        offset -= 1;
    }
    offset
}

/// The lines of a text, without their ends.
pub(crate) fn lines(text: &str) -> Vec<Range<usize>> {
    let mut lines = Vec::new();
    let mut start = 0;
    let mut rest = text.char_indices().peekable();
    while let Some((at, c)) = rest.next() {
        if !matches!(c, '\n' | '\r') {
            continue;
        }
        lines.push(start..at);
        start = at + 1;
        if c == '\r' && rest.next_if(|(_, next)| *next == '\n').is_some() {
            start += 1;
        }
    }
    lines.push(start..text.len());
    lines
}

/// The bytes of the line that holds the byte `offset`, its end left out.
pub(crate) fn line(text: &str, offset: usize) -> Range<usize> {
    let lines = lines(text);
    lines[line_number(&lines, offset)].clone()
}

fn line_number(lines: &[Range<usize>], offset: usize) -> usize {
    let after = lines.partition_point(|line| line.start <= offset);
    after.saturating_sub(1)
}

/// The tokens of a part of a text, with their places in the whole.
pub(crate) fn tokens(text: &str, part: Range<usize>) -> Vec<Token> {
    let mut lexer = Lexer::new(text.get(part.clone()).unwrap_or_default());
    let moved = |token: Token| Token {
        kind: token.kind,
        span: Span::new(
            part.start + token.span.range().start,
            part.start + token.span.range().end,
        ),
    };
    std::iter::from_fn(|| lexer.take()).map(moved).collect()
}

/// Those of them that say something.
pub(crate) fn code(text: &str, part: Range<usize>) -> Vec<Token> {
    let mut tokens = tokens(text, part);
    tokens.retain(|token| !matches!(token.kind, TokenKind::Comment | TokenKind::LineEnd));
    tokens
}

/// Whether a token ends an operand: behind it stands an operator, if anything.
pub(crate) fn ends_operand(kind: Option<TokenKind>) -> bool {
    use TokenKind as T;
    matches!(
        kind,
        Some(T::Name | T::Quoted | T::Close | T::Number | T::Time)
    )
}

/// The statement of rung notation at the byte `offset`: whole lines, without
/// the end of the last. A rung goes on to the next line that begins a statement
/// or is blank, everything else ends with its line.
pub(crate) fn in_ladder(text: &str, offset: usize) -> Range<usize> {
    let lines = lines(text);
    let at = line_number(&lines, offset);
    let content = |at: usize| text[lines[at].clone()].trim();
    let word = |at: usize| {
        let is_part = |c: char| c.is_alphanumeric() || c == '_';
        let first = content(at).split(|c| !is_part(c)).next()?;
        LADDER_WORDS
            .iter()
            .find(|word| word.eq_ignore_ascii_case(first))
    };
    let mut first = at;
    while first > 0 && word(first).is_none() && !content(first - 1).is_empty() {
        first -= 1;
    }
    let is_rung = word(first).is_none_or(|word| *word == "rung");
    if !is_rung && first < at {
        first = at;
    }
    let mut last = at;
    while is_rung
        && last + 1 < lines.len()
        && !content(last + 1).is_empty()
        && word(last + 1).is_none()
    {
        last += 1;
    }
    lines[first].start..lines[last].end
}

/// The statement of a rule text at the byte `offset`: whole lines, without the
/// end of the last. A line goes on in the next after a comma, `*` or `+`.
pub(crate) fn in_spec(text: &str, offset: usize) -> Range<usize> {
    let lines = lines(text);
    let at = line_number(&lines, offset);
    let goes_on = |at: usize| {
        let last = code(text, lines[at].clone()).last().map(|token| token.kind);
        matches!(
            last,
            Some(TokenKind::Comma | TokenKind::Star | TokenKind::Plus)
        )
    };
    let mut first = at;
    while first > 0 && goes_on(first - 1) {
        first -= 1;
    }
    let mut last = at;
    while last + 1 < lines.len() && goes_on(last) {
        last += 1;
    }
    lines[first].start..lines[last].end
}

/// What a caret stands in or behind: the word that is being typed, to be
/// replaced by a completion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Typed {
    /// The word; empty where none is typed yet.
    pub(crate) span: Span,
    /// Whether the caret stands in a comment.
    pub(crate) in_comment: bool,
    /// Whether the word stands in quotes.
    pub(crate) quoted: bool,
}

impl Typed {
    /// What is typed at the byte `offset` of `text`.
    pub(crate) fn at(text: &str, offset: usize) -> Self {
        let line = line(text, offset);
        let tokens = tokens(text, line.clone());
        let holds = |token: &&Token| {
            let range = token.span.range();
            range.start < offset && offset <= range.end
        };
        let word = |span, quoted| Self {
            span,
            in_comment: false,
            quoted,
        };
        // Behind a quote that does not end, everything is the name.
        let is_open =
            |token: &&Token| token.kind == TokenKind::Unknown && token.text(text).starts_with('"');
        if let Some(open) = tokens.iter().find(is_open)
            && open.span.range().start < offset
        {
            return word(Span::new(open.span.range().start, offset), true);
        }
        match tokens.iter().find(holds) {
            Some(token) if token.kind == TokenKind::Comment => Self {
                span: Span::at(offset),
                in_comment: true,
                quoted: false,
            },
            Some(token) if token.kind == TokenKind::Quoted => {
                let closed = token.span.range().end == offset;
                match closed {
                    true => word(Span::at(offset), false),
                    false => word(token.span, true),
                }
            }
            Some(token) if token.kind == TokenKind::Name => word(token.span, false),
            Some(token) if token.text(text) == "%" => word(token.span, false),
            _ => word(Span::at(offset), false),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(find: fn(&str, usize) -> Range<usize>, text: &str, expected: &str) {
        let offset = text.find("$0").expect("a cursor");
        let text = text.replace("$0", "");
        assert_eq!(&text[find(&text, offset)], expected);
    }

    #[test]
    fn a_rung_goes_on_until_a_blank_line_or_a_word() {
        check(
            in_ladder,
            "input a\nrung: a\n  * $0b\n-> c\n\nx",
            "rung: a\n  * b\n-> c",
        );
        check(in_ladder, "rung: a\r\n-> c$0\r\nrung: d", "rung: a\r\n-> c");
        check(in_ladder, "rung: a\ninput$0 b\nrung: d", "input b");
        check(in_ladder, "input b\n$0", "");
    }

    #[test]
    fn a_rule_goes_on_after_an_operator() {
        check(in_spec, "Step a,\n b$0,\n c\nt: x", "Step a,\n b,\n c");
        check(
            in_spec,
            "t1: a * // on\n b |- @c$0\nt2:",
            "t1: a * // on\n b |- @c",
        );
        check(in_spec, "$0\nt2:", "");
    }

    #[track_caller]
    fn typed(text: &str, word: &str) {
        let offset = text.find("$0").expect("a cursor");
        let text = text.replace("$0", "");
        let typed = Typed::at(&text, offset);
        assert_eq!((&text[typed.span.range()], typed.in_comment), (word, false));
    }

    #[test]
    fn the_word_that_is_typed_is_found() {
        typed("rung: a * ls$02 -> b", "ls2");
        typed("rung: a * $0 -> b", "");
        typed("rung: a * t1.$0", "t1.");
        typed("rung: %$0", "%");
        typed("rung: a * \"Local:1$0 -> b", "\"Local:1");
        typed("rung: a * \"Loc$0al:1\" -> b", "\"Local:1\"");
        typed("rung: \"Fill\"$0", "");
        assert!(Typed::at("a // b", 6).in_comment);
    }
}
