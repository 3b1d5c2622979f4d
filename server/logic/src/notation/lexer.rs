use logos::Logos;
use source::Span;

/// What a token is.
#[derive(Logos, Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[logos(skip r"[ \t\u{feff}\u{a0}]+")]
pub enum TokenKind {
    /// A name without quotes: `v1`, `%I0`, `T1.DN`.
    #[regex(r"%?[\p{L}_][\p{L}\p{N}_.]*")]
    Name,
    /// A name in double quotes; it may hold anything but a quote or line end.
    #[regex(r#""[^"\r\n]*""#)]
    Quoted,
    /// A number: `5`, `2.5`, `16#F0`.
    #[regex(r"[0-9][0-9_]*(\.[0-9]+)?([eE][+-]?[0-9]+)?")]
    #[regex(r"[0-9]+#[0-9A-Fa-f_]+", priority = 5)]
    Number,
    /// A time: `5s`, `1m30s`, `250ms`, `T#5s`.
    #[regex(r"([tT]#)?([0-9]+(\.[0-9]+)?(ms|[dhms]))+", priority = 6)]
    Time,
    /// `*`
    #[token("*")]
    Star,
    /// `+`
    #[token("+")]
    Plus,
    /// `-`
    #[token("-")]
    Minus,
    /// `/`
    #[token("/")]
    Slash,
    /// `(`
    #[token("(")]
    Open,
    /// `)`
    #[token(")")]
    Close,
    /// `[`
    #[token("[")]
    OpenBracket,
    /// `]`
    #[token("]")]
    CloseBracket,
    /// `{`
    #[token("{")]
    OpenBrace,
    /// `}`
    #[token("}")]
    CloseBrace,
    /// `=`
    #[token("=")]
    Equal,
    /// `<>`
    #[token("<>")]
    NotEqual,
    /// `<`
    #[token("<")]
    Less,
    /// `<=`
    #[token("<=")]
    LessOrEqual,
    /// `>`
    #[token(">")]
    Greater,
    /// `>=`
    #[token(">=")]
    GreaterOrEqual,
    /// `^`
    #[token("^")]
    Caret,
    /// `@`
    #[token("@")]
    At,
    /// `|-`
    #[token("|-")]
    Yields,
    /// `->`
    #[token("->")]
    Arrow,
    /// `=>`
    #[token("=>")]
    DoubleArrow,
    /// `:=`
    #[token(":=")]
    Assign,
    /// `:`
    #[token(":")]
    Colon,
    /// `,`
    #[token(",")]
    Comma,
    /// `;`
    #[token(";")]
    Semicolon,
    /// `//` to the end of the line.
    #[regex(r"//[^\r\n]*", allow_greedy = true)]
    Comment,
    /// A line end.
    #[regex(r"\r\n|\n|\r")]
    LineEnd,
    /// A character that no token begins with.
    Unknown,
}

impl TokenKind {
    /// The token as a message names it.
    pub fn describe(self) -> &'static str {
        match self {
            Self::Name | Self::Quoted => "a name",
            Self::Number => "a number",
            Self::Time => "a time",
            Self::Star => "`*`",
            Self::Plus => "`+`",
            Self::Minus => "`-`",
            Self::Slash => "`/`",
            Self::Open => "`(`",
            Self::Close => "`)`",
            Self::OpenBracket => "`[`",
            Self::CloseBracket => "`]`",
            Self::OpenBrace => "`{`",
            Self::CloseBrace => "`}`",
            Self::Equal => "`=`",
            Self::NotEqual => "`<>`",
            Self::Less => "`<`",
            Self::LessOrEqual => "`<=`",
            Self::Greater => "`>`",
            Self::GreaterOrEqual => "`>=`",
            Self::Caret => "`^`",
            Self::At => "`@`",
            Self::Yields => "`|-`",
            Self::Arrow => "`->`",
            Self::DoubleArrow => "`=>`",
            Self::Assign => "`:=`",
            Self::Colon => "`:`",
            Self::Comma => "`,`",
            Self::Semicolon => "`;`",
            Self::Comment => "a comment",
            Self::LineEnd => "the end of the line",
            Self::Unknown => "an unknown character",
        }
    }
}

/// A piece of the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Token {
    /// What it is.
    pub kind: TokenKind,
    /// Where it stands.
    pub span: Span,
}

