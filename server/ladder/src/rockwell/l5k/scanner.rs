//! Finds components, statements and attributes in the text of an L5K.

use std::collections::HashMap;
use std::ops::Range;

use super::super::listing::quoted;
use super::super::neutral::{Quotes, name_end, skip_blanks};

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

/// The places of all `END_` words of a text, found once, so that looking for
/// the end of a component does not walk over the text again and again.
#[derive(Debug)]
pub(super) struct Ends<'t> {
    places: HashMap<&'t str, Places>,
}

/// Where one `END_` word stands, in ascending order.
#[derive(Debug, Default)]
struct Places {
    /// All of them.
    all: Vec<usize>,
    /// Those before which only blanks stand on their line.
    beginning_lines: Vec<usize>,
}

impl<'t> Ends<'t> {
    /// The `END_` words of `text` that stand at the beginning of a line or after
    /// something that ends a statement.
    pub(super) fn of(text: &'t str) -> Self {
        let mut places: HashMap<&str, Places> = HashMap::new();
        for (at, mark) in text.match_indices(END) {
            let before = text[..at].trim_end_matches([' ', '\t']);
            let begins_line = before.is_empty() || before.ends_with(['\n', '\r']);
            if begins_line || before.ends_with([';', ')']) {
                let word_start = at + mark.len();
                let word = &text[word_start..name_end(text, word_start)];
                let places = places.entry(word).or_default();
                places.all.push(at);
                if begins_line {
                    places.beginning_lines.push(at);
                }
            }
        }
        Self { places }
    }

    /// The first end of a component called `word` in `range`.
    fn find(&self, word: &str, range: Range<usize>) -> Option<usize> {
        // Structured text and encoded data hold quotes that nothing closes; an end
        // word in them counts at the beginning of a line only.
        let raw = !matches!(word, "CONTROLLER" | "PROGRAM" | "ROUTINE" | "TAG" | "TASK");
        let found = self.places.get(word)?;
        let places = if raw {
            &found.beginning_lines
        } else {
            &found.all
        };
        let first = places.partition_point(|&at| at < range.start);
        places.get(first).copied().filter(|&at| at < range.end)
    }
}

const END: &str = "END_";

/// Goes through a part of a text.
#[derive(Debug)]
pub(super) struct Scanner<'t, 'e> {
    text: &'t str,
    at: usize,
    ends: &'e Ends<'t>,
}

impl<'t, 'e> Scanner<'t, 'e> {
    /// A scanner for `range` of `text`, whose ends are `ends`.
    pub(super) fn new(text: &'t str, range: Range<usize>, ends: &'e Ends<'t>) -> Self {
        let text = text.get(..range.end).unwrap_or(text);
        Self {
            text,
            at: range.start,
            ends,
        }
    }

    /// The next component. Text between components, such as `IE_VER := 2.11;`,
    /// is passed over.
    pub(super) fn component(&mut self) -> Option<Component<'t>> {
        loop {
            self.at = skip_comments(self.text, self.at);
            let start = self.at;
            let word = self.text.get(start..name_end(self.text, start))?;
            if word.is_empty() {
                if start >= self.text.len() {
                    return None;
                }
                self.pass_character();
                continue;
            }
            self.at += word.len();
            let is_component = word.bytes().all(|b| b.is_ascii_uppercase() || b == b'_');
            let assigned = self.rest().trim_start().starts_with(":=");
            if !is_component || word.starts_with(END) || assigned {
                continue;
            }
            return Some(self.component_after(word, start));
        }
    }

    fn component_after(&mut self, word: &'t str, start: usize) -> Component<'t> {
        // A name stands on the word's own line; a list such as TAG has none.
        let name_start = skip_blanks(self.text, self.at);
        let between = self.text.get(self.at..name_start).unwrap_or_default();
        let mut name = "";
        if has_name(word) && !between.contains(['\n', '\r']) {
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
        let end = self.ends.find(word, inside_start..self.text.len());
        let inside_end = end.unwrap_or(self.text.len());
        self.at = match end {
            Some(end) => end + END.len() + word.len(),
            None if is_known(word) => self.text.len(),
            None => inside_start,
        };
        Component {
            word,
            name,
            attributes,
            inside: inside_start..inside_end,
            place: start..self.at,
            ended: end.is_some() || !is_known(word),
        }
    }

    /// The next statement, up to and with its `;`.
    pub(super) fn statement(&mut self) -> Option<Range<usize>> {
        self.at = skip_comments(self.text, self.at);
        let start = self.at;
        let mut quotes = Quotes::default();
        while let Some(character) = self.rest().chars().next() {
            match character {
                ';' => {
                    self.at += 1;
                    return Some(start..self.at);
                }
                '"' => self.at = quoted(self.text, self.at).1,
                '\'' => self.at = quotes.end(self.text, self.at),
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
}

/// The first word of `text` after blanks and comments.
pub(super) fn first_word(text: &str) -> &str {
    let start = skip_comments(text, 0);
    text.get(start..name_end(text, start)).unwrap_or_default()
}

/// The place after blanks and comments `(* ... *)`.
fn skip_comments(text: &str, from: usize) -> usize {
    let mut at = skip_blanks(text, from);
    while let Some(comment) = text.get(at..).filter(|rest| rest.starts_with("(*")) {
        let length = comment.find("*)").map_or(comment.len(), |end| end + 2);
        at = skip_blanks(text, at + length);
    }
    at
}

/// Whether a component of this kind is read, and so must end. An unknown word
/// without an end is passed over alone.
fn is_known(word: &str) -> bool {
    matches!(
        word,
        "CONTROLLER"
            | "PROGRAM"
            | "ADD_ON_INSTRUCTION_DEFINITION"
            | "TAG"
            | "PARAMETERS"
            | "LOCAL_TAGS"
            | "ROUTINE"
            | "ST_ROUTINE"
            | "FBD_ROUTINE"
            | "SFC_ROUTINE"
            | "ENCODED_DATA"
            | "TASK"
    )
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
