use logic::Stop;
use source::codes;

use super::{Found, Mark, Subject};
use crate::conditions::{Variable, WriteKind};

/// Coils whose condition does not fit the budget.
pub(super) fn find(subject: &Subject<'_>, variable: &Variable, found: &mut Vec<Found>) {
    for write in &variable.writes {
        let coil = matches!(write.kind, WriteKind::Coil(_));
        if coil && matches!(write.guard, Err(Stop::TooLarge)) {
            found.push(
                Found::new(
                    codes::TOO_LARGE,
                    Mark::Name(write.place),
                    format!(
                        "the condition of `{}` needs more than {} nodes",
                        variable.name, subject.budget.nodes
                    ),
                )
                .help("raise the budget, or split the rung with an auxiliary coil"),
            );
        }
    }
}
