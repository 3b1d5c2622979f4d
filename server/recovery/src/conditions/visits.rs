//! From rungs, each solved by itself, to what happens in a scan.

use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::sync::Arc;

use ladder::{ElementKind, Program, flow};
use logic::{AtomId, Budget, Function, Stop};
use petgraph::graph::NodeIndex;

use super::rung::{self, Event, Solved};
use super::sequence::Rungs;
use super::writes::Place;
use super::{TimerLaw, Walk};

/// Something that an element does, and under which circumstances.
pub(super) struct Occurrence {
    pub(super) event: Arc<Event>,
    pub(super) solved: Result<Function, Stop>,
    pub(super) zone: Result<Function, Stop>,
    pub(super) place: Place,
}

/// What happens in a scan.
#[derive(Default)]
pub(super) struct Happening {
    /// In the order of the scan.
    pub(super) occurrences: Vec<Occurrence>,
    pub(super) timers: HashMap<AtomId, TimerLaw>,
}

/// What decides whether a visit is solved, as conditions.
#[derive(Clone)]
struct Circumstances {
    solved: Result<Function, Stop>,
    zone: Result<Function, Stop>,
}

/// Follows `program` in the order of its scan.
pub(super) fn happening(
    program: &Program,
    execution: &flow::Execution,
    rungs: &Rungs,
    walk: &mut Walk<'_>,
) -> Happening {
    let mut collector = Collector {
        program,
        rungs,
        found: Happening::default(),
    };
    collector.order(&execution.scan, walk);
    for (_, order) in &execution.definitions {
        collector.order(order, walk);
    }
    for &routine in &execution.unreachable {
        collector.unreachable(routine, walk);
    }
    collector.found
}

impl Circumstances {
    fn always() -> Self {
        Self {
            solved: Ok(Function::constant(true)),
            zone: Ok(Function::constant(true)),
        }
    }
}

struct Collector<'p> {
    program: &'p Program,
    rungs: &'p Rungs,
    found: Happening,
}

impl Collector<'_> {
    fn order(&mut self, order: &flow::Order, walk: &mut Walk<'_>) {
        // Power at the calls, jumps, returns and zones of earlier visits.
        let mut steering: HashMap<(usize, NodeIndex), Result<Function, Stop>> = HashMap::new();
        let mut known = HashMap::from([(flow::GuardSet::NONE, Circumstances::always())]);
        for (at, visit) in order.visits.iter().enumerate() {
            if walk.budget.cancel.is_cancelled() {
                return;
            }
            let circumstances = circumstances(order, visit.guards, &steering, &mut known, walk);
            let place = (visit.routine, visit.rung);
            let Some(solved) = self.solved(place, &circumstances, walk) else {
                continue;
            };
            let network = &self.program.routines[visit.routine].rungs[visit.rung].network;
            for (element, power) in &solved.steering {
                if visit.elements.contains(&element.index()) {
                    let kind = &network.element(*element).kind;
                    let there = steered(kind, power, &circumstances, walk);
                    steering.insert((at, *element), there);
                }
            }
            self.visit(place, &solved, &visit.elements, &circumstances, walk);
        }
    }

    /// Rungs that nothing leads to: shown, but they never write.
    fn unreachable(&mut self, routine: usize, walk: &mut Walk<'_>) {
        let circumstances = Circumstances {
            solved: Ok(Function::constant(false)),
            zone: Ok(Function::constant(true)),
        };
        for at in 0..self.program.routines[routine].rungs.len() {
            if let Some(solved) = self.solved((routine, at), &circumstances, walk) {
                let all = 0..usize::MAX;
                self.visit((routine, at), &solved, &all, &circumstances, walk);
            }
        }
    }

    /// The rung, solved in its zone.
    fn solved(
        &self,
        (routine, at): (usize, usize),
        circumstances: &Circumstances,
        walk: &mut Walk<'_>,
    ) -> Option<Arc<Solved>> {
        let solved = self.rungs.get((routine, at))?;
        let is_on = circumstances.zone.as_ref().is_ok_and(Function::is_true);
        if is_on || !solved.rewrites {
            return Some(Arc::clone(solved));
        }
        let network = &self.program.routines[routine].rungs[at].network;
        Some(rung::solve(network, &circumstances.zone, walk).into())
    }

    fn visit(
        &mut self,
        (routine, rung): (usize, usize),
        solved: &Solved,
        elements: &std::ops::Range<usize>,
        circumstances: &Circumstances,
        walk: &mut Walk<'_>,
    ) {
        walk.opaque.extend(&solved.opaque);
        let here = solved.events.iter();
        for event in here.filter(|event| elements.contains(&event.element)) {
            self.found.occurrences.push(Occurrence {
                event: Arc::clone(event),
                solved: circumstances.solved.clone(),
                zone: circumstances.zone.clone(),
                place: Place {
                    routine,
                    rung,
                    element: event.element,
                },
            });
        }
        for timer in &solved.timers {
            if !elements.contains(&timer.element) {
                continue;
            }
            let input = conjoined(&[&timer.input, &circumstances.zone], walk.budget);
            let law = TimerLaw {
                kind: timer.kind,
                input,
            };
            match self.found.timers.entry(timer.output) {
                Entry::Vacant(free) => {
                    free.insert(law);
                }
                // Run from several rungs: no law of one of them holds.
                Entry::Occupied(mut taken) => {
                    taken.get_mut().input = Ok(Function::constant(true));
                }
            }
        }
    }
}

