//! In which range a number from the plant is whose very value counts too.
//!
//! What is computed with such a number is not followed. What it is compared with
//! is: a value for each range stands for it there, and is what the interpreters
//! are given when a difference is run.

use std::collections::HashMap;

use logic::{Datum, Relation};
use proof::{Netlist, Signal};

use crate::value::Value;

/// A number that is not followed but for the range that it is in.
#[derive(Clone, Debug)]
pub(crate) struct Ranged {
    /// A value for each range.
    pub(crate) value: Value,
    /// The constants that tell the ranges apart.
    pub(crate) compared: Vec<Datum>,
}

/// The ranges of numbers that are not followed, by the numbers of the unknowns.
#[derive(Clone, Debug, Default)]
pub(crate) struct Ranges(HashMap<usize, Ranged>);

impl Ranges {
    pub(crate) fn insert(&mut self, unknown: usize, ranged: Ranged) {
        self.0.insert(unknown, ranged);
    }

    /// What can stand for a value where it is compared with this constant: a value
    /// for each range, if these tell apart what is needed.
    pub(crate) fn of(&self, value: &Value, constant: Datum) -> Option<&Value> {
        let Value::Unknown(number) = value else {
            return None;
        };
        let ranged = self.0.get(number)?;
        let mut compared = ranged.compared.iter();
        let is_told_apart = compared.any(|it| it.key() == constant.key());
        is_told_apart.then_some(&ranged.value)
    }

    /// When a value is on.
    pub(crate) fn on(&self, value: &Value, net: &mut Netlist) -> Option<Signal> {
        match self.of(value, Datum::Integer(0)) {
            Some(ranged) => ranged.on(net),
            None => value.on(net),
        }
    }

    /// When the relation holds between two values.
    pub(crate) fn compares(
        &self,
        net: &mut Netlist,
        [one, other]: [&Value; 2],
        relation: Relation,
    ) -> Option<Signal> {
        let constant = |value: &Value| match value.cases() {
            [(constant, _)] => Some(*constant),
            _ => None,
        };
        let ranged = |value, with| constant(with).and_then(|it| self.of(value, it));
        let sides = [
            ranged(one, other).unwrap_or(one),
            ranged(other, one).unwrap_or(other),
        ];
        sides[0].compares(net, relation, sides[1])
    }
}
