//! From lines to statements: which kind each is, and where it stands.

use logic::Name;
use logic::notation::{Lexer, Problem, Token, TokenKind};
use source::Span;

use super::syntax::{Document, Kind, Line, Mark, Statement, Usage, comment_text};
use super::words::{DECISION, GRAFCET, PartWord, Section, Word};
use super::{clauses, decisions, lines, lists};

/// The statements of `text`. Nothing is left out, nothing fails.
pub(crate) fn parse(text: &str) -> Document<'_> {
    let mut part: Option<Name> = None;
    let mut section = None;
    let mut statements = Vec::new();
    for lines in lines::statements(text) {
        let mut statement = statement(text, lines, section);
        match &statement.kind {
            Kind::Part(name, _) => {
                part = Some(name.clone());
                section = None;
            }
            Kind::Section(new) => section = Some(*new),
            _ => {}
        }
        statement.part.clone_from(&part);
        statement.section = section;
        statements.push(statement);
    }
    Document { text, statements }
}

/// What a parser of one kind of statement gives: as much as it understood.
pub(crate) struct Parsed {
    pub(crate) kind: Kind,
    pub(crate) problem: Option<Problem>,
}

/// A statement being read: its tokens, and the names met so far.
pub(crate) struct Parser<'t> {
    pub(crate) lexer: Lexer<'t>,
    pub(crate) marks: Vec<Mark>,
}

impl Parser<'_> {
    /// The name that stands next, noted as used for `usage`.
    pub(crate) fn name(&mut self, usage: Usage, expected: &str) -> Result<(Name, Span), Problem> {
        let found = self.any_name(expected)?;
        self.mark(&found.0, found.1, usage);
        Ok(found)
    }

    /// The name that stands next.
    pub(crate) fn any_name(&mut self, expected: &str) -> Result<(Name, Span), Problem> {
        let text = self.lexer.text();
        let token = self.lexer.peek().filter(|token| {
            matches!(token.kind, TokenKind::Name | TokenKind::Quoted)
                && !token.name(text).is_empty()
        });
        let token = token.ok_or_else(|| self.expected(expected))?;
        self.lexer.take();
        Ok((token.name(text).into(), token.span))
    }

    pub(crate) fn mark(&mut self, name: &Name, span: Span, usage: Usage) {
        let name = name.clone();
        self.marks.push(Mark { name, span, usage });
    }

    /// The token of this kind that stands next.
    pub(crate) fn token(&mut self, kind: TokenKind) -> Result<Token, Problem> {
        let token = self.lexer.take_if(kind);
        token.ok_or_else(|| self.expected(kind.describe()))
    }

    /// Takes the next token if it is this small word, without quotes.
    pub(crate) fn word(&mut self, word: &str) -> bool {
        let text = self.lexer.text();
        let found = self.lexer.peek().is_some_and(|token| {
            token.kind == TokenKind::Name && token.text(text).eq_ignore_ascii_case(word)
        });
        if found {
            self.lexer.take();
        }
        found
    }

    /// Nothing may follow.
    pub(crate) fn end(&self, expected: &str) -> Result<(), Problem> {
        match self.lexer.peek() {
            None => Ok(()),
            Some(_) => Err(self.expected(expected)),
        }
    }

    pub(crate) fn expected(&self, what: &str) -> Problem {
        Problem {
            span: self.lexer.here(),
            message: format!("expected {what}, found {}", self.lexer.found()),
        }
    }
}

fn statement(text: &str, lines: Vec<Line>, section: Option<Section>) -> Statement {
    let tokens: Vec<Token> = lines
        .iter()
        .flat_map(|line| &line.tokens)
        .copied()
        .collect();
    let comment = lines.last().and_then(|line| line.comment);
    let mut parser = Parser {
        lexer: Lexer::over(text, tokens.clone()),
        marks: Vec::new(),
    };
    let said = comment.and_then(|comment| comment_text(text, comment));
    let parsed = match tokens.first() {
        Some(first) => significant(&mut parser, *first, &lines, said, section),
        None => match comment {
            None => Ok(Parsed {
                kind: Kind::Blank,
                problem: None,
            }),
            Some(comment) if comment.text(text).starts_with(DECISION) => {
                decisions::read(text, comment, &mut parser.marks).map(|decision| Parsed {
                    kind: Kind::Decision(decision),
                    problem: None,
                })
            }
            Some(_) => Ok(Parsed {
                kind: Kind::Comment,
                problem: None,
            }),
        },
    };
    let label = label(text, &tokens);
    let Parsed { kind, problem } = parsed.unwrap_or_else(|problem| Parsed {
        kind: Kind::Broken(label),
        problem: Some(problem),
    });
    Statement {
        lines,
        tokens,
        kind,
        marks: parser.marks,
        problem,
        part: None,
        section: None,
    }
}

/// The name before the colon, if the tokens begin as a rule does.
fn label(text: &str, tokens: &[Token]) -> Option<Name> {
    let [first, second, ..] = tokens else {
        return None;
    };
    let is_name = matches!(first.kind, TokenKind::Name | TokenKind::Quoted);
    (is_name && second.kind == TokenKind::Colon).then(|| first.name(text).into())
}

fn significant(
    parser: &mut Parser<'_>,
    first: Token,
    lines: &[Line],
    comment: Option<Name>,
    section: Option<Section>,
) -> Result<Parsed, Problem> {
    let text = parser.lexer.text();
    if parser.lexer.peek_at(1) == Some(TokenKind::Colon) {
        return rule_or_section(parser, first, comment, section);
    }
    let leading = match first.kind {
        TokenKind::Name => first.text(text),
        _ => "",
    };
    if let Some(word) = Word::parse(leading) {
        parser.lexer.take();
        return Ok(lists::read(parser, word, lines));
    }
    if let Some(word) = PartWord::parse(leading) {
        parser.lexer.take();
        return lists::part(parser, word).map(whole);
    }
    if leading.eq_ignore_ascii_case(GRAFCET) {
        parser.lexer.take();
        let (name, _) = parser.name(Usage::DeclaresGrafcet, "the name of the grafcet")?;
        parser.end("the end of the line")?;
        return Ok(whole(Kind::Grafcet(name)));
    }
    Err(parser.expected("a declaration such as `Step p1`, a section such as `Transitions:`, or a rule `t1: p1*m |- @p2`"))
}

fn whole(kind: Kind) -> Parsed {
    Parsed {
        kind,
        problem: None,
    }
}

fn rule_or_section(
    parser: &mut Parser<'_>,
    first: Token,
    comment: Option<Name>,
    section: Option<Section>,
) -> Result<Parsed, Problem> {
    let text = parser.lexer.text();
    if first.kind == TokenKind::Name
        && parser.lexer.peek_at(2).is_none()
        && let Some(section) = Section::parse(first.text(text))
    {
        return Ok(whole(Kind::Section(section)));
    }
    let Some(section) = section else {
        return Err(Problem {
            span: first.span,
            message: "expected `Transitions:`, `Steps:`, `Environment:` or `Never:` before the \
                      first rule"
                .to_owned(),
        });
    };
    clauses::read(parser, section, comment).map(whole)
}
