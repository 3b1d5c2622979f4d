//! What an operand of neutral text is: a tag, a constant or an expression.
//!
//! A tag is written with its whole path: `Line[3].Valve.2`, `Local:1:I.Data.0`,
//! `Word.[Index]` for a bit chosen at run time, `\Program.Tag` for another
//! program's. Only its shape is read here; which variable it means depends on
//! the scope, see [`names`](super::names).

use std::borrow::Cow;
use std::ops::Range;

use super::neutral::{Quotes, name_end, quote_end, skip_blanks, starts_name};

/// A tag with its path.
#[derive(Debug, PartialEq)]
pub(super) struct Path<'t> {
    /// The program of a `\Program.Tag`.
    pub(super) program: Option<&'t str>,
    /// The tag: `Valve`, `Local:1:I`.
    pub(super) root: &'t str,
    /// What follows it.
    pub(super) tail: Vec<Part<'t>>,
}

/// A part of a path after the tag.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Part<'t> {
    /// `.DN` or `.3`.
    Member(&'t str),
    /// `[3]`, `[Index]`, `[i + 1,2]`; the text inside.
    Index(&'t str),
    /// `.[Index]`; the text inside.
    Bit(&'t str),
}

/// The path that all of `text` is, if it is one.
pub(super) fn path(text: &str) -> Option<Path<'_>> {
    let mut program = None;
    let mut root_start = 0;
    if let Some(rest) = text.strip_prefix('\\') {
        let end = name_end(text, 1);
        program = text.get(1..end).filter(|name| !name.is_empty());
        program?;
        if !rest.get(end - 1..)?.starts_with('.') {
            return None;
        }
        root_start = end + 1;
    }
    let root_end = root_end(text, root_start)?;
    let mut tail = Vec::new();
    let mut at = root_end;
    while at < text.len() {
        let (part, end) = part(text, at)?;
        tail.push(part);
        at = end;
    }
    Some(Path {
        program,
        root: text.get(root_start..root_end)?,
        tail,
    })
}

/// The end of the path that begins at byte `start` of `text`, if one does.
pub(super) fn path_end(text: &str, start: usize) -> Option<usize> {
    let rest = text.get(start..)?;
    let mut at = start;
    if rest.starts_with('\\') {
        at = name_end(text, start + 1);
        if !text.get(at..)?.starts_with('.') {
            return None;
        }
        at += 1;
    }
    at = root_end(text, at)?;
    while let Some((_, end)) = part(text, at) {
        at = end;
    }
    Some(at)
}

/// The end of a tag's own name, which for modules holds colons: `Local:1:I`.
fn root_end(text: &str, start: usize) -> Option<usize> {
    let first = text.get(start..)?.chars().next()?;
    if !starts_name(first) {
        return None;
    }
    let mut end = name_end(text, start);
    while text.get(end..).is_some_and(|rest| rest.starts_with(':')) {
        let next = name_end(text, end + 1);
        if next == end + 1 {
            break;
        }
        end = next;
    }
    Some(end)
}

/// The part that begins at byte `start`, and its end.
fn part(text: &str, start: usize) -> Option<(Part<'_>, usize)> {
    let rest = text.get(start..)?;
    if rest.starts_with('[') {
        let end = bracket_end(text, start)?;
        return Some((Part::Index(text.get(start + 1..end - 1)?), end));
    }
    if rest.starts_with(".[") {
        let end = bracket_end(text, start + 1)?;
        return Some((Part::Bit(text.get(start + 2..end - 1)?), end));
    }
    if !rest.starts_with('.') {
        return None;
    }
    let end = name_end(text, start + 1);
    let member = text.get(start + 1..end).filter(|m| !m.is_empty())?;
    Some((Part::Member(member), end))
}

/// Longest index that is read, in characters.
const LONGEST_INDEX: usize = 1000;

/// The place after the `]` that closes the `[` at byte `start`.
fn bracket_end(text: &str, start: usize) -> Option<usize> {
    let mut depth = 0_usize;
    for (offset, character) in text.get(start..)?.char_indices().take(LONGEST_INDEX) {
        match character {
            '[' => depth += 1,
            ']' => {
                depth = depth.saturating_sub(1);
                if depth == 0 {
                    return Some(start + offset + 1);
                }
            }
            _ => {}
        }
    }
    None
}

/// The integer that `text` writes, if it writes one: `5`, `-1`, `16#F000`,
/// `2#1010_0000`, `3.0`. A word whose highest of 32 bits is set, written in a
/// radix, is negative, as the controller takes it.
pub(super) fn integer(text: &str) -> Option<i64> {
    let plain = match text.contains('_') {
        true => Cow::Owned(text.trim().replace('_', "")),
        false => Cow::Borrowed(text.trim()),
    };
    if let Some((radix, digits)) = plain.split_once('#') {
        let radix = radix
            .parse()
            .ok()
            .filter(|radix| matches!(radix, 2 | 8 | 10 | 16))?;
        let bits = u64::from_str_radix(digits, radix).ok()?;
        return match u32::try_from(bits) {
            Ok(word) => Some(i64::from(word.cast_signed())),
            Err(_) => Some(bits.cast_signed()),
        };
    }
    if let Ok(number) = plain.parse() {
        return Some(number);
    }
    if !is_constant(text) {
        return None;
    }
    let real: f64 = plain.parse().ok()?;
    let exact = real.fract() == 0.0 && real.abs() < 1e15;
    exact.then_some(real as i64)
}

/// Whether `text` is a number or a string, not a tag.
pub(super) fn is_constant(text: &str) -> bool {
    let text = text.trim();
    let unsigned = text.strip_prefix(['-', '+']).unwrap_or(text).trim_start();
    if unsigned.starts_with('\'') {
        return quote_end(unsigned, 0) == unsigned.len();
    }
    let starts = unsigned.trim_start_matches('.');
    starts.starts_with(|c: char| c.is_ascii_digit()) && number_end(unsigned, 0) == unsigned.len()
}

/// The end of the number that begins at byte `start`: `12`, `1.5e-3`,
/// `16#00ff_ff00`, `1.#QNAN`.
pub(super) fn number_end(text: &str, start: usize) -> usize {
    let mut end = start;
    let mut before = ' ';
    let mut in_radix = false;
    for character in text.get(start..).unwrap_or_default().chars() {
        in_radix |= before == '#';
        let exponent_sign =
            matches!(character, '+' | '-') && matches!(before, 'e' | 'E') && !in_radix;
        if !(character.is_ascii_alphanumeric()
            || matches!(character, '.' | '_' | '#' | '$')
            || exponent_sign)
        {
            break;
        }
        before = character;
        end += character.len_utf8();
    }
    end
}

/// A piece of an expression.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Token {
    /// A tag.
    Tag(Range<usize>),
    /// A number or a string.
    Constant(Range<usize>),
    /// A function or a word operator: `SQR`, `AND`.
    Word(Range<usize>),
    /// An operator, parenthesis or anything else.
    Sign(Range<usize>),
}

