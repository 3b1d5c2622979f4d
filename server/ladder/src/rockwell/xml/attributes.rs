use std::ops::Range;

/// Attributes of a tag as name and place of the value, found one after the
/// other: `Name="Start" Type='N'`.
pub(super) struct Attributes<'t> {
    tag: &'t str,
    at: usize,
    /// Where something that is no attribute stands.
    pub(super) fault: Option<usize>,
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
        let rest = self.tag.get(self.at..)?;
        let trimmed = rest.trim_start();
        if trimmed.is_empty() || self.fault.is_some() {
            return None;
        }
        let start = self.at + (rest.len() - trimmed.len());
        let found = attribute(trimmed);
        let Some((name, value, length)) = found else {
            self.fault = Some(start);
            return None;
        };
        self.at = start + length;
        Some((name, start + value.start..start + value.end))
    }
}

/// The attribute that `text` begins with: its name, the place of its value and
/// the length of it all.
fn attribute(text: &str) -> Option<(&str, Range<usize>, usize)> {
    let equals = text.find('=')?;
    let name = text.get(..equals)?.trim_end();
    if name.is_empty() || name.contains(|c: char| c.is_whitespace() || c == '"' || c == '\'') {
        return None;
    }
    let after = text.get(equals + 1..)?;
    let value = after.trim_start();
    let quote = value.chars().next().filter(|c| matches!(c, '"' | '\''))?;
    let start = text.len() - value.len() + 1;
    let length = text.get(start..)?.find(quote)?;
    Some((name, start..start + length, start + length + 1))
}
