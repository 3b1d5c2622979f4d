//! Routines cut into the stretches that are solved in one go, with every
//! call, jump and zone led to its target.

use std::collections::HashMap;
use std::ops::Range;

use logic::Name;
use petgraph::graph::NodeIndex;
use source::{Diagnostic, Span, codes};

use crate::{ElementKind, Network, Operand, Program, Routine, Rung, Wire};

/// A routine as a list of stretches.
#[derive(Clone, Debug, Default)]
pub(crate) struct Layout {
    pub(crate) stretches: Vec<Stretch>,
    /// Stretches between a label and a jump back to it: first, last, and the
    /// jump. Disjoint and in order.
    pub(crate) repeated: Vec<(usize, usize, NodeIndex)>,
}

/// Elements of a rung with nothing between them that steers.
#[derive(Clone, Debug)]
pub(crate) struct Stretch {
    pub(crate) rung: usize,
    pub(crate) elements: Range<usize>,
    /// What its last element does to the order, if anything.
    pub(crate) steer: Option<Steer>,
}

impl Stretch {
    /// The element that steers, the last of the stretch.
    pub(crate) fn last(&self) -> NodeIndex {
        NodeIndex::new(self.elements.end.saturating_sub(1))
    }
}

/// What an element does to the order of solving.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Steer {
    /// Solves a routine, if it is in the file.
    Call(Option<usize>),
    /// Goes on at a stretch of this routine, if its label is there.
    Jump(Option<usize>),
    /// Leaves the routine.
    Return,
    /// Ends the main routine and all it called.
    End,
    /// Begins a zone of these stretches: from the rung behind this one to the
    /// rung of its end, or to the end of the routine.
    ZoneBegin { first: usize, last: usize },
    /// Ends a zone.
    ZoneEnd,
}

/// The layouts of all routines, and what is wrong with their targets.
pub(crate) fn layouts(program: &Program) -> (Vec<Layout>, Vec<Diagnostic>) {
    let mut places: HashMap<(&str, &str), usize> = HashMap::new();
    for (at, routine) in program.routines.iter().enumerate() {
        places.entry((&routine.unit, &routine.name)).or_insert(at);
    }
    let mut diagnostics = Vec::new();
    let layouts = program
        .routines
        .iter()
        .map(|routine| {
            let find = |name: &str| places.get(&(&*routine.unit, name)).copied();
            layout(routine, find, &mut diagnostics)
        })
        .collect();
    (layouts, diagnostics)
}

