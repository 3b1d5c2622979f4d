use foldhash::{HashSet, HashSetExt};
use ladder::Class;
use logic::Name;
use rustc_hash::FxHashSet;
use source::{Diagnostic, Span, codes};

use super::Subject;
use crate::conditions::Place;

/// Contacts of names that nothing in the file writes and no declaration gives
/// as an input. Each name is reported once, at its first contact.
pub(super) fn find(subject: &Subject<'_>) -> Vec<Diagnostic> {
    let mut seen = FxHashSet::default();
    let mut contacts: Vec<(Span, &Name)> = Vec::new();
    for (routine, it) in subject.program.routines.iter().enumerate() {
        for rung in 0..it.rungs.len() {
            for (element, atom) in subject.conditions.contacts(routine, rung) {
                if !seen.insert(atom) || subject.conditions.variable(atom).is_some() {
                    continue;
                }
                let place = Place {
                    routine,
                    rung,
                    element,
                };
                if let Some((name, span)) = subject.contact(place)
                    && !comes_from_outside(subject, name)
                {
                    contacts.push((span, name));
                }
            }
        }
    }
    if contacts.is_empty() {
        return Vec::new();
    }
    let mut written: HashSet<&str> = HashSet::new();
    for (_, rung) in subject.program.rungs() {
        for (_, element) in rung.network.elements() {
            written.extend(element.kind.writes().iter().map(|operand| &*operand.name));
        }
    }
    contacts.retain(|(_, name)| !is_written(name, &written));
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