impl Token {
    /// The text of the token in `text`, the text it was cut from.
    pub fn text<'t>(&self, text: &'t str) -> &'t str {
        text.get(self.span.range()).unwrap_or_default()
    }

    /// The name that a [`TokenKind::Name`] or [`TokenKind::Quoted`] token
    /// writes, without its quotes.
    pub fn name<'t>(&self, text: &'t str) -> &'t str {
        let whole = self.text(text);
        match self.kind {
            TokenKind::Quoted => whole.trim_matches('"'),
            _ => whole,
        }
    }
}

/// A text cut into tokens, with a place to read from.
///
/// Comments and line ends are tokens too, since some grammars need them;
/// [`Lexer::skip_blank`] passes over both.
#[derive(Clone, Debug)]
pub struct Lexer<'t> {
    text: &'t str,
    tokens: Vec<Token>,
    next: usize,
    end: usize,
    end_name: &'static str,
}

impl<'t> Lexer<'t> {
    /// Cuts `text` into tokens; places count from its first byte.
    pub fn new(text: &'t str) -> Self {
        let tokens = TokenKind::lexer(text)
            .spanned()
            .map(|(kind, range)| Token {
                kind: kind.unwrap_or(TokenKind::Unknown),
                span: Span::new(range.start, range.end),
            })
            .collect();
        Self {
            text,
            tokens,
            next: 0,
            end: text.len(),
            end_name: "the end of the text",
        }
    }

    /// Reads some of the tokens of `text` as if they were all: one statement
    /// of it, say, without the comments and line ends inside. Places still
    /// count from the first byte of `text`.
    pub fn over(text: &'t str, tokens: Vec<Token>) -> Self {
        let end = tokens.last().map_or(0, |token| token.span.range().end);
        Self {
            text,
            tokens,
            next: 0,
            end,
            end_name: "the end of the statement",
        }
    }

    /// The text being read.
    pub fn text(&self) -> &'t str {
        self.text
    }

    /// The next token, if the text has not ended.
    pub fn peek(&self) -> Option<Token> {
        self.tokens.get(self.next).copied()
    }

    /// The kind of the next token.
    pub fn peek_kind(&self) -> Option<TokenKind> {
        self.peek().map(|token| token.kind)
    }

    /// The kind of the token `ahead` places after the next one.
    pub fn peek_at(&self, ahead: usize) -> Option<TokenKind> {
        self.tokens.get(self.next + ahead).map(|token| token.kind)
    }

    /// Takes the next token.
    pub fn take(&mut self) -> Option<Token> {
        let token = self.peek()?;
        self.next += 1;
        Some(token)
    }

    /// Takes the next token if it is of this kind.
    pub fn take_if(&mut self, kind: TokenKind) -> Option<Token> {
        (self.peek_kind() == Some(kind))
            .then(|| self.take())
            .flatten()
    }

    /// Passes over line ends and comments.
    pub fn skip_blank(&mut self) {
        while matches!(
            self.peek_kind(),
            Some(TokenKind::LineEnd | TokenKind::Comment)
        ) {
            self.next += 1;
        }
    }

    /// Where the next token stands, or where the tokens end.
    pub fn here(&self) -> Span {
        match self.peek() {
            Some(token) => token.span,
            None => Span::at(self.end),
        }
    }

    /// The next token, or the end, as a message names it: `found {found}`.
    pub fn found(&self) -> String {
        let Some(token) = self.peek() else {
            return self.end_name.to_owned();
        };
        let text = token.text(self.text);
        match token.kind {
            TokenKind::Unknown if text.starts_with('"') => {
                "a quote that does not end on its line".to_owned()
            }
            TokenKind::Name
            | TokenKind::Quoted
            | TokenKind::Number
            | TokenKind::Time
            | TokenKind::Unknown => format!("`{text}`"),
            kind => kind.describe().to_owned(),
        }
    }

    /// The span from the byte at `start` to the end of the last token taken.
    pub fn since(&self, start: usize) -> Span {
        let end = self.previous().map_or(start, |last| last.span.range().end);
        Span::new(start, end)
    }

    /// The last token taken.
    pub fn previous(&self) -> Option<Token> {
        self.next
            .checked_sub(1)
            .and_then(|at| self.tokens.get(at).copied())
    }

    /// The tokens taken since a [`mark`](Lexer::mark) of this lexer.
    pub fn taken_since(&self, mark: usize) -> &[Token] {
        self.tokens.get(mark..self.next).unwrap_or_default()
    }

    /// A mark that [`Lexer::rewind`] goes back to.
    pub fn mark(&self) -> usize {
        self.next
    }

    /// Goes back to a mark of this lexer.
    pub fn rewind(&mut self, mark: usize) {
        self.next = mark.min(self.tokens.len());
    }
}
