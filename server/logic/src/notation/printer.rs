use std::fmt::{self, Display, Formatter};

use super::{Lexer, TokenKind};
use crate::{Atom, Expr};

/// Prints an expression so that reading it gives the expression back: no
/// blanks in a product, one on each side of `+`.
pub fn write(expr: &Expr) -> String {
    expr.to_string()
}

/// Prints an expression as a factor of a product: a sum, a product or a
/// comparison stands in parentheses.
pub fn write_factor(expr: &Expr) -> String {
    struct Factor<'e>(&'e Expr);
    impl Display for Factor<'_> {
        fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
            print(self.0, Binding::Complement, f)
        }
    }
    Factor(expr).to_string()
}

/// A name as the notation writes it: in double quotes where it holds more
/// than letters, digits, `_`, `.` and a leading `%`, or would read as
/// something else.
pub fn quoted(name: &str) -> String {
    let lexer = Lexer::new(name);
    let plain = lexer
        .peek()
        .is_some_and(|token| token.kind == TokenKind::Name && token.span.len() == name.len());
    if plain {
        name.to_owned()
    } else {
        // A quote cannot stand inside quotes; no format has names with one.
        format!("\"{}\"", name.replace(['"', '\r', '\n'], "'"))
    }
}

#[derive(Clone, Copy, PartialEq, PartialOrd)]
enum Binding {
    Sum,
    Product,
    Complement,
}

impl Display for Expr {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        print(self, Binding::Sum, f)
    }
}

impl Display for Atom {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Variable(name) => f.write_str(&quoted(name)),
            Self::Comparison(c) => {
                write!(
                    f,
                    "{} {} {}",
                    quoted_value(&c.left),
                    c.relation.sign(),
                    quoted_value(&c.right)
                )
            }
            Self::Rise(inner) => write!(f, "rise({inner})"),
            Self::Fall(inner) => write!(f, "fall({inner})"),
            Self::Elapsed { time, step } => write!(f, "{time}/{}", quoted(step)),
        }
    }
}

/// A side of a comparison as the notation writes it: numbers and times as they
/// are, names in quotes where needed.
pub fn quoted_value(side: &str) -> String {
    if is_literal(side) {
        side.to_owned()
    } else {
        quoted(side)
    }
}

/// Whether a side of a comparison is a number or a time, not a name.
pub fn is_literal(side: &str) -> bool {
    let digits = side.strip_prefix('-').unwrap_or(side);
    Lexer::new(digits).peek().is_some_and(|token| {
        token.span.len() == digits.len()
            && (token.kind == TokenKind::Number
                || token.kind == TokenKind::Time && digits.len() == side.len())
    })
}

fn print(expr: &Expr, around: Binding, f: &mut Formatter<'_>) -> fmt::Result {
    match expr {
        Expr::Constant(value) => f.write_str(if *value { "1" } else { "0" }),
        // A comparison binds loosely for the eye: keep it apart in a product.
        Expr::Atom(atom @ Atom::Comparison(_)) if around > Binding::Sum => write!(f, "({atom})"),
        Expr::Atom(atom) => write!(f, "{atom}"),
        Expr::Not(inner) => match &**inner {
            Expr::Atom(Atom::Comparison(c)) => {
                let mut complement = c.clone();
                complement.relation = c.relation.complement();
                let atom = Atom::Comparison(complement);
                if around > Binding::Sum {
                    write!(f, "({atom})")
                } else {
                    write!(f, "{atom}")
                }
            }
            Expr::Not(_) => {
                f.write_str("/(")?;
                print(inner, Binding::Sum, f)?;
                f.write_str(")")
            }
            _ => {
                f.write_str("/")?;
                print(inner, Binding::Complement, f)
            }
        },
        Expr::And(parts) => joined(parts, "*", "1", Binding::Product, around, f),
        Expr::Or(parts) => joined(parts, " + ", "0", Binding::Sum, around, f),
    }
}

fn joined(
    parts: &[Expr],
    sign: &str,
    empty: &str,
    binding: Binding,
    around: Binding,
    f: &mut Formatter<'_>,
) -> fmt::Result {
    match parts {
        [] => return f.write_str(empty),
        [only] => return print(only, around, f),
        _ => {}
    }
    // A sum inside a sum, or a product inside a product, keeps its own
    // parentheses, so that reading gives the same tree.
    let inner = match binding {
        Binding::Sum => Binding::Product,
        _ => Binding::Complement,
    };
    let enclosed = around > binding;
    if enclosed {
        f.write_str("(")?;
    }
    for (at, part) in parts.iter().enumerate() {
        if at > 0 {
            f.write_str(sign)?;
        }
        let comparison_in_sum = binding == Binding::Sum && is_comparison(part);
        print(
            part,
            if comparison_in_sum {
                Binding::Sum
            } else {
                inner
            },
            f,
        )?;
    }
    if enclosed {
        f.write_str(")")?;
    }
    Ok(())
}

fn is_comparison(expr: &Expr) -> bool {
    match expr {
        Expr::Atom(Atom::Comparison(_)) => true,
        Expr::Not(inner) => matches!(&**inner, Expr::Atom(Atom::Comparison(_))),
        _ => false,
    }
}
