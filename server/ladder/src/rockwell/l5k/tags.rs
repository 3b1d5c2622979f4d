//! Tags, parameters and local tags in an L5K.
//!
//! ```text
//! Level : REAL (Description := "tank level", RADIX := Float) := 0.0;
//! Start OF Local:1:I.Data.0 (Description := "start button");
//! In : BOOL (Usage := Input, Required := Yes, DefaultData := "0");
//! ```

use std::collections::HashMap;
use std::ops::Range;

use super::super::data;
use super::super::neutral::{name_end, skip_blanks, trimmed};
use super::super::operand;
use super::super::project::Tag;
use super::scanner::{attributes_in, closing};
use crate::Class;
use crate::reading::Source;

/// The parameters of an Add-On Instruction.
pub(super) struct Parameters {
    pub(super) tags: Vec<Tag>,
    /// Those that calls pass: the required ones.
    pub(super) passed: Vec<(String, Class)>,
}

/// The tags that `statements` declare.
pub(super) fn tags(source: Source<'_>, statements: impl Iterator<Item = Range<usize>>) -> Vec<Tag> {
    statements
        .filter_map(|statement| tag(source, statement, Class::Internal))
        .map(|(tag, _)| tag)
        .collect()
}

/// The parameters that `statements` declare.
pub(super) fn parameters(
    source: Source<'_>,
    statements: impl Iterator<Item = Range<usize>>,
) -> Parameters {
    let mut parameters = Parameters {
        tags: Vec::new(),
        passed: Vec::new(),
    };
    for statement in statements {
        let Some((tag, attributes)) = tag(source, statement, Class::Unknown) else {
            continue;
        };
        let required = attributes.get("required");
        if required.is_some_and(|value| value.eq_ignore_ascii_case("yes")) {
            parameters.passed.push((tag.name.to_string(), tag.class));
        }
        parameters.tags.push(tag);
    }
    parameters
}

/// The tag that a statement declares, with its attributes; `class` is what a tag
/// without a usage is for.
fn tag(
    source: Source<'_>,
    statement: Range<usize>,
    class: Class,
) -> Option<(Tag, HashMap<String, String>)> {
    let text = source.text.get(..statement.end)?;
    let name_place = statement.start..name_end(text, statement.start);
    let name = text
        .get(name_place.clone())
        .filter(|name| !name.is_empty())?;
    let span = source.span(name_place.start, name_place.end);
    let mut tag = Tag::new(name, class, span);
    let mut at = skip_blanks(text, name_place.end);
    let rest = text.get(at..)?;
    let is_alias = rest
        .get(..2)
        .is_some_and(|word| word.eq_ignore_ascii_case("OF"));
    at += if is_alias { 2 } else { 1 };
    if !is_alias && !rest.starts_with(':') {
        return None;
    }
    let head_end = text
        .get(at..)?
        .find(['(', ';', '='])
        .map_or(text.len(), |end| at + end);
    let head = text
        .get(trimmed(text, at..head_end))?
        .trim_end_matches(':')
        .trim();
    if is_alias {
        tag.alias_for = Some(head.to_owned());
    } else {
        tag.data_type = Some(head.into());
    }
    let mut attributes = HashMap::new();
    at = head_end;
    if text.get(at..).is_some_and(|rest| rest.starts_with('(')) {
        let close = closing(text, at);
        attributes = attributes_in(text, at + 1..close);
        at = (close + 1).min(text.len());
    }
    let value = text
        .get(at..)?
        .trim_start_matches([' ', '\t', '\r', '\n', ':']);
    let value = value
        .strip_prefix('=')
        .map(|value| value.trim_end_matches(';').trim());
    let default = attributes.get("defaultdata").map(String::as_str);
    if let Some(value) = value.or(default) {
        set_value(&mut tag, value);
    }
    tag.description = attributes
        .get("description")
        .map(|text| text.trim())
        .filter(|text| !text.is_empty())
        .map(Into::into);
    for (attribute, text) in &attributes {
        if let Some(part) = attribute.strip_prefix("comment") {
            tag.comments
                .push((part.trim().to_owned(), text.as_str().into()));
        }
    }
    tag.comments.sort();
    tag.class = usage(&attributes).unwrap_or(class);
    Some((tag, attributes))
}

fn set_value(tag: &mut Tag, value: &str) {
    if operand::is_constant(value) {
        tag.initial = Some(value.into());
    }
    let data_type = tag.data_type.as_deref().unwrap_or_default();
    tag.presets = data::presets(data_type, value);
}

fn usage(attributes: &HashMap<String, String>) -> Option<Class> {
    if attributes
        .get("constant")
        .is_some_and(|value| value.eq_ignore_ascii_case("yes") || value == "1")
    {
        return Some(Class::Constant);
    }
    match attributes.get("usage")?.to_lowercase().as_str() {
        "input" => Some(Class::Input),
        "output" => Some(Class::Output),
        "inout" => Some(Class::InOut),
        _ => None,
    }
}
