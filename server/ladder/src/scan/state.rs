//! The values of all variables.
//!
//! One store, by canonical name. [`Names`] tells which name that is.

use std::collections::HashMap;

use logic::{Datum, Name};

use super::names::Names;
use crate::{Operand, Program};

#[derive(Clone, Debug, Default)]
pub(super) struct State {
    values: HashMap<Name, Datum>,
    names: Names,
}

impl State {
    /// Every declared variable at its initial value.
    pub(super) fn new(program: &Program) -> Self {
        let mut state = Self {
            values: HashMap::new(),
            names: Names::new(&program.declarations),
        };
        for declaration in program.declarations.iter() {
            if let Some(value) = declaration.initial.as_deref().and_then(Datum::constant) {
                state.write(&declaration.name, value);
            }
        }
        state
    }

    /// Makes `other` another name for `name`.
    pub(super) fn add_alias(&mut self, other: Name, name: Name) {
        self.names.add_alias(other, name);
    }

    /// What names mean here.
    pub(super) fn names(&self) -> &Names {
        &self.names
    }

    /// All that is stored.
    pub(super) fn values(&self) -> impl Iterator<Item = (&Name, Datum)> {
        self.values.iter().map(|(name, value)| (name, *value))
    }

    fn stored(&self) -> impl Fn(&str) -> Option<Datum> + '_ {
        |name| self.values.get(name).copied()
    }

    /// Whether anything has been written or declared under this very name.
    pub(super) fn holds(&self, name: &str) -> bool {
        let name = self.names.resolved(name, &self.stored());
        self.values.contains_key(&*name)
    }

    /// Whether every variable has the same value.
    pub(super) fn is_same(&self, other: &Self) -> bool {
        let mut values = self.values.iter();
        self.values.len() == other.values.len()
            && values.all(|(name, value)| {
                let other = other.values.get(name);
                other.is_some_and(|other| other.key() == value.key())
            })
    }

    /// The value of a variable or constant; 0 before it is first written.
    pub(super) fn read(&self, name: &str) -> Datum {
        self.names.read(name, &self.stored())
    }

    /// The value of a variable, constant or term, if it can be computed.
    pub(super) fn compute(&self, text: &str) -> Option<Datum> {
        self.names.compute(text, &self.stored())
    }

    /// Gives the timer or counter `instance` the preset that a variable holds.
    pub(super) fn copy_preset(&mut self, from: Option<&Operand>, instance: &str) {
        if let Some(preset) = from.and_then(|variable| self.compute(&variable.name)) {
            self.write(&format!("{instance}.PRE"), preset);
        }
    }

    /// Writes a variable, turned into its declared type.
    pub(super) fn write(&mut self, name: &str, value: Datum) {
        let (name, value) = self.names.written(name, value, &self.stored());
        match self.values.get_mut(&*name) {
            Some(stored) => *stored = value,
            None => {
                let name = name.into_owned();
                self.values.insert(name.into(), value);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_word_and_its_bits_are_one() {
        let mut state = State::default();
        state.write("W.3", Datum::Bool(true));
        assert_eq!(state.read("W"), Datum::Integer(8));
        state.write("W", Datum::Integer(1));
        assert_eq!(state.read("W.3"), Datum::Bool(false));
        assert_eq!(state.read("W.0"), Datum::Bool(true));
        state.write("W.63", Datum::Bool(true));
        assert_eq!(state.read("W.63"), Datum::Bool(true));
    }

    #[test]
    fn an_index_that_is_a_variable_is_looked_up() {
        let mut state = State::default();
        state.write("Step", Datum::Integer(4));
        state.write("OK[4]", Datum::Bool(true));
        assert_eq!(state.read("OK[Step]"), Datum::Bool(true));
        state.write("W", Datum::Integer(16));
        assert_eq!(state.read("W.[Step]"), Datum::Bool(true));
        state.write("Of[4]", Datum::Integer(4));
        assert_eq!(state.read("OK[Of[Step]]"), Datum::Bool(true));
        assert_eq!(state.read("OK[Step"), Datum::Bool(false));
        assert_eq!(state.read("OK[]]["), Datum::Bool(false));
    }
}
