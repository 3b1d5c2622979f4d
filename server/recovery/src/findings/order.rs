use ladder::CoilKind;
use logic::AtomId;
use rustc_hash::{FxHashMap, FxHashSet};
use source::{Diagnostic, Span, codes};

use super::Subject;
use crate::conditions::{Place, Write, WriteKind};

/// Coils that some rungs read before they are written in a scan and others
/// after: the first see the value of the scan before.
pub(super) fn find(subject: &Subject<'_>) -> Vec<Diagnostic> {
    let visits = &subject.conditions.execution.scan.visits;
    let mut visited = FxHashSet::default();
    let first_visits = visits.iter().enumerate().filter_map(|(at, visit)| {
        let rung = (visit.routine, visit.rung);
        visited.insert(rung).then_some((rung, at))
    });
    let solved_at: FxHashMap<(usize, usize), usize> = first_visits.collect();
    let mut readers = written_once(subject, &solved_at);
    let mut in_order: Vec<_> = solved_at.iter().map(|(rung, at)| (*at, *rung)).collect();
    in_order.sort_unstable();
    for (at, (routine, rung)) in in_order {
        for (element, atom) in subject.conditions.contacts(routine, rung) {
            let Some(of) = readers.get_mut(&atom) else {
                continue;
            };
            let here = Place {
                routine,
                rung,
                element,
            };
            if at < of.written {
                of.early.get_or_insert(here);
            } else if at > of.written {
                of.late.get_or_insert(here);
            }
        }
    }
    let variables = subject.conditions.variables.iter();
    variables
        .filter_map(|variable| {
            let of = readers.get(&variable.atom)?;
            let [write] = &variable.writes[..] else {
                return None;
            };
            Some(finding(subject, &variable.name, write, of.early?, of.late?))
        })
        .collect()
}

/// Who reads a variable that is written once in a scan.
struct Readers {
    /// The visit that writes it.
    written: usize,
    /// The first contact that is solved before that.
    early: Option<Place>,
    /// The first that is solved after it.
    late: Option<Place>,
}

/// The variables that one plain coil alone writes.
fn written_once(
    subject: &Subject<'_>,
    solved_at: &FxHashMap<(usize, usize), usize>,
) -> FxHashMap<AtomId, Readers> {
    let variables = subject.conditions.variables.iter();
    let once = variables.filter_map(|variable| match &variable.writes[..] {
        [write] if matches!(write.kind, WriteKind::Coil(CoilKind::Plain)) => {
            let written = *solved_at.get(&(write.place.routine, write.place.rung))?;
            let readers = Readers {
                written,
                early: None,
                late: None,
            };
            Some((variable.atom, readers))
        }
        _ => None,
    });
    once.collect()
}

fn finding(
    subject: &Subject<'_>,
    name: &str,
    write: &Write,
    early: Place,
    late: Place,
) -> Diagnostic {
    Diagnostic::new(
        codes::READ_BEFORE_WRITTEN,
        operand_span(subject, early),
        format!(
            "`{name}` is read here before {} writes it, and again after: the two see different \
             scans",
            subject.rung_name(write.place)
        ),
    )
    .related(subject.target_span(write), "written here")
    .related(operand_span(subject, late), "read after it was written")
}

fn operand_span(subject: &Subject<'_>, contact: Place) -> Span {
    subject.contact(contact).map_or(Span::default(), |it| it.1)
}
