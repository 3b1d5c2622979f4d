//! Adds declarations to a program, each name and each address once.

use std::collections::HashMap;

use logic::Name;
use source::{Diagnostic, Span, codes};

use super::declaration::DeclarationText;
use super::names::address_key;
use super::network::place;
use super::statement::{Statement, comment_text};
use crate::reading::Source;
use crate::{Class, Declaration, Declarations};

/// The declarations of a text, and where their names and addresses stand.
#[derive(Default)]
pub(super) struct Declared {
    /// All of them, those that are declared twice too.
    pub(super) all: Declarations,
    names: HashMap<Name, Span>,
    addresses: HashMap<String, (Name, Span)>,
}

/// Adds what a statement declares.
///
/// The description is the comment behind it. Comments above are none: they are
/// the headings of groups.
pub(super) fn declare(
    declared: &mut Declared,
    source: Source<'_>,
    statement: &Statement,
    class: Class,
    written: &DeclarationText,
    findings: &mut Vec<Diagnostic>,
) {
    let text = source.text;
    let name = Name::from(written.name.name(text));
    // A bare address declares itself: `input %I3 // Level`.
    let address = match written.address {
        None if name.starts_with('%') => Some(written.name),
        address => address,
    };
    let known = declared.names.get(&name).copied();
    if let Some(first) = known {
        findings.push(twice(
            written.name.span,
            format!("`{name}` is declared twice"),
            first,
        ));
    } else {
        declared.names.insert(name.clone(), written.name.span);
    }
    if let Some(token) = address {
        let key = address_key(token.name(text));
        let taken = declared.addresses.get(&key).cloned();
        match taken {
            Some((other, first)) if other != name => {
                let message = format!(
                    "the address {} already belongs to `{other}`",
                    token.text(text)
                );
                findings.push(twice(token.span, message, first));
            }
            Some(_) => {}
            None => {
                declared.addresses.insert(key, (name.clone(), token.span));
            }
        }
    }
    let as_name = |token: logic::notation::Token| Name::from(token.name(text));
    let mut declaration = Declaration::new(name, class, place(source, statement.span()));
    declaration.address = address.map(as_name);
    declaration.data_type = written.data_type.map(as_name);
    declaration.initial = written.initial.map(|(minus, value)| match minus {
        Some(_) => format!("-{}", value.name(text)).into(),
        None => as_name(value),
    });
    declaration.description = statement
        .behind
        .map(|comment| comment_text(text, comment))
        .filter(|description| !description.is_empty())
        .map(Name::from);
    declared.all.add(declaration);
}

fn twice(span: Span, message: String, first: Span) -> Diagnostic {
    Diagnostic::new(codes::DECLARED_TWICE, span, message)
        .related(first, "first declared here")
        .help("keep one of them; until then the first counts")
}
