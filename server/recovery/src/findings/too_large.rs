use logic::Stop;
use source::{Diagnostic, codes};

use super::Subject;
use crate::conditions::WriteKind;

/// Coils whose condition does not fit the budget.
pub(super) fn find(subject: &Subject<'_>) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    for variable in &subject.conditions.variables {
        for write in &variable.writes {
            let coil = matches!(write.kind, WriteKind::Coil(_));
            if coil && matches!(write.guard, Err(Stop::TooLarge)) {
                found.push(
                    Diagnostic::new(
                        codes::TOO_LARGE,
                        subject.target_span(write),
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
    found
}
