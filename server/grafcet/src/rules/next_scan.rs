//! The right side of an environment rule, where `@` speaks of the next scan:
//! `@(tl*as + /ls1)`.

use std::collections::HashMap;

use logic::notation::{Problem, TokenKind, is_literal, one_factor, write, write_factor};
use logic::{Atom, Expr, Name};

use super::clauses::note;
use super::parse::Parser;
use crate::model::renamed_expr;
use crate::{in_next_scan, is_in_next_scan};

/// Right sides nest at most this deep; what is deeper was not written by a
/// person.
const DEEPEST: usize = 100;

/// Reads a right side. Names under `@` come out marked.
pub(crate) fn read(parser: &mut Parser<'_>) -> Result<Expr, Problem> {
    sum(parser, 0)
}

fn sum(parser: &mut Parser<'_>, depth: usize) -> Result<Expr, Problem> {
    list(parser, depth, TokenKind::Plus, product, Expr::Or)
}

fn product(parser: &mut Parser<'_>, depth: usize) -> Result<Expr, Problem> {
    list(parser, depth, TokenKind::Star, factor, Expr::And)
}

fn list(
    parser: &mut Parser<'_>,
    depth: usize,
    operator: TokenKind,
    part: fn(&mut Parser<'_>, usize) -> Result<Expr, Problem>,
    many: fn(Vec<Expr>) -> Expr,
) -> Result<Expr, Problem> {
    let first = part(parser, depth)?;
    if parser.lexer.peek_kind() != Some(operator) {
        return Ok(first);
    }
    let mut parts = vec![first];
    while parser.lexer.take_if(operator).is_some() {
        parts.push(part(parser, depth)?);
    }
    Ok(many(parts))
}

fn factor(parser: &mut Parser<'_>, depth: usize) -> Result<Expr, Problem> {
    if depth > DEEPEST {
        return Err(Problem {
            span: parser.lexer.here(),
            message: format!("expression nests deeper than {DEEPEST}"),
        });
    }
    match parser.lexer.peek_kind() {
        Some(TokenKind::At) => {
            parser.lexer.take();
            plain(parser).map(|expr| marked(&expr))
        }
        Some(TokenKind::Slash) => {
            parser.lexer.take();
            factor(parser, depth + 1).map(Expr::complement)
        }
        Some(TokenKind::Open) => {
            parser.lexer.take();
            let inner = sum(parser, depth + 1)?;
            match parser.lexer.take_if(TokenKind::Close) {
                Some(_) => Ok(inner),
                None => Err(parser.expected("`)` or an operator")),
            }
        }
        _ => plain(parser),
    }
}

/// A factor without `@`.
fn plain(parser: &mut Parser<'_>) -> Result<Expr, Problem> {
    let node = one_factor(&mut parser.lexer)?;
    let mut problem = None;
    node.each_name(&mut |name, span| {
        if is_in_next_scan(name).is_some() {
            problem = Some(Problem {
                span,
                message: "expected a name that does not begin with `@`".to_owned(),
            });
        }
    });
    note(parser, &node);
    problem.map_or_else(|| Ok(node.to_expr()), Err)
}

/// Prints a right side so that reading it gives it back. A part that speaks
/// of the next scan alone has one `@` before it.
pub(crate) fn print(expr: &Expr) -> String {
    print_in(expr, Around::Nothing)
}

/// What stands around a printed part.
#[derive(Clone, Copy, PartialEq)]
enum Around {
    Nothing,
    Sum,
    Product,
}

fn print_in(expr: &Expr, around: Around) -> String {
    match (scan(expr), expr) {
        (Scan::This, _) if around == Around::Nothing => write(expr),
        (Scan::This, _) => write_factor(expr),
        (_, Expr::Not(inner)) if !matches!(**inner, Expr::Atom(Atom::Comparison(_))) => {
            format!("/{}", print_in(inner, Around::Product))
        }
        (Scan::Both, Expr::And(parts)) => {
            joined(parts, "*", Around::Product, around == Around::Product)
        }
        (Scan::Both, Expr::Or(parts)) => {
            joined(parts, " + ", Around::Sum, around != Around::Nothing)
        }
        _ => format!("@{}", write_factor(&unmarked(expr))),
    }
}

fn joined(parts: &[Expr], sign: &str, inside: Around, enclosed: bool) -> String {
    let parts: Vec<String> = parts.iter().map(|part| print_in(part, inside)).collect();
    let text = parts.join(sign);
    match enclosed {
        true => format!("({text})"),
        false => text,
    }
}

/// Which scans an expression speaks of.
#[derive(Clone, Copy, PartialEq)]
enum Scan {
    This,
    Next,
    Both,
}

fn scan(expr: &Expr) -> Scan {
    let (mut this, mut next) = (false, false);
    each_name(expr, &mut |name| match is_in_next_scan(name) {
        Some(_) => next = true,
        None => this = true,
    });
    match (this, next) {
        (true, true) => Scan::Both,
        (false, true) => Scan::Next,
        (_, false) => Scan::This,
    }
}

/// `expr` with all its names marked as those of the next scan.
fn marked(expr: &Expr) -> Expr {
    let mut names = HashMap::new();
    each_name(expr, &mut |name| {
        names.insert(name.clone(), in_next_scan(name));
    });
    renamed_expr(expr, &names)
}

/// `expr` with the marks taken off.
fn unmarked(expr: &Expr) -> Expr {
    let mut names = HashMap::new();
    each_name(expr, &mut |name| {
        if let Some(plain) = is_in_next_scan(name) {
            names.insert(name.clone(), Name::from(plain));
        }
    });
    renamed_expr(expr, &names)
}

/// Calls `visit` with every name, those inside edges included.
fn each_name(expr: &Expr, visit: &mut dyn FnMut(&Name)) {
    expr.each_atom(&mut |atom| match atom {
        Atom::Variable(name) => visit(name),
        Atom::Comparison(comparison) => {
            for side in [&comparison.left, &comparison.right] {
                if !is_literal(side) {
                    visit(side);
                }
            }
        }
        Atom::Rise(inner) | Atom::Fall(inner) => each_name(inner, visit),
        Atom::Elapsed { step, .. } => visit(step),
    });
}
