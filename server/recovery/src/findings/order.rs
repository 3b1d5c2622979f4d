use std::collections::HashMap;

use ladder::{CoilKind, ElementKind, flow};
use logic::AtomId;
use source::{Diagnostic, Span, codes};

use super::Subject;
use crate::conditions::{Write, WriteKind};

/// Coils that some rungs read before they are written in a scan and others
/// after: the first see the value of the scan before.
pub(super) fn find(subject: &Subject<'_>) -> Vec<Diagnostic> {
    let order = flow::execution(subject.program).scan;
    let mut solved_at: HashMap<(usize, usize), usize> = HashMap::new();
    for (at, visit) in order.visits.iter().enumerate() {
        solved_at.entry((visit.routine, visit.rung)).or_insert(at);
    }
    let mut reads: HashMap<AtomId, Vec<(usize, Span)>> = HashMap::new();
    let mut seen_rungs = std::collections::HashSet::new();
    for (at, visit) in order.visits.iter().enumerate() {
        if !seen_rungs.insert((visit.routine, visit.rung)) {
            continue;
        }
        let rung = &subject.program.routines[visit.routine].rungs[visit.rung];
        for (_, element) in rung.network.elements() {
            if let ElementKind::Contact(contact) = &element.kind
                && let Some(atom) = subject
                    .conditions
                    .atoms
                    .find_variable(&contact.operand.name)
            {
                reads
                    .entry(atom)
                    .or_default()
                    .push((at, rung.place(contact.operand.within)));
            }
        }
    }
    let mut found = Vec::new();
    for variable in &subject.conditions.variables {
        let [write] = &variable.writes[..] else {
            continue;
        };
        let Some(diagnostic) = late_write(subject, &variable.name, write, &reads, &solved_at)
        else {
            continue;
        };
        found.push(diagnostic);
    }
    found
}

fn late_write(
    subject: &Subject<'_>,
    name: &str,
    write: &Write,
    reads: &HashMap<AtomId, Vec<(usize, Span)>>,
    solved_at: &HashMap<(usize, usize), usize>,
) -> Option<Diagnostic> {
    if !matches!(write.kind, WriteKind::Coil(CoilKind::Plain)) {
        return None;
    }
    let written = *solved_at.get(&(write.place.routine, write.place.rung))?;
    let readers = reads.get(&write.target)?;
    let (_, early) = readers.iter().find(|(at, _)| *at < written)?;
    let (_, late) = readers.iter().find(|(at, _)| *at > written)?;
    Some(
        Diagnostic::new(
            codes::READ_BEFORE_WRITTEN,
            *early,
            format!(
                "`{name}` is read here before {} writes it, and again after: the two see \
                 different scans",
                subject.rung_name(write.place)
            ),
        )
        .related(subject.target_span(write), "written here")
        .related(*late, "read after it was written"),
    )
}