/// The condition under which an element that gets `power` calls, jumps or
/// leaves, or the zone that it begins is switched on. A jump that is not solved
/// does not jump; a zone whose begin is not solved is on.
fn steered(
    kind: &ElementKind,
    power: &Result<Function, Stop>,
    circumstances: &Circumstances,
    walk: &Walk<'_>,
) -> Result<Function, Stop> {
    let solved = &circumstances.solved;
    if *kind != ElementKind::Zone {
        return conjoined(&[power, solved, &circumstances.zone], walk.budget);
    }
    let power = conjoined(&[power, &circumstances.zone], walk.budget)?;
    power.or(&solved.clone()?.not(), walk.budget)
}

/// The product of all parts.
pub(super) fn conjoined(
    parts: &[&Result<Function, Stop>],
    budget: &Budget,
) -> Result<Function, Stop> {
    parts
        .iter()
        .try_fold(Function::constant(true), |all, part| {
            all.and(part.as_ref().map_err(|stop| *stop)?, budget)
        })
}

/// The circumstances of a guard set: those of the set it extends, and its
/// last guard.
fn circumstances(
    order: &flow::Order,
    set: flow::GuardSet,
    steering: &HashMap<(usize, NodeIndex), Result<Function, Stop>>,
    known: &mut HashMap<flow::GuardSet, Circumstances>,
    walk: &mut Walk<'_>,
) -> Circumstances {
    // Sets extend earlier ones: climb to the nearest known, then come back.
    let mut climbed = Vec::new();
    let mut outer = set;
    while !known.contains_key(&outer) {
        let Some((guard, next)) = order.last_guard(outer) else {
            break;
        };
        climbed.push((outer, guard));
        outer = next;
    }
    let mut here = known
        .get(&outer)
        .cloned()
        .unwrap_or_else(Circumstances::always);
    for (set, guard) in climbed.into_iter().rev() {
        here = guarded(here, guard, steering, walk);
        known.insert(set, here.clone());
    }
    here
}

fn guarded(
    outer: Circumstances,
    guard: flow::Guard,
    steering: &HashMap<(usize, NodeIndex), Result<Function, Stop>>,
    walk: &mut Walk<'_>,
) -> Circumstances {
    let power = |place: flow::Place| {
        steering
            .get(&(place.visit, place.element))
            .cloned()
            .unwrap_or(Ok(Function::constant(false)))
    };
    match guard {
        flow::Guard::Skipped { by, solved_when } => {
            let power = power(by).map(|p| if solved_when { p } else { p.not() });
            Circumstances {
                solved: conjoined(&[&outer.solved, &power], walk.budget),
                ..outer
            }
        }
        flow::Guard::Zone { begin } => Circumstances {
            zone: conjoined(&[&outer.zone, &power(begin)], walk.budget),
            ..outer
        },
        flow::Guard::Repeated { rung, .. } => {
            // How often it is solved is unknown: an atom of its own says so.
            let atom = walk
                .atoms
                .add_variable(&format!("repeated by rung {rung}").into());
            walk.opaque.insert(atom);
            Circumstances {
                solved: conjoined(&[&outer.solved, &Ok(Function::atom(atom))], walk.budget),
                ..outer
            }
        }
    }
}
