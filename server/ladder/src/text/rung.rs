//! Reads `rung "title" label again: CONDITION -> OUTPUTS`.

use logic::notation::{Lexer, TokenKind, expression};
use source::{Diagnostic, Span};

use super::findings::{expected, problem, syntax};
use super::output::outputs;
use super::syntax::{Condition, Leg, RungText};

/// Reads a rung whose statement begins at the lexer's place. What cannot be
/// read is kept as such; the rest of the rung is read all the same.
pub(super) fn rung(lexer: &mut Lexer<'_>, findings: &mut Vec<Diagnostic>) -> RungText {
    lexer.take();
    let title = lexer.take_if(TokenKind::Quoted);
    let label = label(lexer, findings);
    colon(lexer, findings);
    let leg = match lexer.peek() {
        None => Leg::default(),
        Some(_) => leg(lexer, 0, findings),
    };
    RungText { title, label, leg }
}

fn label(lexer: &mut Lexer<'_>, findings: &mut Vec<Diagnostic>) -> Option<logic::notation::Token> {
    let word = lexer.peek()?;
    if word.kind != TokenKind::Name || word.text(lexer.text()) != "label" {
        return None;
    }
    lexer.take();
    match lexer.peek_kind() {
        Some(TokenKind::Name | TokenKind::Quoted) => lexer.take(),
        _ => {
            findings.push(expected(lexer, "the name of the label"));
            None
        }
    }
}

/// Takes the colon. Where there is none, what stands before a later one is
/// passed over; without any the condition is taken to begin here.
fn colon(lexer: &mut Lexer<'_>, findings: &mut Vec<Diagnostic>) {
    if lexer.take_if(TokenKind::Colon).is_some() {
        return;
    }
    let finding = expected(lexer, "`:`")
        .help("a rung reads `rung \"title\": a * /b -> c`; title and `label NAME` may be left out");
    findings.push(finding);
    let here = lexer.mark();
    while let Some(token) = lexer.take() {
        match token.kind {
            TokenKind::Colon => return,
            TokenKind::Arrow => break,
            _ => {}
        }
    }
    lexer.rewind(here);
}

/// Legs nest at most this deep, as expressions do.
const DEEPEST: usize = 200;

/// Reads `CONDITION -> OUTPUTS` up to the end, or up to the parenthesis that
/// closes the leg.
pub(super) fn leg(lexer: &mut Lexer<'_>, depth: usize, findings: &mut Vec<Diagnostic>) -> Leg {
    if depth > DEEPEST {
        let rest = rest_of_statement(lexer);
        findings.push(syntax(rest, format!("legs nest deeper than {DEEPEST}")));
        return Leg {
            condition: Condition::NotRead(rest),
            outputs: Vec::new(),
        };
    }
    let condition = condition(lexer, depth, findings);
    let outputs = match lexer.take_if(TokenKind::Arrow) {
        Some(_) => outputs(lexer, depth, findings),
        None => Vec::new(),
    };
    Leg { condition, outputs }
}

/// Reads up to the arrow, which is left. A rung may lack the arrow, a leg may
/// not.
fn condition(lexer: &mut Lexer<'_>, depth: usize, findings: &mut Vec<Diagnostic>) -> Condition {
    let start = lexer.here().range().start;
    let first = lexer.mark();
    let finding = if lexer.peek_kind() == Some(TokenKind::Arrow) {
        expected(lexer, "a condition").help("write `1` for what is always driven: `rung: 1 -> a`")
    } else {
        match expression(lexer) {
            Err(why) => problem(why),
            Ok(node) => match lexer.peek_kind() {
                Some(TokenKind::Arrow) => return Condition::Read(node),
                None if depth == 0 => return Condition::Read(node),
                Some(TokenKind::Open) => expected(lexer, "an operator or `->`").help(
                    "boxes stand behind `->`, and what they give is read as a name, `t1.Q`; \
                     values compare as in `level >= 5`",
                ),
                _ => expected(lexer, "an operator or `->`"),
            },
        }
    };
    findings.push(finding);
    skip_condition(lexer, first, depth);
    Condition::NotRead(lexer.since(start))
}

/// Passes over what is left of a condition that began at the mark `first`: up
/// to the arrow, or the parenthesis that closes the leg.
fn skip_condition(lexer: &mut Lexer<'_>, first: usize, depth: usize) {
    let count = |kind| {
        let taken = lexer.taken_since(first).iter();
        taken.filter(|token| token.kind == kind).count()
    };
    let mut open = count(TokenKind::Open).saturating_sub(count(TokenKind::Close));
    while let Some(kind) = lexer.peek_kind() {
        match kind {
            TokenKind::Arrow => return,
            TokenKind::Close if open == 0 && depth > 0 => return,
            TokenKind::Close => open = open.saturating_sub(1),
            TokenKind::Open => open += 1,
            _ => {}
        }
        lexer.take();
    }
}

fn rest_of_statement(lexer: &mut Lexer<'_>) -> Span {
    let start = lexer.here().range().start;
    while lexer.take().is_some() {}
    lexer.since(start)
}
