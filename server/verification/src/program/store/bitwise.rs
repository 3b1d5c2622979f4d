//! Terms that join words bit by bit: `Status AND 16#F0`.
//!
//! Each bit of such a term depends on the same bit of its operands alone. So the
//! machine's own arithmetic is asked what it gives where all bits of an operand
//! are 0 and where all are 1: each place of the answers shows what the term does
//! there.

use ladder::scan::is_plain;
use logic::Datum;
use proof::{Gates, Signal};

use super::Store;
use crate::value::Value;
use crate::word::Word;

const OPERATORS: [&str; 4] = ["AND", "OR", "XOR", "NOT"];

/// Terms of more operands are not followed by their bits.
const MOST_OPERANDS: usize = 4;

impl Store<'_> {
    /// The value of a term that joins words bit by bit. `None` of all else.
    pub(super) fn bitwise(&mut self, text: &str) -> Option<Value> {
        let operands = operands(text)?;
        if self.is_written(text) || self.is_given(text) {
            return None;
        }
        let values = operands.iter().map(|it| self.direct(it));
        let values: Vec<Value> = values.collect::<Option<_>>()?;
        if !values.iter().any(|it| matches!(it, Value::Word(_))) {
            return None;
        }
        let words = values.iter().map(|it| it.word(&mut self.net));
        let words: Vec<Word> = words.collect::<Option<_>>()?;
        // The complement of what is off is on, that of 0 is -1.
        let are_numbers = words.iter().all(Word::is_number);
        if !are_numbers && text.to_ascii_uppercase().contains("NOT") {
            return None;
        }
        let answers = (0..1_usize << operands.len()).map(|ones| {
            let value = |name: &str| {
                let at = operands.iter().position(|it| *it == name)?;
                Some(Datum::Integer(-i64::from(ones >> at & 1 == 1)))
            };
            match self.names.compute(text, &value)? {
                Datum::Integer(answer) => Some(answer),
                _ => None,
            }
        });
        let answers: Vec<i64> = answers.collect::<Option<_>>()?;
        let mut bits = [Signal::FALSE; 64];
        for (at, bit) in (0..).zip(&mut bits) {
            *bit = self.joined(&answers, &words, at);
        }
        Some(Value::Word(Word::of(|at| bits[at], are_numbers)))
    }

    /// A bit of the term, from its answers for all ones and zeros of the words.
    fn joined(&mut self, answers: &[i64], words: &[Word], at: u32) -> Signal {
        let on = answers.iter().map(|it| Signal::constant(it >> at & 1 == 1));
        let mut on: Vec<Signal> = on.collect();
        for word in words {
            let bit = word.bit(at);
            let pairs = on.chunks(2);
            on = pairs
                .map(|pair| self.net.ite(bit, pair[1], pair[0]))
                .collect();
        }
        on.first().copied().unwrap_or(Signal::FALSE)
    }
}

/// The variables of a term of nothing but variables, whole numbers, parentheses and
/// operators that work bit by bit. `None` of any other.
fn operands(text: &str) -> Option<Vec<&str>> {
    let is_between = |c: char| c.is_whitespace() || matches!(c, '(' | ')' | '&');
    let mut operands = Vec::new();
    let mut rest = text;
    while let Some(start) = rest.find(|c| !is_between(c)) {
        rest = &rest[start..];
        let end = rest.find(is_between).unwrap_or(rest.len());
        let (part, after) = rest.split_at(end);
        rest = after;
        let is_operator = OPERATORS.iter().any(|it| part.eq_ignore_ascii_case(it));
        match Datum::constant(part) {
            _ if is_operator => {}
            Some(Datum::Integer(_)) => {}
            Some(_) => return None,
            // What stands before a parenthesis is a function.
            None if !is_plain(part) || rest.trim_start().starts_with('(') => return None,
            None if operands.contains(&part) => {}
            None => operands.push(part),
        }
    }
    (1..=MOST_OPERANDS)
        .contains(&operands.len())
        .then_some(operands)
}

#[cfg(test)]
mod tests {
    use super::operands;

    #[test]
    fn terms_that_work_bit_by_bit_are_told_from_others() {
        let cases = [
            ("a AND 16#F0", Some(vec!["a"])),
            ("(a or b) & NOT a", Some(vec!["a", "b"])),
            ("R[2].x XOR (b AND 1)", Some(vec!["R[2].x", "b"])),
            ("a + b", None),
            ("a AND 2.5", None),
            ("a AND -b", None),
            ("MAX(a) AND b", None),
            ("1 AND 2", None),
        ];
        for (text, expected) in cases {
            assert_eq!(operands(text), expected, "{text}");
        }
    }
}
