//! Folds every spelling of a variable onto one name.
//!
//! A variable that is declared with an address may be called by either; both
//! give its name. An address that nobody declares is its own name. Addresses
//! ignore case, and `%IX0.1` is `%I0.1` (IEC 61131-3, 6.5.5.2: no size letter
//! means a single bit).

use std::collections::HashMap;
use std::sync::Arc;

use logic::Name;

use crate::Declarations;

/// What the statements of a text say together about the names in each.
#[derive(Clone, Debug)]
pub(super) struct Spellings {
    /// The names of declared addresses; the first to have an address keeps it.
    declared: Arc<HashMap<String, Name>>,
    /// Addresses that nobody declares, as they were first written.
    met: Arc<HashMap<String, Name>>,
    /// How often each name is written that ends in the pin of a timer or
    /// counter, such as `t1.DN`.
    pub(super) pins: Arc<HashMap<String, usize>>,
}

impl Spellings {
    /// Those of a text that declares `declared`, before any rung is read.
    pub(super) fn new(declared: &Declarations, pins: HashMap<String, usize>) -> Self {
        let mut by_address = HashMap::new();
        for declaration in declared.iter() {
            if let Some(address) = &declaration.address {
                by_address
                    .entry(address_key(address))
                    .or_insert_with(|| declaration.name.clone());
            }
        }
        Self {
            declared: Arc::new(by_address),
            met: Arc::default(),
            pins: Arc::new(pins),
        }
    }

    /// The same with other counts of pins.
    pub(super) fn with_pins(&self, pins: Arc<HashMap<String, usize>>) -> Self {
        Self {
            pins,
            ..self.clone()
        }
    }

    fn at(&self, key: &str) -> Option<&Name> {
        self.declared.get(key).or_else(|| self.met.get(key))
    }
}

/// The variables of a program by their spellings.
pub(super) struct Names<'d> {
    declared: &'d Declarations,
    pub(super) spellings: Spellings,
    known: HashMap<String, Name>,
    /// Spellings of addresses that nobody declares, in the order in which they
    /// were met.
    pub(super) undeclared: Vec<String>,
}

impl<'d> Names<'d> {
    /// The names that `declared` and `spellings` give.
    pub(super) fn new(declared: &'d Declarations, spellings: Spellings) -> Self {
        Self {
            declared,
            spellings,
            known: HashMap::new(),
            undeclared: Vec::new(),
        }
    }

    /// The name of the variable spelled so.
    pub(super) fn fold(&mut self, spelling: &str) -> Name {
        if let Some(name) = self.known.get(spelling) {
            return name.clone();
        }
        let name = self.look_up(spelling);
        self.known.insert(spelling.to_owned(), name.clone());
        name
    }

    fn look_up(&mut self, spelling: &str) -> Name {
        if let Some(declaration) = self.declared.find(spelling) {
            return declaration.name.clone();
        }
        let key = address_key(spelling);
        if let Some(name) = self.spellings.declared.get(&key) {
            return name.clone();
        }
        if spelling.starts_with('%') {
            self.undeclared.push(spelling.to_owned());
        }
        if let Some(name) = self.spellings.met.get(&key) {
            return name.clone();
        }
        if let Some(name) = self.part_of_an_address(spelling) {
            return name;
        }
        let name = Name::from(spelling);
        if spelling.starts_with('%') {
            Arc::make_mut(&mut self.spellings.met).insert(key, name.clone());
        }
        name
    }

    /// `Speed.3` for `%MW4.3` where `Speed` is declared at `%MW4`. Bits have
    /// no parts: `%I0.3` has nothing to do with what is declared at `%I0`.
    fn part_of_an_address(&self, spelling: &str) -> Option<Name> {
        spelling
            .rmatch_indices('.')
            .take(DEEPEST_PART)
            .find_map(|(at, _)| {
                let (whole, part) = spelling.split_at_checked(at)?;
                let key = address_key(whole);
                if is_bit(&key) {
                    return None;
                }
                let name = self.spellings.at(&key)?;
                Some(format!("{name}{part}").into())
            })
    }

