//! What one rung says by itself: everything about it that does not depend on
//! where it stands, when it is solved or what other rungs write.
//!
//! That is what is kept of an unchanged rung when the program around it is
//! edited.

use std::collections::{BTreeSet, HashSet};
use std::sync::Arc;

use ladder::{
    Assignment, CoilKind, ContactKind, Edge, ElementKind, Network, PinDirection, TimerKind,
};
use logic::{AtomId, Function, Name, Stop};
use petgraph::graph::NodeIndex;

use super::power::{edge_of, powers_seeing};
use super::solving::{Solving, leading_to};
use super::{Powers, Walk};

/// A rung, solved.
#[derive(Debug)]
pub(super) struct Solved {
    /// What its elements write, in their order.
    pub(super) events: Vec<Arc<Event>>,
    /// Its timers.
    pub(super) timers: Vec<Timed>,
    /// The power at the elements that call, jump, leave or begin a zone.
    pub(super) steering: Vec<(NodeIndex, Result<Function, Stop>)>,
    /// Atoms that stand for what an unknown box does.
    pub(super) opaque: HashSet<AtomId>,
    /// Every atom that it asks for, in the order of first asking.
    pub(super) atoms: Vec<AtomId>,
    /// Whether it depends on the zone around it: some of it sees what its
    /// coils did there.
    pub(super) rewrites: bool,
}

/// A timer of a rung.
#[derive(Debug)]
pub(super) struct Timed {
    pub(super) element: usize,
    pub(super) output: AtomId,
    pub(super) kind: TimerKind,
    /// The power at its input.
    pub(super) input: Result<Function, Stop>,
}

/// What an element does, before words and their bits are told apart: which
/// bits of a word matter is known only when all rungs have been seen.
#[derive(Debug)]
pub(super) enum Effect {
    Coil(AtomId, CoilKind),
    Assign(Assignment),
    Unknown { target: Name, by: Name },
}

/// An effect, and when it happens.
#[derive(Debug)]
pub(super) struct Event {
    pub(super) element: usize,
    pub(super) effect: Effect,
    pub(super) guard: Result<Function, Stop>,
    pub(super) closed_contacts: Arc<BTreeSet<AtomId>>,
    pub(super) effective: Option<Result<Function, Stop>>,
}

impl Solved {
    /// What its coils write.
    pub(super) fn targets(&self) -> impl Iterator<Item = AtomId> {
        self.events.iter().filter_map(|event| match event.effect {
            Effect::Coil(target, _) => Some(target),
            Effect::Assign(_) | Effect::Unknown { .. } => None,
        })
    }
}

/// Solves a rung in a zone that is on under the condition `zone`.
pub(super) fn solve(
    network: &Network,
    zone: &Result<Function, Stop>,
    walk: &mut Walk<'_>,
) -> Solved {
    walk.atoms.watch();
    let mut opaque = HashSet::new();
    let mut inner = Walk {
        atoms: walk.atoms,
        opaque: &mut opaque,
        budget: walk.budget,
    };
    let mut solved = solved(network, zone, &mut inner);
    let mut seen = HashSet::new();
    solved.atoms = walk.atoms.watched();
    solved.atoms.retain(|atom| seen.insert(*atom));
    solved.opaque = opaque;
    solved
}

fn solved(network: &Network, zone: &Result<Function, Stop>, walk: &mut Walk<'_>) -> Solved {
    let mut solving = Solving::new(network, walk);
    let mut found = Solved {
        events: Vec::new(),
        timers: Vec::new(),
        steering: Vec::new(),
        opaque: HashSet::new(),
        atoms: Vec::new(),
        rewrites: solving.rewrites(),
    };
    for (at, element) in network.elements() {
        for effect in effects(&element.kind, walk) {
            let event = event(at, effect, network, &solving, walk);
            solving.add(&event, network, zone, walk);
            found.events.push(event.into());
        }
        if !steers(&element.kind) && !matches!(element.kind, ElementKind::Timer(_)) {
            continue;
        }
        let power = match solving.since(network, at, None, walk) {
            Some(since) => since.whole.at(at).cloned(),
            None => solving.powers.at(at).cloned(),
        };
        if let ElementKind::Timer(timer) = &element.kind {
            found.timers.push(Timed {
                element: at.index(),
                output: walk.atoms.add_variable(&timer.output),
                kind: timer.kind,
                input: power.clone(),
            });
        }
        if steers(&element.kind) {
            found.steering.push((at, power));
        }
    }
    found
}

fn event(
    at: NodeIndex,
    effect: Effect,
    network: &Network,
    solving: &Solving,
    walk: &mut Walk<'_>,
) -> Event {
    let upstream = upstream(network, at, &effect, walk);
    let seen = upstream
        .target
        .map(|target| solving.seen(target, &upstream.contacts))
        .filter(|seen| !seen.is_empty());
    let since = solving.since(network, at, upstream.target, walk);
    let effective = seen.map(|seen| match &since {
        Some(since) => guard_of(&effect, since.whole, at, walk),
        None => {
            let powers = powers_seeing(&seen, network, walk);
            guard_of(&effect, &powers, at, walk)
        }
    });
    let powers = since.as_ref().map_or(&solving.powers, |it| &it.powers);
    Event {
        element: at.index(),
        guard: guard_of(&effect, powers, at, walk),
        effect,
        closed_contacts: Arc::new(upstream.closed_contacts),
        effective,
    }
}

/// Whether an element decides what is solved.
pub(super) fn steers(kind: &ElementKind) -> bool {
    matches!(
        kind,
        ElementKind::Call(_)
            | ElementKind::Jump(_)
            | ElementKind::Return { .. }
            | ElementKind::Zone
    )
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
pub(super) fn guard_of(
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
    for at in leading_to(network, element) {
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
