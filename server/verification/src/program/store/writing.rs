//! How variables are given values.

use ladder::scan::{Kind, bit_of_word};
use logic::{Datum, Name};
use proof::{Gates, Signal};

use super::terms::is_nested;
use super::{Key, Store};
use crate::refusal::Refusal;
use crate::value::{MOST_VALUES, Value, applied, chosen, gathered};

impl Store<'_> {
    /// Gives a variable a value under a condition.
    pub(in crate::program) fn write(
        &mut self,
        name: &str,
        value: &Value,
        when: Signal,
    ) -> Result<(), Refusal> {
        if !name.contains('[') || self.is_direct(name) {
            let key = self.key(name);
            self.put(key, value, when);
            return Ok(());
        }
        if is_nested(name) {
            return Err(Refusal::NestedIndex(name.into()));
        }
        let Some(targets) = self.targets(name) else {
            return Err(Refusal::UnknownTarget(name.into()));
        };
        for (target, also) in targets {
            let when = self.net.and(when, also);
            let key = self.key(&target);
            self.put(key, value, when);
        }
        Ok(())
    }

    fn put(&mut self, key: Key, value: &Value, when: Signal) {
        let (name, value) = match key {
            Key::Whole(name) => {
                let converted = self.converted(&name, value);
                let converted = match bit_of_word(&name) {
                    Some(_) => Value::bit(self.on(&converted, &name)),
                    None => converted,
                };
                (name, converted)
            }
            Key::BitOf(word, bit) => {
                self.knowledge.writes_bit(&word, bit);
                let changed = self.with_bit(&word, bit, value);
                (word, changed)
            }
        };
        self.note_write(&name, &value);
        let before = self.load(&name);
        let after = chosen(&mut self.net, when, &value, &before);
        let after = match after {
            Some(after) if after.cases().len() <= MOST_VALUES => after,
            _ => self.unknown(),
        };
        self.now.insert(name, after);
    }

    /// A value turned into the declared type of a variable.
    fn converted(&mut self, name: &Name, value: &Value) -> Value {
        match (value, self.names.kind(name)) {
            (Value::Unknown(_), Some(Kind::Bool)) => return Value::bit(self.on(value, name)),
            // The nearest whole number may be another one.
            (Value::Unknown(number), Some(Kind::Integer)) => {
                let from = self.outside.get(number);
                return match from.and_then(|it| self.names.kind(it)) {
                    Some(Kind::Integer) => value.clone(),
                    _ => self.unknown(),
                };
            }
            (Value::Unknown(_), _) => return value.clone(),
            _ => {}
        }
        if let Value::Word(word) = value {
            match self.names.kind(name) {
                Some(Kind::Bool) => return Value::bit(word.on(&mut self.net)),
                Some(Kind::Integer) => return Value::Word(word.clone().number()),
                None => return value.clone(),
                Some(Kind::Real) => {}
            }
        }
        let Some(cases) = value.listed(&mut self.net) else {
            return self.unknown();
        };
        let cases = cases.iter();
        let cases = cases.map(|(value, when)| (self.names.converted(name, *value), *when));
        let cases = cases.collect();
        gathered(&mut self.net, cases)
    }

    /// What a word holds, with a bit changed.
    fn with_bit(&mut self, word: &Name, bit: u32, value: &Value) -> Value {
        let before = self.load(word);
        if let Value::Known(_) = before {
            let changed = applied(&mut self.net, &[&before, value], |both| {
                let rest = both[0].integer() & !(1 << bit);
                Datum::Integer(rest | i64::from(both[1].is_on()) << bit)
            });
            if let Some(changed) = changed {
                return changed;
            }
        }
        let on = self.on(value, &format!("{word}.{bit}"));
        match before.rounded(&mut self.net) {
            Some(word) => Value::Word(word.with(bit, on)),
            None => self.unknown(),
        }
    }
}
