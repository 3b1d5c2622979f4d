//! Every write of a program, in the order of the scan.

use std::collections::{BTreeSet, HashMap};

use ladder::{
    Assignment, CoilKind, ContactKind, Edge, ElementKind, Network, PinDirection, Program, Value,
    flow,
};
use logic::{Atom, AtomId, Function, Name, Stop};
use petgraph::graph::NodeIndex;
use petgraph::visit::{Dfs, Reversed};
use source::Span;

use super::power::{edge_of, powers_seeing};
use super::solving::Solving;
use super::{Powers, TimerLaw, Walk};

/// Where an element stands in its program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Place {
    /// Place of the routine in [`Program::routines`].
    pub routine: usize,
    /// Place of the rung in its routine.
    pub rung: usize,
    /// Place of the element in its network.
    pub element: usize,
}

/// How a write changes a Boolean variable.
#[derive(Clone, Debug)]
pub enum WriteKind {
    /// A coil.
    Coil(CoilKind),
    /// A bit written through its word by a constant: 1 sets, 0 resets.
    Bit(bool),
    /// A bit copied from the same bit of another word.
    BitOf(AtomId),
    /// Written by a box; the value is unknown.
    Unknown(AtomId),
}

/// One write of a Boolean variable.
#[derive(Clone, Debug)]
pub struct Write {
    /// The variable.
    pub target: AtomId,
    /// How.
    pub kind: WriteKind,
    /// The power at the element, over what its contacts see.
    pub guard: Result<Function, Stop>,
    /// The condition under which the rung is solved at all; true for most.
    pub solved: Result<Function, Stop>,
    /// The condition of the master control zone around it; true for most.
    pub zone: Result<Function, Stop>,
    /// Where.
    pub place: Place,
    /// The bytes of the element.
    pub span: Span,
    /// Coils that stand as normally closed contacts before it.
    pub closed_contacts: BTreeSet<AtomId>,
    /// Where contacts of the variable before it see what an earlier write on
    /// the same rung has written: the guard with that in their place, over the
    /// value before the rung.
    pub effective: Option<Result<Function, Stop>>,
}

/// One write of a number.
#[derive(Clone, Debug)]
pub struct RegisterWrite {
    /// The variable.
    pub target: Name,
    /// What is written.
    pub value: Value,
    /// The power at the element, and that the rung is solved.
    pub guard: Result<Function, Stop>,
    /// Where.
    pub place: Place,
    /// The bytes of the element.
    pub span: Span,
}

/// What the walk over the program finds.
pub(super) struct Found {
    pub(super) writes: Vec<Write>,
    pub(super) timers: HashMap<AtomId, TimerLaw>,
    pub(super) register_writes: Vec<RegisterWrite>,
}

/// Walks `program` in the order of its scan and takes down every write.
pub(super) fn collect(program: &Program, walk: &mut Walk<'_>) -> Found {
    let execution = flow::execution(program);
    let mut collector = Collector {
        program,
        events: Vec::new(),
        timers: HashMap::new(),
    };
    collector.order(&execution.scan, walk);
    for (_, order) in &execution.definitions {
        collector.order(order, walk);
    }
    for &routine in &execution.unreachable {
        collector.unreachable(routine, walk);
    }
    let (writes, register_writes) = resolved(collector.events, walk);
    Found {
        writes,
        timers: collector.timers,
        register_writes,
    }
}

/// What an element does, before words and their bits are told apart: which
/// bits of a word matter is known only when all rungs have been seen.
pub(super) enum Effect {
    Coil(AtomId, CoilKind),
    Assign(Assignment),
    Unknown { target: Name, by: Name },
}

/// An effect, and when it happens.
pub(super) struct Event {
    pub(super) effect: Effect,
    pub(super) guard: Result<Function, Stop>,
    solved: Result<Function, Stop>,
    pub(super) zone: Result<Function, Stop>,
    pub(super) place: Place,
    span: Span,
    closed_contacts: BTreeSet<AtomId>,
    pub(super) effective: Option<Result<Function, Stop>>,
}

/// What decides whether a visit is solved, as conditions.
#[derive(Clone)]
struct Circumstances {
    solved: Result<Function, Stop>,
    zone: Result<Function, Stop>,
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
    events: Vec<Event>,
    timers: HashMap<AtomId, TimerLaw>,
}

