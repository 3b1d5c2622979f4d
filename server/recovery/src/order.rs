//! When in a scan the rungs are solved, and who writes what there.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::ops::Range;
use std::sync::Arc;

use ladder::{Class, ContactKind, ElementKind, Program, flow};
use logic::{Atom, Datum, Expr, Name};
use petgraph::graph::NodeIndex;

use crate::conditions::{changing, leading_to, sees_several_moments};

/// A moment of the scan: which visit to a rung, and which element of it.
pub(crate) type Place = (usize, usize);

/// A rung, by its routine and its place there.
pub(crate) type Rung = (usize, usize);

/// Calls, jumps and zones in each other beyond which nobody looks.
const DEEPEST: usize = 64;

/// Stretches of one rung beyond which nobody looks.
const MOST_STRETCHES: usize = 64;

/// When the rungs of a program are solved.
#[derive(Debug)]
pub(crate) struct Order {
    program: Arc<Program>,
    execution: flow::Execution,
    /// The rungs by the ranks of the visits to them.
    ranked: Vec<Rung>,
    /// The visits to a rung: one, or one for each stretch of it, or several.
    visits: HashMap<Rung, Vec<Visit>>,
    /// Where a variable is written; none for what is solved several times.
    writings: HashMap<Name, Vec<Option<Place>>>,
    /// Where it may be written with all its parts: by anything but a coil.
    wholes: HashMap<Name, Vec<Option<Place>>>,
    /// Where a part of it is written.
    parts: HashMap<Name, Vec<Option<Place>>>,
}

/// A visit: the order it is in, its place there and among all, and the elements
/// that are solved.
#[derive(Clone, Debug)]
struct Visit {
    order: usize,
    at: usize,
    rank: usize,
    elements: Range<usize>,
}

/// What reads a variable on the way to an element.
type Reads = HashMap<Name, Vec<Place>>;

/// Something that is solved, and what decides whether it is.
pub(crate) struct Reader {
    place: Place,
    /// What is read on the way to it, and to the elements that decide whether it
    /// is solved.
    reads: Reads,
}

