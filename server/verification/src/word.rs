//! Whole numbers by their bits.
//!
//! The interpreters keep every whole number in 64 bits, as its two's complement,
//! whatever the width of its type. So does a [`Word`]: a signal for each bit. Most
//! are constant, and what is made of them costs nothing.

use logic::{Datum, Relation};
use proof::{Gates, Netlist, Signal};

use crate::value::MOST_VALUES;

const BITS: usize = 64;
const SIGN: usize = BITS - 1;

/// Up to here a number with a fraction tells all whole numbers apart.
const EXACT: f64 = 9e15;

/// A number whose bits are signals.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Word {
    /// From the lowest to the sign.
    bits: Box<[Signal; BITS]>,
    /// Whether it is a number for certain: what was never written may be off
    /// instead of 0.
    is_number: bool,
}

impl Word {
    /// Of a signal for each bit.
    pub fn of(bits: impl Fn(usize) -> Signal, is_number: bool) -> Self {
        Self {
            bits: Box::new(std::array::from_fn(bits)),
            is_number,
        }
    }

    /// Always this number.
    pub fn constant(number: i64) -> Self {
        Self::of(|at| Signal::constant(number >> at & 1 == 1), true)
    }

    /// One of several values, each as the nearest whole number.
    pub fn of_cases(net: &mut Netlist, cases: &[(Datum, Signal)]) -> Self {
        let is_number = |(value, _): &(Datum, Signal)| !matches!(value, Datum::Bool(_));
        let mut bits = Box::new([Signal::FALSE; BITS]);
        for (at, bit) in bits.iter_mut().enumerate() {
            let is_set = |(value, _): &&(Datum, Signal)| value.integer() >> at & 1 == 1;
            let set = cases.iter().filter(is_set).map(|(_, when)| *when);
            let set: Vec<Signal> = set.collect();
            *bit = match set.len() == cases.len() {
                true => Signal::TRUE,
                false => net.any(&set),
            };
        }
        Self {
            bits,
            is_number: cases.iter().all(is_number),
        }
    }

    /// Whether it is a number for certain, and never off or on.
    pub fn is_number(&self) -> bool {
        self.is_number
    }

    /// The same as a number: what is off is 0.
    pub fn number(mut self) -> Self {
        self.is_number = true;
        self
    }

    /// The same as what may be off instead of 0.
    pub fn uncertain(mut self) -> Self {
        self.is_number = false;
        self
    }

    /// A bit, the lowest being 0.
    pub fn bit(&self, at: u32) -> Signal {
        self.bits.get(at as usize).copied().unwrap_or(Signal::FALSE)
    }

    /// The bits, from the lowest to the sign.
    pub fn bits(&self) -> &[Signal] {
        &*self.bits
    }

    /// The number with one of its bits changed.
    pub fn with(mut self, at: u32, bit: Signal) -> Self {
        if let Some(own) = self.bits.get_mut(at as usize) {
            *own = bit;
        }
        self.number()
    }

    /// When it is not 0.
    pub fn on(&self, net: &mut Netlist) -> Signal {
        net.any(&*self.bits)
    }

    /// `then` where the condition holds, else `otherwise`.
    pub fn chosen(net: &mut Netlist, condition: Signal, then: &Self, otherwise: &Self) -> Self {
        let mut bits = otherwise.bits.clone();
        for (own, then) in bits.iter_mut().zip(&*then.bits) {
            *own = net.ite(condition, *then, *own);
        }
        Self {
            bits,
            is_number: then.is_number && otherwise.is_number,
        }
    }

    /// When the relation holds between two numbers.
    pub fn compares(&self, net: &mut Netlist, relation: Relation, other: &Self) -> Signal {
        match relation {
            Relation::Equal | Relation::NotEqual => {
                let pairs = self.bits.iter().zip(&*other.bits);
                let equal: Vec<Signal> = pairs.map(|(a, b)| net.equal(*a, *b)).collect();
                let equal = net.all(&equal);
                match relation {
                    Relation::Equal => equal,
                    _ => !equal,
                }
            }
            Relation::Less => self.is_less(net, other),
            Relation::GreaterOrEqual => !self.is_less(net, other),
            Relation::Greater => other.is_less(net, self),
            Relation::LessOrEqual => !other.is_less(net, self),
        }
    }

    fn is_less(&self, net: &mut Netlist, other: &Self) -> Signal {
        let mut less = Signal::FALSE;
        for at in 0..BITS {
            // The highest bit in which they differ decides; the sign the other way.
            let (own, other) = (self.bits[at], other.bits[at]);
            let differ = net.xor(own, other);
            let is_larger = if at == SIGN { own } else { other };
            less = net.ite(differ, is_larger, less);
        }
        less
    }

    /// When the relation holds with a constant. `None` with a number that is so
    /// large that its fraction tells whole numbers no more apart.
    pub fn compares_with(
        &self,
        net: &mut Netlist,
        relation: Relation,
        constant: Datum,
    ) -> Option<Signal> {
        let Datum::Real(number) = constant else {
            let other = Self::constant(constant.integer());
            return Some(self.compares(net, relation, &other));
        };
        if number.is_nan() || number.abs() >= EXACT {
            return None;
        }
        let (below, above) = (number.floor() as i64, number.ceil() as i64);
        if below != above && matches!(relation, Relation::Equal | Relation::NotEqual) {
            return Some(Signal::constant(relation == Relation::NotEqual));
        }
        let whole = match relation {
            Relation::Less | Relation::GreaterOrEqual => above,
            _ => below,
        };
        Some(self.compares(net, relation, &Self::constant(whole)))
    }

    /// Each number that it can be, and when; `None` if there are too many, or it
    /// may be no number.
    pub fn cases(&self, net: &mut Netlist) -> Option<Vec<(Datum, Signal)>> {
        if !self.is_number {
            return None;
        }
        let mut cases = vec![(0_i64, Signal::TRUE)];
        // A sign has many copies; each signal is taken once.
        let mut taken: Vec<(Signal, usize)> = Vec::new();
        for (at, bit) in self.bits.iter().enumerate() {
            let known = taken.iter().find(|(it, _)| *it == *bit || *it == !*bit);
            if let Some(&(same, from)) = known {
                for (number, _) in &mut cases {
                    let is_set = (*number >> from & 1 == 1) == (same == *bit);
                    *number |= i64::from(is_set) << at;
                }
                continue;
            }
            taken.push((*bit, at));
            let mut longer = Vec::with_capacity(2 * cases.len());
            for (number, when) in cases {
                for (is_set, also) in [(false, !*bit), (true, *bit)] {
                    let when = net.and(when, also);
                    if when != Signal::FALSE {
                        longer.push((number | i64::from(is_set) << at, when));
                    }
                }
            }
            if longer.len() > MOST_VALUES {
                return None;
            }
            cases = longer;
        }
        let cases = cases.into_iter();
        Some(cases.map(|(number, when)| (number.into(), when)).collect())
    }
}
