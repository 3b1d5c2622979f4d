//! What stands in the text of an `<expression>`: a variable, a constant, or a
//! term over both.
//!
//! Exporters write anything there that structured text allows. Only the forms
//! that a rung can show by itself are taken apart, a variable, a constant,
//! `NOT x`, `a > b`; the rest stays a term of which only the variables are
//! known. This is no structured text parser, and needs to be none.

use std::ops::Range;

use logic::Relation;

/// What an expression is. Ranges are bytes of its text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Meaning {
    /// A variable with its members and indices.
    Variable,
    /// `TRUE` or `FALSE`.
    Truth(bool),
    /// A whole number, typed or not, in any base.
    Integer(i64),
    /// A constant of another kind: a time, a real number, a string.
    Literal,
    /// The complement of a variable.
    Not(Range<usize>),
    /// A comparison of two sides.
    Relation(Range<usize>, Relation, Range<usize>),
    /// Anything else.
    Term,
}

const WORDS: [&str; 7] = ["AND", "OR", "XOR", "NOT", "MOD", "TRUE", "FALSE"];

/// What `text` is, which has no blanks around it.
pub(super) fn meaning(text: &str) -> Meaning {
    match text.to_ascii_uppercase().as_str() {
        "TRUE" | "BOOL#TRUE" | "BOOL#1" => return Meaning::Truth(true),
        "FALSE" | "BOOL#FALSE" | "BOOL#0" => return Meaning::Truth(false),
        _ => {}
    }
    if let Some(number) = integer(text) {
        return Meaning::Integer(number);
    }
    if is_variable(text) {
        return Meaning::Variable;
    }
    if is_literal(text) {
        return Meaning::Literal;
    }
    if let Some(inner) = complemented(text) {
        return Meaning::Not(inner);
    }
    relation(text).unwrap_or(Meaning::Term)
}

/// Whether `text` is one variable and nothing else.
pub(super) fn is_variable(text: &str) -> bool {
    matches!(variables(text).as_slice(), [whole] if *whole == (0..text.len()))
}

/// The whole number that `text` writes: `5`, `-1`, `16#FF`, `INT#5`.
pub(super) fn integer(text: &str) -> Option<i64> {
    let (prefix, rest) = text.split_once('#').unwrap_or(("", text));
    let typed = !prefix.is_empty() && prefix.chars().all(|c| c.is_ascii_alphabetic());
    if typed {
        let whole = [
            "SINT", "INT", "DINT", "LINT", "USINT", "UINT", "UDINT", "ULINT",
        ];
        let bits = ["BYTE", "WORD", "DWORD", "LWORD"];
        let prefix = prefix.to_ascii_uppercase();
        let known = whole.contains(&prefix.as_str()) || bits.contains(&prefix.as_str());
        return if known { integer(rest) } else { None };
    }
    let base = match prefix {
        "" => 10,
        "2" => 2,
        "8" => 8,
        "16" => 16,
        _ => return None,
    };
    let digits = rest.strip_prefix(['+', '-']).unwrap_or(rest);
    if !digits.starts_with(|c: char| c.is_ascii_hexdigit()) {
        return None;
    }
    let sign = if rest.starts_with('-') { "-" } else { "" };
    i64::from_str_radix(&format!("{sign}{}", digits.replace('_', "")), base).ok()
}

/// The milliseconds of a time constant: `T#5s`, `TIME#1h_30m`, `t#1.5s`.
pub(super) fn milliseconds(text: &str) -> Option<u64> {
    let (prefix, rest) = text.split_once('#')?;
    if !["T", "TIME", "LT", "LTIME"].contains(&prefix.to_ascii_uppercase().as_str()) {
        return None;
    }
    let rest = rest.replace('_', "").to_ascii_lowercase();
    let mut rest = rest.as_str();
    let mut sum = 0.0;
    if rest.is_empty() {
        return None;
    }
    while !rest.is_empty() {
        let digits = rest.find(|c: char| !c.is_ascii_digit() && c != '.')?;
        let amount: f64 = rest.get(..digits)?.parse().ok()?;
        rest = rest.get(digits..)?;
        let letters = rest
            .find(|c: char| !c.is_ascii_alphabetic())
            .unwrap_or(rest.len());
        sum += amount
            * match rest.get(..letters)? {
                "d" => 86_400_000.0,
                "h" => 3_600_000.0,
                "m" => 60_000.0,
                "s" => 1_000.0,
                "ms" => 1.0,
                "us" => 0.001,
                "ns" => 0.000_001,
                _ => return None,
            };
        rest = rest.get(letters..)?;
    }
    Some(sum.round() as u64)
}

