//! Values that comparisons and assignments read: a variable, a number, or a
//! sum of both.

use logic::Datum;
use logic::notation::{Lexer, TokenKind};

use super::condition::View;

/// What stands for a value.
#[derive(Clone, Debug, PartialEq)]
pub enum Operand {
    /// A number.
    Constant(Datum),
    /// A variable.
    Variable(usize),
    /// A step's variable, 0 or 1.
    Step(usize),
}

impl Operand {
    pub(super) fn value(&self, view: &View<'_>) -> Datum {
        match *self {
            Self::Constant(value) => value,
            Self::Variable(at) => view.value(at),
            Self::Step(at) => view.is_active(at).into(),
        }
    }
}

/// A sum such as `C + 1`, the value of an assignment.
#[derive(Clone, Debug, PartialEq)]
pub struct Term(Vec<Summand>);

#[derive(Clone, Debug, PartialEq)]
struct Summand {
    is_subtracted: bool,
    /// `-3`, whatever stands before it.
    is_negative: bool,
    operand: Operand,
}

impl Term {
    /// Reads what the rule text allows: numbers and names with `+` and `-`
    /// between. What is anything else is one variable of that name, which
    /// nobody but the machine's owner writes.
    pub(super) fn read(text: &str, mut operand: impl FnMut(&str) -> Operand) -> Self {
        match summands(text, &mut operand) {
            Some(summands) => Self(summands),
            None => Self(vec![Summand {
                is_subtracted: false,
                is_negative: false,
                operand: operand(text),
            }]),
        }
    }

    pub(super) fn value(&self, view: &View<'_>) -> Datum {
        let mut operands = self.0.iter();
        self.sum(|| {
            operands
                .next()
                .map_or(Datum::default(), |it| it.operand.value(view))
        })
    }

    /// The operands, in their order.
    pub fn operands(&self) -> impl Iterator<Item = &Operand> {
        self.0.iter().map(|part| &part.operand)
    }

    /// The operand whose value it is as it is, if it is one.
    pub fn copied(&self) -> Option<&Operand> {
        match self.0.as_slice() {
            [only] if !only.is_negative => Some(&only.operand),
            _ => None,
        }
    }

    /// The value, where `next` gives that of each operand in turn.
    pub fn sum(&self, mut next: impl FnMut() -> Datum) -> Datum {
        let mut values = self.0.iter().map(|part| {
            let value = next();
            let value = match part.is_negative {
                true => minus(Datum::Integer(0), value),
                false => value,
            };
            (part.is_subtracted, value)
        });
        let first = values.next().map_or(Datum::default(), |(_, value)| value);
        values.fold(first, |sum, (is_subtracted, value)| match is_subtracted {
            true => minus(sum, value),
            false => sum.combine(value, i64::wrapping_add, |a, b| a + b),
        })
    }
}

fn minus(left: Datum, right: Datum) -> Datum {
    left.combine(right, i64::wrapping_sub, |a, b| a - b)
}

fn summands(text: &str, operand: &mut impl FnMut(&str) -> Operand) -> Option<Vec<Summand>> {
    let mut lexer = Lexer::new(text);
    let mut summands = Vec::new();
    let mut is_subtracted = false;
    loop {
        let is_negative = lexer.take_if(TokenKind::Minus).is_some();
        let token = lexer.take()?;
        let operand = match token.kind {
            TokenKind::Number | TokenKind::Time => {
                Operand::Constant(Datum::constant(token.text(text))?)
            }
            TokenKind::Name | TokenKind::Quoted => operand(token.name(text)),
            _ => return None,
        };
        summands.push(Summand {
            is_subtracted,
            is_negative,
            operand,
        });
        is_subtracted = match lexer.take() {
            None => return Some(summands),
            Some(sign) if sign.kind == TokenKind::Plus => false,
            Some(sign) if sign.kind == TokenKind::Minus => true,
            Some(_) => return None,
        };
    }
}
