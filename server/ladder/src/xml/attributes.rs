//! The attributes of a tag as places in its text: `Name="Start" Type='N'`.
//!
//! The model wants the bytes of every value, and a large file has more
//! attributes than anything else. So they are found here once, byte by byte:
//! names and values are a few bytes long, where searching by machine words
//! costs more than it saves.

use std::ops::Range;

/// An attribute, in bytes of the text that holds its tag.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Attribute {
    name: (u32, u32),
    value: (u32, u32),
}

impl Attribute {
    /// The attribute with its name and its value at these places.
    pub(crate) fn new(name: Range<usize>, value: Range<usize>) -> Self {
        Self {
            name: narrow(name),
            value: narrow(value),
        }
    }

    /// Its name with the prefix, in the text that holds the tag.
    pub(crate) fn name(self, text: &str) -> &str {
        let (start, end) = self.name;
        text.get(start as usize..end as usize).unwrap_or_default()
    }

    /// What stands between the quotes.
    pub(crate) fn value(self) -> Range<usize> {
        let (start, end) = self.value;
        start as usize..end as usize
    }
}

/// Finds the attributes of a tag, one after the other.
pub(crate) struct Attributes<'t> {
    bytes: &'t [u8],
    at: usize,
    /// Where something that is no attribute stands; nothing is found after it.
    pub(crate) fault: Option<usize>,
}

impl<'t> Attributes<'t> {
    /// The attributes in bytes `inside` of `text`, which follow a tag's name.
    /// The text is shorter than 4 GiB.
    pub(crate) fn of(text: &'t str, inside: Range<usize>) -> Self {
        let bytes = text.as_bytes();
        Self {
            bytes: bytes.get(..inside.end).unwrap_or(bytes),
            at: inside.start,
            fault: None,
        }
    }
}

impl Iterator for Attributes<'_> {
    type Item = Attribute;

    fn next(&mut self) -> Option<Self::Item> {
        let start = skip_blanks(self.bytes, self.at);
        if start >= self.bytes.len() {
            return None;
        }
        match attribute(self.bytes, start) {
            Some((name, value)) => {
                self.at = value.end + 1;
                Some(Attribute::new(name, value))
            }
            None => {
                self.fault = Some(start);
                self.at = self.bytes.len();
                None
            }
        }
    }
}

fn narrow(range: Range<usize>) -> (u32, u32) {
    let narrow = |place| u32::try_from(place).unwrap_or(u32::MAX);
    (narrow(range.start), narrow(range.end))
}

/// The attribute that begins at byte `start`: the places of its name, and of
/// its value between the quotes.
fn attribute(bytes: &[u8], start: usize) -> Option<(Range<usize>, Range<usize>)> {
    let length = bytes.get(start..)?.iter().position(|&b| ends_name(b))?;
    let name = start..start + length;
    if name.is_empty() {
        return None;
    }
    let equals = skip_blanks(bytes, name.end);
    if bytes.get(equals) != Some(&b'=') {
        return None;
    }
    let open = skip_blanks(bytes, equals + 1);
    let quote = *bytes.get(open).filter(|b| matches!(b, b'"' | b'\''))?;
    let value = open + 1;
    let length = bytes.get(value..)?.iter().position(|&b| b == quote)?;
    Some((name, value..value + length))
}

fn ends_name(byte: u8) -> bool {
    // Letters come after all of these, and nearly every byte is one.
    byte <= b'=' && (matches!(byte, b'=' | b'"' | b'\'') || is_blank(byte))
}

/// The first byte at or after `at` that is no blank, as XML counts blanks.
fn skip_blanks(bytes: &[u8], mut at: usize) -> usize {
    while bytes.get(at).is_some_and(|&byte| is_blank(byte)) {
        at += 1;
    }
    at
}

fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | b'\r' | b'\n')
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(tag: &str, expected: &str) {
        let name = tag.find(' ').unwrap_or(tag.len());
        let mut attributes = Attributes::of(tag, name..tag.len());
        let found: Vec<String> = attributes
            .by_ref()
            .map(|found| format!("{}:{}", found.name(tag), &tag[found.value()]))
            .collect();
        let fault = attributes.fault.map(|at| format!("! {}", &tag[at..]));
        let shown: Vec<String> = found.into_iter().chain(fault).collect();
        assert_eq!(shown.join(" "), expected, "{tag}");
    }

    #[test]
    fn names_and_values_are_found_up_to_what_is_no_attribute() {
        check("a", "");
        check("a k='v w'  x:y = \"'\"\nz=\"\" ", "k:v w x:y:' z:");
        check("a k=\"v\" x", "k:v ! x");
        check("a k=\"v\" x=1 y=\"2\"", "k:v ! x=1 y=\"2\"");
        check("a =\"v\"", "! =\"v\"");
        check("a k=\"v", "! k=\"v");
    }
}
