//! A rung with several legs: what a leg sees of what those above it wrote.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use ladder::{ContactKind, ElementKind, Network};
use logic::{AtomId, Function, Name, Stop};
use petgraph::graph::NodeIndex;
use petgraph::visit::{Dfs, Reversed};

use super::fold;
use super::power::{Seen, powers_seeing};
use super::rung::{self, Effect, Event};
use super::{Powers, Walk, WriteKind, powers};

/// A rung while it is solved.
pub(super) struct Solving {
    /// The power everywhere, over what contacts see.
    pub(super) powers: Powers,
    /// The same over what was before the rung.
    since: Powers,
    /// Variables that several of its coils write, and what has been written
    /// so far.
    rewritten: HashMap<AtomId, Vec<Written>>,
    /// Variables that contacts see before and after a coil writes them, their
    /// contacts, and what has been written so far, over what was before the
    /// rung.
    changing: HashMap<AtomId, (Vec<NodeIndex>, Vec<Written>)>,
}

/// A coil that was solved, and the value of its variable after it, over the
/// value before the rung.
type Written = (NodeIndex, Result<Function, Stop>);

impl Solving {
    pub(super) fn new(network: &Network, walk: &mut Walk<'_>) -> Self {
        let powers = powers(network, walk);
        let changing = changing(network).into_iter();
        Self {
            since: powers.clone(),
            powers,
            rewritten: rewritten(network, walk),
            changing: changing
                .map(|(name, contacts)| (walk.atoms.add_variable(name), (contacts, Vec::new())))
                .collect(),
        }
    }

    /// Whether what a coil has written is seen on the rung.
    pub(super) fn rewrites(&self) -> bool {
        !self.rewritten.is_empty() || !self.changing.is_empty()
    }

    /// What the contacts at `places` see of `target` where an earlier coil has
    /// written it.
    pub(super) fn seen(&self, target: AtomId, contacts: &[NodeIndex]) -> Seen {
        let writes = self.rewritten.get(&target).map_or(&[][..], Vec::as_slice);
        seen(writes, contacts)
    }

    /// The powers over what was before the rung, if contacts before the element
    /// see one variable at different moments: of what contacts see its
    /// conditions could not speak. A coil's `own` variable does not count and is
    /// as its contacts see it, since [`seen`](Self::seen) tells what that is;
    /// `whole` are the powers in which it is not.
    pub(super) fn since(
        &self,
        network: &Network,
        element: NodeIndex,
        own: Option<AtomId>,
        walk: &mut Walk<'_>,
    ) -> Option<Since<'_>> {
        if self.changing.is_empty() || !sees_several_moments(network, element) {
            return None;
        }
        let seen = self.changed(own);
        Some(Since {
            powers: powers_seeing(&seen, network, walk),
            whole: &self.since,
        })
    }

    /// What contacts see of changing variables, but of `own`.
    fn changed(&self, own: Option<AtomId>) -> Seen {
        let others = self.changing.iter().filter(|(of, _)| Some(**of) != own);
        others
            .flat_map(|(_, (contacts, writes))| seen(writes, contacts))
            .collect()
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
        let kind = WriteKind::Coil(kind);
        let element = NodeIndex::new(event.element);
        if let Some(writes) = self.rewritten.get_mut(&target) {
            let guard = event.effective.as_ref().unwrap_or(&event.guard).clone();
            // The power of the zone was there before the rung, so that in it
            // the variable has the value of another moment.
            let zone = zone
                .clone()
                .and_then(|zone| zone.substitute(target, &fold::at_start(), walk.budget));
            let value = written(target, &kind, guard, zone, writes, walk);
            writes.push((element, value));
        }
        if let Some((_, writes)) = self.changing.get_mut(&target) {
            let guard = rung::guard_of(&event.effect, &self.since, element, walk);
            // Only the variable itself knows what it was at the start.
            let zone = zone.clone().and_then(|zone| match zone.depends_on(target) {
                true => Err(Stop::TooLarge),
                false => Ok(zone),
            });
            let value = written(target, &kind, guard, zone, writes, walk);
            writes.push((element, value));
            self.since = powers_seeing(&self.changed(None), network, walk);
        }
    }
}

