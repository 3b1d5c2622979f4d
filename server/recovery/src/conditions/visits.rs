//! From rungs, each solved by itself, to what happens in a scan.

use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::sync::Arc;

use ladder::{ElementKind, Network, Program, flow};
use logic::{AtomId, Budget, Function, Stop};
use petgraph::graph::NodeIndex;

use super::rung::{self, Event, Solved, Timed};
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
pub(super) struct Happening {
    /// In the order of the scan.
    pub(super) occurrences: Vec<Occurrence>,
    pub(super) timers: HashMap<AtomId, TimerLaw>,
    pub(super) visited: Visited,
}

/// What decides whether a visit is solved, as conditions.
#[derive(Debug)]
pub(super) struct Circumstances {
    pub(super) solved: Result<Function, Stop>,
    pub(super) zone: Result<Function, Stop>,
}

/// How often the rungs of each routine are visited.
#[derive(Debug)]
pub(super) struct Visited {
    rungs: Vec<Vec<Visits>>,
    /// How many visits there are.
    count: usize,
}

/// How often a rung is visited.
#[derive(Clone, Debug)]
pub(super) enum Visits {
    Never,
    Once {
        /// The place of the visit among all.
        rank: usize,
        /// Its place in the order of the scan, if it is there.
        in_scan: Option<usize>,
        circumstances: Arc<Circumstances>,
    },
    /// More than once, or in several parts.
    Often {
        /// The place of the first visit in the order of the scan, if it is
        /// there.
        in_scan: Option<usize>,
    },
}

impl Visits {
    /// The place of the first visit in the order of the scan, if it is there.
    pub(super) fn in_scan(&self) -> Option<usize> {
        match self {
            Self::Never => None,
            Self::Once { in_scan, .. } | Self::Often { in_scan } => *in_scan,
        }
    }
}

impl Visited {
    fn none(program: &Program) -> Self {
        let routines = program.routines.iter();
        Self {
            rungs: routines
                .map(|it| vec![Visits::Never; it.rungs.len()])
                .collect(),
            count: 0,
        }
    }

    pub(super) fn get(&self, (routine, rung): (usize, usize)) -> &Visits {
        let visits = self.rungs.get(routine).and_then(|it| it.get(rung));
        visits.unwrap_or(&Visits::Never)
    }

    fn add(
        &mut self,
        (routine, rung): (usize, usize),
        in_scan: Option<usize>,
        circumstances: &Arc<Circumstances>,
    ) {
        let visits = &mut self.rungs[routine][rung];
        *visits = match &*visits {
            Visits::Never => Visits::Once {
                rank: self.count,
                in_scan,
                circumstances: Arc::clone(circumstances),
            },
            visited => Visits::Often {
                in_scan: visited.in_scan().or(in_scan),
            },
        };
        self.count += 1;
    }
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
        found: Happening {
            occurrences: Vec::new(),
            timers: HashMap::new(),
            visited: Visited::none(program),
        },
    };
    collector.order(&execution.scan, true, walk);
    for (_, order) in &execution.definitions {
        collector.order(order, false, walk);
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

    /// The rung, solved in its zone.
    pub(super) fn met(
        &self,
        solved: &Arc<Solved>,
        network: &Network,
        walk: &mut Walk<'_>,
    ) -> Arc<Solved> {
        let is_on = self.zone.as_ref().is_ok_and(Function::is_true);
        match is_on || !solved.rewrites {
            true => Arc::clone(solved),
            false => rung::solve(network, &self.zone, walk).into(),
        }
    }

    /// What an element does when it is solved under them.
    pub(super) fn occurrence(
        &self,
        event: &Arc<Event>,
        (routine, rung): (usize, usize),
    ) -> Occurrence {
        Occurrence {
            event: Arc::clone(event),
            solved: self.solved.clone(),
            zone: self.zone.clone(),
            place: Place {
                routine,
                rung,
                element: event.element,
            },
        }
    }

    /// What a timer's output obeys when it runs under them.
    pub(super) fn law(&self, timer: &Timed, budget: &Budget) -> TimerLaw {
        TimerLaw {
            kind: timer.kind,
            input: conjoined(&[&timer.input, &self.zone], budget),
        }
    }
}

struct Collector<'p> {
    program: &'p Program,
    rungs: &'p Rungs,
    found: Happening,
}

impl Collector<'_> {
    fn order(&mut self, order: &flow::Order, is_scan: bool, walk: &mut Walk<'_>) {
        // Power at the calls, jumps, returns and zones of earlier visits.
        let mut steering: HashMap<(usize, NodeIndex), Result<Function, Stop>> = HashMap::new();
        let mut known = HashMap::from([(flow::GuardSet::NONE, Circumstances::always().into())]);
        for (at, visit) in order.visits.iter().enumerate() {
            if walk.budget.cancel.is_cancelled() {
                return;
            }
            let circumstances = circumstances(order, visit.guards, &steering, &mut known, walk);
            let place = (visit.routine, visit.rung);
            let in_scan = is_scan.then_some(at);
            self.found.visited.add(place, in_scan, &circumstances);
            let network = &self.program.routines[visit.routine].rungs[visit.rung].network;
            let solved = self.rungs.get(place);
            let Some(solved) = solved.map(|it| circumstances.met(it, network, walk)) else {
                continue;
            };
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
        let circumstances = Arc::new(circumstances);
        for at in 0..self.program.routines[routine].rungs.len() {
            let place = (routine, at);
            self.found.visited.add(place, None, &circumstances);
            if let Some(solved) = self.rungs.get(place).cloned() {
                let all = 0..usize::MAX;
                self.visit(place, &solved, &all, &circumstances, walk);
            }
        }
    }

    fn visit(
        &mut self,
        place: (usize, usize),
        solved: &Solved,
        elements: &std::ops::Range<usize>,
        circumstances: &Circumstances,
        walk: &mut Walk<'_>,
    ) {
        walk.opaque.extend(&solved.opaque);
        let here = solved.events.iter();
        for event in here.filter(|event| elements.contains(&event.element)) {
            let occurrence = circumstances.occurrence(event, place);
            self.found.occurrences.push(occurrence);
        }
        for timer in &solved.timers {
            if !elements.contains(&timer.element) {
                continue;
            }
            let law = circumstances.law(timer, walk.budget);
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
    known: &mut HashMap<flow::GuardSet, Arc<Circumstances>>,
    walk: &mut Walk<'_>,
) -> Arc<Circumstances> {
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
        .unwrap_or_else(|| Circumstances::always().into());
    for (set, guard) in climbed.into_iter().rev() {
        here = guarded(&here, guard, steering, walk).into();
        known.insert(set, Arc::clone(&here));
    }
    here
}

fn guarded(
    outer: &Circumstances,
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
                zone: outer.zone.clone(),
            }
        }
        flow::Guard::Zone { begin } => Circumstances {
            solved: outer.solved.clone(),
            zone: conjoined(&[&outer.zone, &power(begin)], walk.budget),
        },
        flow::Guard::Repeated { rung, .. } => {
            // How often it is solved is unknown: an atom of its own says so.
            let atom = walk
                .atoms
                .add_variable(&format!("repeated by rung {rung}").into());
            walk.opaque.insert(atom);
            Circumstances {
                solved: conjoined(&[&outer.solved, &Ok(Function::atom(atom))], walk.budget),
                zone: outer.zone.clone(),
            }
        }
    }
}
