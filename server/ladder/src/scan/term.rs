//! Arithmetic terms, as comparisons and assignments hold them.
//!
//! ```text
//! term   = xor { "OR" xor }
//! xor    = and { "XOR" and }
//! and    = sum { ("AND" | "&") sum }
//! sum    = product { ("+" | "-") product }
//! product = power { ("*" | "/" | "%" | "MOD") power }
//! power  = sign [ "**" power ]
//! sign   = ("-" | "+" | "NOT") sign | constant | name | name "(" [term {"," term}] ")" | "(" term ")"
//! ```
//!
//! Words are read without regard to case. A division by 0 gives 0:
//! controllers differ there, and most raise a fault. What does not fit gives
//! no value; the machine then treats the whole term as an input.

use logic::Datum;

/// Terms nest at most this deep.
const DEEPEST: usize = 100;

/// The value of `text`, with the values of its variables given by `read`.
pub(super) fn evaluate(text: &str, read: &dyn Fn(&str) -> Datum) -> Option<Datum> {
    let mut parser = Parser {
        text,
        at: 0,
        depth: 0,
        read,
    };
    let value = parser.disjunction()?;
    parser.blank();
    (parser.at == text.len()).then_some(value)
}

struct Parser<'t> {
    text: &'t str,
    at: usize,
    depth: usize,
    read: &'t dyn Fn(&str) -> Datum,
}

impl Parser<'_> {
    fn disjunction(&mut self) -> Option<Datum> {
        let mut value = self.exclusion()?;
        while self.word("OR") {
            value = bitwise(value, self.exclusion()?, |a, b| a | b);
        }
        Some(value)
    }

    fn exclusion(&mut self) -> Option<Datum> {
        let mut value = self.conjunction()?;
        while self.word("XOR") {
            value = bitwise(value, self.conjunction()?, |a, b| a ^ b);
        }
        Some(value)
    }

    fn conjunction(&mut self) -> Option<Datum> {
        let mut value = self.sum()?;
        while self.word("AND") || self.sign("&") {
            value = bitwise(value, self.sum()?, |a, b| a & b);
        }
        Some(value)
    }

    fn sum(&mut self) -> Option<Datum> {
        let mut value = self.product()?;
        loop {
            if self.sign("+") {
                value = value.combine(self.product()?, i64::wrapping_add, |a, b| a + b);
            } else if self.sign("-") {
                value = value.combine(self.product()?, i64::wrapping_sub, |a, b| a - b);
            } else {
                return Some(value);
            }
        }
    }

    fn product(&mut self) -> Option<Datum> {
        let mut value = self.power()?;
        loop {
            if self.sign("*") {
                value = value.combine(self.power()?, i64::wrapping_mul, |a, b| a * b);
            } else if self.sign("/") {
                value = quotient(value, self.power()?);
            } else if self.sign("%") || self.word("MOD") {
                value = remainder(value, self.power()?);
            } else {
                return Some(value);
            }
        }
    }

    fn power(&mut self) -> Option<Datum> {
        let base = self.signed()?;
        if !self.sign("**") {
            return Some(base);
        }
        self.deeper(Self::power)
            .map(|exponent| Datum::Real(base.real().powf(exponent.real())))
    }

    fn signed(&mut self) -> Option<Datum> {
        if self.sign("-") {
            let value = self.deeper(Self::signed)?;
            Some(Datum::Integer(0).combine(value, i64::wrapping_sub, |a, b| a - b))
        } else if self.sign("+") {
            self.deeper(Self::signed)
        } else if self.word("NOT") {
            let value = self.deeper(Self::signed)?;
            Some(match value {
                Datum::Bool(on) => Datum::Bool(!on),
                other => Datum::Integer(!other.integer()),
            })
        } else if self.sign("(") {
            let value = self.deeper(Self::disjunction)?;
            self.sign(")").then_some(value)
        } else {
            self.atom()
        }
    }

    fn atom(&mut self) -> Option<Datum> {
        self.blank();
        let rest = self.text.get(self.at..)?;
        let length = atom_length(rest);
        let atom = rest.get(..length).filter(|atom| !atom.is_empty())?;
        self.at += length;
        if let Some(value) = Datum::constant(atom) {
            return Some(value);
        }
        if atom.starts_with(|c: char| c.is_ascii_digit()) {
            return None;
        }
        if !self.sign("(") {
            return Some((self.read)(atom));
        }
        let arguments = self.deeper(Self::arguments)?;
        function(&atom.to_ascii_uppercase(), &arguments)
    }

    fn arguments(&mut self) -> Option<Vec<Datum>> {
        let mut arguments = Vec::new();
        if self.sign(")") {
            return Some(arguments);
        }
        loop {
            arguments.push(self.disjunction()?);
            if self.sign(")") {
                return Some(arguments);
            }
            if !self.sign(",") {
                return None;
            }
        }
    }

    fn deeper<T>(&mut self, read: impl FnOnce(&mut Self) -> Option<T>) -> Option<T> {
        if self.depth == DEEPEST {
            return None;
        }
        self.depth += 1;
        let value = read(self);
        self.depth -= 1;
        value
    }

    fn blank(&mut self) {
        let rest = self.text.get(self.at..).unwrap_or_default();
        self.at += rest.len() - rest.trim_start().len();
    }

    /// Takes a sign if it stands next. `*` is not the half of a `**`.
    fn sign(&mut self, sign: &str) -> bool {
        self.blank();
        let rest = self.text.get(self.at..).unwrap_or_default();
        let found = rest.starts_with(sign) && !(sign == "*" && rest.starts_with("**"));
        if found {
            self.at += sign.len();
        }
        found
    }

    /// Takes a word if it stands next, in either case and by itself.
    fn word(&mut self, word: &str) -> bool {
        self.blank();
        let rest = self.text.get(self.at..).unwrap_or_default();
        let found = rest
            .get(..word.len())
            .is_some_and(|head| head.eq_ignore_ascii_case(word))
            && atom_length(rest) == word.len();
        if found {
            self.at += word.len();
        }
        found
    }
}

