//! Cuts a text into statements, before any of them is understood.
//!
//! A statement begins at a line whose first word is a [`Keyword`]. A rung goes
//! on until the next such line or a blank line; everything else ends with its
//! line. Nothing inside a statement, no open parenthesis and no quote, can
//! swallow the next one: that is why an error costs one statement and no more.
//! The price is that a variable called `input` needs quotes where it begins a
//! line.

use logic::notation::{Lexer, Token, TokenKind};
use source::Span;

use crate::Class;

/// The word that a statement begins with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Keyword {
    /// `program NAME`
    Program,
    /// `routine NAME`
    Routine,
    /// `rung: CONDITION -> OUTPUTS`
    Rung,
    /// `input NAME` and the like.
    Declaration(Class),
}

/// All words that begin a statement.
pub(super) const WORDS: &[(&str, Keyword)] = &[
    ("program", Keyword::Program),
    ("routine", Keyword::Routine),
    ("rung", Keyword::Rung),
    ("input", Keyword::Declaration(Class::Input)),
    ("output", Keyword::Declaration(Class::Output)),
    ("inout", Keyword::Declaration(Class::InOut)),
    ("internal", Keyword::Declaration(Class::Internal)),
    ("constant", Keyword::Declaration(Class::Constant)),
    ("variable", Keyword::Declaration(Class::Unknown)),
];

impl Keyword {
    /// The keyword that `word` is, in small or capital letters, and how it is
    /// written.
    pub(super) fn of(word: &str) -> Option<(&'static str, Self)> {
        WORDS
            .iter()
            .find(|(known, _)| known.eq_ignore_ascii_case(word))
            .copied()
    }

    /// Number of bytes.
    pub(super) fn len(self) -> usize {
        let word = WORDS.iter().find(|(_, keyword)| *keyword == self);
        word.map_or(0, |(word, _)| word.len())
    }

    /// Whether a line without a keyword belongs to the statement above it.
    fn goes_on(self) -> bool {
        self == Self::Rung
    }
}

/// A piece of the text.
#[derive(Clone, Debug)]
pub(super) enum Item {
    /// An empty line.
    Blank,
    /// A comment with a line of its own, between statements.
    Comment(Token),
    /// A statement.
    Statement(Statement),
}

impl Item {
    /// The statement that it is.
    pub(super) fn statement(&self) -> Option<&Statement> {
        match self {
            Self::Statement(statement) => Some(statement),
            _ => None,
        }
    }
}

/// A statement as it is written.
#[derive(Clone, Debug)]
pub(super) struct Statement {
    /// What it begins with, if that is a keyword.
    pub(super) keyword: Option<Keyword>,
    /// Its tokens, with the comments and line ends between the first and the
    /// last. Never empty.
    pub(super) tokens: Vec<Token>,
    /// The comment behind its last token, on the same line.
    pub(super) behind: Option<Token>,
}

impl Statement {
    /// From its first token to its last.
    pub(super) fn span(&self) -> Span {
        match (self.tokens.first(), self.tokens.last()) {
            (Some(first), Some(last)) => first.span.cover(last.span),
            _ => Span::default(),
        }
    }

    /// A lexer over its tokens, comments and line ends left out.
    pub(super) fn lexer<'t>(&self, text: &'t str) -> Lexer<'t> {
        let code = self.tokens.iter().filter(|token| is_code(token));
        Lexer::over(text, code.copied().collect())
    }

    /// Whether a comment stands between its first token and its last.
    pub(super) fn holds_a_comment(&self) -> bool {
        self.tokens
            .iter()
            .any(|token| token.kind == TokenKind::Comment)
    }
}

/// Whether the token says something to the reader of a program.
pub(super) fn is_code(token: &Token) -> bool {
    !matches!(token.kind, TokenKind::Comment | TokenKind::LineEnd)
}

/// What a comment says, its slashes and outer blanks left out.
pub(super) fn comment_text(text: &str, comment: Token) -> &str {
    let whole = comment.text(text);
    whole.strip_prefix("//").unwrap_or(whole).trim()
}

