use ladder::CoilKind;
use source::codes;

use super::{Found, Mark, Message, Subject};
use crate::conditions::{Place, Uses, Variable, WriteKind};

/// Coils that some rungs read before they are written in a scan and others
/// after: the first see the value of the scan before. One plain coil alone
/// writes them.
pub(super) fn find(
    subject: &Subject<'_>,
    variable: &Variable,
    uses: &Uses,
    found: &mut Vec<Found>,
) {
    let [write] = &variable.writes[..] else {
        return;
    };
    let solved_at = |place: &Place| subject.conditions.solved_at(place.rung());
    let Some(written) = solved_at(&write.place) else {
        return;
    };
    if !matches!(write.kind, WriteKind::Coil(CoilKind::Plain)) {
        return;
    }
    let (mut early, mut late) = (None, None);
    for contact in &uses.contacts {
        let Some(at) = solved_at(contact) else {
            continue;
        };
        let here = Some((at, *contact));
        let first = match at.cmp(&written) {
            std::cmp::Ordering::Less => &mut early,
            std::cmp::Ordering::Equal => continue,
            std::cmp::Ordering::Greater => &mut late,
        };
        if first.is_none() || here < *first {
            *first = here;
        }
    }
    let (Some((_, early)), Some((_, late))) = (early, late) else {
        return;
    };
    let before = format!("`{}` is read here before ", variable.name);
    let after = " writes it, and again after: the two see different scans";
    found.push(
        Found::new(
            codes::READ_BEFORE_WRITTEN,
            Mark::Name(early),
            Message::naming(before, write.place, after),
        )
        .related(Mark::Name(write.place), "written here")
        .related(Mark::Name(late), "read after it was written"),
    );
}
