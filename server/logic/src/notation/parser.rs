use source::Span;

use super::printer::is_literal;
use super::{Lexer, Token, TokenKind};
use crate::{Atom, Expr, Name, Relation};

/// A part of an expression with the bytes it was written in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Node {
    /// The whole part, parentheses around it left out.
    pub span: Span,
    /// What it is.
    pub kind: NodeKind,
}

/// What a part of an expression is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NodeKind {
    /// `0` or `1`
    Constant(bool),
    /// A name.
    Variable(Name),
    /// `left relation right`; each side a name or number with its place.
    Comparison {
        /// Left side.
        left: (Name, Span),
        /// The sign.
        relation: Relation,
        /// Right side.
        right: (Name, Span),
    },
    /// `rise(a)`
    Rise(Box<Node>),
    /// `fall(a)`
    Fall(Box<Node>),
    /// `5s/X3`
    Elapsed {
        /// The time.
        time: Name,
        /// The step variable.
        step: Name,
        /// Where the step variable stands.
        step_span: Span,
    },
    /// `/a`
    Not(Box<Node>),
    /// `a*b`
    And(Vec<Node>),
    /// `a + b`
    Or(Vec<Node>),
}

/// Why an expression could not be read: where, and what would have been right.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// Where.
    pub span: Span,
    /// What was expected, and what stands there.
    pub message: String,
}

impl Node {
    /// The expression without its places.
    pub fn to_expr(&self) -> Expr {
        match &self.kind {
            NodeKind::Constant(value) => Expr::Constant(*value),
            NodeKind::Variable(name) => Expr::variable(name.clone()),
            NodeKind::Comparison {
                left,
                relation,
                right,
            } => Expr::comparison(&left.0, *relation, &right.0),
            NodeKind::Rise(inner) => Expr::Atom(Atom::Rise(Box::new(inner.to_expr()))),
            NodeKind::Fall(inner) => Expr::Atom(Atom::Fall(Box::new(inner.to_expr()))),
            NodeKind::Elapsed { time, step, .. } => Expr::Atom(Atom::Elapsed {
                time: time.clone(),
                step: step.clone(),
            }),
            NodeKind::Not(inner) => inner.to_expr().complement(),
            NodeKind::And(parts) => Expr::And(parts.iter().map(Node::to_expr).collect()),
            NodeKind::Or(parts) => Expr::Or(parts.iter().map(Node::to_expr).collect()),
        }
    }

    /// Calls `visit` with every name and its place, from left to right,
    /// numbers and times excluded.
    pub fn each_name<'n>(&'n self, visit: &mut impl FnMut(&'n Name, Span)) {
        match &self.kind {
            NodeKind::Constant(_) => {}
            NodeKind::Variable(name) => visit(name, self.span),
            NodeKind::Comparison { left, right, .. } => {
                for (name, span) in [left, right] {
                    if !is_literal(name) {
                        visit(name, *span);
                    }
                }
            }
            NodeKind::Elapsed {
                step, step_span, ..
            } => visit(step, *step_span),
            NodeKind::Rise(inner) | NodeKind::Fall(inner) | NodeKind::Not(inner) => {
                inner.each_name(visit);
            }
            NodeKind::And(parts) | NodeKind::Or(parts) => {
                parts.iter().for_each(|part| part.each_name(visit));
            }
        }
    }
}

/// Reads a text that holds one expression and nothing else.
pub fn parse(text: &str) -> Result<Expr, Problem> {
    let mut lexer = Lexer::new(text);
    let node = expression(&mut lexer)?;
    lexer.skip_blank();
    match lexer.peek() {
        None => Ok(node.to_expr()),
        Some(_) => Err(unexpected(&lexer, "an operator or the end")),
    }
}

/// Expressions nest at most this deep; what is deeper was not written by a
/// person and would exhaust the stack.
const DEEPEST: usize = 200;

/// Reads an expression at the lexer's place. On failure the lexer stands at
/// the token that did not fit.
pub fn expression(lexer: &mut Lexer<'_>) -> Result<Node, Problem> {
    sum(lexer, 0)
}

/// Reads one factor at the lexer's place: what may stand between two `*`.
/// For grammars with operators of their own around it, as `@` in a rule about
/// the next scan.
pub fn one_factor(lexer: &mut Lexer<'_>) -> Result<Node, Problem> {
    factor(lexer, 0)
}

fn sum(lexer: &mut Lexer<'_>, depth: usize) -> Result<Node, Problem> {
    list(lexer, depth, TokenKind::Plus, product, NodeKind::Or)
}

fn product(lexer: &mut Lexer<'_>, depth: usize) -> Result<Node, Problem> {
    list(lexer, depth, TokenKind::Star, factor, NodeKind::And)
}

