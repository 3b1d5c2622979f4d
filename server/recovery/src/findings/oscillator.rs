use source::codes;

use super::{Found, Mark, Subject};
use crate::conditions::Variable;

/// Coils that switch themselves off: under a constant input they change at
/// every scan.
pub(super) fn find(_: &Subject<'_>, variable: &Variable, found: &mut Vec<Found>) {
    let Some(write) = variable
        .writes
        .last()
        .filter(|_| variable.falls_in_itself())
    else {
        return;
    };
    found.push(
        Found::new(
            codes::FALLS_IN_ITSELF,
            Mark::Name(write.place),
            format!(
                "`{}` falls in its own rung: once on, it makes its condition false",
                variable.name
            ),
        )
        .help("make the feedback contact normally open, or hold the state with a timer"),
    );
}
