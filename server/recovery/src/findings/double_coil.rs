use std::collections::BTreeSet;

use ladder::CoilKind;
use source::codes;

use super::{Found, Mark, Message, Subject};
use crate::conditions::{Variable, Write, WriteKind};

/// Variables that plain coils of several rungs drive, all writers named. Coils
/// of which only one can be solved in a scan, as in alternative routines, are
/// not meant.
pub(super) fn find(subject: &Subject<'_>, variable: &Variable, found: &mut Vec<Found>) {
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
        return;
    };
    let meets_last = |write: &&&Write| match (&write.solved, &last.solved) {
        (Ok(a), Ok(b)) => a.meets(b, subject.budget) == Ok(true),
        _ => true,
    };
    let hidden: Vec<&&Write> = earlier.iter().filter(meets_last).collect();
    if hidden.is_empty() {
        return;
    }
    let mut finding = Found::new(
        codes::DOUBLE_COIL,
        Mark::Name(last.place),
        format!(
            "`{}` is driven from {} places; this one is solved last and decides",
            variable.name,
            hidden.len() + 1
        ),
    )
    .help("merge the rungs, with their conditions in parallel branches");
    for write in hidden {
        finding = finding.related(
            Mark::Name(write.place),
            Message::naming("also driven by ".to_owned(), write.place, ""),
        );
    }
    found.push(finding);
}
