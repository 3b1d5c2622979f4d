use source::{Diagnostic, codes};

use super::Subject;
use crate::conditions::WriteKind;

/// Bits that a coil writes and that are written through their word as well.
pub(super) fn find(subject: &Subject<'_>) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    for variable in &subject.conditions.variables {
        let is_coil = |kind: &WriteKind| matches!(kind, WriteKind::Coil(_));
        let coil = variable.writes.iter().find(|write| is_coil(&write.kind));
        let whole = variable.writes.iter().find(|write| !is_coil(&write.kind));
        let (Some(coil), Some(whole)) = (coil, whole) else {
            continue;
        };
        found.push(
            Diagnostic::new(
                codes::WRITTEN_AS_A_WORD,
                subject.target_span(coil),
                format!(
                    "`{}` is written here, and through its word by {}",
                    variable.name,
                    subject.rung_name(whole.place)
                ),
            )
            .related(whole.place.span(subject.program), "writes the whole word"),
        );
    }
    found
}
