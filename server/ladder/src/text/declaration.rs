//! Reads declarations, `input ls2 %I2 : BOOL = 0`, and the lines that begin a
//! program or a routine.

use logic::notation::{Lexer, Token, TokenKind};

use super::findings::{Refusal, expected};
use crate::Role;

/// A declaration as written.
#[derive(Clone, Copy, Debug)]
pub(super) struct DeclarationText {
    /// The variable; a bare address declares itself.
    pub(super) name: Token,
    /// Its address: `%I0`, or anything in quotes after `at`.
    pub(super) address: Option<Token>,
    /// Its type.
    pub(super) data_type: Option<Token>,
    /// Its initial value, and the minus before it.
    pub(super) initial: Option<(Option<Token>, Token)>,
}

/// Reads a declaration whose statement begins at the lexer's place.
pub(super) fn declaration(lexer: &mut Lexer<'_>) -> Result<DeclarationText, Refusal> {
    lexer.take();
    let name = name(lexer, "a name, as in `input s %I0 // Start button`")?;
    let address = address(lexer)?;
    let data_type = match lexer.take_if(TokenKind::Colon) {
        Some(_) => Some(name_of_type(lexer)?),
        None => None,
    };
    let initial = match lexer.peek_kind() {
        Some(TokenKind::Equal | TokenKind::Assign) => {
            lexer.take();
            Some(value(lexer)?)
        }
        _ => None,
    };
    let next = match (address, data_type, initial) {
        (None, None, None) => {
            "an address such as `%I0`, `:` and a type, `=` or the end of the line"
        }
        (_, None, None) => "`:` and a type, `=` or the end of the line",
        (_, _, None) => "`=` or the end of the line",
        _ => "the end of the line",
    };
    end(lexer, next).map_err(|finding| match lexer.peek_kind() {
        Some(TokenKind::Quoted) => Box::new(finding.help("a description stands behind `//`")),
        _ => finding,
    })?;
    Ok(DeclarationText {
        name,
        address,
        data_type,
        initial,
    })
}

/// Reads `program NAME`.
pub(super) fn program(lexer: &mut Lexer<'_>) -> Result<Token, Refusal> {
    lexer.take();
    let name = name(lexer, "the name of the program")?;
    end(lexer, "the end of the line")?;
    Ok(name)
}

/// Reads `routine NAME`, or `routine NAME main` and `routine NAME block`.
pub(super) fn routine(lexer: &mut Lexer<'_>) -> Result<(Token, Role), Refusal> {
    lexer.take();
    let name = name(lexer, "the name of the routine")?;
    let role = match lexer.peek().map(|token| token.text(lexer.text())) {
        Some("main") => Role::Main,
        Some("block") => Role::Definition,
        _ => {
            end(lexer, "`main`, `block` or the end of the line")?;
            return Ok((name, Role::Called));
        }
    };
    lexer.take();
    end(lexer, "the end of the line")?;
    Ok((name, role))
}

/// Reads `%I0`, `at %I0` or `at "Local:1:I.Data.0"`.
fn address(lexer: &mut Lexer<'_>) -> Result<Option<Token>, Refusal> {
    let Some(token) = lexer.peek().filter(|token| token.kind == TokenKind::Name) else {
        return Ok(None);
    };
    let word = token.text(lexer.text());
    if word == "at" {
        lexer.take();
        return name(lexer, "an address, as in `at \"Local:1:I.Data.0\"`").map(Some);
    }
    Ok(word.starts_with('%').then(|| lexer.take()).flatten())
}

fn name(lexer: &mut Lexer<'_>, what: &str) -> Result<Token, Refusal> {
    match lexer.peek() {
        Some(token) if matches!(token.kind, TokenKind::Name | TokenKind::Quoted) => {
            lexer.take();
            Ok(token)
        }
        _ => Err(expected(lexer, what).into()),
    }
}

fn name_of_type(lexer: &mut Lexer<'_>) -> Result<Token, Refusal> {
    name(
        lexer,
        "a type, as in `: BOOL` or `: \"ARRAY[0..9] OF INT\"`",
    )
}

fn value(lexer: &mut Lexer<'_>) -> Result<(Option<Token>, Token), Refusal> {
    let minus = lexer.take_if(TokenKind::Minus);
    match lexer.peek() {
        Some(token)
            if matches!(
                token.kind,
                TokenKind::Number | TokenKind::Time | TokenKind::Name | TokenKind::Quoted
            ) =>
        {
            lexer.take();
            Ok((minus, token))
        }
        _ => Err(expected(lexer, "a number, a time, a name or a text in quotes").into()),
    }
}

fn end(lexer: &Lexer<'_>, what: &str) -> Result<(), Refusal> {
    match lexer.peek() {
        None => Ok(()),
        Some(_) => Err(expected(lexer, what).into()),
    }
}
