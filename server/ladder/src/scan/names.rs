//! What names mean: which variable a name leads to, and what is stored there.
//!
//! `Word.3` is bit 3 of `Word`, so that writing the word moves its bits. What a
//! timer or counter shows is stored under its Rockwell member (`T1.DN`,
//! `T1.ACC`); the IEC names are led there. An index that is a variable is
//! looked up first: `OK[Step]` is `OK[4]` while `Step` is 4.
//!
//! Where values come from is for the caller to say: the machine looks them up,
//! a translation into gates tries one after the other.

use std::borrow::Cow;
use std::collections::HashMap;

use logic::{Datum, Name};

use super::term::{self, evaluate};
use crate::Declarations;

/// The type of a declared variable, as far as it matters here.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Off or on.
    Bool,
    /// Whole numbers.
    Integer,
    /// Numbers with a fraction.
    Real,
}

/// Index brackets are looked up at most this often in one name.
const MOST_INDICES: usize = 8;

/// Gives the value that is stored under a very name, if one is.
pub type Stored<'s> = dyn Fn(&str) -> Option<Datum> + 's;

/// Types of variables, and other names for them.
#[derive(Clone, Debug, Default)]
pub struct Names {
    kinds: HashMap<Name, Kind>,
    /// Other names for the members of timers and counters.
    aliases: HashMap<Name, Name>,
}

impl Names {
    /// The names of declared variables.
    pub(super) fn new(declarations: &Declarations) -> Self {
        let mut names = Self::default();
        for declaration in declarations.iter() {
            let kind = declaration.data_type.as_deref().and_then(kind_of);
            if let Some(kind) = kind {
                names.kinds.insert(declaration.name.clone(), kind);
            }
        }
        names
    }

    /// Makes `other` another name for `name`.
    pub(super) fn add_alias(&mut self, other: Name, name: Name) {
        if other != name {
            self.aliases.insert(other, name);
        }
    }

    /// The declared type of what is stored under `name`.
    pub fn kind(&self, name: &str) -> Option<Kind> {
        self.kinds.get(name).copied()
    }

    /// Whether a value can be stored under this very name: it is no constant,
    /// no other name of something, no bit of a word, and has no index that can be
    /// looked up.
    pub fn is_stored(&self, name: &str) -> bool {
        let is_number = |text: &str| text.parse().is_ok_and(|it: i64| it.to_string() == text);
        let is_index = |text: &str| text.split(',').all(is_number);
        let has_variable_index = match brackets(name, 0) {
            Some((open, close)) => {
                let index = &name[open + 1..close];
                // What is no term, `[?](x)`, is a part of the name.
                let is_term = || index.contains('[') || self.index(index, &|_| None).is_some();
                !is_index(index) && is_term()
            }
            None => false,
        };
        !has_variable_index
            && !self.aliases.contains_key(name)
            && bit_of_word(name).is_none()
            && Datum::constant(name).is_none()
    }

    /// The value of a variable or constant; 0 before it is first written.
    pub fn read(&self, name: &str, stored: &Stored<'_>) -> Datum {
        if let Some(value) = stored(name) {
            return value;
        }
        if let Some(value) = Datum::constant(name) {
            return value;
        }
        let name = self.resolved(name, stored);
        if let Some((word, bit)) = bit_of_word(&name) {
            return Datum::Bool(whole(word, stored) >> bit & 1 == 1);
        }
        stored(&name).unwrap_or_default()
    }

    /// The value of a variable, constant or term, if it can be computed.
    pub fn compute(&self, text: &str, stored: &Stored<'_>) -> Option<Datum> {
        match stored(text) {
            Some(value) => Some(value),
            None => evaluate(text, &|name| self.read(name, stored)),
        }
    }

    /// What is stored, and where, when `name` is given a value: the value turned
    /// into its declared type, or the word with one of its bits changed.
    pub fn written<'t>(
        &self,
        name: &'t str,
        value: Datum,
        stored: &Stored<'_>,
    ) -> (Cow<'t, str>, Datum) {
        let name = self.resolved(name, stored);
        if let Some((word, bit)) = bit_of_word(&name) {
            let rest = whole(word, stored) & !(1 << bit);
            let value = Datum::Integer(rest | i64::from(value.is_on()) << bit);
            return (word.to_owned().into(), value);
        }
        let value = self.converted(&name, value);
        (name, value)
    }

    /// The value turned into the declared type of what is stored under `name`.
    pub fn converted(&self, name: &str, value: Datum) -> Datum {
        match self.kinds.get(name) {
            Some(Kind::Bool) => Datum::Bool(value.is_on()),
            Some(Kind::Integer) => Datum::Integer(value.integer()),
            Some(Kind::Real) => Datum::Real(value.real()),
            None => value,
        }
    }

    /// The name that a value is stored under.
    pub fn resolved<'t>(&self, name: &'t str, stored: &Stored<'_>) -> Cow<'t, str> {
        let indexed = self.indexed(name, stored);
        match self.aliases.get(&*indexed) {
            Some(stored) => Cow::Owned(stored.to_string()),
            None => indexed,
        }
    }

    /// The name with its variable indices replaced by their values, and a bit
    /// number in brackets, `Word.[3]`, written as `Word.3`.
    fn indexed<'t>(&self, name: &'t str, stored: &Stored<'_>) -> Cow<'t, str> {
        if !name.contains('[') {
            return Cow::Borrowed(name);
        }
        let mut text = name.to_owned();
        let mut from = 0;
        for _ in 0..MOST_INDICES {
            let Some((open, close)) = brackets(&text, from) else {
                break;
            };
            let Some(index) = self.index(&text[open + 1..close], stored) else {
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
    fn index(&self, text: &str, stored: &Stored<'_>) -> Option<String> {
        if text.contains('[') {
            // An index that is indexed itself goes one level down, no further.
            let (open, close) = brackets(text, 0)?;
            let inner = self.compute_flat(&text[open + 1..close], stored)?;
            let flat = format!("{}[{inner}]{}", &text[..open], &text[close + 1..]);
            return stored(&flat).map(|value| value.integer().to_string());
        }
        self.compute_flat(text, stored)
    }

    fn compute_flat(&self, text: &str, stored: &Stored<'_>) -> Option<String> {
        let flat = |name: &str| {
            let own = self.aliases.get(name).map_or(name, |own| own);
            match bit_of_word(own) {
                Some((word, bit)) => Datum::Integer(whole(word, stored) >> bit & 1),
                None => stored(own).unwrap_or_default(),
            }
        };
        let numbers: Option<Vec<String>> = text
            .split(',')
            .map(|part| evaluate(part, &flat).map(|value| value.integer().to_string()))
            .collect();
        numbers.map(|numbers| numbers.join(","))
    }
}

/// Whether `text` is a name or constant by itself and no term.
pub fn is_plain(text: &str) -> bool {
    !text.is_empty() && term::atom_length(text) == text.len()
}

fn whole(word: &str, stored: &Stored<'_>) -> i64 {
    stored(word).map_or(0, |value| value.integer())
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
pub fn bit_of_word(name: &str) -> Option<(&str, u32)> {
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