/// A constant that is no whole number: typed (`T#5s`), real or a string.
fn is_literal(text: &str) -> bool {
    if !variables(text).is_empty()
        || text.contains(['(', '[', ' ']) && !text.starts_with(['\'', '"'])
    {
        return false;
    }
    text.contains('#') || text.parse::<f64>().is_ok() || text.starts_with(['\'', '"'])
}

/// The variable that `text` complements: `NOT x`, `NOT(x)`.
fn complemented(text: &str) -> Option<Range<usize>> {
    let head = text.get(..3)?;
    let rest = text.get(3..)?;
    if !head.eq_ignore_ascii_case("NOT") || !rest.starts_with([' ', '\t', '\n', '\r', '(']) {
        return None;
    }
    let mut inner = rest.trim();
    while let Some(bare) = inner.strip_prefix('(').and_then(|i| i.strip_suffix(')')) {
        inner = bare.trim();
    }
    if !is_variable(inner) {
        return None;
    }
    let start = rest.find(inner)? + 3;
    Some(start..start + inner.len())
}

/// The one comparison that `text` is, if it is no more than that.
fn relation(text: &str) -> Option<Meaning> {
    let mut found: Option<(Range<usize>, Relation)> = None;
    let mut cursor = Cursor { text, at: 0 };
    let mut depth = 0usize;
    while let Some(next) = cursor.peek() {
        match next {
            '(' | '[' => depth += 1,
            ')' | ']' => depth = depth.saturating_sub(1),
            '\'' | '"' => {
                cursor.quoted(next);
                continue;
            }
            '<' | '>' | '=' | ':' | '&' if depth == 0 => {
                let start = cursor.at;
                let sign = cursor.run(|c| matches!(c, '<' | '>' | '=' | ':' | '&'));
                let relation = match sign {
                    "=" => Relation::Equal,
                    "<>" => Relation::NotEqual,
                    "<" => Relation::Less,
                    "<=" => Relation::LessOrEqual,
                    ">" => Relation::Greater,
                    ">=" => Relation::GreaterOrEqual,
                    _ => return None,
                };
                if found.replace((start..cursor.at, relation)).is_some() {
                    return None;
                }
                continue;
            }
            c if begins_name(c) => {
                let word = cursor.run(continues_name);
                let joins = ["AND", "OR", "XOR", "NOT"];
                if depth == 0 && joins.contains(&word.to_ascii_uppercase().as_str()) {
                    return None;
                }
                continue;
            }
            _ => {}
        }
        cursor.step();
    }
    let (sign, relation) = found?;
    let left = without_blanks(text, 0..sign.start);
    let right = without_blanks(text, sign.end..text.len());
    if left.is_empty() || right.is_empty() {
        return None;
    }
    Some(Meaning::Relation(left, relation, right))
}

fn without_blanks(text: &str, range: Range<usize>) -> Range<usize> {
    let Some(part) = text.get(range.clone()) else {
        return range;
    };
    let start = range.start + (part.len() - part.trim_start().len());
    start..start + part.trim().len()
}

/// Where variables stand in `text`, each with its members and indices. Names
/// of functions, literals, strings and comments are none.
pub(super) fn variables(text: &str) -> Vec<Range<usize>> {
    let mut found = Vec::new();
    let mut cursor = Cursor { text, at: 0 };
    while let Some(next) = cursor.peek() {
        let start = cursor.at;
        if next == '\'' || next == '"' {
            cursor.quoted(next);
        } else if cursor.rest().starts_with("(*") {
            cursor.comment();
        } else if next == '%' {
            cursor.step();
            cursor.run(|c| c.is_ascii_alphanumeric() || c == '.');
            found.push(start..cursor.at);
        } else if next.is_ascii_digit() {
            cursor.run(|c| c.is_ascii_alphanumeric() || matches!(c, '_' | '#' | '.'));
        } else if begins_name(next) {
            let word = cursor.run(continues_name).to_ascii_uppercase();
            if cursor.peek() == Some('#') {
                cursor.literal(&word);
            } else if !WORDS.contains(&word.as_str())
                && !cursor.rest().trim_start().starts_with('(')
            {
                cursor.members();
                found.push(start..cursor.at);
            }
        } else {
            cursor.step();
        }
    }
    found
}

pub(super) fn begins_name(c: char) -> bool {
    c.is_alphabetic() || c == '_'
}

pub(super) fn continues_name(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

struct Cursor<'t> {
    text: &'t str,
    at: usize,
}

