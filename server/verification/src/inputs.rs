//! What is free in each scan, and what it stands for.

use std::collections::{BTreeMap, BTreeSet};

use ladder::scan::Kind;
use logic::{Datum, Name};
use proof::{Gates, Netlist, Signal};

use crate::value::{Value, gathered};
use crate::word::Word;

/// What an input of a translation stands for.
#[derive(Clone, Debug, PartialEq)]
pub enum Source {
    /// A variable, on or off.
    Bit(Name),
    /// That a variable has this value. The first of a variable's that is on
    /// counts; [`Inputs::resting`] is the value if none is.
    Choice {
        /// The variable.
        variable: Name,
        /// The value.
        value: Datum,
    },
    /// A bit of a variable that is a whole number, the lowest being 0. The highest
    /// is the sign, where its type has one.
    WordBit {
        /// The variable.
        variable: Name,
        /// The bit.
        bit: u32,
    },
    /// When a timer runs out, or a counter is at its preset: decided by time or
    /// numbers that are not followed. The timer or counter.
    Event(Name),
    /// That a step has been active for so many milliseconds.
    Elapsed {
        /// The step.
        step: Name,
        /// Milliseconds.
        time_ms: u64,
    },
    /// Something of which only the text is known: a comparison of numbers that
    /// are not followed, a variable that holds one.
    Opaque(Name),
}

impl Source {
    /// Whether the plant or a person gives it, and not time or what is not followed.
    pub fn is_given(&self) -> bool {
        match self {
            Self::Bit(_) | Self::Choice { .. } | Self::WordBit { .. } => true,
            Self::Event(_) | Self::Elapsed { .. } | Self::Opaque(_) => false,
        }
    }
}

/// The inputs of a translation.
#[derive(Clone, Debug, Default)]
pub struct Inputs {
    /// By their places among the inputs of the netlist.
    pub sources: Vec<Source>,
    /// The value of a variable none of whose [choices](Source::Choice) is on.
    pub resting: BTreeMap<Name, Datum>,
    /// The place of the sign in a variable whose bits are inputs.
    signs: BTreeMap<Name, u32>,
}

impl Inputs {
    /// The values of all variables, where the inputs of the netlist are these.
    pub fn values(&self, row: &[bool]) -> Vec<(Name, Datum)> {
        let mut values = Vec::new();
        let mut numbers: BTreeMap<&Name, Datum> = BTreeMap::new();
        let mut words: BTreeMap<&Name, i64> = BTreeMap::new();
        for (source, on) in self.sources.iter().zip(row) {
            match source {
                Source::Bit(name) => values.push((name.clone(), (*on).into())),
                Source::Choice { variable, value } if *on => {
                    numbers.entry(variable).or_insert(*value);
                }
                Source::WordBit { variable, bit } => {
                    *words.entry(variable).or_default() |= self.set(variable, *bit, *on);
                }
                _ => {}
            }
        }
        let words = words.into_iter();
        values.extend(words.map(|(name, word)| (name.clone(), word.into())));
        for (name, rest) in &self.resting {
            let value = numbers.get(name).unwrap_or(rest);
            values.push((name.clone(), *value));
        }
        values
    }

    /// What a bit that is on adds to its word.
    fn set(&self, variable: &Name, bit: u32, on: bool) -> i64 {
        match (on, self.signs.get(variable)) {
            (false, _) => 0,
            (true, Some(sign)) if *sign == bit => -1 << bit,
            (true, _) => 1 << bit,
        }
    }

    fn add(&mut self, net: &mut Netlist, name: &str, source: Source) -> Signal {
        let signal = net.input(name);
        if net.inputs().len() > self.sources.len() {
            self.sources.push(source);
        }
        signal
    }

    /// A variable that is on or off.
    pub(crate) fn bit(&mut self, net: &mut Netlist, name: &Name) -> Signal {
        self.add(net, name, Source::Bit(name.clone()))
    }