impl Token {
    pub(super) fn place(&self) -> Range<usize> {
        match self {
            Self::Tag(place) | Self::Constant(place) | Self::Word(place) | Self::Sign(place) => {
                place.clone()
            }
        }
    }
}

/// The pieces of an expression, `range` of `text`, blanks left out.
pub(super) fn tokens(text: &str, range: Range<usize>) -> impl Iterator<Item = Token> {
    let text = text.get(..range.end).unwrap_or_default();
    let mut quotes = Quotes::default();
    let mut at = skip_blanks(text, range.start);
    std::iter::from_fn(move || {
        let character = text.get(at..)?.chars().next()?;
        let token = match character {
            '\'' => Token::Constant(at..quotes.end(text, at)),
            _ => token(text, at, character),
        };
        at = skip_blanks(text, token.place().end);
        Some(token)
    })
}

fn token(text: &str, at: usize, character: char) -> Token {
    if character.is_ascii_digit() {
        return Token::Constant(at..number_end(text, at));
    }
    if let Some(end) = path_end(text, at) {
        let word = &text[at..end];
        let called = text[skip_blanks(text, end)..].starts_with('(');
        let operator = ["AND", "OR", "XOR", "NOT", "MOD"]
            .iter()
            .any(|known| word.eq_ignore_ascii_case(known));
        return if called || operator {
            Token::Word(at..end)
        } else {
            Token::Tag(at..end)
        };
    }
    let two = text.get(at..at + 2).unwrap_or_default();
    let length = if matches!(two, "<=" | ">=" | "<>" | "**" | "||" | "&&") {
        2
    } else {
        character.len_utf8()
    };
    Token::Sign(at..at + length)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths() {
        let parts = |text| path(text).map(|path| (path.root, path.tail.len()));
        assert_eq!(parts("A.B[3].C.7"), Some(("A", 4)));
        assert_eq!(parts("Local:1:I.Data.0"), Some(("Local:1:I", 2)));
        assert_eq!(parts("S:FS"), Some(("S:FS", 0)));
        assert_eq!(parts("Word.[x[2].y]"), Some(("Word", 1)));
        assert_eq!(parts("\\Main.Ready.2"), Some(("Ready", 1)));
        assert_eq!(parts("a b"), None);
        assert_eq!(parts("a["), None);
        assert_eq!(parts("5"), None);
        assert_eq!(parts("a."), None);
    }

    #[test]
    fn constants() {
        assert_eq!(integer("16#F000"), Some(0xF000));
        assert_eq!(integer("16#ffff_ffff"), Some(-1));
        assert_eq!(integer("-12"), Some(-12));
        assert_eq!(integer("2.0"), Some(2));
        assert_eq!(integer("0.5"), None);
        assert_eq!(integer("inf"), None);
        assert!(is_constant("1.5e-3"));
        assert!(is_constant("1.#QNAN"));
        assert!(is_constant("'a,b'"));
        assert!(!is_constant("a"));
        assert!(!is_constant("1 + 2"));
        assert!(!is_constant("?"));
    }

    #[test]
    fn expressions_fall_into_pieces() {
        let text = "(In_Raw-Cfg.Min[i])*-1.0e-3 AND SQR ( x ) <= 16#0F";
        let shown: Vec<&str> = tokens(text, 0..text.len())
            .map(|token| &text[token.place()])
            .collect();
        assert_eq!(
            shown.join(" "),
            "( In_Raw - Cfg.Min[i] ) * - 1.0e-3 AND SQR ( x ) <= 16#0F"
        );
    }
}
