use ladder::ElementKind;
use source::codes;

use super::{Found, Mark, Subject};
use crate::conditions::{Variable, Write, WriteKind};

/// Coils whose condition is always true or never true, although contacts
/// stand before them. A coil without a contact, or behind an always-false
/// instruction, is meant so.
pub(super) fn find(subject: &Subject<'_>, variable: &Variable, found: &mut Vec<Found>) {
    let name = &variable.name;
    for write in &variable.writes {
        let Ok(guard) = &write.guard else { continue };
        let is_constant = guard.is_true() || guard.is_false();
        if !is_constant
            || !matches!(write.kind, WriteKind::Coil(_))
            || !has_contacts(subject, write)
        {
            continue;
        }
        let mark = Mark::Name(write.place);
        if guard.is_true() {
            found.push(Found::new(
                codes::ALWAYS_TRUE,
                mark,
                format!("the condition of `{name}` is always true"),
            ));
        } else if guard.is_false() && !is_switched_off(subject, write) {
            found.push(Found::new(
                codes::ALWAYS_FALSE,
                mark,
                format!("the condition of `{name}` can never be true"),
            ));
        }
    }
}

fn has_contacts(subject: &Subject<'_>, write: &Write) -> bool {
    subject.rung(write.place).is_some_and(|rung| {
        rung.network.elements().any(|(at, element)| {
            at.index() < write.place.element
                && matches!(
                    element.kind,
                    ElementKind::Contact(_) | ElementKind::Comparison(_)
                )
        })
    })
}

/// Whether the rung holds an instruction that never passes power, or a
/// constant: then it was switched off on purpose.
fn is_switched_off(subject: &Subject<'_>, write: &Write) -> bool {
    subject.rung(write.place).is_some_and(|rung| {
        rung.network
            .elements()
            .any(|(_, element)| match &element.kind {
                ElementKind::Open => true,
                ElementKind::Contact(contact) => {
                    matches!(&*contact.operand.name, "0" | "1" | "TRUE" | "FALSE")
                }
                _ => false,
            })
    })
}
