//! What passes over a program have found out about its variables.

use std::collections::{BTreeMap, BTreeSet};

use logic::{Datum, Name};

use crate::domain::Domain;
use crate::word::Word;

/// A word of which more bits than this are written one by one is followed by its
/// bits at once: it can have more values than are followed.
const MOST_WRITTEN_BITS: u32 = 6;

/// A variable whose values grow in more passes than this counts on and on, as far
/// as can be seen.
const MOST_GROWTH: usize = 40;

/// What is done with a number that the program does not write.
#[derive(Clone, Debug, Default)]
pub(super) struct Number {
    /// The constants that it is compared with, and 0.
    pub(super) compared: Vec<Datum>,
    /// Whether more is done: its very value counts.
    pub(super) is_computed_with: bool,
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
    /// Those of which bits are looked at too.
    pub(super) split: BTreeSet<Name>,
    /// Those of which bits are written too, and which bits.
    written_bits: BTreeMap<Name, u64>,
    /// Variables that the program does not write and looks at as numbers.
    pub(super) numbers: BTreeMap<Name, Number>,
    /// In how many passes a variable was found to have more values.
    grown: BTreeMap<Name, usize>,
    /// Whether anything has been learnt.
    has_learnt: bool,
    /// Whether anything but values has been learnt of variables that were followed
    /// in another way before: how they are looked at, and that they are written.
    has_learnt_uses: bool,
}

impl Knowledge {
    /// Whether anything has been learnt since this was asked last.
    pub(super) fn take_learnt(&mut self) -> bool {
        let has_learnt_uses = std::mem::take(&mut self.has_learnt_uses);
        std::mem::take(&mut self.has_learnt) || has_learnt_uses
    }

    /// Whether this pass has found out of variables how they are used when it had
    /// begun to follow them in another way. Then its values do not count.
    pub(super) fn has_learnt_uses(&self) -> bool {
        self.has_learnt_uses
    }

    fn learns_use(&mut self, is_followed: bool) {
        self.has_learnt = true;
        self.has_learnt_uses |= is_followed;
    }

    /// The program writes the variable, which is `initial` at first.
    pub(super) fn writes(&mut self, name: &Name, initial: Datum, is_followed: bool) {
        if !self.written.contains_key(name) {
            let domain = Domain::Values(vec![initial]);
            self.written.insert(name.clone(), domain);
            self.learns_use(is_followed);
        }
    }

    /// Something else than a timer or counter writes the variable.
    pub(super) fn writes_by_hand(&mut self, name: &Name) {
        if self.by_hand.insert(name.clone()) {
            self.learns_use(true);
        }
    }

    /// The values of the variable grow in this pass: what counts on and on is not
    /// followed.
    pub(super) fn grows(&mut self, name: &Name) {
        let passes = self.grown.entry(name.clone()).or_default();
        *passes += 1;
        if *passes > MOST_GROWTH {
            self.loses_values(name);
        }
    }

    /// The variable can have the value when a scan begins.
    pub(super) fn holds(&mut self, name: &Name, value: Datum) {
        let Some(domain) = self.written.get_mut(name) else {
            return;
        };
        let before = domain.clone();
        self.has_learnt |= domain.add(value);
        if *domain == Domain::Unknown && before != Domain::Unknown {
            *domain = before;
            self.loses_values(name);
        }
    }

    /// The variable has more values than are followed one by one.
    fn loses_values(&mut self, name: &Name) {
        match self.written_bits.contains_key(name) {
            true => self.goes_by_bits(name),
            false => self.loses(name),
        }
    }

    /// The variable is followed by its bits.
    pub(super) fn goes_by_bits(&mut self, name: &Name) {
        if let Some(domain @ Domain::Values(_)) = self.written.get_mut(name) {
            *domain = domain.by_bits();
            self.has_learnt = true;
        }
    }

    /// The variable is this word when a scan ends.
    pub(super) fn widens(&mut self, name: &Name, word: &Word) {
        if let Some(domain) = self.written.get_mut(name) {
            let before = domain.clone();
            domain.widen(word);
            self.has_learnt |= *domain != before;
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
        if self.whole.insert(word.clone()) {
            self.learns_use(true);
        }
    }

    /// A bit of a word is looked at that is looked at as a whole too.
    pub(super) fn splits(&mut self, word: &Name, is_followed: bool) {
        if self.split.insert(word.clone()) {
            self.learns_use(is_followed);
        }
    }

    /// A bit of a word is written that is looked at as a whole too.
    pub(super) fn writes_bit(&mut self, word: &Name, bit: u32) {
        let bits = self.written_bits.entry(word.clone()).or_default();
        let before = *bits;
        *bits |= 1_u64.checked_shl(bit).unwrap_or(0);
        self.has_learnt |= *bits != before;
        if bits.count_ones() > MOST_WRITTEN_BITS {
            self.goes_by_bits(word);
        }
    }

    /// The program computes with a variable that it does not write.
    pub(super) fn computes_with(&mut self, name: &Name, is_followed: bool) {
        let number = self.numbers.entry(name.clone()).or_default();
        if !std::mem::replace(&mut number.is_computed_with, true) {
            self.learns_use(is_followed);
        }
    }

    /// The program compares a variable that it does not write with a constant.
    pub(super) fn compares(&mut self, name: &Name, constant: Datum, is_followed: bool) {
        let number = self.numbers.entry(name.clone()).or_default();
        let mut has_learnt = false;
        for value in [Datum::Integer(0), constant] {
            if !number.compared.iter().any(|it| it.key() == value.key()) {
                number.compared.push(value);
                has_learnt = true;
            }
        }
        if has_learnt {
            self.learns_use(is_followed);
        }
    }
}