impl Order {
    pub(crate) fn new(program: &Arc<Program>) -> Self {
        let mut order = Self {
            program: Arc::clone(program),
            execution: flow::execution(program),
            ranked: Vec::new(),
            visits: HashMap::new(),
            writings: HashMap::new(),
            wholes: HashMap::new(),
            parts: HashMap::new(),
        };
        for number in 0..=order.execution.definitions.len() {
            for at in 0..order.visits_of(number).visits.len() {
                let visit = &order.visits_of(number).visits[at];
                let rung = (visit.routine, visit.rung);
                let elements = visit.elements.clone();
                let visit = Visit {
                    order: number,
                    at,
                    rank: order.ranked.len(),
                    elements,
                };
                order.visits.entry(rung).or_default().push(visit);
                order.ranked.push(rung);
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
        for (&(routine, rung), visits) in &self.visits {
            let network = &self.program.routines[routine].rungs[rung].network;
            for (at, element) in network.elements() {
                let place = match only_one(visits, at.index()) {
                    Some(Ok(visit)) => Some((visit.rank, at.index())),
                    Some(Err(())) => None,
                    None => continue,
                };
                // What a box writes that nobody knows comes from outside, as
                // inputs do.
                if matches!(element.kind, ElementKind::Block(_)) {
                    continue;
                }
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

    /// The rung that is solved at a moment.
    pub(crate) fn rung(&self, place: Place) -> Option<Rung> {
        self.ranked.get(place.0).copied()
    }

    /// When an element is solved; none if it never is, an error if it is solved
    /// several times.
    pub(crate) fn of(&self, rung: Rung, element: usize) -> Option<Result<usize, ()>> {
        let visit = match only_one(self.visits.get(&rung)?, element)? {
            Ok(visit) => visit,
            Err(()) => return Some(Err(())),
        };
        let order = self.visits_of(visit.order);
        let guards = order.guards(order.visits[visit.at].guards);
        let mut guards = guards.take(DEEPEST + 1).enumerate();
        let is_beyond = guards.any(|(depth, guard)| {
            depth == DEEPEST || matches!(guard, flow::Guard::Repeated { .. })
        });
        Some(if is_beyond { Err(()) } else { Ok(visit.rank) })
    }

    /// What is solved at `place` of a rung, and only there.
    pub(crate) fn reader(&self, place: Place, rung: Rung) -> Reader {
        let mut reads = self.reads(rung, place.1);
        let visits = self.visits.get(&rung).map_or(&[][..], Vec::as_slice);
        if let Some(Ok(visit)) = only_one(visits, place.1) {
            let order = self.visits_of(visit.order);
            for guard in order.guards(order.visits[visit.at].guards).take(DEEPEST) {
                let by = match guard {
                    flow::Guard::Skipped { by, .. } => by,
                    flow::Guard::Zone { begin } => begin,
                    flow::Guard::Repeated { .. } => continue,
                };
                let at = &order.visits[by.visit];
                let there = self.reads((at.routine, at.rung), by.element.index());
                for (name, places) in there {
                    reads.entry(name).or_default().extend(places);
                }
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
        let visits = self.visits.get(&(routine, rung));
        let visits = visits.map_or(&[][..], Vec::as_slice);
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
                let Some(Ok(visit)) = only_one(visits, at) else {
                    continue;
                };
                let known = reads.entry(read.name.clone()).or_default();
                known.push((visit.rank, at));
            }
        }
        reads
    }

    /// Where `reader` looks at a variable; where it stands itself if nothing
    /// on the way to it does.
    pub(crate) fn readings(&self, name: &Name, reader: &Reader) -> Vec<Place> {
        let known = reader.reads.get(name).cloned();
        known.unwrap_or_else(|| vec![reader.place])
    }

    /// Whether a name is that of a number that never changes.
    pub(crate) fn is_constant(&self, name: &str) -> bool {
        let declared = self.program.declarations.find(name);
        Datum::constant(name).is_some() || declared.is_some_and(|it| it.class == Class::Constant)
    }

    /// Where a variable is written, as a whole or in part; an error if that is
    /// in a rung that is solved several times.
    pub(crate) fn writings(&self, name: &Name) -> Result<Vec<Place>, ()> {
        let known = wholes(name).filter_map(|whole| self.wholes.get(whole));
        let known = known.chain(self.writings.get(name));
        let known = known.chain(self.parts.get(name)).flatten();
        known.map(|place| place.ok_or(())).collect()
    }
}

/// The visit in which an element is solved; none if there is none, an error if
/// there are several.
fn only_one(visits: &[Visit], element: usize) -> Option<Result<&Visit, ()>> {
    if visits.len() > MOST_STRETCHES {
        return Some(Err(()));
    }
    let mut those = visits.iter().filter(|it| it.elements.contains(&element));
    let first = those.next()?;
    Some(those.next().map_or(Ok(first), |_| Err(())))
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

/// The variables that an expression names, those in its edges and comparisons
/// too.
pub(crate) fn names_in(expr: &Expr) -> BTreeSet<Name> {
    let mut names = BTreeSet::new();
    expr.each_atom(&mut |atom| match atom {
        Atom::Variable(name) => {
            names.insert(name.clone());
        }
        Atom::Comparison(it) => {
            for side in [&it.left, &it.right] {
                let words = side.split(|c: char| " +-*/()".contains(c));
                names.extend(words.filter(|it| !it.is_empty()).map(Name::from));
            }
        }
        Atom::Rise(inner) | Atom::Fall(inner) => names.extend(names_in(inner)),
        Atom::Elapsed { step, .. } => {
            names.insert(step.clone());
        }
    });
    names
}