/// The pieces of `text`, in order. Every token but line ends is in one.
pub(super) fn cut(text: &str) -> Vec<Item> {
    let mut cutter = Cutter::default();
    let mut lexer = Lexer::new(text);
    let mut line = Vec::new();
    while let Some(token) = lexer.take() {
        if token.kind == TokenKind::LineEnd {
            cutter.line(text, &line, Some(token));
            line.clear();
        } else {
            line.push(token);
        }
    }
    if !line.is_empty() {
        cutter.line(text, &line, None);
    }
    cutter.close();
    cutter.items
}

#[derive(Default)]
struct Cutter {
    items: Vec<Item>,
    open: Option<Statement>,
    /// What follows the last word of the open statement and may turn out to
    /// stand inside it: comments and line ends.
    tail: Vec<Token>,
}

impl Cutter {
    fn line(&mut self, text: &str, line: &[Token], end: Option<Token>) {
        let comment = line.last().filter(|last| !is_code(last));
        let code = &line[..line.len() - usize::from(comment.is_some())];
        match (code.first(), comment) {
            (None, None) => {
                self.close();
                self.items.push(Item::Blank);
                return;
            }
            (None, Some(&comment)) if self.open.is_none() => {
                self.items.push(Item::Comment(comment));
                return;
            }
            (None, _) => {}
            (Some(first), _) => self.code(text, *first, code),
        }
        self.tail.extend(comment);
        self.tail.extend(end);
    }

    fn code(&mut self, text: &str, first: Token, code: &[Token]) {
        let keyword = match first.kind {
            TokenKind::Name => Keyword::of(first.text(text)).map(|(_, keyword)| keyword),
            _ => None,
        };
        let above = self.open.as_ref().and_then(|open| open.keyword);
        if keyword.is_some() || above.is_some_and(|above| !above.goes_on()) {
            self.close();
        }
        let statement = self.open.get_or_insert_with(|| Statement {
            keyword,
            tokens: Vec::new(),
            behind: None,
        });
        statement.tokens.append(&mut self.tail);
        statement.tokens.extend_from_slice(code);
    }

    /// Ends the open statement. What its tail holds stands after it.
    fn close(&mut self) {
        let Some(mut statement) = self.open.take() else {
            return;
        };
        let mut tail = std::mem::take(&mut self.tail).into_iter().peekable();
        statement.behind = tail.next_if(|token| token.kind == TokenKind::Comment);
        self.items.push(Item::Statement(statement));
        let comments = tail.filter(|token| token.kind == TokenKind::Comment);
        self.items.extend(comments.map(Item::Comment));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every piece on a line: `-` for a blank line, comments and statements
    /// with single blanks between their tokens.
    fn pieces(text: &str) -> Vec<String> {
        let words = |tokens: &[Token]| {
            let words: Vec<_> = tokens.iter().map(|token| token.text(text).trim()).collect();
            words.join(" ")
        };
        let piece = |item: Item| match item {
            Item::Blank => "-".to_owned(),
            Item::Comment(comment) => words(&[comment]),
            Item::Statement(statement) => {
                let mut all = statement.tokens;
                all.extend(statement.behind);
                words(&all)
            }
        };
        cut(text).into_iter().map(piece).collect()
    }

    #[test]
    fn a_rung_ends_at_the_next_keyword_or_a_blank_line() {
        assert_eq!(
            pieces("rung: (a +\n b -> c\nrung: d\n\n * e"),
            ["rung : ( a +  b -> c", "rung : d", "-", "* e"]
        );
    }

    #[test]
    fn only_rungs_go_on_over_several_lines() {
        assert_eq!(pieces("input a\n%I0\nx"), ["input a", "%I0  x"]);
    }

    #[test]
    fn a_comment_belongs_to_what_it_stands_in() {
        assert_eq!(
            pieces("// x\nrung: a // y\n// z\n -> b // u\n// v\nrung: c"),
            ["// x", "rung : a // y  // z  -> b // u", "// v", "rung : c"]
        );
    }
}