impl Collector<'_> {
    fn order(&mut self, order: &flow::Order, walk: &mut Walk<'_>) {
        // Power at the calls, jumps, returns and zones of earlier visits.
        let mut steering: HashMap<(usize, NodeIndex), Result<Function, Stop>> = HashMap::new();
        let mut known = HashMap::from([(flow::GuardSet::NONE, Circumstances::always())]);
        let mut solving: Option<Solving<'_>> = None;
        for (at, visit) in order.visits.iter().enumerate() {
            if walk.budget.cancel.is_cancelled() {
                return;
            }
            let routine = self.program.routines.get(visit.routine);
            let Some(rung) = routine.and_then(|routine| routine.rungs.get(visit.rung)) else {
                continue;
            };
            let circumstances = circumstances(order, visit.guards, &steering, &mut known, walk);
            let here = (visit.routine, visit.rung);
            let solving = match &mut solving {
                Some(solving) if solving.place == here && visit.elements.start > 0 => solving,
                other => other.insert(Solving::new(here, rung, walk)),
            };
            for element in visit.elements.clone().map(NodeIndex::new) {
                if element.index() >= rung.network.len() {
                    break;
                }
                let kind = &rung.network.element(element).kind;
                if steers(kind) {
                    let power = solving.powers.at(element).cloned();
                    let there = steered(kind, &power, &circumstances, walk);
                    steering.insert((at, element), there);
                }
            }
            self.visit(solving, visit.elements.clone(), &circumstances, walk);
        }
    }

    /// Rungs that nothing leads to: shown, but they never write.
    fn unreachable(&mut self, routine: usize, walk: &mut Walk<'_>) {
        let circumstances = Circumstances {
            solved: Ok(Function::constant(false)),
            zone: Ok(Function::constant(true)),
        };
        for (at, rung) in self.program.routines[routine].rungs.iter().enumerate() {
            let mut solving = Solving::new((routine, at), rung, walk);
            let all = 0..rung.network.len();
            self.visit(&mut solving, all, &circumstances, walk);
        }
    }

    fn visit(
        &mut self,
        solving: &mut Solving<'_>,
        elements: std::ops::Range<usize>,
        circumstances: &Circumstances,
        walk: &mut Walk<'_>,
    ) {
        let (routine, at) = solving.place;
        let network = &solving.rung.network;
        for element in elements.map(NodeIndex::new) {
            if element.index() >= network.len() {
                break;
            }
            let node = network.element(element);
            for effect in effects(&node.kind, walk) {
                let upstream = upstream(network, element, &effect, walk);
                let seen = (upstream.target)
                    .map(|target| solving.seen(target, &upstream.contacts))
                    .filter(|seen| !seen.is_empty());
                let effective = seen.map(|seen| {
                    let powers = powers_seeing(&seen, network, walk);
                    guard_of(&effect, &powers, element, walk)
                });
                let event = Event {
                    guard: guard_of(&effect, &solving.powers, element, walk),
                    effect,
                    solved: circumstances.solved.clone(),
                    zone: circumstances.zone.clone(),
                    place: Place {
                        routine,
                        rung: at,
                        element: element.index(),
                    },
                    span: solving.rung.place(node.within),
                    closed_contacts: upstream.closed_contacts,
                    effective,
                };
                solving.add(&event, walk);
                self.events.push(event);
            }
            self.timer(&node.kind, &solving.powers, element, circumstances, walk);
        }
    }

    fn timer(
        &mut self,
        kind: &ElementKind,
        powers: &Powers,
        element: NodeIndex,
        circumstances: &Circumstances,
        walk: &mut Walk<'_>,
    ) {
        let ElementKind::Timer(timer) = kind else {
            return;
        };
        let input = powers.at(element).cloned();
        let input = conjoined(&[&input, &circumstances.zone], walk);
        let output = walk.atoms.add_variable(&timer.output);
        let law = TimerLaw {
            kind: timer.kind,
            input,
        };
        match self.timers.entry(output) {
            std::collections::hash_map::Entry::Vacant(free) => {
                free.insert(law);
            }
            // Run from several rungs: no law of one of them holds.
            std::collections::hash_map::Entry::Occupied(mut taken) => {
                taken.get_mut().input = Ok(Function::constant(true));
            }
        }
    }
}

