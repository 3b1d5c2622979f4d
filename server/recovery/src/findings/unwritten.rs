use source::codes;

use super::{Found, Mark, Subject};
use crate::conditions::Names;

/// Contacts of names that nothing in the file writes and no declaration gives
/// as an input. Each name is reported once, at its first contact.
pub(super) fn find(subject: &Subject<'_>) -> Vec<Found> {
    let conditions = subject.conditions;
    let unknown = conditions.names.unaccounted();
    let contacts = unknown.filter_map(|name| {
        let uses = conditions.names.uses(name)?;
        let mut contacts = uses.contacts.iter();
        let first = contacts.find(|place| conditions.is_visited(place.rung()))?;
        let is_known = conditions.find(name).is_some() || is_written(name, &conditions.names);
        (!is_known).then_some((name, *first))
    });
    contacts
        .map(|(name, place)| {
            Found::new(
                codes::NEVER_WRITTEN,
                Mark::Name(place),
                format!("`{name}` is read, but nothing in this file writes it or declares it as an input"),
            )
            .help("declare it as an input, or check its spelling")
        })
        .collect()
}

/// Whether the name, the structure or word it is part of, or an instance it is
/// an output of, is written.
fn is_written(name: &str, names: &Names) -> bool {
    let mut whole = name;
    loop {
        if names.uses(whole).is_some_and(|uses| uses.is_written()) {
            return true;
        }
        match whole.rfind(['.', '[']) {
            Some(at) => whole = &whole[..at],
            None => return false,
        }
    }
}
