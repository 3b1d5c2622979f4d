use ladder::CoilKind;
use source::{Diagnostic, codes};

use super::Subject;
use crate::conditions::{Variable, Write, WriteKind};

/// Latches of which one half is missing. The other may live in another file.
pub(super) fn find(subject: &Subject<'_>) -> Vec<Diagnostic> {
    subject
        .conditions
        .variables
        .iter()
        .filter_map(|variable| half_latch(subject, variable))
        .collect()
}

fn half_latch(subject: &Subject<'_>, variable: &Variable) -> Option<Diagnostic> {
    let (mut set, mut reset) = (None::<&Write>, None::<&Write>);
    for write in &variable.writes {
        match write.kind {
            WriteKind::Coil(CoilKind::Set) | WriteKind::Bit(true) => {
                set.get_or_insert(write);
            }
            WriteKind::Coil(CoilKind::Reset) | WriteKind::Bit(false) => {
                reset.get_or_insert(write);
            }
            // A plain coil, or an unknown write, does either.
            _ => return None,
        }
    }
    let (code, write, verb, other) = match (set, reset) {
        (Some(set), None) => (codes::LATCH_WITHOUT_UNLATCH, set, "set", "resets"),
        (None, Some(reset)) => (codes::UNLATCH_WITHOUT_LATCH, reset, "reset", "sets"),
        _ => return None,
    };
    Some(
        Diagnostic::new(
            code,
            subject.target_span(write),
            format!(
                "`{}` is {verb} here, and nothing in this file {other} it",
                variable.name
            ),
        )
        .help("the other half may live in another program or in the operator's panel"),
    )
}
