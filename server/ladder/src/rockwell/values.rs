//! Instructions that compute: what they write, and what `CMP` compares.

use std::ops::Range;

use logic::Relation;

use super::boxes::pin;
use super::catalogue::Meaning;
use super::neutral::Instruction;
use super::operand::{self, Token};
use super::rung::Drawing;
use crate::{
    Assignment, Block, Comparison, ElementKind, Familiarity, Operand, PinDirection, Value,
};

impl Drawing<'_, '_, '_> {
    /// `CMP(expression)`: a comparison where it compares two plain values, else
    /// a box that decides by what it reads.
    pub(super) fn compare_expression(&mut self, it: &Instruction, mnemonic: &str) -> ElementKind {
        let range = whole(&it.operands, 0);
        let tokens = self.tokens(&range);
        if let Some((left, relation, right)) = self.plain_comparison(&tokens)
            && let (Some(left), Some(right)) = (self.operand_at(left), self.operand_at(right))
        {
            return ElementKind::Comparison(Comparison {
                left,
                relation,
                right,
            });
        }
        let reads = self.tags(&tokens);
        let pins = reads
            .into_iter()
            .map(|operand| pin(None, PinDirection::Input, Some(operand)))
            .collect();
        ElementKind::Block(Block {
            name: mnemonic.into(),
            instance: None,
            pins,
            familiarity: Familiarity::Known,
            shapes_power: true,
        })
    }

    fn plain_comparison(&self, tokens: &[Token]) -> Option<(Range<usize>, Relation, Range<usize>)> {
        let sign_at = tokens
            .iter()
            .position(|token| relation(self.text(&token.place())).is_some())?;
        let (left, rest) = tokens.split_at(sign_at);
        let (sign, right) = rest.split_first()?;
        let relation = relation(self.text(&sign.place()))?;
        Some((self.plain_value(left)?, relation, self.plain_value(right)?))
    }

    /// The place of a tag or constant that is all of `tokens`.
    fn plain_value(&self, tokens: &[Token]) -> Option<Range<usize>> {
        match tokens {
            [Token::Tag(place) | Token::Constant(place)] => Some(place.clone()),
            [Token::Sign(sign), Token::Constant(number)] if self.text(sign) == "-" => {
                Some(sign.start..number.end)
            }
            _ => None,
        }
    }

    /// The pieces of the expression at `range`.
    pub(super) fn tokens(&self, range: &Range<usize>) -> Vec<Token> {
        operand::tokens(self.place.text.text(), range.clone()).collect()
    }

    /// The tags among the pieces of an expression.
    pub(super) fn tags(&mut self, tokens: &[Token]) -> Vec<Operand> {
        tokens
            .iter()
            .filter_map(|token| match token {
                Token::Tag(place) => self.operand_at(place.clone()),
                _ => None,
            })
            .collect()
    }

    pub(super) fn assignment(
        &mut self,
        it: &Instruction,
        meaning: Meaning,
        mnemonic: &str,
    ) -> ElementKind {
        let (target, value) = match meaning {
            Meaning::Clear => (self.operand(it, 0), Value::Constant(0)),
            Meaning::Compute => {
                let target = self.operand(it, 0);
                let value = self.computed(whole(&it.operands, 1), &target);
                (target, value)
            }
            Meaning::Binary(sign) => {
                let target = self.operand(it, 2);
                let left = it.operands.first().cloned().unwrap_or_default();
                let right = it.operands.get(1).cloned().unwrap_or_default();
                let value = self.sum_or_term(left, sign, right, &target);
                (target, value)
            }
            Meaning::Unary(function) => {
                let target = self.operand(it, 1);
                let value = self.function(function, it.operands.first().cloned());
                (target, value)
            }
            _ => {
                let target = self.operand(it, 1);
                let value =
                    self.computed(it.operands.first().cloned().unwrap_or_default(), &target);
                (target, value)
            }
        };
        ElementKind::Assign(Assignment {
            target,
            value,
            mnemonic: mnemonic.into(),
        })
    }

    /// The value of the expression at `range`, written to `target`.
    fn computed(&mut self, range: Range<usize>, target: &Operand) -> Value {
        let tokens = self.tokens(&range);
        if let Some(place) = self.plain_value(&tokens) {
            if let Some(number) = operand::integer(self.text(&place)) {
                return Value::Constant(number);
            }
            if let ([Token::Tag(_)], Some(operand)) = (&tokens[..], self.operand_at(place)) {
                return Value::Copy(operand);
            }
        }
        if let [left, Token::Sign(sign), right] = &tokens[..]
            && !matches!(left, Token::Sign(_))
        {
            let sign = self.text(sign).to_owned();
            return self.sum_or_term(left.place(), &sign, right.place(), target);
        }
        self.term(range, &tokens)
    }

    fn sum_or_term(
        &mut self,
        left: Range<usize>,
        sign: &str,
        right: Range<usize>,
        target: &Operand,
    ) -> Value {
        let numbers = [&left, &right].map(|side| operand::integer(self.text(side)));
        let mut is_target = |side: &Range<usize>| {
            self.operand_at(side.clone())
                .is_some_and(|operand| operand.name == target.name)
        };
        match (sign, numbers) {
            ("+", [_, Some(number)]) if is_target(&left) => return Value::Increment(number),
            ("+", [Some(number), _]) if is_target(&right) => return Value::Increment(number),
            ("-", [_, Some(number)]) if is_target(&left) => {
                return Value::Increment(number.saturating_neg());
            }
            _ => {}
        }
        let mut tokens = self.tokens(&left);
        tokens.extend(self.tokens(&right));
        let [left, right] = [left, right].map(|side| self.expression(&side));
        Value::Term {
            text: format!("{left} {sign} {right}").into(),
            reads: self.tags(&tokens),
        }
    }

    fn function(&mut self, function: &str, argument: Option<Range<usize>>) -> Value {
        let range = argument.unwrap_or_default();
        let tokens = self.tokens(&range);
        Value::Term {
            text: format!("{function}({})", self.expression(&range)).into(),
            reads: self.tags(&tokens),
        }
    }

    fn term(&mut self, range: Range<usize>, tokens: &[Token]) -> Value {
        Value::Term {
            text: self.expression(&range).into(),
            reads: self.tags(tokens),
        }
    }

    fn expression(&mut self, range: &Range<usize>) -> String {
        let place = self.place;
        let text = place.text.text().get(range.clone()).unwrap_or_default();
        let span = place.text.span(range.clone());
        self.names.canonical_expression(place.scope, text, span)
    }
}

/// All operands from `first` on as one place: an expression is the last
/// operand, and commas in it that stand in no parentheses are its own.
fn whole(operands: &[Range<usize>], first: usize) -> Range<usize> {
    match (operands.get(first), operands.last()) {
        (Some(begin), Some(end)) => begin.start..end.end,
        _ => 0..0,
    }
}

fn relation(sign: &str) -> Option<Relation> {
    Some(match sign {
        "=" => Relation::Equal,
        "<>" => Relation::NotEqual,
        "<" => Relation::Less,
        "<=" => Relation::LessOrEqual,
        ">" => Relation::Greater,
        ">=" => Relation::GreaterOrEqual,
        _ => return None,
    })
}
