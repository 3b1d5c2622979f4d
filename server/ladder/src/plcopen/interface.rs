//! The units of a project and the variables that they declare.
//!
//! A unit is what the standard calls a program organisation unit, a POU: a
//! program, a function block or a function. Most exporters keep units under
//! `types/pous`; CODESYS wraps them in `addData`, so they are looked for
//! anywhere.

use logic::Name;
use source::{Diagnostic, Span, codes};

use super::xml::{Tag, Text};
use crate::Class;

/// What kind of unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum UnitKind {
    /// Runs as its task says.
    Program,
    /// Runs where an instance of it is drawn, and remembers.
    FunctionBlock,
    /// Runs where it is drawn, and remembers nothing.
    Function,
}

/// A unit with what it declares.
pub(super) struct Unit<'d, 't> {
    pub(super) name: Name,
    pub(super) kind: UnitKind,
    pub(super) tag: Tag<'d, 't>,
    pub(super) variables: Vec<Variable>,
    /// Names that its charts give to steps.
    pub(super) steps: Vec<Name>,
    /// Names that its charts give to transitions: the coil of a transition's
    /// own ladder writes to it.
    pub(super) transitions: Vec<Name>,
}

/// Whose the variable is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Owner {
    /// The unit's own.
    Unit,
    /// Declared elsewhere, named here.
    External,
}

/// A variable as declared.
#[derive(Clone, Debug)]
pub(super) struct Variable {
    pub(super) name: Name,
    pub(super) owner: Owner,
    pub(super) class: Class,
    pub(super) address: Option<Name>,
    pub(super) data_type: Option<Name>,
    pub(super) initial: Option<Name>,
    pub(super) description: Option<Name>,
    pub(super) span: Span,
}

/// Global variables under one name, as CODESYS groups them; the name is empty
/// where they have none.
pub(super) struct Globals {
    pub(super) list: Name,
    pub(super) variables: Vec<Variable>,
}

/// A structure that the project declares: its members' names and types.
pub(super) struct Structure {
    pub(super) name: Name,
    pub(super) members: Vec<(Name, Name)>,
}

