use std::collections::HashSet;
use std::ops::Range;

/// Attributes of a tag as name and place of the value, found one after the
/// other: `Name="Start" Type='N'`.
pub(super) struct Attributes<'t> {
    tag: &'t str,
    at: usize,
    /// Where something that is no attribute stands.
    fault: Option<usize>,
}

impl<'t> Attributes<'t> {
    /// The attributes of `tag`, which begins with a name of this length.
    pub(super) fn of(tag: &'t str, name_length: usize) -> Self {
        Self {
            tag,
            at: name_length,
            fault: None,
        }
    }
}

impl<'t> Iterator for Attributes<'t> {
    type Item = (&'t str, Range<usize>);

    fn next(&mut self) -> Option<Self::Item> {
        let start = skip_blanks(self.tag.as_bytes(), self.at);
        if start >= self.tag.len() || self.fault.is_some() {
            return None;
        }
        let Some((name, value)) = attribute(self.tag, start) else {
            self.fault = Some(start);
            return None;
        };
        self.at = value.end + 1;
        Some((name, value))
    }
}

/// Where in `tag` something stands that is no attribute, if anything does.
pub(super) fn fault(tag: &str, name_length: usize) -> Option<usize> {
    let mut attributes = Attributes::of(tag, name_length);
    while attributes.next().is_some() {}
    attributes.fault
}

/// The first attribute of `tag` whose name an earlier one bears, and the place
/// of its value.
pub(super) fn repeated(tag: &str, name_length: usize) -> Option<(&str, Range<usize>)> {
    const FEW: usize = 16;
    let mut few: [&str; FEW] = [""; FEW];
    let mut many = HashSet::new();
    for (at, (name, value)) in Attributes::of(tag, name_length).enumerate() {
        // Nearly all tags have few, and comparing these costs less than hashing.
        let known = few.iter().take(at).any(|other| *other == name);
        if known || at >= FEW && !many.insert(name) {
            return Some((name, value));
        }
        if let Some(free) = few.get_mut(at) {
            *free = name;
        }
    }
    None
}

/// The attribute that begins at byte `start`: its name, and the place of its
/// value between the quotes.
///
/// Goes byte by byte: names and values are a few bytes long, where searching
/// by machine words costs more than it saves, and there is nothing that the
/// reader of a large file does more often.
fn attribute(tag: &str, start: usize) -> Option<(&str, Range<usize>)> {
    let bytes = tag.as_bytes();
    let length = bytes
        .get(start..)?
        .iter()
        .position(|&byte| ends_name(byte))?;
    let name = tag
        .get(start..start + length)
        .filter(|name| !name.is_empty())?;
    let equals = skip_blanks(bytes, start + length);
    if bytes.get(equals) != Some(&b'=') {
        return None;
    }
    let open = skip_blanks(bytes, equals + 1);
    let quote = *bytes
        .get(open)
        .filter(|byte| matches!(byte, b'"' | b'\''))?;
    let value = open + 1;
    let length = bytes.get(value..)?.iter().position(|&byte| byte == quote)?;
    Some((name, value..value + length))
}

fn ends_name(byte: u8) -> bool {
    matches!(byte, b'=' | b'"' | b'\'') || byte.is_ascii_whitespace()
}

/// The first byte at or after `at` that is no blank, as XML counts blanks.
fn skip_blanks(bytes: &[u8], at: usize) -> usize {
    let rest = bytes.get(at..).unwrap_or_default();
    at + rest
        .iter()
        .take_while(|byte| byte.is_ascii_whitespace())
        .count()
}