fn list(
    lexer: &mut Lexer<'_>,
    depth: usize,
    operator: TokenKind,
    part: fn(&mut Lexer<'_>, usize) -> Result<Node, Problem>,
    many: fn(Vec<Node>) -> NodeKind,
) -> Result<Node, Problem> {
    let start = lexer.here().range().start;
    let first = part(lexer, depth)?;
    if lexer.peek_kind() != Some(operator) {
        return Ok(first);
    }
    let mut parts = vec![first];
    while lexer.take_if(operator).is_some() {
        parts.push(part(lexer, depth)?);
    }
    Ok(Node {
        span: lexer.since(start),
        kind: many(parts),
    })
}

fn factor(lexer: &mut Lexer<'_>, depth: usize) -> Result<Node, Problem> {
    if depth > DEEPEST {
        return Err(Problem {
            span: lexer.here(),
            message: format!("expression nests deeper than {DEEPEST}"),
        });
    }
    let Some(token) = lexer.peek() else {
        return Err(unexpected(lexer, "a name, `/` or `(`"));
    };
    match token.kind {
        TokenKind::Slash => {
            lexer.take();
            let inner = factor(lexer, depth + 1)?;
            Ok(Node {
                span: lexer.since(token.span.range().start),
                kind: NodeKind::Not(Box::new(inner)),
            })
        }
        TokenKind::Caret => {
            lexer.take();
            let inner = factor(lexer, depth + 1)?;
            Ok(Node {
                span: lexer.since(token.span.range().start),
                kind: NodeKind::Rise(Box::new(inner)),
            })
        }
        TokenKind::Open => {
            lexer.take();
            let inner = sum(lexer, depth + 1)?;
            closing(lexer)?;
            Ok(inner)
        }
        TokenKind::Time => elapsed(lexer, token),
        TokenKind::Name if is_edge(lexer, token) => edge(lexer, token, depth),
        TokenKind::Name | TokenKind::Quoted | TokenKind::Number | TokenKind::Minus => {
            operand(lexer)
        }
        _ => Err(unexpected(lexer, "a name, `/` or `(`")),
    }
}

fn is_edge(lexer: &Lexer<'_>, token: Token) -> bool {
    matches!(token.text(lexer.text()), "rise" | "fall") && lexer.peek_at(1) == Some(TokenKind::Open)
}

fn edge(lexer: &mut Lexer<'_>, word: Token, depth: usize) -> Result<Node, Problem> {
    let rising = word.text(lexer.text()) == "rise";
    lexer.take();
    lexer.take();
    let inner = Box::new(sum(lexer, depth + 1)?);
    let close = closing(lexer)?;
    Ok(Node {
        span: word.span.cover(close.span),
        kind: if rising {
            NodeKind::Rise(inner)
        } else {
            NodeKind::Fall(inner)
        },
    })
}

fn closing(lexer: &mut Lexer<'_>) -> Result<Token, Problem> {
    lexer
        .take_if(TokenKind::Close)
        .ok_or_else(|| unexpected(lexer, "`)` or an operator"))
}

fn elapsed(lexer: &mut Lexer<'_>, time: Token) -> Result<Node, Problem> {
    lexer.take();
    if lexer.take_if(TokenKind::Slash).is_none() {
        return Err(unexpected(lexer, "`/` and a step, as in `5s/X3`"));
    }
    let text = lexer.text();
    match lexer.peek() {
        Some(step) if matches!(step.kind, TokenKind::Name | TokenKind::Quoted) => {
            lexer.take();
            Ok(Node {
                span: time.span.cover(step.span),
                kind: NodeKind::Elapsed {
                    time: time.text(text).into(),
                    step: step.name(text).into(),
                    step_span: step.span,
                },
            })
        }
        _ => Err(unexpected(lexer, "the name of a step")),
    }
}

/// A name, a constant, or a comparison that begins with either.
fn operand(lexer: &mut Lexer<'_>) -> Result<Node, Problem> {
    let (left, left_span, is_number) = value(lexer)?;
    if let Some(relation) = lexer.peek_kind().and_then(relation) {
        lexer.take();
        let (right, right_span) = right_side(lexer)?;
        return Ok(Node {
            span: left_span.cover(right_span),
            kind: NodeKind::Comparison {
                left: (left, left_span),
                relation,
                right: (right, right_span),
            },
        });
    }
    let kind = match (&*left, is_number) {
        ("0", true) => NodeKind::Constant(false),
        ("1", true) => NodeKind::Constant(true),
        (_, true) => return Err(unexpected(lexer, "a comparison after the number")),
        _ => NodeKind::Variable(left),
    };
    Ok(Node {
        span: left_span,
        kind,
    })
}

/// What stands right of a relation: a value, or a time as in `t1.ET > 5s`.
fn right_side(lexer: &mut Lexer<'_>) -> Result<(Name, Span), Problem> {
    if let Some(time) = lexer.take_if(TokenKind::Time) {
        return Ok((time.text(lexer.text()).into(), time.span));
    }
    value(lexer).map(|(name, span, _)| (name, span))
}

fn value(lexer: &mut Lexer<'_>) -> Result<(Name, Span, bool), Problem> {
    let text = lexer.text();
    let Some(token) = lexer.peek() else {
        return Err(unexpected(lexer, "a name or a number"));
    };
    match token.kind {
        TokenKind::Name | TokenKind::Quoted => {
            lexer.take();
            Ok((token.name(text).into(), token.span, false))
        }
        TokenKind::Number => {
            lexer.take();
            Ok((token.text(text).into(), token.span, true))
        }
        TokenKind::Minus if lexer.peek_at(1) == Some(TokenKind::Number) => {
            lexer.take();
            let digits = lexer.take().unwrap_or(token);
            let name = format!("-{}", digits.text(text));
            Ok((name.into(), token.span.cover(digits.span), true))
        }
        _ => Err(unexpected(lexer, "a name or a number")),
    }
}

fn relation(kind: TokenKind) -> Option<Relation> {
    Some(match kind {
        TokenKind::Equal => Relation::Equal,
        TokenKind::NotEqual => Relation::NotEqual,
        TokenKind::Less => Relation::Less,
        TokenKind::LessOrEqual => Relation::LessOrEqual,
        TokenKind::Greater => Relation::Greater,
        TokenKind::GreaterOrEqual => Relation::GreaterOrEqual,
        _ => return None,
    })
}

fn unexpected(lexer: &Lexer<'_>, expected: &str) -> Problem {
    Problem {
        span: lexer.here(),
        message: format!("expected {expected}, found {}", lexer.found()),
    }
}
