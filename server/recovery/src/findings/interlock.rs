use std::sync::Arc;

use source::codes;

use super::{Found, Mark, Subject};
use crate::conditions::Variable;

/// The variables that `first` is locked out by, as its closed contacts name
/// them; `None` for what no coil writes.
pub(super) fn locking(subject: &Subject<'_>, first: &Variable) -> Vec<Option<Arc<Variable>>> {
    let closed = first.closed_contacts.iter();
    closed
        .map(|atom| subject.conditions.kept(*atom).cloned())
        .collect()
}

/// Outputs that lock each other out although one of them, once on, can never
/// be ended by anything in the program.
pub(super) fn find(first: &Variable, locking: &[Option<Arc<Variable>>], found: &mut Vec<Found>) {
    for second in locking.iter().flatten() {
        if !second.closed_contacts.contains(&first.atom) || !stays_for_ever(first, second) {
            continue;
        }
        let (Some(here), Some(there)) = (first.writes.last(), second.writes.last()) else {
            continue;
        };
        found.push(
            Found::new(
                codes::INTERLOCK_NEVER_RELEASES,
                Mark::Name(here.place),
                format!(
                    "once `{}` is on nothing ends it, so `{}` can never come on",
                    first.name, second.name
                ),
            )
            .help(format!("give `{}` a condition that ends it", first.name))
            .related(Mark::Name(there.place), "locked out for ever"),
        );
    }
}

/// Whether `first`, once on with `second` off, stays on whatever happens.
fn stays_for_ever(first: &Variable, second: &Variable) -> bool {
    first
        .stays_on()
        .is_ok_and(|stays| stays.restrict(second.atom, false).is_true())
        && first
            .turns_on()
            .is_ok_and(|turns_on| !turns_on.is_true() && !turns_on.is_false())
}