/// The powers of a rung over what was before it.
pub(super) struct Since<'s> {
    /// But for the variable of one coil.
    pub(super) powers: Powers,
    /// That variable, too.
    pub(super) whole: &'s Powers,
}

/// The value of a variable after one more write.
fn written(
    target: AtomId,
    kind: &WriteKind,
    guard: Result<Function, Stop>,
    zone: Result<Function, Stop>,
    writes: &[Written],
    walk: &Walk<'_>,
) -> Result<Function, Stop> {
    let before = writes.last().map(|(_, value)| value.clone());
    let before = before.unwrap_or(Ok(Function::atom(target)));
    fold::apply(kind, &guard?, &zone?, &before?, walk.budget)
}

/// What contacts see where an earlier coil has written their variable.
fn seen(writes: &[Written], contacts: &[NodeIndex]) -> Seen {
    let last_before = |contact: NodeIndex| {
        let before = writes.iter().rev().find(|(element, _)| *element < contact);
        before.map(|(_, value)| (contact, value.clone()))
    };
    contacts.iter().copied().filter_map(last_before).collect()
}

/// The contacts of each variable of which some see another value than others,
/// since a coil between them writes it.
pub(crate) fn changing(network: &Network) -> BTreeMap<&Name, Vec<NodeIndex>> {
    let all = network.elements().map(|(at, _)| at);
    let mut contacts = moments(network, all);
    contacts.retain(|_, seen| seen.iter().any(|(_, before)| *before != seen[0].1));
    let places = |seen: Vec<(NodeIndex, usize)>| seen.into_iter().map(|(at, _)| at).collect();
    let all = contacts.into_iter();
    all.map(|(name, seen)| (name, places(seen))).collect()
}

/// Whether contacts that lead to an element see one variable at different
/// moments, and not the one that it writes if it is a coil.
pub(crate) fn sees_several_moments(network: &Network, element: NodeIndex) -> bool {
    let own = match &network.element(element).kind {
        ElementKind::Coil(coil) => Some(&coil.operand.name),
        _ => None,
    };
    let contacts = moments(network, leading_to(network, element).into_iter());
    let mut others = contacts.iter().filter(|(name, _)| Some(**name) != own);
    others.any(|(_, seen)| seen.iter().any(|(_, before)| *before != seen[0].1))
}

/// The elements that lead to one, in their order.
pub(crate) fn leading_to(network: &Network, element: NodeIndex) -> BTreeSet<NodeIndex> {
    let backwards = Reversed(network.graph());
    let mut search = Dfs::new(backwards, element);
    let mut found = BTreeSet::new();
    while let Some(at) = search.next(backwards) {
        found.insert(at);
    }
    found
}

/// The contacts among `places` that see values, by their variables, each with
/// how many coils have written the variable before it.
fn moments(
    network: &Network,
    places: impl Iterator<Item = NodeIndex>,
) -> BTreeMap<&Name, Vec<(NodeIndex, usize)>> {
    let mut coils: BTreeMap<&Name, Vec<NodeIndex>> = BTreeMap::new();
    for (at, element) in network.elements() {
        if let ElementKind::Coil(coil) = &element.kind {
            coils.entry(&coil.operand.name).or_default().push(at);
        }
    }
    let mut contacts: BTreeMap<&Name, Vec<(NodeIndex, usize)>> = BTreeMap::new();
    for at in places {
        if let ElementKind::Contact(contact) = &network.element(at).kind
            && matches!(contact.kind, ContactKind::Open | ContactKind::Closed)
            && let Some(coils) = coils.get(&contact.operand.name)
        {
            let before = coils.partition_point(|coil| *coil < at);
            let known = contacts.entry(&contact.operand.name).or_default();
            known.push((at, before));
        }
    }
    contacts
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
