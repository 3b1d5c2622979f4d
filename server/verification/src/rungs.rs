//! The rungs that decide over an output.

use std::collections::{BTreeSet, HashMap};

use ladder::{ElementKind, Program};
use logic::Name;
use source::Span;

/// A rung that writes an output.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RungOf {
    /// `Program/Routine`, or the POU.
    pub scope: Name,
    /// The number that the source gives it.
    pub number: u32,
    /// Its title or comment.
    pub comment: Option<Name>,
    /// Where it stands.
    pub span: Span,
}

/// The rungs that write a variable, and how many others it depends on.
pub fn rungs_of(program: &Program, variable: &str) -> (Vec<RungOf>, usize) {
    let mut writers: HashMap<&str, Vec<usize>> = HashMap::new();
    let mut reads: Vec<Vec<&str>> = Vec::new();
    let all: Vec<_> = program.rungs().collect();
    for (at, (_, rung)) in all.iter().enumerate() {
        let mut read = Vec::new();
        for (_, element) in rung.network.elements() {
            for operand in element.kind.writes() {
                writers.entry(base(&operand.name)).or_default().push(at);
            }
            for operand in element.kind.reads() {
                read.push(base(&operand.name));
            }
            if let ElementKind::OneShot(shot) = &element.kind {
                read.extend(shot.memory.iter().map(|it| base(&it.name)));
            }
        }
        reads.push(read);
    }
    let own: BTreeSet<usize> = writers
        .get(base(variable))
        .into_iter()
        .flatten()
        .copied()
        .collect();
    let mut cone = own.clone();
    let mut open: Vec<usize> = own.iter().copied().collect();
    while let Some(at) = open.pop() {
        for name in &reads[at] {
            for &writer in writers.get(name).into_iter().flatten() {
                if cone.insert(writer) {
                    open.push(writer);
                }
            }
        }
    }
    let others = cone.len() - own.len();
    let rungs = own.into_iter().map(|at| {
        let (routine, rung) = all[at];
        RungOf {
            scope: routine.scope.clone(),
            number: rung.number,
            comment: rung.comment.clone(),
            span: rung.span,
        }
    });
    (rungs.collect(), others)
}

/// The variable without the member of a timer or counter that is looked at.
fn base(name: &str) -> &str {
    const MEMBERS: [&str; 15] = [
        "Q", "DN", "EN", "TT", "ET", "ACC", "IN", "PT", "PRE", "CU", "CD", "CV", "PV", "QU", "QD",
    ];
    match name.rsplit_once('.') {
        Some((whole, member)) if MEMBERS.contains(&member) => whole,
        _ => name,
    }
}
