use source::{Diagnostic, codes};

use super::Subject;
use crate::conditions::Variable;

/// Outputs that lock each other out although one of them, once on, can never
/// be ended by anything in the program.
pub(super) fn find(subject: &Subject<'_>) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    for first in &subject.conditions.variables {
        let locked = first
            .closed_contacts
            .iter()
            .filter_map(|atom| subject.conditions.variable(*atom))
            .filter(|second| second.closed_contacts.contains(&first.atom));
        for second in locked {
            if !stays_for_ever(first, second) {
                continue;
            }
            let (Some(here), Some(there)) = (first.writes.last(), second.writes.last()) else {
                continue;
            };
            found.push(
                Diagnostic::new(
                    codes::INTERLOCK_NEVER_RELEASES,
                    subject.target_span(here),
                    format!(
                        "once `{}` is on nothing ends it, so `{}` can never come on",
                        first.name, second.name
                    ),
                )
                .help(format!("give `{}` a condition that ends it", first.name))
                .related(subject.target_span(there), "locked out for ever"),
            );
        }
    }
    found
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