/// The units of the project, in document order.
pub(super) fn units<'d, 't>(
    root: Tag<'d, 't>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Vec<Unit<'d, 't>> {
    let tags = root.inside(|tag| tag.name() == "pou");
    let mut units: Vec<_> = tags.map(unit).collect();
    for unit in &mut units {
        if unit.name.is_empty() {
            unit.name = "unnamed".into();
            diagnostics.push(
                Diagnostic::new(codes::NAMELESS, unit.tag.span(), "this unit has no name")
                    .help("give it a name"),
            );
        }
    }
    units
}

fn unit<'d, 't>(tag: Tag<'d, 't>) -> Unit<'d, 't> {
    let name = name_of(tag);
    let kind = match tag.attribute("pouType").as_ref().map(|text| &*text.value) {
        Some("functionBlock") => UnitKind::FunctionBlock,
        Some("function") => UnitKind::Function,
        _ => UnitKind::Program,
    };
    let mut variables = Vec::new();
    for interface in tag.inside(|tag| tag.name() == "interface") {
        for section in interface.children() {
            section_variables(section, &mut variables);
        }
        if let Some(result) = interface.child("returnType") {
            variables.push(Variable {
                name: name.clone(),
                owner: Owner::Unit,
                class: Class::Output,
                address: None,
                data_type: data_type(result),
                initial: None,
                description: None,
                span: result.span(),
            });
        }
    }
    let named = |wanted: &str| {
        let tags = tag.inside(|tag| tag.name() == wanted);
        let names = tags.map(name_of);
        names.filter(|name| !name.is_empty()).collect()
    };
    Unit {
        name,
        kind,
        tag,
        variables,
        steps: named("step"),
        transitions: named("transition"),
    }
}

/// Variables that belong to no unit, in document order.
pub(super) fn globals(root: Tag<'_, '_>) -> Vec<Globals> {
    let lists = root.inside(|tag| matches!(tag.name(), "globalVars" | "pou"));
    lists
        .filter(|tag| tag.name() == "globalVars")
        .map(|tag| {
            let mut variables = Vec::new();
            section_variables(tag, &mut variables);
            Globals {
                list: name_of(tag),
                variables,
            }
        })
        .collect()
}

/// Structures among the project's data types.
pub(super) fn structures(root: Tag<'_, '_>) -> Vec<Structure> {
    root.inside(|tag| tag.name() == "dataType")
        .filter_map(|tag| {
            let members = tag.child("baseType")?.child("struct")?.children();
            Some(Structure {
                name: name_of(tag),
                members: members
                    .filter_map(|member| Some((name_of(member), data_type(member.child("type")?)?)))
                    .collect(),
            })
        })
        .collect()
}

/// The programs that the resources run, in the order in which they name them.
pub(super) fn running_order(root: Tag<'_, '_>) -> Vec<Name> {
    root.inside(|tag| tag.name() == "pouInstance")
        .filter_map(|tag| {
            // The first edition of the format said `type`.
            let named = tag
                .attribute("typeName")
                .or_else(|| tag.attribute("type"))?;
            Some(named.value.trim().into())
        })
        .collect()
}

pub(super) fn name_of(tag: Tag<'_, '_>) -> Name {
    tag.attribute("name")
        .map_or_else(|| "".into(), |text| text.value.trim().into())
}

fn section_variables(section: Tag<'_, '_>, variables: &mut Vec<Variable>) {
    let class = match section.name() {
        "inputVars" => Class::Input,
        "outputVars" => Class::Output,
        "inOutVars" => Class::InOut,
        "localVars" | "tempVars" | "globalVars" => Class::Internal,
        "externalVars" | "accessVars" => Class::Unknown,
        _ => return,
    };
    let owner = if section.name() == "externalVars" {
        Owner::External
    } else {
        Owner::Unit
    };
    let constant = section.says("constant");
    for tag in section.children().filter(|tag| tag.name() == "variable") {
        let address = tag
            .attribute("address")
            .map(|text| Name::from(text.value.trim()))
            .filter(|address| !address.is_empty());
        let class = match class {
            _ if constant => Class::Constant,
            Class::Internal => class_by_address(address.as_deref()),
            class => class,
        };
        variables.push(Variable {
            name: name_of(tag),
            owner,
            class,
            address,
            data_type: tag.child("type").and_then(data_type),
            initial: tag.child("initialValue").and_then(value),
            description: tag
                .child("documentation")
                .and_then(Tag::text)
                .map(|text| text.value.into()),
            span: tag.span(),
        });
    }
}

/// A local variable at an input's or output's address comes from the plant or
/// goes to it.
fn class_by_address(address: Option<&str>) -> Class {
    let letter = address.and_then(|address| address.strip_prefix('%')?.chars().next());
    match letter {
        Some('I' | 'i') => Class::Input,
        Some('Q' | 'q') => Class::Output,
        _ => Class::Internal,
    }
}

/// The type inside a `type`, `baseType` or `returnType` element, as the
/// standard writes it.
fn data_type(tag: Tag<'_, '_>) -> Option<Name> {
    let kind = tag.children().next()?;
    let inner = || kind.child("baseType").and_then(data_type);
    let written = match kind.name() {
        "derived" => return Some(name_of(kind)),
        "array" => {
            let bound = |tag: Tag<'_, '_>, side: &str| {
                tag.attribute(side)
                    .map_or_else(String::new, |text| text.value.trim().to_owned())
            };
            let bounds: Vec<_> = kind
                .children()
                .filter(|tag| tag.name() == "dimension")
                .map(|tag| format!("{}..{}", bound(tag, "lower"), bound(tag, "upper")))
                .collect();
            format!("ARRAY [{}] OF {}", bounds.join(", "), inner()?)
        }
        "pointer" => format!("POINTER TO {}", inner()?),
        "subrangeSigned" | "subrangeUnsigned" => return inner(),
        name => name.to_uppercase(),
    };
    Some(written.into())
}

/// The initial value in an `initialValue` or `value` element, as the standard
/// writes it.
fn value(tag: Tag<'_, '_>) -> Option<Name> {
    let kind = tag.children().next()?;
    let written = match kind.name() {
        "simpleValue" => kind.attribute("value")?.value.trim().to_owned(),
        "arrayValue" => format!("[{}]", values(kind)),
        "structValue" => format!("({})", values(kind)),
        _ => return None,
    };
    Some(written.into())
}

fn values(tag: Tag<'_, '_>) -> String {
    let parts: Vec<_> = tag
        .children()
        .filter_map(|part| {
            let value = value(part)?;
            Some(match part.attribute("member") {
                Some(Text { value: member, .. }) => format!("{member} := {value}"),
                None => value.to_string(),
            })
        })
        .collect();
    parts.join(", ")
}
