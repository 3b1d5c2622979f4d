//! What the program looks at and does not write.

use ladder::scan::Kind;
use logic::Name;

use super::Store;
use crate::ranges::Ranged;
use crate::value::{Value, gathered};

impl Store<'_> {
    /// A variable that the program does not write.
    pub(super) fn given_from_outside(&mut self, name: &Name) -> Value {
        let kind = self.names.kind(name);
        if let Some(value) = self.given.constants.get(name) {
            return Value::constant(*value);
        }
        if self.is_word_from_outside(name) {
            let (bits, is_signed) = self.given.widths.get(name).copied().unwrap_or((64, true));
            let word = self.inputs.word(&mut self.net, name, bits, is_signed);
            return Value::Word(word);
        }
        match self.knowledge.numbers.get(name) {
            Some(number) if kind != Some(Kind::Bool) => {
                let compared = &number.compared;
                let is_computed_with = number.is_computed_with;
                let ranged = (!compared.is_empty()).then(|| Ranged {
                    value: self.inputs.number(&mut self.net, name, kind, compared),
                    compared: compared.clone(),
                });
                match ranged {
                    Some(ranged) if !is_computed_with => ranged.value,
                    ranged => self.number_from_outside(name, ranged),
                }
            }
            _ => {
                let on = self.inputs.bit(&mut self.net, name);
                let cases = [(false, !on), (true, on)];
                let cases =
                    cases.map(|(is_on, when)| (self.names.converted(name, is_on.into()), when));
                gathered(&mut self.net, cases.into())
            }
        }
    }

    /// A number whose very value counts. What it is compared with tells in which
    /// range it is.
    fn number_from_outside(&mut self, name: &Name, ranged: Option<Ranged>) -> Value {
        self.unknowns += 1;
        self.outside.insert(self.unknowns, name.clone());
        if let Some(ranged) = ranged {
            self.ranges.insert(self.unknowns, ranged);
        }
        Value::Unknown(self.unknowns)
    }

    /// Whether no few values stand for a variable that the program does not write,
    /// but its bits do: it is looked at by these and as a whole, or a whole number
    /// that is copied or computed with.
    pub(super) fn is_word_from_outside(&self, name: &Name) -> bool {
        let is_looked_at =
            || self.knowledge.whole.contains(name) && self.knowledge.split.contains(name);
        let number = self.knowledge.numbers.get(name);
        let is_computed_with = || number.is_some_and(|it| it.is_computed_with);
        let is_word = match self.names.kind(name) {
            Some(Kind::Integer) => is_looked_at() || is_computed_with(),
            None => is_looked_at(),
            Some(Kind::Bool | Kind::Real) => false,
        };
        is_word && !self.is_written(name)
    }
}
