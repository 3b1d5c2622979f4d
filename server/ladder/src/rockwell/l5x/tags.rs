//! Tags, parameters and their data in L5X.

use logic::Name;

use super::super::data;
use super::super::names::lower;
use super::super::operand;
use super::super::project::Tag;
use super::super::xml::Element;
use super::{inside, name, text};
use crate::Class;

/// The tags of a controller or a program.
pub(super) fn all(owner: Element<'_, '_>) -> Vec<Tag> {
    inside(owner, "Tags", "Tag")
        .filter(|element| element.is_complete())
        .map(|element| tag(element, class_of_tag(element)))
        .collect()
}

/// The parameters and local tags of an Add-On Instruction.
pub(super) fn of_definition(definition: Element<'_, '_>) -> Vec<Tag> {
    let parameters = inside(definition, "Parameters", "Parameter")
        .map(|element| tag(element, class_of_usage(element)));
    let local =
        inside(definition, "LocalTags", "LocalTag").map(|element| tag(element, Class::Internal));
    parameters.chain(local).collect()
}

/// The parameters that a call in a ladder passes: the required ones. The others
/// are reached through the instance.
pub(super) fn passed(definition: Element<'_, '_>) -> Vec<(String, Class)> {
    inside(definition, "Parameters", "Parameter")
        .filter(|parameter| parameter.attribute_is("Required", "true"))
        .map(|parameter| (name(parameter, "Name"), class_of_usage(parameter)))
        .collect()
}

fn tag(element: Element<'_, '_>, class: Class) -> Tag {
    let mut tag = Tag::new(
        element.attribute("Name").unwrap_or_default(),
        class,
        element.tag_span(),
    );
    tag.data_type = data_type(element);
    tag.description = element.child("Description").and_then(text);
    tag.alias_for = element
        .attribute("AliasFor")
        .map(|target| target.trim().to_owned())
        .filter(|target| !target.is_empty());
    for comment in inside(element, "Comments", "Comment") {
        if let (Some(part), Some(text)) = (comment.attribute("Operand"), text(comment)) {
            tag.comments.push((part.into_owned(), text));
        }
    }
    let data = || {
        ["Data", "DefaultData"]
            .into_iter()
            .flat_map(|kind| element.children_named(kind))
    };
    for data in data().filter(|data| data.attribute_is("Format", "Decorated")) {
        let value = data.child("DataValue");
        tag.initial = value
            .and_then(|value| value.attribute("Value"))
            .map(Into::into);
        presets_inside(data, &mut Vec::new(), &mut tag.presets);
    }
    let listed = data().find(|data| data.attribute_is("Format", "L5K"));
    if let Some(data) = listed {
        let passage = data.passage();
        let value = passage.text().trim();
        if tag.presets.is_empty() {
            let data_type = tag.data_type.as_deref().unwrap_or_default();
            tag.presets = data::presets(data_type, value);
        }
        if tag.initial.is_none() && operand::is_constant(value) {
            tag.initial = Some(value.into());
        }
    }
    tag
}

fn data_type(element: Element<'_, '_>) -> Option<Name> {
    let data_type = element.attribute("DataType")?;
    let dimensions = element.attribute("Dimensions").unwrap_or_default();
    let dimensions = dimensions.trim();
    Some(if dimensions.is_empty() || dimensions == "0" {
        data_type.into()
    } else {
        format!("{data_type}[{}]", dimensions.replace(' ', ",")).into()
    })
}

/// Collects the presets of timers and counters in decorated data: `element`
/// lies inside the elements of `path`. The depth of a document bounds the
/// recursion.
fn presets_inside<'d, 't>(
    element: Element<'d, 't>,
    path: &mut Vec<Element<'d, 't>>,
    presets: &mut Vec<(String, i64)>,
) {
    let mut holds_preset = None;
    path.push(element);
    for child in element.children() {
        if !child.is_leaf() && child.name() != "DataValueMember" {
            presets_inside(child, path, presets);
            continue;
        }
        let holds_preset = *holds_preset.get_or_insert_with(|| is_timer_or_counter(element));
        if holds_preset && child.name() == "DataValueMember" && child.attribute_is("Name", "PRE") {
            let value = child.attribute("Value");
            let value = value.and_then(|value| operand::integer(&value));
            presets.extend(value.map(|value| (path_of(path), value)));
        }
    }
    path.pop();
}

fn is_timer_or_counter(element: Element<'_, '_>) -> bool {
    element
        .attribute("DataType")
        .is_some_and(|data_type| data::is_timer_or_counter(&data_type))
}

/// The path within a tag that nested elements of data stand for: `.tmr[3]`, in
/// lower case.
fn path_of(elements: &[Element<'_, '_>]) -> String {
    let mut path = String::new();
    for element in elements {
        let part = match element.name() {
            "StructureMember" | "ArrayMember" => {
                path.push('.');
                element.attribute("Name")
            }
            "Element" => element.attribute("Index"),
            _ => None,
        };
        path.push_str(&lower(&part.unwrap_or_default()));
    }
    path
}

fn class_of_tag(element: Element<'_, '_>) -> Class {
    if element.attribute_is("Constant", "true") {
        return Class::Constant;
    }
    if element.attribute_is("TagType", "Consumed") {
        return Class::Input;
    }
    if element.attribute_is("TagType", "Produced") {
        return Class::Output;
    }
    match class_of_usage(element) {
        Class::Unknown => Class::Internal,
        class => class,
    }
}

fn class_of_usage(element: Element<'_, '_>) -> Class {
    let usage = element.attribute("Usage").unwrap_or_default();
    let classes = [
        ("Input", Class::Input),
        ("Output", Class::Output),
        ("InOut", Class::InOut),
    ];
    let found = classes
        .iter()
        .find(|(word, _)| usage.eq_ignore_ascii_case(word));
    found.map_or(Class::Unknown, |(_, class)| *class)
}
