use std::cmp::Ordering;
use std::fmt::{self, Display, Formatter};

use crate::Relation;
use crate::notation::unit_in_milliseconds;

/// The value of a variable, in whatever is run: a ladder, a grafcet, a
/// scenario.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Datum {
    /// Off or on.
    Bool(bool),
    /// A whole number, whatever the width of its type; times in milliseconds.
    Integer(i64),
    /// A number with a fraction.
    Real(f64),
}

impl Default for Datum {
    fn default() -> Self {
        Self::Bool(false)
    }
}

impl Datum {
    /// Reads a constant: `5`, `-2.5`, `1e3`, `16#F0`, `TRUE`, `T#1m30s`, `500ms`.
    /// Times are milliseconds.
    pub fn constant(text: &str) -> Option<Self> {
        let text = text.trim();
        let first = text.chars().next()?;
        if text.eq_ignore_ascii_case("true") {
            return Some(Self::Bool(true));
        }
        if text.eq_ignore_ascii_case("false") {
            return Some(Self::Bool(false));
        }
        if let Some(time) = duration(text) {
            return Some(Self::Integer(time));
        }
        if !(first.is_ascii_digit() || matches!(first, '-' | '+' | '.')) {
            return None;
        }
        let plain: String = text.chars().filter(|&c| c != '_').collect();
        if let Some((base, digits)) = plain.split_once('#') {
            let base = base.parse().ok().filter(|base| (2..=36).contains(base))?;
            return i64::from_str_radix(digits, base).ok().map(Self::Integer);
        }
        if let Ok(number) = plain.parse() {
            return Some(Self::Integer(number));
        }
        plain.parse().ok().map(Self::Real)
    }

    /// Whether a contact with this value is on: anything but 0 is.
    pub fn is_on(self) -> bool {
        match self {
            Self::Bool(on) => on,
            Self::Integer(number) => number != 0,
            Self::Real(number) => number != 0.0,
        }
    }

    /// The nearest whole number, the even one of two; on is 1.
    pub fn integer(self) -> i64 {
        match self {
            Self::Bool(on) => i64::from(on),
            Self::Integer(number) => number,
            Self::Real(number) => number.round_ties_even() as i64,
        }
    }

    /// The value as a number with a fraction.
    pub fn real(self) -> f64 {
        match self {
            Self::Real(number) => number,
            other => other.integer() as f64,
        }
    }

    /// The value as two numbers, equal where nothing tells the values apart. A
    /// number that is none (NaN) is itself here; on and 1 differ.
    pub fn key(self) -> [u64; 2] {
        match self {
            Self::Bool(on) => [0, u64::from(on)],
            Self::Integer(number) => [1, number.cast_unsigned()],
            Self::Real(number) => [2, number.to_bits()],
        }
    }

    /// Whether the relation holds between two values. Nothing holds with a
    /// number that is none (NaN) but `<>`.
    pub fn compares(self, relation: Relation, other: Self) -> bool {
        match (self, other) {
            (Self::Real(_), _) | (_, Self::Real(_)) => relation.holds(self.real(), other.real()),
            _ => relation.holds(self.integer(), other.integer()),
        }
    }

    /// The result of `whole` for two values without a fraction, else of
    /// `fraction`.
    #[must_use]
    pub fn combine(
        self,
        other: Self,
        whole: impl Fn(i64, i64) -> i64,
        fraction: impl Fn(f64, f64) -> f64,
    ) -> Self {
        match (self, other) {
            (Self::Real(_), _) | (_, Self::Real(_)) => {
                Self::Real(fraction(self.real(), other.real()))
            }
            _ => Self::Integer(whole(self.integer(), other.integer())),
        }
    }

    /// The smaller of two values; this one where neither is.
    #[must_use]
    pub fn smaller(self, other: Self) -> Self {
        match self.real().partial_cmp(&other.real()) {
            Some(Ordering::Greater) => other,
            _ => self,
        }
    }

    /// The larger of two values; this one where neither is.
    #[must_use]
    pub fn larger(self, other: Self) -> Self {
        match self.real().partial_cmp(&other.real()) {
            Some(Ordering::Less) => other,
            _ => self,
        }
    }
}

/// Reads a duration in milliseconds: `T#5s`, `TIME#1h2m`, `500ms`, `2.5s`.
pub fn duration(text: &str) -> Option<i64> {
    let text = text.trim();
    let after = |prefix: &str| {
        let head = text.get(..prefix.len())?;
        head.eq_ignore_ascii_case(prefix)
            .then(|| &text[prefix.len()..])
    };
    let marked = after("t#").or_else(|| after("time#"));
    let (negative, mut rest) = match marked {
        Some(rest) => (rest.starts_with('-'), rest.trim_start_matches('-')),
        None => (false, text),
    };
    if rest.is_empty() {
        return None;
    }
    let mut total = 0.0;
    while !rest.is_empty() {
        let digits = rest
            .find(|c: char| !(c.is_ascii_digit() || matches!(c, '.' | '_')))
            .filter(|&end| end > 0)?;
        let number: f64 = rest[..digits].replace('_', "").parse().ok()?;
        rest = &rest[digits..];
        let letters = rest
            .find(|c: char| !c.is_ascii_alphabetic())
            .unwrap_or(rest.len());
        let unit = match &*rest[..letters].to_ascii_lowercase() {
            "us" => 0.001,
            other => unit_in_milliseconds(other)?,
        };
        total += number * unit;
        rest = rest[letters..].trim_start_matches('_');
    }
    let total = total.round() as i64;
    Some(if negative { -total } else { total })
}

impl Display for Datum {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Bool(on) => write!(f, "{}", u8::from(*on)),
            Self::Integer(number) => write!(f, "{number}"),
            Self::Real(number) => write!(f, "{number}"),
        }
    }
}

impl From<bool> for Datum {
    fn from(on: bool) -> Self {
        Self::Bool(on)
    }
}

impl From<i64> for Datum {
    fn from(number: i64) -> Self {
        Self::Integer(number)
    }
}

impl From<f64> for Datum {
    fn from(number: f64) -> Self {
        Self::Real(number)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constants_are_read_in_every_notation_that_formats_use() {
        let cases = [
            ("5", Datum::Integer(5)),
            ("-2.5", Datum::Real(-2.5)),
            ("16#F0", Datum::Integer(240)),
            ("1_000", Datum::Integer(1000)),
            ("TRUE", Datum::Bool(true)),
            ("T#1m30s", Datum::Integer(90_000)),
            ("500ms", Datum::Integer(500)),
            ("t#2.5s", Datum::Integer(2_500)),
            ("1e3", Datum::Real(1000.0)),
        ];
        for (text, value) in cases {
            assert_eq!(Datum::constant(text), Some(value), "{text}");
        }
        for text in ["", "v1", "5 apples", "16#", "T#", "s", "'a'"] {
            assert_eq!(Datum::constant(text), None, "{text}");
        }
    }
}
