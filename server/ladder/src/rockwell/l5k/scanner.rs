//! Finds components, statements and attributes in the text of an L5K.

use std::collections::HashMap;
use std::ops::Range;

use super::super::listing::quoted;
use super::super::neutral::{name_end, skip_blanks};

/// A component: from its word to `END_` with that word.
#[derive(Debug)]
pub(super) struct Component<'t> {
    /// `PROGRAM`, `TAG` and so on.
    pub(super) word: &'t str,
    /// Its name, empty where it has none.
    pub(super) name: &'t str,
    /// Attributes by their name in lower case, quotes removed.
    attributes: HashMap<String, String>,
    /// What is inside, after the attributes.
    pub(super) inside: Range<usize>,
    /// The whole of it.
    pub(super) place: Range<usize>,
    /// Whether its `END_` was there.
    pub(super) ended: bool,
}

impl Component<'_> {
    /// The value of an attribute; its name is compared without case.
    pub(super) fn attribute(&self, name: &str) -> Option<String> {
        self.attributes.get(&name.to_lowercase()).cloned()
    }

    /// Whether an attribute is set.
    pub(super) fn says_yes(&self, name: &str) -> bool {
        self.attribute(name)
            .is_some_and(|value| matches!(value.to_lowercase().as_str(), "yes" | "true" | "1"))
    }
}

/// Goes through a part of a text.
#[derive(Debug)]
pub(super) struct Scanner<'t> {
    text: &'t str,
    at: usize,
}

impl<'t> Scanner<'t> {
    /// A scanner for `range` of `text`.
    pub(super) fn new(text: &'t str, range: Range<usize>) -> Self {
        let text = text.get(..range.end).unwrap_or(text);
        Self {
            text,
            at: range.start,
        }
    }

    /// The next word, after blanks and comments; nothing is consumed.
    pub(super) fn word(&mut self) -> Option<&'t str> {
        self.skip();
        let word = self.text.get(self.at..name_end(self.text, self.at))?;
        (!word.is_empty()).then_some(word)
    }

    /// The next component. Text between components, such as `IE_VER := 2.11;`,
    /// is passed over.
    pub(super) fn component(&mut self) -> Option<Component<'t>> {
        loop {
            let word = match self.word() {
                Some(word) => word,
                None if self.at >= self.text.len() => return None,
                None => {
                    self.pass_character();
                    continue;
                }
            };
            let start = self.at;
            self.at += word.len();
            let is_component = word.bytes().all(|b| b.is_ascii_uppercase() || b == b'_');
            let assigned = self.rest().trim_start().starts_with(":=");
            if !is_component || word.starts_with("END_") || assigned {
                continue;
            }
            return Some(self.component_after(word, start));
        }
    }

    fn component_after(&mut self, word: &'t str, start: usize) -> Component<'t> {
        // A name stands on the word's own line; a list such as TAG has none.
        let line = self.rest().find(['\n', '\r']).unwrap_or(self.rest().len());
        let name_start = skip_blanks(self.text, self.at);
        let mut name = "";
        if has_name(word) && name_start <= self.at + line {
            let end = name_end(self.text, name_start);
            name = self.text.get(name_start..end).unwrap_or_default();
            self.at = end;
        }
        let mut attributes = HashMap::new();
        let open = skip_blanks(self.text, self.at);
        if self.text[open..].starts_with('(') && !self.text[open..].starts_with("(*") {
            let close = closing(self.text, open);
            attributes = attributes_in(self.text, open + 1..close);
            self.at = (close + 1).min(self.text.len());
        }
        let inside_start = self.at;
        let (inside_end, end) = self.end_of(word);
        self.at = end;
        Component {
            word,
            name,
            attributes,
            inside: inside_start..inside_end,
            place: start..end,
            ended: inside_end < end,
        }
    }

    /// Where what is inside a component ends, and where the component does:
    /// before and after its `END_` word, else both at the end.
    fn end_of(&self, word: &str) -> (usize, usize) {
        let end_word = format!("END_{word}");
        // Structured text and encoded data hold quotes that nothing closes; an end
        // word in them counts at the beginning of a line only.
        let raw = !matches!(word, "CONTROLLER" | "PROGRAM" | "ROUTINE" | "TAG");
        let mut at = self.at;
        while let Some(found) = self.next_end(&end_word, at) {
            let after = found + end_word.len();
            let whole = name_end(self.text, found) == after;
            let line = self.text[self.at..found].trim_end_matches([' ', '\t']);
            let begins_line = line.is_empty() || line.ends_with(['\n', '\r']);
            if whole && (begins_line || !raw && line.ends_with([';', ')'])) {
                return (found, after);
            }
            at = after;
        }
        (self.text.len(), self.text.len())
    }

    fn next_end(&self, end_word: &str, from: usize) -> Option<usize> {
        let found = self.text.get(from..)?.find(end_word)?;
        Some(from + found)
    }

    /// The next statement, up to and with its `;`.
    pub(super) fn statement(&mut self) -> Option<Range<usize>> {
        self.skip();
        let start = self.at;
        while let Some(character) = self.rest().chars().next() {
            match character {
                ';' => {
                    self.at += 1;
                    return Some(start..self.at);
                }
                '"' => self.at = quoted(self.text, self.at).1,
                '\'' => self.at = super::super::neutral::quote_end(self.text, self.at),
                _ => self.pass_character(),
            }
        }
        (start < self.at).then_some(start..self.at)
    }

    fn rest(&self) -> &'t str {
        self.text.get(self.at..).unwrap_or_default()
    }

    fn pass_character(&mut self) {
        self.at += self.rest().chars().next().map_or(1, char::len_utf8);
    }

    /// Passes blanks and comments `(* ... *)`.
    fn skip(&mut self) {
        loop {
            self.at = skip_blanks(self.text, self.at);
            if !self.rest().starts_with("(*") {
                return;
            }
            let length = self.rest().find("*)").map(|end| end + 2);
            self.at += length.unwrap_or(self.rest().len());
        }
    }
}