fn steers(kind: &ElementKind) -> bool {
    matches!(
        kind,
        ElementKind::Call(_)
            | ElementKind::Jump(_)
            | ElementKind::Return { .. }
            | ElementKind::Zone
    )
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
        return conjoined(&[power, solved, &circumstances.zone], walk);
    }
    let power = conjoined(&[power, &circumstances.zone], walk)?;
    power.or(&solved.clone()?.not(), walk.budget)
}

fn conjoined(parts: &[&Result<Function, Stop>], walk: &Walk<'_>) -> Result<Function, Stop> {
    parts
        .iter()
        .try_fold(Function::constant(true), |all, part| {
            all.and(part.as_ref().map_err(|stop| *stop)?, walk.budget)
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
                solved: conjoined(&[&outer.solved, &power], walk),
                ..outer
            }
        }
        flow::Guard::Zone { begin } => Circumstances {
            zone: conjoined(&[&outer.zone, &power(begin)], walk),
            ..outer
        },
        flow::Guard::Repeated { rung, .. } => {
            // How often it is solved is unknown: an atom of its own says so.
            let atom = walk
                .atoms
                .add_variable(&format!("repeated by rung {rung}").into());
            walk.opaque.insert(atom);
            Circumstances {
                solved: conjoined(&[&outer.solved, &Ok(Function::atom(atom))], walk),
                ..outer
            }
        }
    }
}

/// What an element writes.
fn effects(kind: &ElementKind, walk: &mut Walk<'_>) -> Vec<Effect> {
    match kind {
        ElementKind::Coil(coil) => {
            let atom = walk.atoms.add_variable(&coil.operand.name);
            vec![Effect::Coil(atom, coil.kind)]
        }
        ElementKind::Assign(assignment) => vec![Effect::Assign(assignment.clone())],
        ElementKind::Block(block) => block
            .pins
            .iter()
            .filter(|pin| pin.direction == PinDirection::Output)
            .filter_map(|pin| pin.operand.as_ref())
            .map(|operand| Effect::Unknown {
                target: operand.name.clone(),
                by: block.name.clone(),
            })
            .collect(),
        _ => Vec::new(),
    }
}

/// The power at an element; for a coil that writes an edge, the edge of it.
fn guard_of(
    effect: &Effect,
    powers: &Powers,
    element: NodeIndex,
    walk: &mut Walk<'_>,
) -> Result<Function, Stop> {
    let power = powers.at(element).cloned();
    match effect {
        Effect::Coil(_, CoilKind::Rising) => edge_of(&power?, Edge::Rising, walk),
        Effect::Coil(_, CoilKind::Falling) => edge_of(&power?, Edge::Falling, walk),
        _ => power,
    }
}

/// What stands before an element.
struct Upstream {
    /// The Boolean variable that the element writes, if it is a coil.
    target: Option<AtomId>,
    /// Contacts that let power pass by that variable's value.
    contacts: Vec<NodeIndex>,
    /// Variables of normally closed contacts.
    closed_contacts: BTreeSet<AtomId>,
}

fn upstream(
    network: &Network,
    element: NodeIndex,
    effect: &Effect,
    walk: &mut Walk<'_>,
) -> Upstream {
    let Effect::Coil(target, _) = effect else {
        return Upstream {
            target: None,
            contacts: Vec::new(),
            closed_contacts: BTreeSet::new(),
        };
    };
    let mut contacts = Vec::new();
    let mut closed_contacts = BTreeSet::new();
    let backwards = Reversed(network.graph());
    let mut search = Dfs::new(backwards, element);
    while let Some(at) = search.next(backwards) {
        let ElementKind::Contact(contact) = &network.element(at).kind else {
            continue;
        };
        let atom = walk.atoms.add_variable(&contact.operand.name);
        let by_value = matches!(contact.kind, ContactKind::Open | ContactKind::Closed);
        if atom == *target && by_value {
            contacts.push(at);
        }
        if contact.kind == ContactKind::Closed {
            closed_contacts.insert(atom);
        }
    }
    Upstream {
        target: Some(*target),
        contacts,
        closed_contacts,
    }
}

