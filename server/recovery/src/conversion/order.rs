//! When in a scan the rungs are solved, and who writes what there.

use std::collections::{BTreeMap, HashMap};

use ladder::{ContactKind, ElementKind, Program, flow};
use logic::Name;
use petgraph::graph::NodeIndex;

use crate::conditions::{changing, leading_to, sees_several_moments};

/// A moment of the scan: which visit to a rung, and which element of it.
pub(super) type Place = (usize, usize);

/// A rung, by its routine and its place there.
type Rung = (usize, usize);

/// Calls, jumps and zones in each other beyond which nobody looks.
const DEEPEST: usize = 64;

/// When the rungs of a program are solved.
pub(super) struct Order<'p> {
    program: &'p Program,
    execution: flow::Execution,
    /// The one visit to a rung: the order it is in, its place there and among
    /// all. None if there are several.
    visits: HashMap<Rung, Option<Visit>>,
    /// Where a variable is written; none for a rung with several visits.
    writings: HashMap<Name, Vec<Option<Place>>>,
    /// Where it may be written with all its parts: by anything but a coil.
    wholes: HashMap<Name, Vec<Option<Place>>>,
    /// Where a part of it is written.
    parts: HashMap<Name, Vec<Option<Place>>>,
}

#[derive(Clone, Copy)]
struct Visit {
    order: usize,
    at: usize,
    rank: usize,
}

/// What reads a variable on the way to an element.
type Reads = HashMap<Name, Vec<usize>>;

/// Something that is solved, and what decides whether it is.
pub(super) struct Reader {
    place: Place,
    /// It and the elements that decide whether it is solved: when they are, and
    /// what is read on the way to them.
    reads: Vec<(usize, Reads)>,
}

impl<'p> Order<'p> {
    pub(super) fn new(program: &'p Program) -> Self {
        let mut order = Self {
            program,
            execution: flow::execution(program),
            visits: HashMap::new(),
            writings: HashMap::new(),
            wholes: HashMap::new(),
            parts: HashMap::new(),
        };
        let mut rank = 0;
        for number in 0..=order.execution.definitions.len() {
            for at in 0..order.visits_of(number).visits.len() {
                let visit = &order.visits_of(number).visits[at];
                let rung = (visit.routine, visit.rung);
                let visit = Visit {
                    order: number,
                    at,
                    rank,
                };
                let known = order.visits.entry(rung).or_insert(Some(visit));
                if known.is_some_and(|it| it.rank != rank) {
                    *known = None;
                }
                rank += 1;
            }
        }
        order.find_writings();
        order
    }

    fn visits_of(&self, number: usize) -> &flow::Order {
        match number.checked_sub(1) {
            None => &self.execution.scan,
            Some(at) => &self.execution.definitions[at].1,
        }
    }

    fn find_writings(&mut self) {
        for (&(routine, rung), visit) in &self.visits {
            let network = &self.program.routines[routine].rungs[rung].network;
            for (at, element) in network.elements() {
                let place = visit.map(|it| (it.rank, at.index()));
                for written in element.kind.writes() {
                    let known = match element.kind {
                        ElementKind::Coil(_) => &mut self.writings,
                        _ => &mut self.wholes,
                    };
                    known.entry(written.name.clone()).or_default().push(place);
                    for whole in wholes(&written.name).skip(1) {
                        self.parts.entry(whole.into()).or_default().push(place);
                    }
                }
            }
        }
    }

    /// Where a rung stands in the scan; none if it is never solved, an error
    /// if it is solved several times.
    pub(super) fn of(&self, rung: Rung) -> Option<Result<usize, ()>> {
        let visit = self.visits.get(&rung)?;
        let Some(visit) = visit else {
            return Some(Err(()));
        };
        let order = self.visits_of(visit.order);
        let guards = order.guards(order.visits[visit.at].guards);
        let mut guards = guards.take(DEEPEST + 1).enumerate();
        let is_beyond = guards.any(|(depth, guard)| {
            depth == DEEPEST || matches!(guard, flow::Guard::Repeated { .. })
        });
        Some(if is_beyond { Err(()) } else { Ok(visit.rank) })
    }

    /// What is solved at `place` of a rung that is solved once.
    pub(super) fn reader(&self, place: Place, rung: Rung) -> Reader {
        let mut reads = vec![(place.0, self.reads(rung, place.1))];
        if let Some(Some(visit)) = self.visits.get(&rung) {
            let order = self.visits_of(visit.order);
            for guard in order.guards(order.visits[visit.at].guards).take(DEEPEST) {
                let by = match guard {
                    flow::Guard::Skipped { by, .. } => by,
                    flow::Guard::Zone { begin } => begin,
                    flow::Guard::Repeated { .. } => continue,
                };
                let at = &order.visits[by.visit];
                let rank = visit.rank - visit.at + by.visit;
                let there = self.reads((at.routine, at.rung), by.element.index());
                reads.push((rank, there));
            }
        }
        Reader { place, reads }
    }

    /// What is read on the way to an element. Where contacts on it see one
    /// variable at different moments its conditions speak of what was before
    /// the rung, which is the place of the rail.
    fn reads(&self, (routine, rung): Rung, element: usize) -> Reads {
        let mut reads = Reads::new();
        let network = &self.program.routines[routine].rungs[rung].network;
        let element = NodeIndex::new(element);
        let is_since = sees_several_moments(network, element);
        let changing = match is_since {
            true => changing(network),
            false => BTreeMap::new(),
        };
        for at in leading_to(network, element) {
            let kind = &network.element(at).kind;
            let sees_edge = matches!(kind, ElementKind::Contact(contact)
                if matches!(contact.kind, ContactKind::Rising | ContactKind::Falling));
            for read in kind.reads() {
                let is_since = !sees_edge && changing.contains_key(&read.name);
                let at = if is_since { 0 } else { at.index() };
                reads.entry(read.name.clone()).or_default().push(at);
            }
        }
        reads
    }

    /// Where `reader` looks at a variable; where it stands itself if nothing
    /// on the way to it does.
    pub(super) fn readings(&self, name: &Name, reader: &Reader) -> Vec<Place> {
        let mut found = Vec::new();
        for (rank, reads) in &reader.reads {
            let at = reads.get(name).map_or(&[][..], Vec::as_slice);
            found.extend(at.iter().map(|at| (*rank, *at)));
        }
        if found.is_empty() {
            found.push(reader.place);
        }
        found
    }

    /// Where a variable is written, as a whole or in part; an error if that is
    /// in a rung that is solved several times.
    pub(super) fn writings(&self, name: &Name) -> Result<Vec<Place>, ()> {
        let known = wholes(name).filter_map(|whole| self.wholes.get(whole));
        let known = known.chain(self.writings.get(name));
        let known = known.chain(self.parts.get(name)).flatten();
        known.map(|place| place.ok_or(())).collect()
    }
}

/// A name, and the names of what it is a part of: `A.B[1].2`, `A.B[1]`, `A.B`,
/// `A`.
fn wholes(name: &str) -> impl Iterator<Item = &str> {
    let mut rest = Some(name).filter(|it| !it.is_empty());
    std::iter::from_fn(move || {
        let whole = rest?;
        rest = whole
            .rfind(['.', '['])
            .and_then(|at| whole.get(..at))
            .filter(|it| !it.is_empty());
        Some(whole)
    })
}
