//! The values that a variable can have when a scan begins, as they are found pass
//! by pass, and the latches that keep them.

use logic::Datum;
use proof::{Netlist, Signal};

use crate::value::{MOST_VALUES, Value, gathered};
use crate::word::Word;

/// The values that a variable can have when a scan begins.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Domain {
    /// One of these; the first is the initial one.
    Values(Vec<Datum>),
    /// A whole number by its bits.
    Word(Moving),
    /// A number that is not followed.
    Unknown,
}

/// Which bits of a word can be other than they were at first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Moving {
    initial: i64,
    moving: i64,
    is_number: bool,
}

/// What a latch stands for.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Kept {
    /// That the variable has this value.
    Value(Datum),
    /// A bit of a word.
    Bit(u32),
}

impl Domain {
    /// Adds a value. Whether it is new.
    pub fn add(&mut self, value: Datum) -> bool {
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

    /// Takes in what the variable is when a scan ends, by its bits.
    pub fn widen(&mut self, word: &Word) {
        *self = self.by_bits();
        if let Self::Word(moving) = self {
            moving.widen(word);
        }
    }

    /// The same by bits, if these are whole numbers.
    pub fn by_bits(&self) -> Self {
        let Self::Values(values) = self else {
            return self.clone();
        };
        let is_whole = |value: &Datum| !matches!(value, Datum::Real(_));
        let Some(initial) = values.first().filter(|_| values.iter().all(is_whole)) else {
            return Self::Unknown;
        };
        let initial = initial.integer();
        let moving = values.iter();
        let moving = moving.fold(0, |all, value| all | value.integer() ^ initial);
        let is_number = |value: &Datum| matches!(value, Datum::Integer(_));
        Self::Word(Moving {
            initial,
            moving,
            is_number: values.iter().all(is_number),
        })
    }

    /// What the variable holds when a scan begins, and its latches, each with what
    /// it stands for. `None` if it is not followed.
    pub fn begin(&self, net: &mut Netlist, name: &str) -> Option<(Value, Vec<(Kept, Signal)>)> {
        let mut kept = Vec::new();
        let values = match self {
            Self::Values(values) => values,
            Self::Word(moving) => {
                let word = moving.begin(net, name, &mut kept);
                return Some((Value::Word(word), kept));
            }
            Self::Unknown => return None,
        };
        let value = match values.as_slice() {
            [value] => Value::constant(*value),
            [Datum::Bool(initial), Datum::Bool(_)] => {
                let latch = net.latch(name, *initial);
                kept.push((Kept::Value(true.into()), latch));
                Value::bit(latch)
            }
            _ => {
                let mut cases = Vec::new();
                for (at, value) in values.iter().enumerate() {
                    let latch = net.latch(format!("{name}={value}"), at == 0);
                    kept.push((Kept::Value(*value), latch));
                    cases.push((*value, latch));
                }
                gathered(net, cases)
            }
        };
        Some((value, kept))
    }
}

impl Moving {
    fn begin(self, net: &mut Netlist, name: &str, kept: &mut Vec<(Kept, Signal)>) -> Word {
        let mut word = Word::constant(self.initial);
        for at in (0..i64::BITS).filter(|at| self.moving >> at & 1 == 1) {
            let initial = self.initial >> at & 1 == 1;
            let latch = net.latch(format!("{name}.{at}"), initial);
            kept.push((Kept::Bit(at), latch));
            word = word.with(at, latch);
        }
        match self.is_number {
            true => word,
            false => word.uncertain(),
        }
    }

    /// Takes in what the word is when a scan ends.
    fn widen(&mut self, word: &Word) {
        let initial = Word::constant(self.initial);
        for (at, (own, bit)) in initial.bits().iter().zip(word.bits()).enumerate() {
            self.moving |= i64::from(own != bit) << at;
        }
        self.is_number &= word.is_number();
    }
}

impl Kept {
    /// What its latch holds when the scan has ended with this value.
    pub fn next(self, value: &Value, net: &mut Netlist) -> Signal {
        match self {
            Self::Value(kept) => {
                let mut cases = value.cases().iter();
                let own = cases.find(|(it, _)| it.key() == kept.key());
                own.map_or(Signal::FALSE, |(_, when)| *when)
            }
            Self::Bit(at) => {
                let word = value.word(net);
                word.map_or(Signal::FALSE, |word| word.bit(at))
            }
        }
    }
}
