//! Values that depend on signals.
//!
//! A variable of a program holds one of finitely many values, and a signal for
//! each says when. Booleans are the common case: two values, one signal and its
//! complement. What computes with numbers is tried for every value that its
//! operands can have. A word whose bits are written one by one has too many
//! values for that: it is kept by its bits.

use std::borrow::Cow;

use logic::{Datum, Relation};
use proof::{Gates, Netlist, Signal};

use crate::word::Word;

/// A variable that can have more values than this is not followed.
pub(crate) const MOST_VALUES: usize = 96;

/// So many pairs of values are compared pair by pair, more by their bits.
const FEW_PAIRS: usize = 64;

/// What a variable holds at some point of a scan.
#[derive(Clone, Debug)]
pub(crate) enum Value {
    /// Each value that it can have, and when. No two of the signals are 1 at
    /// once, and one of them is.
    Known(Vec<(Datum, Signal)>),
    /// A whole number by its bits.
    Word(Word),
    /// A number that is not followed. Equal numbers mean the same unknown.
    Unknown(usize),
}

impl Value {
    /// Always this one.
    pub fn constant(value: Datum) -> Self {
        Self::Known(vec![(value, Signal::TRUE)])
    }

    /// On while the signal is 1.
    pub fn bit(on: Signal) -> Self {
        match on {
            Signal::TRUE => Self::constant(true.into()),
            Signal::FALSE => Self::constant(false.into()),
            _ => Self::Known(vec![(false.into(), !on), (true.into(), on)]),
        }
    }

    /// The signal that says whether it is on, if it is nothing but on or off.
    fn as_bit(&self) -> Option<Signal> {
        match self {
            Self::Known(all) => match all.as_slice() {
                [(Datum::Bool(on), _)] => Some(Signal::constant(*on)),
                [(Datum::Bool(false), _), (Datum::Bool(true), on)] => Some(*on),
                _ => None,
            },
            Self::Word(_) | Self::Unknown(_) => None,
        }
    }

    /// When it is on. `None` if it is unknown.
    pub fn on(&self, net: &mut Netlist) -> Option<Signal> {
        let all = match self {
            Self::Known(all) => all,
            Self::Word(word) => return Some(word.on(net)),
            Self::Unknown(_) => return None,
        };
        let on = all.iter().filter(|(value, _)| value.is_on());
        let on: Vec<Signal> = on.map(|(_, when)| *when).collect();
        Some(match on.len() == all.len() {
            true => Signal::TRUE,
            false => net.any(&on),
        })
    }

    /// The values with their signals; none of an unknown, or of a word by its bits.
    pub fn cases(&self) -> &[(Datum, Signal)] {
        match self {
            Self::Known(all) => all,
            Self::Word(_) | Self::Unknown(_) => &[],
        }
    }

    /// Its bits, if it is a word by its bits.
    pub fn bits(&self) -> &[Signal] {
        match self {
            Self::Word(word) => word.bits(),
            Self::Known(_) | Self::Unknown(_) => &[],
        }
    }

    /// The values with their signals. `None` if it is unknown, or has too many.
    pub fn listed(&self, net: &mut Netlist) -> Option<Cow<'_, [(Datum, Signal)]>> {
        match self {
            Self::Known(all) => Some(Cow::Borrowed(all)),
            Self::Word(word) => word.cases(net).map(Cow::Owned),
            Self::Unknown(_) => None,
        }
    }

    /// Its bits, of the nearest whole number. `None` if it is unknown.
    pub fn rounded(&self, net: &mut Netlist) -> Option<Word> {
        match self {
            Self::Known(all) => Some(Word::of_cases(net, all)),
            Self::Word(word) => Some(word.clone()),
            Self::Unknown(_) => None,
        }
    }

    /// The same by its bits. `None` if it is unknown or has a fraction.
    pub fn word(&self, net: &mut Netlist) -> Option<Word> {
        let is_whole = |(value, _): &(Datum, Signal)| !matches!(value, Datum::Real(_));
        match self {
            Self::Known(all) if !all.iter().all(is_whole) => None,
            value => value.rounded(net),
        }
    }

    /// When the relation holds with another. `None` if one is unknown or too many
    /// cases would have to be tried.
    pub fn compares(&self, net: &mut Netlist, relation: Relation, other: &Self) -> Option<Signal> {
        match (self, other) {
            (Self::Word(own), Self::Word(other)) => Some(own.compares(net, relation, other)),
            (Self::Word(own), Self::Known(others)) => {
                if let Some(other) = other.word(net) {
                    return Some(own.compares(net, relation, &other));
                }
                let mut holds = Vec::with_capacity(others.len());
                for (value, when) in others {
                    let also = own.compares_with(net, relation, *value)?;
                    holds.push(net.and(*when, also));
                }
                Some(net.any(&holds))
            }
            (Self::Known(_), Self::Word(_)) => other.compares(net, relation.mirrored(), self),
            (Self::Known(own), Self::Known(others))
                if own.len() * others.len() > FEW_PAIRS
                    && let (Some(own), Some(other)) = (self.word(net), other.word(net)) =>
            {
                Some(own.compares(net, relation, &other))
            }
            _ => {
                let compared = applied(net, &[self, other], |both| {
                    both[0].compares(relation, both[1]).into()
                });
                compared.and_then(|it| it.on(net))
            }
        }
    }

    /// When it equals another as a number, off being 0 and on 1.
    pub fn equals(&self, other: &Self, net: &mut Netlist) -> Option<Signal> {
        let (Self::Known(own), Self::Known(others)) = (self, other) else {
            return self.compares(net, Relation::Equal, other);
        };
        if let (Some(one), Some(two)) = (self.as_bit(), other.as_bit()) {
            return Some(net.equal(one, two));
        }
        let mut equal = Vec::new();
        for (one, when) in own {
            for (two, also) in others {
                if one.key() == two.key() || one.compares(Relation::Equal, *two) {
                    equal.push(net.and(*when, *also));
                }
            }
        }
        Some(net.any(&equal))
    }
}

