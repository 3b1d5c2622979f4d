//! Reads what a rung drives: coils, boxes, moves, jumps, and legs with a
//! condition of their own.
//!
//! `set`, `reset`, `rising`, `falling`, `jump` and `call` are words only where
//! a name follows them, so a coil may be called `reset`. `return` alone is
//! always the word.

use logic::notation::{Lexer, Token, TokenKind};
use source::Diagnostic;

use super::boxes;
use super::findings::{Refusal, expected};
use super::rung::leg;
use super::syntax::{Argument, OutputKind, OutputText, Pin};
use super::term::term;
use crate::CoilKind;

/// Reads outputs with commas between them, up to the end of the statement or
/// the parenthesis that closes the leg, which is left.
pub(super) fn outputs(
    lexer: &mut Lexer<'_>,
    depth: usize,
    findings: &mut Vec<Diagnostic>,
) -> Vec<OutputText> {
    let mut all = Vec::new();
    loop {
        let start = lexer.here().range().start;
        let kind = output(lexer, depth, findings).unwrap_or_else(|finding| {
            findings.push(*finding);
            skip_output(lexer, depth);
            OutputKind::NotRead
        });
        all.push(OutputText {
            span: lexer.since(start),
            kind,
        });
        if !ends_output(lexer, depth) {
            findings.push(expected(lexer, "`,` or the end of the rung"));
            let start = lexer.here().range().start;
            skip_output(lexer, depth);
            all.push(OutputText {
                span: lexer.since(start),
                kind: OutputKind::NotRead,
            });
        }
        if lexer.take_if(TokenKind::Comma).is_none() {
            return all;
        }
    }
}

fn ends_output(lexer: &Lexer<'_>, depth: usize) -> bool {
    match lexer.peek_kind() {
        None | Some(TokenKind::Comma) => true,
        Some(TokenKind::Close) => depth > 0,
        _ => false,
    }
}

/// Passes over what is left of an output that could not be read.
fn skip_output(lexer: &mut Lexer<'_>, depth: usize) {
    let mut open = 0_usize;
    while let Some(kind) = lexer.peek_kind() {
        match kind {
            TokenKind::Open => open += 1,
            TokenKind::Close if open == 0 && depth > 0 => return,
            TokenKind::Close => open = open.saturating_sub(1),
            TokenKind::Comma if open == 0 => return,
            _ => {}
        }
        lexer.take();
    }
}

const OUTPUT: &str = "a coil, a box or a leg `(a -> b)`";

fn output(
    lexer: &mut Lexer<'_>,
    depth: usize,
    findings: &mut Vec<Diagnostic>,
) -> Result<OutputKind, Refusal> {
    let Some(first) = lexer.peek() else {
        return Err(expected(lexer, OUTPUT).into());
    };
    match first.kind {
        TokenKind::Slash => {
            lexer.take();
            Ok(OutputKind::Coil(CoilKind::Negated, name(lexer, "a coil")?))
        }
        TokenKind::Open => {
            lexer.take();
            let leg = leg(lexer, depth + 1, findings);
            match lexer.take_if(TokenKind::Close) {
                Some(_) => Ok(OutputKind::Leg(leg)),
                None => {
                    // The leg itself was read, and stays.
                    findings.push(expected(lexer, "`)`, the end of the leg"));
                    Ok(OutputKind::Leg(leg))
                }
            }
        }
        TokenKind::Name => word_or_name(lexer, first),
        TokenKind::Quoted => after_name(lexer, first),
        _ => Err(expected(lexer, OUTPUT).into()),
    }
}

fn word_or_name(lexer: &mut Lexer<'_>, first: Token) -> Result<OutputKind, Refusal> {
    let word = first.text(lexer.text());
    let name_follows = matches!(lexer.peek_at(1), Some(TokenKind::Name | TokenKind::Quoted));
    if word == "return" && !name_follows {
        lexer.take();
        return Ok(OutputKind::Return { program: false });
    }
    if !name_follows {
        return after_name(lexer, first);
    }
    let coil = match word {
        "set" => CoilKind::Set,
        "reset" => CoilKind::Reset,
        "rising" => CoilKind::Rising,
        "falling" => CoilKind::Falling,
        "jump" => {
            lexer.take();
            return Ok(OutputKind::Jump(name(lexer, "a label")?));
        }
        "call" => {
            lexer.take();
            let routine = name(lexer, "a routine")?;
            let handed = match lexer.peek_kind() {
                Some(TokenKind::Open) => arguments(lexer)?,
                _ => Vec::new(),
            };
            return Ok(OutputKind::Call(routine, handed));
        }
        "return" => {
            lexer.take();
            return match lexer.peek() {
                Some(next) if next.text(lexer.text()) == "program" => {
                    lexer.take();
                    Ok(OutputKind::Return { program: true })
                }
                _ => Err(expected(lexer, "`program`, `,` or the end of the rung").into()),
            };
        }
        _ => return after_name(lexer, first),
    };
    lexer.take();
    Ok(OutputKind::Coil(coil, name(lexer, "a coil")?))
}

/// What begins with a name that is no word of the notation.
fn after_name(lexer: &mut Lexer<'_>, first: Token) -> Result<OutputKind, Refusal> {
    lexer.take();
    match lexer.peek_kind() {
        Some(TokenKind::Open) => {
            let handed = arguments(lexer)?;
            let whole = lexer.since(first.span.range().start);
            boxes::known(lexer.text(), first, handed, whole)
        }
        Some(TokenKind::Assign) => {
            lexer.take();
            Ok(OutputKind::Assign(first, term(lexer)?))
        }
        _ => Ok(OutputKind::Coil(CoilKind::Plain, first)),
    }
}

fn name(lexer: &mut Lexer<'_>, of: &str) -> Result<Token, Refusal> {
    match lexer.peek() {
        Some(token) if matches!(token.kind, TokenKind::Name | TokenKind::Quoted) => {
            lexer.take();
            Ok(token)
        }
        _ => Err(expected(lexer, &format!("the name of {of}")).into()),
    }
}

/// Reads `(a, IN := b, OUT => c)`.
fn arguments(lexer: &mut Lexer<'_>) -> Result<Vec<Argument>, Refusal> {
    let mut all = Vec::new();
    lexer.take();
    if lexer.take_if(TokenKind::Close).is_some() {
        return Ok(all);
    }
    loop {
        all.push(argument(lexer)?);
        if lexer.take_if(TokenKind::Close).is_some() {
            return Ok(all);
        }
        if lexer.take_if(TokenKind::Comma).is_none() {
            return Err(expected(lexer, "`,` or `)`").into());
        }
    }
}

fn argument(lexer: &mut Lexer<'_>) -> Result<Argument, Refusal> {
    let mut pin = None;
    if matches!(lexer.peek_kind(), Some(TokenKind::Name | TokenKind::Quoted)) {
        let direction: Option<fn(Token) -> Pin> = match lexer.peek_at(1) {
            Some(TokenKind::Assign) => Some(Pin::Input),
            Some(TokenKind::DoubleArrow) => Some(Pin::Output),
            _ => None,
        };
        if let (Some(direction), Some(token)) = (direction, lexer.peek()) {
            lexer.take();
            lexer.take();
            pin = Some(direction(token));
        }
    }
    let value = match lexer.peek_kind() {
        Some(TokenKind::Comma | TokenKind::Close) => None,
        _ => Some(term(lexer)?),
    };
    Ok(Argument { pin, value })
}