/// How far a name or constant goes on from the start of `text`: `A.B[i+1].C`,
/// `Local:1:I.Data.0`, `16#F0`, `1e-5`.
pub(super) fn atom_length(text: &str) -> usize {
    let number = text.starts_with(|c: char| c.is_ascii_digit());
    let based = number && text.contains('#');
    let mut open = 0usize;
    let mut before = ' ';
    for (at, c) in text.char_indices() {
        let inside = match c {
            '[' => {
                open += 1;
                at > 0
            }
            ']' if open > 0 => {
                open -= 1;
                true
            }
            _ if open > 0 => true,
            '+' | '-' if number && !based => matches!(before, 'e' | 'E'),
            _ => c.is_alphanumeric() || matches!(c, '_' | '.' | ':' | '#' | '\\' | '@' | '$'),
        };
        // A leading `%` marks an address; within a term it is the remainder.
        let address = at == 0 && c == '%' && text[1..].starts_with(char::is_alphabetic);
        if !inside && !address {
            return at;
        }
        before = c;
    }
    if open == 0 { text.len() } else { 0 }
}

fn bitwise(a: Datum, b: Datum, operation: impl Fn(i64, i64) -> i64) -> Datum {
    let value = operation(a.integer(), b.integer());
    match (a, b) {
        (Datum::Bool(_), Datum::Bool(_)) => Datum::Bool(value != 0),
        _ => Datum::Integer(value),
    }
}

fn quotient(a: Datum, b: Datum) -> Datum {
    if !b.is_on() {
        return Datum::Integer(0);
    }
    a.combine(b, i64::wrapping_div, |a, b| a / b)
}