fn layout(
    routine: &Routine,
    find: impl Fn(&str) -> Option<usize>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Layout {
    let mut labels = HashMap::new();
    let mut stretches = Vec::new();
    for (at, rung) in routine.rungs.iter().enumerate() {
        cut(at, rung, &mut stretches, &mut labels, diagnostics);
    }
    let mut layout = Layout {
        stretches,
        repeated: Vec::new(),
    };
    aim(routine, &mut layout, &labels, find, diagnostics);
    report_passed_over(routine, &layout, diagnostics);
    layout
}

/// Cuts a rung into stretches, and notes the labels in it.
fn cut(
    place: usize,
    rung: &Rung,
    stretches: &mut Vec<Stretch>,
    labels: &mut HashMap<Name, (usize, Span)>,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let mut start = 0;
    let mut only_rail = true;
    let network = &rung.network;
    for (at, element) in network.elements() {
        let at = at.index();
        let mut end_after = |steer| {
            stretches.push(Stretch {
                rung: place,
                elements: start..at + 1,
                steer: Some(steer),
            });
            start = at + 1;
        };
        match &element.kind {
            ElementKind::Rail => continue,
            ElementKind::Label(name) => {
                if !only_rail && start < at {
                    stretches.push(Stretch {
                        rung: place,
                        elements: start..at,
                        steer: None,
                    });
                    start = at;
                }
                note_label(rung, name, stretches.len(), labels, diagnostics);
            }
            ElementKind::Call(_) => end_after(Steer::Call(None)),
            ElementKind::Jump(_) => end_after(Steer::Jump(None)),
            ElementKind::Return { program: true } => end_after(Steer::End),
            ElementKind::Return { program: false } => end_after(Steer::Return),
            ElementKind::Zone => end_after(Steer::ZoneEnd),
            _ => {}
        }
        only_rail = false;
    }
    if start < network.len() {
        stretches.push(Stretch {
            rung: place,
            elements: start..network.len(),
            steer: None,
        });
    }
}

fn note_label(
    rung: &Rung,
    name: &Operand,
    stretch: usize,
    labels: &mut HashMap<Name, (usize, Span)>,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let span = rung.place(name.within);
    if let Some((_, first)) = labels.get(&name.name) {
        diagnostics.push(
            Diagnostic::new(
                codes::DECLARED_TWICE,
                span,
                format!("the routine has a label `{}` already", name.name),
            )
            .help("rename one of them; jumps go to the first")
            .related(*first, "the first label of that name"),
        );
    } else {
        labels.insert(name.name.clone(), (stretch, span));
    }
}

/// Leads every call, jump and zone to its target.
fn aim(
    routine: &Routine,
    layout: &mut Layout,
    labels: &HashMap<Name, (usize, Span)>,
    find: impl Fn(&str) -> Option<usize>,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let mut backward = Vec::new();
    let mut open_zone: Option<usize> = None;
    let last = layout.stretches.len().saturating_sub(1);
    for at in 0..layout.stretches.len() {
        let Some(rung) = routine.rungs.get(layout.stretches[at].rung) else {
            continue;
        };
        let node = layout.stretches[at].last();
        let aimed = match (&rung.network.element(node).kind, layout.stretches[at].steer) {
            (ElementKind::Call(call), Some(Steer::Call(_))) => {
                let target = find(&call.routine.name);
                if target.is_none() {
                    let place = rung.place(call.routine.within);
                    diagnostics.push(missing_routine(&call.routine.name, place));
                }
                Steer::Call(target)
            }
            (ElementKind::Jump(name), Some(Steer::Jump(_))) => {
                let target = labels.get(&name.name);
                match target {
                    None => diagnostics.push(missing_label(&name.name, rung.place(name.within))),
                    Some((to, label)) if *to <= at => {
                        let jump = rung.place(name.within);
                        diagnostics.push(backward_jump(&name.name, jump, *label));
                        backward.push((*to, at, node));
                    }
                    Some(_) => {}
                }
                Steer::Jump(target.map(|(to, _)| *to))
            }
            (ElementKind::Zone, _) => match open_zone.take() {
                None => {
                    open_zone = Some(at);
                    let first = behind_rung(&layout.stretches, at);
                    Steer::ZoneBegin { first, last }
                }
                Some(begin) => {
                    layout.stretches[begin].steer = Some(Steer::ZoneBegin {
                        first: behind_rung(&layout.stretches, begin),
                        last: behind_rung(&layout.stretches, at) - 1,
                    });
                    Steer::ZoneEnd
                }
            },
            _ => continue,
        };
        layout.stretches[at].steer = Some(aimed);
    }
    layout.repeated = merged(backward);
}

/// The first stretch behind the rung of the stretch `at`.
fn behind_rung(stretches: &[Stretch], at: usize) -> usize {
    stretches.partition_point(|stretch| stretch.rung <= stretches[at].rung)
}

/// Overlapping stretches of repetition become one, named by its first jump.
fn merged(mut ranges: Vec<(usize, usize, NodeIndex)>) -> Vec<(usize, usize, NodeIndex)> {
    ranges.sort_unstable();
    let mut merged: Vec<(usize, usize, NodeIndex)> = Vec::new();
    for range in ranges {
        match merged.last_mut() {
            Some(last) if range.0 <= last.1 => {
                if range.1 > last.1 {
                    (last.1, last.2) = (range.1, range.2);
                }
            }
            _ => merged.push(range),
        }
    }
    merged
}

/// Says which rungs lie behind a jump or return that is always powered, with
/// no label between where another jump could arrive.
fn report_passed_over(routine: &Routine, layout: &Layout, diagnostics: &mut Vec<Diagnostic>) {
    let mut arrives = vec![false; layout.stretches.len()];
    for stretch in &layout.stretches {
        if let Some(Steer::Jump(Some(to))) = stretch.steer {
            arrives[to] = true;
        }
    }
    let mut at = 0;
    while at < layout.stretches.len() {
        let stretch = &layout.stretches[at];
        at += 1;
        let Some(rung) = routine.rungs.get(stretch.rung) else {
            continue;
        };
        let leaves = match stretch.steer {
            Some(Steer::Jump(Some(to))) => to >= at,
            Some(Steer::Return | Steer::End) => true,
            _ => false,
        };
        if !leaves || !always_powered(&rung.network, stretch.last()) {
            continue;
        }
        let end = (at..layout.stretches.len())
            .find(|&next| arrives[next])
            .unwrap_or(layout.stretches.len());
        let passed = layout.stretches[at..end]
            .iter()
            .filter(|passed| passed.elements.start == 0)
            .filter_map(|passed| routine.rungs.get(passed.rung))
            .collect::<Vec<_>>();
        if let (Some(first), Some(last)) = (passed.first(), passed.last()) {
            diagnostics.push(passed_over(
                first.span.cover(last.span),
                passed.len(),
                rung.place(rung.network.element(stretch.last()).within),
            ));
        }
        at = end;
    }
}

fn always_powered(network: &Network, at: NodeIndex) -> bool {
    network
        .arriving(at)
        .iter()
        .any(|(from, wire)| *from == Network::rail() && **wire == Wire::default())
}

fn passed_over(span: Span, count: usize, jump: Span) -> Diagnostic {
    let message = match count {
        1 => "this rung is never solved: it is always passed over".to_owned(),
        _ => format!("these {count} rungs are never solved: they are always passed over"),
    };
    Diagnostic::new(codes::UNREACHABLE_RUNG, span, message)
        .help("give the jump or return a condition, or remove the rungs")
        .related(jump, "this is always powered")
}

fn missing_routine(name: &Name, call: Span) -> Diagnostic {
    Diagnostic::new(
        codes::MISSING_ROUTINE,
        call,
        format!("the called routine `{name}` is not in the file"),
    )
    .help("export the whole program; until then what the routine writes is unknown")
}

fn missing_label(name: &Name, jump: Span) -> Diagnostic {
    Diagnostic::new(
        codes::DANGLING_CONNECTION,
        jump,
        format!("the routine has no label `{name}` to jump to"),
    )
    .help("add the label or correct its name; until then this never jumps")
}

fn backward_jump(name: &Name, jump: Span, label: Span) -> Diagnostic {
    Diagnostic::new(
        codes::BACKWARD_JUMP,
        jump,
        format!(
            "the jump to `{name}` leads backwards, so the rungs between may be solved several times a scan"
        ),
    )
    .help("their conditions are taken as unknown; jump forwards only to have them")
    .related(label, "the label")
}
