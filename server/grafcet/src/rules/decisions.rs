//! Decision lines: comments that the tool understands.
//!
//! ```text
//! //! accept v1 -> v2             v2 follows v1
//! //! accept v1 -> v2 & h & m     ... and all three start together
//! //! reject v1 -> v4
//! //! initial v1                  the sequence starts in v1
//! //! keep t3                     rule t3 stays as it is
//! //! end v1                      the branch of v1 joins no other
//! ```

use logic::Name;
use logic::notation::{Lexer, Problem, Token, TokenKind};
use source::Span;

use super::lists::state;
use super::parse::Parser;
use super::spell;
use super::syntax::{Mark, Usage, comment_text};
use super::words::DECISION;
use crate::{Decision, Verdict};

/// Reads the decision in `comment`, a token of `text`.
pub(crate) fn read(text: &str, comment: Token, marks: &mut Vec<Mark>) -> Result<Decision, Problem> {
    let start = comment.span.range().start + DECISION.len();
    let rest = text.get(start..comment.span.range().end);
    let mut tokens = tokens(rest.unwrap_or_default(), start);
    let trailing = tokens.last().copied();
    let trailing = trailing.filter(|token| token.kind == TokenKind::Comment);
    if trailing.is_some() {
        tokens.pop();
    }
    let nothing = tokens.is_empty();
    let mut parser = Parser {
        lexer: Lexer::over(text, tokens),
        marks: Vec::new(),
    };
    if nothing {
        return Err(Problem {
            span: comment.span,
            message: format!("expected {EXPECTED}, found nothing"),
        });
    }
    let verdict = verdict(&mut parser)?;
    parser.end("`&` and another state, or the end of the line")?;
    marks.append(&mut parser.marks);
    Ok(Decision {
        verdict,
        comment: trailing.and_then(|trailing| comment_text(text, trailing)),
    })
}

const EXPECTED: &str = "`accept`, `reject`, `initial`, `keep` or `end`";

fn tokens(text: &str, base: usize) -> Vec<Token> {
    let mut lexer = Lexer::new(text);
    let mut tokens = Vec::new();
    while let Some(token) = lexer.take() {
        let range = token.span.range();
        tokens.push(Token {
            kind: token.kind,
            span: Span::new(base + range.start, base + range.end),
        });
    }
    tokens
}

fn verdict(parser: &mut Parser<'_>) -> Result<Verdict, Problem> {
    if parser.word("accept") {
        let from = state(parser)?;
        parser.token(TokenKind::Arrow)?;
        let mut to = vec![state(parser)?];
        while and(parser) {
            to.push(state(parser)?);
        }
        return Ok(Verdict::Accept { from, to });
    }
    if parser.word("reject") {
        let from = state(parser)?;
        parser.token(TokenKind::Arrow)?;
        let to = state(parser)?;
        return Ok(Verdict::Reject { from, to });
    }
    if parser.word("initial") {
        return state(parser).map(Verdict::Initial);
    }
    if parser.word("keep") {
        let (rule, _) = parser.name(Usage::Rule, "the label of a rule")?;
        return Ok(Verdict::Keep(rule));
    }
    if parser.word("end") {
        return state(parser).map(Verdict::End);
    }
    Err(parser.expected(EXPECTED))
}

/// Takes `&`, which is no token of the expressions' notation.
fn and(parser: &mut Parser<'_>) -> bool {
    let text = parser.lexer.text();
    let found = parser
        .lexer
        .peek()
        .is_some_and(|token| token.text(text) == "&");
    if found {
        parser.lexer.take();
    }
    found
}

/// The line of a decision: `//! accept v1 -> v2`.
pub fn decision_line(it: &Decision) -> String {
    print(it)
}

/// The line of a decision.
pub(crate) fn print(decision: &Decision) -> String {
    let said = match &decision.verdict {
        Verdict::Accept { from, to } => {
            let to: Vec<String> = to.iter().map(|state| spell::state(state)).collect();
            format!("{} -> {}", spell::state(from), to.join(" & "))
        }
        Verdict::Reject { from, to } => {
            format!("{} -> {}", spell::state(from), spell::state(to))
        }
        Verdict::Keep(rule) => spell::name(rule),
        Verdict::Initial(state) | Verdict::End(state) => spell::state(state),
    };
    let line = format!("{DECISION} {} {said}", decision.verdict.word());
    spell::with_comment(line, decision.comment.as_deref())
}

/// What a decision's state looks like to [`spell`]: a register and its value.
pub(crate) fn register_value(state: &str) -> Option<(Name, &str)> {
    let (register, value) = state.split_once('=')?;
    let digits = value.strip_prefix('-').unwrap_or(value);
    let mut lexer = Lexer::new(digits);
    let number = lexer.take()?;
    let is_number = number.kind == TokenKind::Number && number.span.len() == digits.len();
    is_number.then(|| (register.into(), value))
}
