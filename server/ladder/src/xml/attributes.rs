//! The attributes of a tag as places in its text: `Name="Start" Type='N'`.
//!
//! The model wants the bytes of every value, and a large file has more
//! attributes than anything else. So they are found here once, byte by byte:
//! names and values are a few bytes long, where searching by machine words
//! costs more than it saves.

use std::collections::HashSet;
use std::ops::Range;

use source::{Diagnostic, codes};

use crate::reading::Source;

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
            name: (narrow(name.start), narrow(name.end)),
            value: (narrow(value.start), narrow(value.end)),
        }
    }

    /// Its name with the prefix, in the text that holds the tag.
    pub(crate) fn name(self, text: &str) -> &str {
        let (start, end) = self.name;
        text.get(start as usize..end as usize).unwrap_or_default()
    }

    /// Bytes of its name.
    pub(crate) fn name_length(self) -> usize {
        (self.name.1 - self.name.0) as usize
    }

    /// What stands between the quotes.
    pub(crate) fn value(self) -> Range<usize> {
        let (start, end) = self.value;
        start as usize..end as usize
    }
}

/// No text is given to a reader that 32 bits cannot count.
fn narrow(place: usize) -> u32 {
    u32::try_from(place).unwrap_or(u32::MAX)
}

/// Adds the attributes in bytes `inside` of `text`, which follow a tag's name.
///
/// # Errors
///
/// The place of the first thing that is no attribute; those before it are
/// added.
pub(crate) fn attributes(
    text: &str,
    inside: Range<usize>,
    found: &mut Vec<Attribute>,
) -> Result<(), usize> {
    let bytes = text.as_bytes().get(..inside.end).unwrap_or_default();
    let mut at = inside.start;
    loop {
        let start = end_of_blanks(bytes, at);
        if start >= bytes.len() {
            return Ok(());
        }
        let (name, value) = attribute(bytes, start).ok_or(start)?;
        at = value.end + 1;
        found.push(Attribute::new(name, value));
    }
}

/// A finding about the first of a tag's `attributes` whose name, prefix and
/// all, an earlier one bears. The places are bytes of the source's text.
pub(crate) fn repeated(source: Source<'_>, attributes: &[Attribute]) -> Option<Diagnostic> {
    // Nearly all tags have few, and comparing these costs less than hashing.
    const FEW: usize = 16;
    let name = |attribute: &Attribute| attribute.name(source.text);
    let found = match attributes.len() <= FEW {
        true => attributes.iter().enumerate().find_map(|(at, attribute)| {
            let mut before = attributes[..at].iter();
            before
                .any(|other| {
                    other.name_length() == attribute.name_length() && name(other) == name(attribute)
                })
                .then_some(attribute)
        }),
        false => {
            let mut seen = HashSet::new();
            attributes
                .iter()
                .find(|attribute| !seen.insert(name(attribute)))
        }
    }?;
    let value = found.value();
    let message = format!("the attribute `{}` stands here twice", name(found));
    let place = source.span(value.start, value.end);
    let finding = Diagnostic::new(codes::XML_SYNTAX, place, message);
    Some(finding.help("remove one of them; the first counts"))
}

/// The attribute that begins at byte `start`: the places of its name, and of
/// its value between the quotes.
fn attribute(bytes: &[u8], start: usize) -> Option<(Range<usize>, Range<usize>)> {
    let mut name_end = start;
    // Letters come after all that ends a name, and nearly every byte is one.
    while *bytes.get(name_end)? > b'=' {
        name_end += 1;
    }
    while !ends_name(*bytes.get(name_end)?) {
        name_end += 1;
    }
    let equals = end_of_blanks(bytes, name_end);
    if name_end == start || bytes.get(equals) != Some(&b'=') {
        return None;
    }
    let open = end_of_blanks(bytes, equals + 1);
    let quote = *bytes.get(open).filter(|b| matches!(b, b'"' | b'\''))?;
    let mut value_end = open + 1;
    while *bytes.get(value_end)? != quote {
        value_end += 1;
    }
    Some((start..name_end, open + 1..value_end))
}

/// The first byte from `at` on that is no blank.
fn end_of_blanks(bytes: &[u8], mut at: usize) -> usize {
    while bytes.get(at).is_some_and(|&byte| is_blank(byte)) {
        at += 1;
    }
    at
}

fn ends_name(byte: u8) -> bool {
    matches!(byte, b'=' | b'"' | b'\'') || is_blank(byte)
}

/// Whether XML counts a byte as a blank.
fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | b'\r' | b'\n')
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(tag: &str, expected: &str) {
        let name = tag.find(' ').unwrap_or(tag.len());
        let mut found = Vec::new();
        let fault = attributes(tag, name..tag.len(), &mut found).err();
        let found = found
            .iter()
            .map(|found| format!("{}:{}", found.name(tag), &tag[found.value()]));
        let fault = fault.map(|at| format!("! {}", &tag[at..]));
        let shown: Vec<String> = found.chain(fault).collect();
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
