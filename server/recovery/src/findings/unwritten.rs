use std::collections::{BTreeMap, HashSet};

use ladder::{Class, ElementKind};
use logic::Name;
use source::{Diagnostic, Span, codes};

use super::Subject;

/// Contacts of names that nothing in the file writes and no declaration gives
/// as an input. Each name is reported once, at its first contact.
pub(super) fn find(subject: &Subject<'_>) -> Vec<Diagnostic> {
    let mut written: HashSet<&str> = HashSet::new();
    for (_, rung) in subject.program.rungs() {
        for (_, element) in rung.network.elements() {
            written.extend(element.kind.writes().iter().map(|operand| &*operand.name));
        }
    }
    let mut contacts: BTreeMap<Span, &Name> = BTreeMap::new();
    let mut seen: HashSet<&str> = HashSet::new();
    for (_, rung) in subject.program.rungs() {
        for (_, element) in rung.network.elements() {
            let ElementKind::Contact(contact) = &element.kind else {
                continue;
            };
            let name = &contact.operand.name;
            let suspicious = !comes_from_outside(subject, name) && !is_written(name, &written);
            if suspicious && seen.insert(name) {
                contacts.insert(rung.place(contact.operand.within), name);
            }
        }
    }
    contacts
        .into_iter()
        .map(|(span, name)| {
            Diagnostic::new(
                codes::NEVER_WRITTEN,
                span,
                format!("`{name}` is read, but nothing in this file writes it or declares it as an input"),
            )
            .help("declare it as an input, or check its spelling")
        })
        .collect()
}

/// Whether the name, the structure or word it is part of, or an instance it is
/// an output of, is written.
fn is_written(name: &str, written: &HashSet<&str>) -> bool {
    let mut whole = name;
    loop {
        if written.contains(whole) {
            return true;
        }
        match whole.rfind(['.', '[']) {
            Some(at) => whole = &whole[..at],
            None => return false,
        }
    }
}

fn comes_from_outside(subject: &Subject<'_>, name: &str) -> bool {
    let address =
        |text: &str| text.starts_with("%I") || text.contains(":I.") || text.contains(":I:");
    if address(name)
        || crate::registers::is_first_scan(name)
        || matches!(name, "0" | "1" | "TRUE" | "FALSE")
    {
        return true;
    }
    let root = name.split(['.', '[']).next().unwrap_or(name);
    [name, root].iter().any(|name| {
        subject
            .program
            .declarations
            .find(name)
            .is_some_and(|declaration| {
                matches!(
                    declaration.class,
                    Class::Input | Class::InOut | Class::Constant
                ) || declaration.address.as_deref().is_some_and(address)
            })
    })
}
