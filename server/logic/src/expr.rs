use std::sync::Arc;

use crate::notation::milliseconds;

/// A variable's name, shared by everything that mentions it.
pub type Name = Arc<str>;

/// What a Boolean expression is made of: something that is true or false by
/// itself.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Atom {
    /// A Boolean variable: an input, a coil, `T1.Q`, a step variable.
    Variable(Name),
    /// A comparison of two values: `Level > 50`.
    Comparison(Comparison),
    /// True in the one scan in which the expression becomes true.
    Rise(Box<Expr>),
    /// True in the one scan in which the expression becomes false.
    Fall(Box<Expr>),
    /// The step has been active for at least this long, `5s/X3` (IEC 60848,
    /// 4.8.4). The time is kept as it was written.
    Elapsed {
        /// The time, such as `5s`.
        time: Name,
        /// The step variable, such as `X3`.
        step: Name,
    },
}

/// A comparison of two values, each a name, a number or an arithmetic term in
/// its source's notation.
///
/// Only `=`, `<` and `>` occur: the other relations are the complements of
/// these, so that `a <= b` and `a > b` are one atom and its complement. Make
/// one with [`Expr::comparison`], which sees to it.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Comparison {
    /// Left side.
    pub left: Name,
    /// `=`, `<` or `>`.
    pub relation: Relation,
    /// Right side; the number, if one side is a number.
    pub right: Name,
}

/// How two values compare.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Relation {
    /// `=`
    Equal,
    /// `<>`
    NotEqual,
    /// `<`
    Less,
    /// `<=`
    LessOrEqual,
    /// `>`
    Greater,
    /// `>=`
    GreaterOrEqual,
}

impl Relation {
    /// The sign in the notation.
    pub fn sign(self) -> &'static str {
        match self {
            Self::Equal => "=",
            Self::NotEqual => "<>",
            Self::Less => "<",
            Self::LessOrEqual => "<=",
            Self::Greater => ">",
            Self::GreaterOrEqual => ">=",
        }
    }

    /// The relation that holds exactly when this one does not.
    pub fn complement(self) -> Self {
        match self {
            Self::Equal => Self::NotEqual,
            Self::NotEqual => Self::Equal,
            Self::Less => Self::GreaterOrEqual,
            Self::LessOrEqual => Self::Greater,
            Self::Greater => Self::LessOrEqual,
            Self::GreaterOrEqual => Self::Less,
        }
    }

    /// The relation with its sides exchanged: `a < b` is `b > a`.
    pub fn mirrored(self) -> Self {
        match self {
            Self::Equal => Self::Equal,
            Self::NotEqual => Self::NotEqual,
            Self::Less => Self::Greater,
            Self::LessOrEqual => Self::GreaterOrEqual,
            Self::Greater => Self::Less,
            Self::GreaterOrEqual => Self::LessOrEqual,
        }
    }

    /// Whether the relation holds between two numbers.
    pub fn holds<T: PartialOrd>(self, left: T, right: T) -> bool {
        match self {
            Self::Equal => left == right,
            Self::NotEqual => left != right,
            Self::Less => left < right,
            Self::LessOrEqual => left <= right,
            Self::Greater => left > right,
            Self::GreaterOrEqual => left >= right,
        }
    }
}

/// A Boolean expression, as written.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Expr {
    /// `0` or `1`.
    Constant(bool),
    /// A variable, comparison, edge or time.
    Atom(Atom),
    /// `/a`
    Not(Box<Expr>),
    /// `a*b*c`; true when empty.
    And(Vec<Expr>),
    /// `a + b + c`; false when empty.
    Or(Vec<Expr>),
}

impl Expr {
    /// The variable called `name`.
    pub fn variable(name: impl Into<Name>) -> Self {
        Self::Atom(Atom::Variable(name.into()))
    }

    /// The complement; a double one cancels.
    #[must_use]
    pub fn complement(self) -> Self {
        match self {
            Self::Not(inner) => *inner,
            Self::Constant(value) => Self::Constant(!value),
            other => Self::Not(Box::new(other)),
        }
    }

    /// `left relation right` in its one canonical form: a number stands on
    /// the right, two names stand in alphabetical order, and only `=`, `<`,
    /// `>` are atoms. Two numbers compare at once.
    pub fn comparison(left: &str, relation: Relation, right: &str) -> Self {
        let numbers = (number(left), number(right));
        if let (Some(left), Some(right)) = numbers {
            return Self::Constant(relation.holds(left, right));
        }
        let exchange = match numbers {
            (Some(_), None) => true,
            (None, Some(_)) => false,
            _ => right < left,
        };
        let (left, relation, right) = if exchange {
            (right, relation.mirrored(), left)
        } else {
            (left, relation, right)
        };
        let positive = matches!(
            relation,
            Relation::Equal | Relation::Less | Relation::Greater
        );
        let atom = Self::Atom(Atom::Comparison(Comparison {
            left: left.into(),
            relation: if positive {
                relation
            } else {
                relation.complement()
            },
            right: right.into(),
        }));
        if positive { atom } else { atom.complement() }
    }

    /// Calls `visit` with every atom, from left to right, edges' insides
    /// excluded.
    pub fn each_atom<'e>(&'e self, visit: &mut impl FnMut(&'e Atom)) {
        match self {
            Self::Constant(_) => {}
            Self::Atom(atom) => visit(atom),
            Self::Not(inner) => inner.each_atom(visit),
            Self::And(parts) | Self::Or(parts) => {
                parts.iter().for_each(|part| part.each_atom(visit));
            }
        }
    }
}

/// The number that a term writes, if it is one: `5`, `-2.5`, `16#F000`,
/// `2#1010`, digits grouped by `_`; a time counts its milliseconds.
fn number(term: &str) -> Option<f64> {
    if let Some(time) = milliseconds(term) {
        return Some(time as f64);
    }
    let plain: String = term.trim().chars().filter(|&c| c != '_').collect();
    if let Some((base, digits)) = plain.split_once('#') {
        let base = base.parse().ok().filter(|base| (2..=36).contains(base))?;
        return i64::from_str_radix(digits, base).ok().map(|n| n as f64);
    }
    if !plain.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '-' | '+' | '.')) {
        return None;
    }
    plain.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_comparison_has_one_form() {
        let same = |a: (&str, Relation, &str), b: (&str, Relation, &str)| {
            assert_eq!(
                Expr::comparison(a.0, a.1, a.2),
                Expr::comparison(b.0, b.1, b.2)
            );
        };
        same(
            ("0", Relation::Equal, "Index"),
            ("Index", Relation::Equal, "0"),
        );
        same(("b", Relation::Less, "a"), ("a", Relation::Greater, "b"));
        assert_eq!(
            Expr::comparison("Index", Relation::LessOrEqual, "4"),
            Expr::comparison("Index", Relation::Greater, "4").complement()
        );
        assert_eq!(
            Expr::comparison("16#0A", Relation::Equal, "10"),
            Expr::Constant(true)
        );
    }
}