fn remainder(a: Datum, b: Datum) -> Datum {
    if !b.is_on() {
        return Datum::Integer(0);
    }
    a.combine(b, i64::wrapping_rem, |a, b| a % b)
}

fn function(name: &str, arguments: &[Datum]) -> Option<Datum> {
    let real = |value: f64| Some(Datum::Real(value));
    match (name, arguments) {
        ("ADD", [a, b]) => Some(a.combine(*b, i64::wrapping_add, |a, b| a + b)),
        ("SUB", [a, b]) => Some(a.combine(*b, i64::wrapping_sub, |a, b| a - b)),
        ("MUL", [a, b]) => Some(a.combine(*b, i64::wrapping_mul, |a, b| a * b)),
        ("DIV", [a, b]) => Some(quotient(*a, *b)),
        ("MOD", [a, b]) => Some(remainder(*a, *b)),
        ("NEG", [a]) => Some(Datum::Integer(0).combine(*a, i64::wrapping_sub, |a, b| a - b)),
        ("ABS", [a]) => Some(match a {
            Datum::Real(number) => Datum::Real(number.abs()),
            other => Datum::Integer(other.integer().wrapping_abs()),
        }),
        ("MIN", [first, rest @ ..]) => {
            Some(rest.iter().fold(*first, |least, next| least.smaller(*next)))
        }
        ("MAX", [first, rest @ ..]) => {
            Some(rest.iter().fold(*first, |most, next| most.larger(*next)))
        }
        ("LIMIT", [low, value, high]) => Some(value.larger(*low).smaller(*high)),
        ("SEL", [which, off, on]) => Some(if which.is_on() { *on } else { *off }),
        ("SQR" | "SQRT", [a]) => real(a.real().max(0.0).sqrt()),
        ("SIN", [a]) => real(a.real().sin()),
        ("COS", [a]) => real(a.real().cos()),
        ("TAN", [a]) => real(a.real().tan()),
        ("LN", [a]) => real(a.real().ln()),
        ("LOG", [a]) => real(a.real().log10()),
        ("EXP", [a]) => real(a.real().exp()),
        ("TRUNC" | "TRN", [a]) => Some(Datum::Integer(a.real().trunc() as i64)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(text: &str) -> Option<Datum> {
        evaluate(text, &|name| match name {
            "a" => Datum::Integer(7),
            "b" => Datum::Integer(2),
            "Rec.Level[b]" => Datum::Real(1.5),
            "%MW10" => Datum::Integer(100),
            _ => Datum::Integer(0),
        })
    }

    #[test]
    fn terms_are_computed_as_written() {
        let cases = [
            ("a + b * 3", Datum::Integer(13)),
            ("(a+b)*3", Datum::Integer(27)),
            ("a / b", Datum::Integer(3)),
            ("a / 2.0", Datum::Real(3.5)),
            ("a MOD b", Datum::Integer(1)),
            ("a % b", Datum::Integer(1)),
            ("%MW10 - -a", Datum::Integer(107)),
            ("Rec.Level[b] * 2", Datum::Real(3.0)),
            ("b ** 3", Datum::Real(8.0)),
            ("a AND 16#3", Datum::Integer(3)),
            ("ADD(a, MAX(b, 5))", Datum::Integer(12)),
            ("LIMIT(0, a, 5)", Datum::Integer(5)),
            ("a / 0", Datum::Integer(0)),
            ("1e-1 + 0.9", Datum::Real(1.0)),
        ];
        for (text, expected) in cases {
            assert_eq!(value(text), Some(expected), "{text}");
        }
    }

    #[test]
    fn what_is_no_term_has_no_value() {
        for text in ["", "a +", "(a", "a b", "UNHEARD(a)", "'text'", "a[b", "5x"] {
            assert_eq!(value(text), None, "{text}");
        }
        assert_eq!(value(&"(".repeat(100_000)), None);
        assert_eq!(value(&"-".repeat(100_000)), None);
    }
}