/// Tells words and bits apart: a write of a whole word is one of each of its
/// bits that a contact or coil of the program names, and, as a number, one of
/// the word.
fn resolved(events: Vec<Event>, walk: &mut Walk<'_>) -> (Vec<Write>, Vec<RegisterWrite>) {
    let bits = bits_of_words(walk);
    let mut writes = Vec::new();
    let mut register_writes = Vec::new();
    for event in events {
        match event.effect {
            Effect::Coil(target, kind) => {
                writes.push(write(&event, target, WriteKind::Coil(kind)));
            }
            Effect::Assign(ref assignment) => {
                let name = &assignment.target.name;
                for (bit, atom) in bits.get(name).into_iter().flatten() {
                    let kind = written_bit(&assignment.value, name, *bit, walk);
                    writes.push(write(&event, *atom, kind));
                }
                if let Some(atom) = walk.atoms.find_variable(name) {
                    let kind = written_whole(&assignment.value, name, walk);
                    writes.push(write(&event, atom, kind));
                }
                register_writes.push(RegisterWrite {
                    target: name.clone(),
                    value: assignment.value.clone(),
                    guard: conjoined(&[&event.guard, &event.solved, &event.zone], walk),
                    place: event.place,
                    span: event.span,
                });
            }
            Effect::Unknown { ref target, ref by } => {
                let targets: Vec<AtomId> = bits
                    .get(target)
                    .into_iter()
                    .flatten()
                    .map(|(_, atom)| *atom)
                    .chain(walk.atoms.find_variable(target))
                    .collect();
                for atom in targets {
                    let unknown = unknown_value(by, target, walk);
                    writes.push(write(&event, atom, WriteKind::Unknown(unknown)));
                }
            }
        }
    }
    (writes, register_writes)
}

fn write(event: &Event, target: AtomId, kind: WriteKind) -> Write {
    Write {
        target,
        kind,
        guard: event.guard.clone(),
        solved: event.solved.clone(),
        zone: event.zone.clone(),
        place: event.place,
        span: event.span,
        closed_contacts: event.closed_contacts.clone(),
        effective: event.effective.clone(),
    }
}

/// The bits that the program names, by their word: `W.3` is bit 3 of `W`.
fn bits_of_words(walk: &Walk<'_>) -> HashMap<Name, Vec<(u32, AtomId)>> {
    let mut bits: HashMap<Name, Vec<(u32, AtomId)>> = HashMap::new();
    for (atom, it) in walk.atoms.iter() {
        let Atom::Variable(name) = it else { continue };
        if let Some((word, bit)) = name.rsplit_once('.')
            && let Ok(bit) = bit.parse()
        {
            bits.entry(word.into()).or_default().push((bit, atom));
        }
    }
    bits
}

fn written_bit(value: &Value, word: &Name, bit: u32, walk: &mut Walk<'_>) -> WriteKind {
    match value {
        Value::Constant(number) => {
            // Bits beyond 63 repeat the sign, as in a longer two's complement.
            WriteKind::Bit(number >> bit.min(63) & 1 == 1)
        }
        Value::Copy(source) => {
            let source = format!("{}.{bit}", source.name).into();
            WriteKind::BitOf(walk.atoms.add_variable(&source))
        }
        Value::Increment(_) | Value::Term { .. } => {
            WriteKind::Unknown(unknown_value(&"value".into(), word, walk))
        }
    }
}

fn written_whole(value: &Value, target: &Name, walk: &mut Walk<'_>) -> WriteKind {
    match value {
        Value::Constant(number) => WriteKind::Bit(*number != 0),
        Value::Copy(source) => WriteKind::BitOf(walk.atoms.add_variable(&source.name)),
        Value::Increment(_) | Value::Term { .. } => {
            WriteKind::Unknown(unknown_value(&"value".into(), target, walk))
        }
    }
}

/// An atom for a value that is not understood.
fn unknown_value(by: &Name, target: &Name, walk: &mut Walk<'_>) -> AtomId {
    let atom = walk.atoms.add_variable(&format!("{by}({target})").into());
    walk.opaque.insert(atom);
    atom
}