impl<'t> Cursor<'t> {
    fn rest(&self) -> &'t str {
        self.text.get(self.at..).unwrap_or_default()
    }

    fn peek(&self) -> Option<char> {
        self.rest().chars().next()
    }

    fn step(&mut self) {
        self.at += self.peek().map_or(0, char::len_utf8);
    }

    fn run(&mut self, belongs: impl Fn(char) -> bool) -> &'t str {
        let rest = self.rest();
        let length = rest.find(|c| !belongs(c)).unwrap_or(rest.len());
        self.at += length;
        rest.get(..length).unwrap_or_default()
    }

    /// A string, with `$` before a character that stands for itself.
    fn quoted(&mut self, quote: char) {
        self.step();
        while let Some(next) = self.peek() {
            self.step();
            if next == quote {
                return;
            }
            if next == '$' {
                self.step();
            }
        }
    }

    fn comment(&mut self) {
        let length = self.rest().find("*)").map(|end| end + 2);
        self.at += length.unwrap_or(self.rest().len());
    }

    /// The value after the type of a typed literal. Dates hold `-` and `:`.
    fn literal(&mut self, prefix: &str) {
        let date = prefix.contains('D') && !prefix.contains("INT") && !prefix.contains("WORD")
            || prefix == "TOD";
        self.step();
        if matches!(self.peek(), Some('+' | '-')) {
            self.step();
        }
        self.run(|c| {
            c.is_ascii_alphanumeric() || matches!(c, '_' | '#' | '.') || date && "-:".contains(c)
        });
    }

    fn members(&mut self) {
        loop {
            match self.peek() {
                Some('^') => self.step(),
                Some('.') => {
                    let after = self.rest().get(1..).and_then(|rest| rest.chars().next());
                    if !after.is_some_and(|c| continues_name(c) || c == '%') {
                        return;
                    }
                    self.step();
                    if after == Some('%') {
                        self.step();
                    }
                    self.run(continues_name);
                }
                Some('[') => {
                    let Some(end) = closing(self.rest()) else {
                        return;
                    };
                    self.at += end;
                }
                _ => return,
            }
        }
    }
}

/// No index is written longer; a limit keeps unclosed brackets from costing a
/// square.
const LONGEST_INDEX: usize = 1_000;

/// The length of the brackets that `text` begins with.
fn closing(text: &str) -> Option<usize> {
    let mut depth = 0usize;
    for (at, c) in text.char_indices().take(LONGEST_INDEX) {
        match c {
            '[' => depth += 1,
            ']' => {
                depth -= 1;
                if depth == 0 {
                    return Some(at + 1);
                }
            }
            _ => {}
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(text: &str) -> Vec<&str> {
        variables(text).into_iter().map(|at| &text[at]).collect()
    }

    #[test]
    fn variables_are_found_with_members_and_indices_and_nothing_else_is_taken_for_one() {
        assert_eq!(names("a.b[i+1].3 + LIMIT(0, x, T#5s)"), ["a.b[i+1].3", "x"]);
        assert_eq!(names("NOT %IX0.1 AND 'it''s $' x' <> s"), ["%IX0.1", "s"]);
        assert_eq!(names("DT#2020-01-02-03:04:05 (* old *) - 16#FF"), [""; 0]);
        assert_eq!(names("größe_1^"), ["größe_1^"]);
    }

    #[test]
    fn simple_forms_are_taken_apart() {
        assert_eq!(meaning("Motor.On"), Meaning::Variable);
        assert_eq!(meaning("true"), Meaning::Truth(true));
        assert_eq!(meaning("16#0A"), Meaning::Integer(10));
        assert_eq!(meaning("INT#-5"), Meaning::Integer(-5));
        assert_eq!(meaning("T#500ms"), Meaning::Literal);
        assert_eq!(meaning("2.5"), Meaning::Literal);
        assert_eq!(meaning("NOT( NOTE )"), Meaning::Not(5..9));
        assert_eq!(
            meaning("level + 1 >= 50"),
            Meaning::Relation(0..9, Relation::GreaterOrEqual, 13..15)
        );
        assert_eq!(meaning("a > 1 AND b"), Meaning::Term);
        assert_eq!(meaning("f(a = b)"), Meaning::Term);
    }

    #[test]
    fn times_become_milliseconds() {
        assert_eq!(milliseconds("T#1h_2m3.5s"), Some(3_723_500));
        assert_eq!(milliseconds("time#20MS"), Some(20));
        assert_eq!(milliseconds("T#"), None);
        assert_eq!(milliseconds("T#5"), None);
        assert_eq!(milliseconds("INT#5"), None);
    }
}
