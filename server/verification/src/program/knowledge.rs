//! What passes over a program have found out about its variables.

use std::collections::{BTreeMap, BTreeSet};

use logic::{Datum, Name};

use crate::value::MOST_VALUES;

/// A variable whose values grow in more passes than this counts on and on, as far
/// as can be seen.
const MOST_GROWTH: usize = 40;

/// The values that a variable can have when a scan begins.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Domain {
    /// One of these; the first is the initial one.
    Values(Vec<Datum>),
    /// A number that is not followed.
    Unknown,
}

impl Domain {
    /// Adds a value. Whether it is new.
    fn add(&mut self, value: Datum) -> bool {
        let Self::Values(values) = self else {
            return false;
        };
        if values.iter().any(|known| known.key() == value.key()) {
            return false;
        }
        match values.len() {
            MOST_VALUES.. => *self = Self::Unknown,
            _ => values.push(value),
        }
        true
    }
}

/// Each pass over the program translates with what those before have learnt;
/// what it learns itself is for the next. The last learns nothing.
#[derive(Clone, Debug, Default)]
pub(super) struct Knowledge {
    /// The variables that the program writes.
    pub(super) written: BTreeMap<Name, Domain>,
    /// Those that something else than timers and counters writes.
    pub(super) by_hand: BTreeSet<Name>,
    /// Words that are looked at as a whole, and not only by their bits.
    pub(super) whole: BTreeSet<Name>,
    /// Variables that the program does not write and computes with: the
    /// constants that they are compared with; `None` if more is done.
    pub(super) numbers: BTreeMap<Name, Option<Vec<Datum>>>,
    /// In how many passes a variable was found to have more values.
    grown: BTreeMap<Name, usize>,
    has_learnt: bool,
}

impl Knowledge {
    /// Whether anything has been learnt since this was asked last.
    pub(super) fn take_learnt(&mut self) -> bool {
        std::mem::take(&mut self.has_learnt)
    }

    /// The program writes the variable, which is `initial` at first.
    pub(super) fn writes(&mut self, name: &Name, initial: Datum) {
        if !self.written.contains_key(name) {
            let domain = Domain::Values(vec![initial]);
            self.written.insert(name.clone(), domain);
            self.has_learnt = true;
        }
    }

    /// Something else than a timer or counter writes the variable.
    pub(super) fn writes_by_hand(&mut self, name: &Name) {
        self.has_learnt |= self.by_hand.insert(name.clone());
    }

    /// The values of the variable grow in this pass: what counts on and on is not
    /// followed.
    pub(super) fn grows(&mut self, name: &Name) {
        let passes = self.grown.entry(name.clone()).or_default();
        *passes += 1;
        if *passes > MOST_GROWTH {
            self.loses(name);
        }
    }

    /// The variable can have the value when a scan begins.
    pub(super) fn holds(&mut self, name: &Name, value: Datum) {
        if let Some(domain) = self.written.get_mut(name) {
            self.has_learnt |= domain.add(value);
        }
    }

    /// The variable holds numbers that are not followed.
    pub(super) fn loses(&mut self, name: &Name) {
        if let Some(domain) = self.written.get_mut(name)
            && *domain != Domain::Unknown
        {
            *domain = Domain::Unknown;
            self.has_learnt = true;
        }
    }

    /// The word is looked at as a whole.
    pub(super) fn looks_at_whole(&mut self, word: &Name) {
        self.has_learnt |= self.whole.insert(word.clone());
    }

    /// The program computes with a variable that it does not write.
    pub(super) fn computes_with(&mut self, name: &Name) {
        let known = self.numbers.insert(name.clone(), None);
        self.has_learnt |= known != Some(None);
    }

    /// The program compares a variable that it does not write with a constant.
    pub(super) fn compares(&mut self, name: &Name, constant: Datum) {
        let all = self.numbers.entry(name.clone()).or_insert_with(|| {
            self.has_learnt = true;
            Some(vec![Datum::Integer(0)])
        });
        if let Some(all) = all
            && !all.iter().any(|known| known.key() == constant.key())
        {
            all.push(constant);
            self.has_learnt = true;
        }
    }
}