    /// The atom of the output of a timer or counter: `t1.Q`, or `t1.DN` where
    /// the program reads that and not `t1.Q`, or where neither is read and the
    /// type is Rockwell's.
    pub(super) fn output_of(&mut self, instance: &Name, spelled: &str) -> Name {
        let is_read = |pin: &str| {
            [spelled, instance]
                .iter()
                .any(|name| self.spellings.pins.contains_key(&format!("{name}.{pin}")))
        };
        let by_type = || {
            let declaration = self.declared.find(instance)?;
            let data_type = declaration.data_type.as_deref()?;
            Some(matches!(data_type, "TIMER" | "COUNTER"))
        };
        let pin = match (is_read("Q"), is_read("DN")) {
            (true, _) => "Q",
            (false, true) => "DN",
            (false, false) if by_type() == Some(true) => "DN",
            (false, false) => "Q",
        };
        self.fold(&format!("{instance}.{pin}"))
    }

    /// Whether the variable is declared with this type.
    pub(super) fn has_type(&self, name: &str, data_type: &str) -> bool {
        self.declared
            .find(name)
            .is_some_and(|declaration| declaration.data_type.as_deref() == Some(data_type))
    }
}

/// Parts of parts of an address are looked for this deep.
const DEEPEST_PART: usize = 4;

fn is_bit(key: &str) -> bool {
    let mut letters = key.chars();
    letters.next() == Some('%')
        && matches!(letters.next(), Some('I' | 'Q' | 'M'))
        && letters.next().is_some_and(|c| c.is_ascii_digit())
}

/// What equal addresses have in common: capital letters, and no `X` for the
/// size of a bit.
pub(super) fn address_key(address: &str) -> String {
    if !address.starts_with('%') {
        return address.to_owned();
    }
    let capital = address.to_ascii_uppercase();
    for place in ["%I", "%Q", "%M"] {
        let bit = capital
            .strip_prefix(place)
            .and_then(|rest| rest.strip_prefix('X'))
            .filter(|rest| rest.starts_with(|c: char| c.is_ascii_digit()));
        if let Some(rest) = bit {
            return format!("{place}{rest}");
        }
    }
    capital
}

#[cfg(test)]
mod tests {
    use source::Span;

    use super::*;
    use crate::{Class, Declaration};

    fn folded(spellings: &[&str]) -> Vec<String> {
        let mut declared = Declarations::default();
        for (name, address) in [("s", "%I0"), ("Speed", "%MW4"), ("door", "Local:1:I")] {
            let mut declaration = Declaration::new(name, Class::Unknown, Span::default());
            declaration.address = Some(address.into());
            declared.add(declaration);
        }
        let whole = Spellings::new(&declared, HashMap::new());
        let mut names = Names::new(&declared, whole);
        let fold = |spelling: &&str| names.fold(spelling).to_string();
        spellings.iter().map(fold).collect()
    }

    #[test]
    fn an_address_is_another_spelling_of_the_name() {
        assert_eq!(folded(&["s", "%I0", "%ix0"]), ["s", "s", "s"]);
        assert_eq!(
            folded(&["Local:1:I", "Local:1:I.Data.3"]),
            ["door", "door.Data.3"]
        );
    }

    #[test]
    fn a_bit_of_a_word_belongs_to_the_word_and_a_bit_has_no_parts() {
        assert_eq!(folded(&["%MW4.3", "%I0.3"]), ["Speed.3", "%I0.3"]);
    }

    #[test]
    fn an_address_that_nobody_declares_keeps_its_first_spelling() {
        assert_eq!(folded(&["%MX0.1", "%m0.1"]), ["%MX0.1", "%MX0.1"]);
    }
}