/// Whether a name follows the word of a component.
fn has_name(word: &str) -> bool {
    !matches!(
        word,
        "TAG" | "PARAMETERS" | "LOCAL_TAGS" | "ENCODED_DATA" | "CHILD_PROGRAMS"
    )
}

/// The place of the `)` that closes the `(` at byte `open`, else the end.
pub(super) fn closing(text: &str, open: usize) -> usize {
    let mut depth = 0_usize;
    let mut at = open;
    while let Some(character) = text.get(at..).and_then(|rest| rest.chars().next()) {
        match character {
            '"' => {
                at = quoted(text, at).1;
                continue;
            }
            '(' => depth += 1,
            ')' => {
                depth = depth.saturating_sub(1);
                if depth == 0 {
                    return at;
                }
            }
            _ => {}
        }
        at += character.len_utf8();
    }
    text.len()
}

/// The attributes `Name := value, Name := value` in `range`, by their names in
/// lower case. Quotes are removed; other values stay as they are.
pub(super) fn attributes_in(text: &str, range: Range<usize>) -> HashMap<String, String> {
    let mut attributes = HashMap::new();
    for place in parts(text, range) {
        let Some((name, value)) = text
            .get(place.clone())
            .and_then(|part| part.split_once(":="))
        else {
            continue;
        };
        let value_start = skip_blanks(text, place.end - value.len());
        let value = if text[value_start..].starts_with('"') {
            quoted(text, value_start).0
        } else {
            value.trim().to_owned()
        };
        attributes
            .entry(name.trim().to_lowercase())
            .or_insert(value);
    }
    attributes
}

/// The parts of `range` between commas that stand in no quotes or brackets.
fn parts(text: &str, range: Range<usize>) -> Vec<Range<usize>> {
    let Some(text) = text.get(..range.end) else {
        return Vec::new();
    };
    let mut parts = Vec::new();
    let mut depth = 0_usize;
    let mut start = range.start;
    let mut at = range.start;
    while let Some(character) = text.get(at..).and_then(|rest| rest.chars().next()) {
        match character {
            '"' => {
                at = quoted(text, at).1;
                continue;
            }
            '(' | '[' => depth += 1,
            ')' | ']' => depth = depth.saturating_sub(1),
            ',' if depth == 0 => {
                parts.push(start..at);
                start = at + 1;
            }
            _ => {}
        }
        at += character.len_utf8();
    }
    parts.push(start.min(at)..at);
    parts
}
