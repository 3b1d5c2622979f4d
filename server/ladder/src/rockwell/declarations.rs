//! What a project declares, under the names that its rungs use.

use std::borrow::Cow;
use std::collections::hash_map::Entry;

use foldhash::HashMap;
use source::{Diagnostic, codes};

use super::names::{Names, Scope, lower};
use super::operand;
use super::project::{Project, Tag};
use crate::{Class, Declaration, Declarations};

/// The declarations of a project: its tags, then the parts of tags that have a
/// comment and are used, then the modules' tags that are used by address.
pub(super) fn declarations(
    project: &Project<'_>,
    names: &Names,
    diagnostics: &mut Vec<Diagnostic>,
) -> Declarations {
    let mut declarations = Declarations::default();
    let mut seen: HashMap<(Scope, Cow<'_, str>), &Tag> = HashMap::default();
    for (scope, tag) in all_tags(project) {
        let entry = seen.entry((scope, lower(&tag.name)));
        if let Entry::Occupied(first) = &entry {
            let message = format!("the tag `{}` is declared twice in its scope", tag.name);
            diagnostics.push(
                Diagnostic::new(codes::DECLARED_TWICE, tag.span, message)
                    .related(first.get().span, "first declared here")
                    .help("rename or remove one of the two; the first counts"),
            );
            continue;
        }
        entry.or_insert(tag);
        let name = names.of_declaration(scope, &tag.name);
        let mut declaration = Declaration::new(name, class(names, scope, tag), tag.span);
        declaration.address = tag.alias_for.as_deref().map(Into::into);
        declaration.description.clone_from(&tag.description);
        declaration.data_type.clone_from(&tag.data_type);
        declaration.initial.clone_from(&tag.initial);
        declarations.add(declaration);
    }
    for (scope, tag) in all_tags(project) {
        for (part, comment) in &tag.comments {
            let Some(name) = names.used_part(scope, &tag.name, part) else {
                continue;
            };
            if declarations.find(&name).is_none() {
                let mut declaration = Declaration::new(name, class(names, scope, tag), tag.span);
                declaration.description = Some(comment.clone());
                declarations.add(declaration);
            }
        }
    }
    for used in names.first_uses() {
        let module = names.undeclared_root(used).and_then(module_class);
        if let Some(class) = module
            && declarations.find(&used.name).is_none()
        {
            let mut declaration = Declaration::new(used.name.clone(), class, used.span);
            declaration.address = Some(used.name.clone());
            declarations.add(declaration);
        }
    }
    declarations
}

/// What a tag is for: an alias of a module's tag is what the module's is.
fn class(names: &Names, scope: Scope, tag: &Tag) -> Class {
    let root = tag
        .alias_for
        .as_ref()
        .and_then(|_| names.aliased_root(scope, &tag.name))
        .unwrap_or(&tag.name);
    module_class(root).unwrap_or(tag.class)
}

/// Whether a tag is a module's input or output by its name: `Local:1:I`,
/// `Drive:O1`.
fn module_class(root: &str) -> Option<Class> {
    let (_, connection) = root.rsplit_once(':')?;
    let (kind, number) = connection.split_at_checked(1)?;
    if !number.bytes().all(|byte| byte.is_ascii_digit()) || operand::path(root).is_none() {
        return None;
    }
    match kind {
        "I" | "i" => Some(Class::Input),
        "O" | "o" => Some(Class::Output),
        _ => None,
    }
}

/// All tags with their scopes.
pub(super) fn all_tags<'p>(project: &'p Project<'_>) -> impl Iterator<Item = (Scope, &'p Tag)> {
    let global = project.tags.iter().map(|tag| (0, tag));
    let units = project.units.iter().enumerate();
    let local = units.flat_map(|(place, unit)| unit.tags.iter().map(move |tag| (place + 1, tag)));
    global.chain(local)
}
