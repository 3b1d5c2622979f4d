use std::collections::BTreeSet;

use ladder::CoilKind;
use source::{Diagnostic, codes};

use super::Subject;
use crate::conditions::{Write, WriteKind};

/// Variables that plain coils of several rungs drive, all writers named. Coils
/// of which only one can be solved in a scan, as in alternative routines, are
/// not meant.
pub(super) fn find(subject: &Subject<'_>) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    for variable in &subject.conditions.variables {
        let mut seen = BTreeSet::new();
        let plain: Vec<&Write> = variable
            .writes
            .iter()
            .filter(|write| {
                matches!(
                    write.kind,
                    WriteKind::Coil(CoilKind::Plain | CoilKind::Negated)
                )
            })
            .filter(|write| seen.insert(write.place))
            .collect();
        let [earlier @ .., last] = &plain[..] else {
            continue;
        };
        let meets_last = |write: &&&Write| match (&write.solved, &last.solved) {
            (Ok(a), Ok(b)) => a.meets(b, subject.budget) == Ok(true),
            _ => true,
        };
        let hidden: Vec<&&Write> = earlier.iter().filter(meets_last).collect();
        if hidden.is_empty() {
            continue;
        }
        let mut diagnostic = Diagnostic::new(
            codes::DOUBLE_COIL,
            subject.target_span(last),
            format!(
                "`{}` is driven from {} places; this one is solved last and decides",
                variable.name,
                hidden.len() + 1
            ),
        )
        .help("merge the rungs, with their conditions in parallel branches");
        for write in hidden {
            diagnostic = diagnostic.related(
                subject.target_span(write),
                format!("also driven by {}", subject.rung_name(write.place)),
            );
        }
        found.push(diagnostic);
    }
    found
}