    /// A whole number with so many bits, the highest of which is its sign if it has
    /// one.
    pub(crate) fn word(
        &mut self,
        net: &mut Netlist,
        name: &Name,
        bits: u32,
        is_signed: bool,
    ) -> Word {
        let own = (0..bits).map(|bit| {
            let source = Source::WordBit {
                variable: name.clone(),
                bit,
            };
            self.add(net, &format!("{name}.{bit}"), source)
        });
        let own: Vec<Signal> = own.collect();
        let above = match own.last() {
            Some(sign) if is_signed => {
                self.signs.insert(name.clone(), bits - 1);
                *sign
            }
            _ => Signal::FALSE,
        };
        Word::of(|at| own.get(at).copied().unwrap_or(above), true)
    }

    /// Something else that is free in each scan.
    pub(crate) fn free(&mut self, net: &mut Netlist, name: &str, source: Source) -> Signal {
        self.add(net, name, source)
    }

    /// A number, by one value for each range that comparisons with these
    /// constants can tell apart.
    pub(crate) fn number(
        &mut self,
        net: &mut Netlist,
        name: &Name,
        kind: Option<Kind>,
        compared: &[Datum],
    ) -> Value {
        let all = representatives(kind, compared);
        // The value nearest to 0 is what it has when nothing is said of it.
        let nearest = |value: &&Datum| value.real().abs();
        let by_size = |a: &&Datum, b: &&Datum| nearest(a).total_cmp(&nearest(b));
        let rest = all.iter().min_by(by_size).copied().unwrap_or_default();
        self.resting.insert(name.clone(), rest);
        let mut none = Signal::TRUE;
        let mut cases = Vec::new();
        for value in all.into_iter().filter(|value| value.key() != rest.key()) {
            let variable = name.clone();
            let source = Source::Choice { variable, value };
            let own = self.add(net, &format!("{name}={value}"), source);
            cases.push((value, net.and(none, own)));
            none = net.and(none, !own);
        }
        cases.push((rest, none));
        gathered(net, cases)
    }
}

/// A value of each range that comparisons with the constants tell apart.
fn representatives(kind: Option<Kind>, compared: &[Datum]) -> Vec<Datum> {
    let number = |value: f64| match kind {
        Some(Kind::Real) => Datum::Real(value),
        _ if value.fract() == 0.0 && value.abs() < 9e15 => Datum::Integer(value as i64),
        _ => Datum::Real(value),
    };
    let mut constants: Vec<f64> = compared.iter().map(|it| it.real()).collect();
    constants.retain(|it| it.is_finite());
    constants.sort_by(f64::total_cmp);
    constants.dedup();
    let is_whole = kind == Some(Kind::Integer);
    let mut all = BTreeSet::new();
    let mut values = Vec::new();
    let mut add = |value: f64| {
        if all.insert(value.to_bits()) {
            values.push(number(value));
        }
    };
    for (at, &constant) in constants.iter().enumerate() {
        if at == 0 {
            add(constant.floor() - 1.0);
        }
        if !is_whole || constant.fract() == 0.0 {
            add(constant);
        }
        let next = constants.get(at + 1).copied();
        let whole = constant.floor() + 1.0;
        match next {
            Some(next) if whole < next => add(whole),
            Some(next) if !is_whole => add(f64::midpoint(constant, next)),
            Some(_) => {}
            None => add(whole),
        }
    }
    values
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(kind: Option<Kind>, constants: &[&str]) -> String {
        let constants: Vec<Datum> = constants
            .iter()
            .filter_map(|it| Datum::constant(it))
            .collect();
        let all = representatives(kind, &constants);
        all.iter()
            .map(Datum::to_string)
            .collect::<Vec<_>>()
            .join(" ")
    }

    #[test]
    fn a_number_has_a_value_in_each_range_that_can_be_told_apart() {
        assert_eq!(of(Some(Kind::Integer), &["50"]), "49 50 51");
        assert_eq!(of(Some(Kind::Integer), &["5", "6"]), "4 5 6 7");
        assert_eq!(of(Some(Kind::Integer), &["2.5"]), "1 3");
        assert_eq!(of(None, &["5", "6"]), "4 5 5.5 6 7");
        assert_eq!(of(Some(Kind::Real), &["0", "80"]), "-1 0 1 80 81");
    }
}
