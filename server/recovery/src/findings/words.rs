use source::codes;

use super::{Found, Mark, Message, Subject};
use crate::conditions::{Variable, WriteKind};

/// Bits that a coil writes and that are written through their word as well.
pub(super) fn find(_: &Subject<'_>, variable: &Variable, found: &mut Vec<Found>) {
    let is_coil = |kind: &WriteKind| matches!(kind, WriteKind::Coil(_));
    let coil = variable.writes.iter().find(|write| is_coil(&write.kind));
    let whole = variable.writes.iter().find(|write| !is_coil(&write.kind));
    let (Some(coil), Some(whole)) = (coil, whole) else {
        return;
    };
    let before = format!(
        "`{}` is written here, and through its word by ",
        variable.name
    );
    found.push(
        Found::new(
            codes::WRITTEN_AS_A_WORD,
            Mark::Name(coil.place),
            Message::naming(before, whole.place, ""),
        )
        .related(Mark::Element(whole.place), "writes the whole word"),
    );
}
