//! A rung with several legs: what a leg sees of what those above it wrote.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use ladder::{ContactKind, ElementKind, Network};
use logic::{AtomId, Function, Name, Stop};
use petgraph::graph::NodeIndex;

use super::fold;
use super::power::{Seen, powers_seeing};
use super::rung::{Effect, Event};
use super::{Powers, Walk, WriteKind, powers};

/// A rung while it is solved.
pub(super) struct Solving {
    pub(super) powers: Powers,
    /// Variables that several of its coils write, and those that its contacts
    /// see before and after a coil writes them; and what has been written so
    /// far.
    rewritten: HashMap<AtomId, Vec<Written>>,
    /// The contacts of variables that contacts see before and after a coil
    /// writes them.
    changing: HashMap<AtomId, Vec<NodeIndex>>,
}

/// A coil that was solved, and the value of its variable after it, over the
/// value before the rung.
type Written = (NodeIndex, Result<Function, Stop>);

impl Solving {
    pub(super) fn new(network: &Network, walk: &mut Walk<'_>) -> Self {
        let mut rewritten = rewritten(network, walk);
        let changing: HashMap<AtomId, Vec<NodeIndex>> = changing(network)
            .into_iter()
            .map(|(name, contacts)| (walk.atoms.add_variable(name), contacts))
            .collect();
        for target in changing.keys() {
            rewritten.entry(*target).or_default();
        }
        Self {
            powers: powers(network, walk),
            rewritten,
            changing,
        }
    }

    /// Whether what a coil has written is seen on the rung.
    pub(super) fn rewrites(&self) -> bool {
        !self.rewritten.is_empty()
    }

    /// What the contacts at `places` see of `target` where an earlier coil has
    /// written it.
    pub(super) fn seen(&self, target: AtomId, contacts: &[NodeIndex]) -> Seen {
        let writes = self.rewritten.get(&target).map_or(&[][..], Vec::as_slice);
        let last_before = |contact: NodeIndex| {
            let before = writes.iter().rev().find(|(element, _)| *element < contact);
            before.map(|(_, value)| (contact, value.clone()))
        };
        contacts.iter().copied().filter_map(last_before).collect()
    }

    /// Takes down what a coil has written, in a zone that is on under the
    /// condition `zone`.
    pub(super) fn add(
        &mut self,
        event: &Event,
        network: &Network,
        zone: &Result<Function, Stop>,
        walk: &mut Walk<'_>,
    ) {
        let Effect::Coil(target, kind) = event.effect else {
            return;
        };
        let Some(writes) = self.rewritten.get_mut(&target) else {
            return;
        };
        let before = writes.last().map(|(_, value)| value.clone());
        let before = before.unwrap_or(Ok(Function::atom(target)));
        let guard = event.effective.as_ref().unwrap_or(&event.guard).clone();
        // The power of the zone was there before the rung, so that in it the
        // variable has the value of another moment.
        let zone = zone
            .clone()
            .and_then(|zone| zone.substitute(target, &fold::at_start(), walk.budget));
        let kind = WriteKind::Coil(kind);
        let value =
            before.and_then(|before| fold::apply(&kind, &guard?, &zone?, &before, walk.budget));
        writes.push((NodeIndex::new(event.element), value));
        if self.changing.contains_key(&target) {
            self.powers = powers_seeing(&self.changed(), network, walk);
        }
    }

    /// What contacts see of variables of which others, before a coil, see
    /// something else.
    pub(super) fn changed(&self) -> Seen {
        let all = self.changing.iter();
        let all = all.flat_map(|(of, contacts)| self.seen(*of, contacts));
        all.map(|(contact, value)| {
            // Only the variable itself knows what it was at the start.
            let known = value.and_then(|value| match value.depends_on(fold::AT_START) {
                true => Err(Stop::TooLarge),
                false => Ok(value),
            });
            (contact, known)
        })
        .collect()
    }
}

/// The contacts of each variable of which some see another value than others,
/// since a coil between them writes it.
fn changing(network: &Network) -> BTreeMap<&Name, Vec<NodeIndex>> {
    let mut writes: BTreeMap<&Name, usize> = BTreeMap::new();
    let mut contacts: BTreeMap<&Name, Vec<(NodeIndex, usize)>> = BTreeMap::new();
    for (at, element) in network.elements() {
        match &element.kind {
            ElementKind::Coil(coil) => *writes.entry(&coil.operand.name).or_default() += 1,
            ElementKind::Contact(contact)
                if matches!(contact.kind, ContactKind::Open | ContactKind::Closed) =>
            {
                let name = &contact.operand.name;
                let before = writes.get(name).copied().unwrap_or(0);
                contacts.entry(name).or_default().push((at, before));
            }
            _ => {}
        }
    }
    contacts.retain(|_, seen| seen.iter().any(|(_, before)| *before != seen[0].1));
    let places = |seen: Vec<(NodeIndex, usize)>| seen.into_iter().map(|(at, _)| at).collect();
    let all = contacts.into_iter();
    all.map(|(name, seen)| (name, places(seen))).collect()
}

/// The variables that several coils of a network write.
fn rewritten(network: &Network, walk: &mut Walk<'_>) -> HashMap<AtomId, Vec<Written>> {
    let mut once = BTreeSet::new();
    let mut rewritten = HashMap::new();
    for (_, element) in network.elements() {
        if let ElementKind::Coil(coil) = &element.kind
            && let target = walk.atoms.add_variable(&coil.operand.name)
            && !once.insert(target)
        {
            rewritten.insert(target, Vec::new());
        }
    }
    rewritten
}
