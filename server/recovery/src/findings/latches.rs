use ladder::CoilKind;
use source::codes;

use super::{Found, Mark, Subject};
use crate::conditions::{Variable, Write, WriteKind};

/// Latches of which one half is missing. The other may live in another file.
pub(super) fn find(_: &Subject<'_>, variable: &Variable, found: &mut Vec<Found>) {
    found.extend(half_latch(variable));
}

fn half_latch(variable: &Variable) -> Option<Found> {
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
        Found::new(
            code,
            Mark::Name(write.place),
            format!(
                "`{}` is {verb} here, and nothing in this file {other} it",
                variable.name
            ),
        )
        .help("the other half may live in another program or in the operator's panel"),
    )
}