/// Cases in one order, each value once, without those that cannot be.
pub(crate) fn gathered(net: &mut Netlist, cases: Vec<(Datum, Signal)>) -> Value {
    let mut cases = cases;
    cases.retain(|(_, when)| *when != Signal::FALSE);
    cases.sort_by_key(|(value, _)| value.key());
    let mut all: Vec<(Datum, Signal)> = Vec::new();
    for (value, when) in cases {
        match all.last_mut() {
            Some((last, known)) if last.key() == value.key() => *known = net.or(*known, when),
            _ => all.push((value, when)),
        }
    }
    match all.as_mut_slice() {
        [] => return Value::constant(Datum::default()),
        // What is the only possibility holds always.
        [(_, when)] => *when = Signal::TRUE,
        // A bit and its complement are one signal.
        [(Datum::Bool(false), off), (Datum::Bool(true), on)] => *off = !*on,
        _ => {}
    }
    Value::Known(all)
}

/// `then` where `condition` holds, else `otherwise`. `None` if one is unknown
/// and it is not known which of the two it is.
pub(crate) fn chosen(
    net: &mut Netlist,
    condition: Signal,
    then: &Value,
    otherwise: &Value,
) -> Option<Value> {
    match condition {
        Signal::TRUE => return Some(then.clone()),
        Signal::FALSE => return Some(otherwise.clone()),
        _ => {}
    }
    if let (Some(then), Some(otherwise)) = (then.as_bit(), otherwise.as_bit()) {
        return Some(Value::bit(net.ite(condition, then, otherwise)));
    }
    match (then, otherwise) {
        (Value::Unknown(one), Value::Unknown(two)) if one == two => Some(then.clone()),
        (Value::Known(own), Value::Known(others)) => {
            let mut cases = Vec::with_capacity(own.len() + others.len());
            for (value, when) in own {
                let other = others.iter().find(|(it, _)| it.key() == value.key());
                let when = match other {
                    Some((_, other)) => net.ite(condition, *when, *other),
                    None => net.and(condition, *when),
                };
                cases.push((*value, when));
            }
            for (value, when) in others {
                if !own.iter().any(|(it, _)| it.key() == value.key()) {
                    cases.push((*value, net.and(!condition, *when)));
                }
            }
            Some(gathered(net, cases))
        }
        (Value::Word(_), _) | (_, Value::Word(_)) => {
            let (then, otherwise) = (then.word(net)?, otherwise.word(net)?);
            let word = Word::chosen(net, condition, &then, &otherwise);
            Some(Value::Word(word))
        }
        _ => None,
    }
}

/// What a function of several values gives. `None` if one of them is unknown
/// or too many cases would have to be tried.
pub(crate) fn applied(
    net: &mut Netlist,
    values: &[&Value],
    function: impl Fn(&[Datum]) -> Datum,
) -> Option<Value> {
    let mut cases: Vec<(Vec<Datum>, Signal)> = vec![(Vec::new(), Signal::TRUE)];
    for value in values {
        let all = value.listed(net)?;
        if cases.len() * all.len() > MOST_VALUES * MOST_VALUES {
            return None;
        }
        let mut longer = Vec::with_capacity(cases.len() * all.len());
        for (before, when) in &cases {
            for (value, also) in &*all {
                let when = net.and(*when, *also);
                if when != Signal::FALSE {
                    let mut values = before.clone();
                    values.push(*value);
                    longer.push((values, when));
                }
            }
        }
        cases = longer;
    }
    let results = cases.iter();
    let results = results.map(|(values, when)| (function(values), *when));
    let value = gathered(net, results.collect());
    (value.cases().len() <= MOST_VALUES).then_some(value)
}
