//! Arithmetic terms, on the right of `:=` and between the parentheses of a
//! box: `x + 1`, `(a - b) * 3`, `ABS(x)`.
//!
//! A term is checked for its form and kept as its tokens: what it computes is
//! the controller's business, what it reads is ours.

use logic::notation::{Lexer, TokenKind};

use super::findings::{Refusal, expected};
use super::syntax::Term;

/// Reads a term at the lexer's place. On failure the lexer stands at the
/// token that did not fit.
pub(super) fn term(lexer: &mut Lexer<'_>) -> Result<Term, Refusal> {
    let start = lexer.here().range().start;
    let first = lexer.mark();
    let mut open = 0_usize;
    loop {
        // An operand, and what may stand before one.
        match lexer.peek_kind() {
            Some(TokenKind::Minus) => {
                lexer.take();
                continue;
            }
            Some(TokenKind::Open) => {
                open += 1;
                lexer.take();
                continue;
            }
            Some(TokenKind::Number | TokenKind::Time | TokenKind::Quoted) => {
                lexer.take();
            }
            Some(TokenKind::Name) => {
                lexer.take();
                if lexer.take_if(TokenKind::Open).is_some() {
                    open += 1;
                    continue;
                }
            }
            _ => return Err(expected(lexer, "a name, a number or `(`").into()),
        }
        while open > 0 && lexer.take_if(TokenKind::Close).is_some() {
            open -= 1;
        }
        match lexer.peek_kind() {
            Some(TokenKind::Plus | TokenKind::Minus | TokenKind::Star | TokenKind::Slash) => {
                lexer.take();
            }
            Some(TokenKind::Comma) if open > 0 => {
                lexer.take();
            }
            _ if open > 0 => return Err(expected(lexer, "`)` or an operator").into()),
            _ => break,
        }
    }
    Ok(Term {
        tokens: lexer.taken_since(first).to_vec(),
        span: lexer.since(start),
    })
}
