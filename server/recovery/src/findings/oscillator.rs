use source::{Diagnostic, codes};

use super::Subject;

/// Coils that switch themselves off: under a constant input they change at
/// every scan.
pub(super) fn find(subject: &Subject<'_>) -> Vec<Diagnostic> {
    subject
        .conditions
        .variables
        .iter()
        .filter(|variable| variable.falls_in_itself())
        .filter_map(|variable| Some((variable, variable.writes.last()?)))
        .map(|(variable, write)| {
            Diagnostic::new(
                codes::FALLS_IN_ITSELF,
                subject.target_span(write),
                format!(
                    "`{}` falls in its own rung: once on, it makes its condition false",
                    variable.name
                ),
            )
            .help("make the feedback contact normally open, or hold the state with a timer")
        })
        .collect()
}
