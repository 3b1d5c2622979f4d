//! The values of all variables.
//!
//! One store, by canonical name. `Word.3` is bit 3 of `Word`, so that writing
//! the word moves its bits. What a timer or counter shows is stored under its
//! Rockwell member (`T1.DN`, `T1.ACC`); the IEC names are led there. An index
//! that is a variable is looked up first: `OK[Step]` is `OK[4]` while `Step`
//! is 4.

use std::borrow::Cow;
use std::collections::HashMap;

use logic::{Datum, Name};

use super::term::evaluate;
use crate::{Declarations, Operand, Program};

/// The type of a declared variable, as far as it matters here.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Bool,
    Integer,
    Real,
}

/// Index brackets are looked up at most this often in one name.
const MOST_INDICES: usize = 8;

#[derive(Clone, Debug, Default)]
pub(super) struct State {
    values: HashMap<Name, Datum>,
    kinds: HashMap<Name, Kind>,
    /// Other names for the members of timers and counters.
    aliases: HashMap<Name, Name>,
}

impl State {
    /// Every declared variable at its initial value.
    pub(super) fn new(program: &Program) -> Self {
        let mut state = Self::default();
        state.declare(&program.declarations);
        state
    }

    fn declare(&mut self, declarations: &Declarations) {
        for declaration in declarations.iter() {
            let kind = declaration.data_type.as_deref().and_then(kind_of);
            if let Some(kind) = kind {
                self.kinds.insert(declaration.name.clone(), kind);
            }
        }
        for declaration in declarations.iter() {
            if let Some(value) = declaration.initial.as_deref().and_then(Datum::constant) {
                self.write(&declaration.name, value);
            }
        }
    }

    /// Makes `other` another name for `name`.
    pub(super) fn add_alias(&mut self, other: Name, name: Name) {
        if other != name {
            self.aliases.insert(other, name);
        }
    }

    /// Whether anything has been written or declared under this very name.
    pub(super) fn holds(&self, name: &str) -> bool {
        let name = self.resolved(name);
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
        if let Some(value) = self.values.get(name) {
            return *value;
        }
        if let Some(value) = Datum::constant(name) {
            return value;
        }
        let name = self.resolved(name);
        if let Some((word, bit)) = bit_of_word(&name) {
            return Datum::Bool(self.read_word(word) >> bit & 1 == 1);
        }
        self.values.get(&*name).copied().unwrap_or_default()
    }

    /// The value of a variable, constant or term, if it can be computed.
    pub(super) fn compute(&self, text: &str) -> Option<Datum> {
        match self.values.get(text) {
            Some(value) => Some(*value),
            None => evaluate(text, &|name| self.read(name)),
        }
    }

    /// Gives the timer or counter `instance` the preset that a variable holds.
    pub(super) fn copy_preset(&mut self, from: Option<&Operand>, instance: &str) {
        if let Some(preset) = from.and_then(|variable| self.compute(&variable.name)) {
            self.write(&format!("{instance}.PRE"), preset);
        }
    }

    /// Writes a variable, turned into its declared type.
    pub(super) fn write(&mut self, name: &str, value: Datum) {
        let name = self.resolved(name);
        if let Some((word, bit)) = bit_of_word(&name) {
            let rest = self.read_word(word) & !(1 << bit);
            let value = rest | i64::from(value.is_on()) << bit;
            self.store(word, Datum::Integer(value));
            return;
        }
        let value = match self.kinds.get(&*name) {
            Some(Kind::Bool) => Datum::Bool(value.is_on()),
            Some(Kind::Integer) => Datum::Integer(value.integer()),
            Some(Kind::Real) => Datum::Real(value.real()),
            None => value,
        };
        let name = name.into_owned();
        self.store(&name, value);
    }

    fn store(&mut self, name: &str, value: Datum) {
        match self.values.get_mut(name) {
            Some(stored) => *stored = value,
            None => {
                self.values.insert(name.into(), value);
            }
        }
    }

    fn read_word(&self, name: &str) -> i64 {
        self.values.get(name).map_or(0, |value| value.integer())
    }

    /// The name that a value is stored under.
    fn resolved<'t>(&self, name: &'t str) -> Cow<'t, str> {
        let indexed = self.indexed(name);
        match self.aliases.get(&*indexed) {
            Some(stored) => Cow::Owned(stored.to_string()),
            None => indexed,
        }
    }

    /// The name with its variable indices replaced by their values, and a bit
    /// number in brackets, `Word.[3]`, written as `Word.3`.
    fn indexed<'t>(&self, name: &'t str) -> Cow<'t, str> {
        if !name.contains('[') {
            return Cow::Borrowed(name);
        }
        let mut text = name.to_owned();
        let mut from = 0;
        for _ in 0..MOST_INDICES {
            let Some((open, close)) = brackets(&text, from) else {
                break;
            };
            let Some(index) = self.index(&text[open + 1..close]) else {
                break;
            };
            let indirect_bit = text[..open].ends_with('.');
            let replacement = if indirect_bit {
                index
            } else {
                format!("[{index}]")
            };
            text.replace_range(open..=close, &replacement);
            from = open + replacement.len();
        }
        Cow::Owned(text)
    }

    /// The numbers of an index, `2` or `2,5`.
    fn index(&self, text: &str) -> Option<String> {
        if text.contains('[') {
            // An index that is indexed itself goes one level down, no further.
            let (open, close) = brackets(text, 0)?;
            let inner = self.compute_flat(&text[open + 1..close])?;
            let flat = format!("{}[{inner}]{}", &text[..open], &text[close + 1..]);
            return self
                .values
                .get(&*flat)
                .map(|value| value.integer().to_string());
        }
        self.compute_flat(text)
    }

    fn compute_flat(&self, text: &str) -> Option<String> {
        let flat = |name: &str| {
            let stored = self.aliases.get(name).map_or(name, |stored| stored);
            match bit_of_word(stored) {
                Some((word, bit)) => Datum::Integer(self.read_word(word) >> bit & 1),
                None => self.values.get(stored).copied().unwrap_or_default(),
            }
        };
        let numbers: Option<Vec<String>> = text
            .split(',')
            .map(|part| evaluate(part, &flat).map(|value| value.integer().to_string()))
            .collect();
        numbers.map(|numbers| numbers.join(","))
    }
}

/// The outermost brackets of `text` from byte `from` on.
fn brackets(text: &str, from: usize) -> Option<(usize, usize)> {
    let open = from + text.get(from..)?.find('[')?;
    let mut depth = 0usize;
    for (at, byte) in text.bytes().enumerate().skip(open) {
        match byte {
            b'[' => depth += 1,
            b']' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return Some((open, at));
        }
    }
    None
}

/// `Word.3` taken apart. Addresses such as `%QX0.3` are no bits of words.
fn bit_of_word(name: &str) -> Option<(&str, u32)> {
    let (word, bit) = name.rsplit_once('.')?;
    if word.is_empty() || word.starts_with('%') || !bit.bytes().all(|b| b.is_ascii_digit()) {
        return None;
    }
    let bit = bit.parse().ok().filter(|bit| *bit < 64)?;
    Some((word, bit))
}

fn kind_of(data_type: &str) -> Option<Kind> {
    match &*data_type.to_ascii_uppercase() {
        "BOOL" | "BIT" => Some(Kind::Bool),
        "SINT" | "INT" | "DINT" | "LINT" | "USINT" | "UINT" | "UDINT" | "ULINT" | "BYTE"
        | "WORD" | "DWORD" | "LWORD" | "TIME" => Some(Kind::Integer),
        "REAL" | "LREAL" => Some(Kind::Real),
        _ => None,
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
