//! A rung with several legs: what a leg sees of what those above it wrote.

use std::collections::{BTreeSet, HashMap};

use ladder::{ElementKind, Network};
use logic::{AtomId, Function, Stop};
use petgraph::graph::NodeIndex;

use super::fold;
use super::power::Seen;
use super::rung::{Effect, Event};
use super::{Powers, Walk, WriteKind, powers};

/// A rung while it is solved.
pub(super) struct Solving {
    pub(super) powers: Powers,
    /// Variables that several of its coils write, and what has been written
    /// so far.
    rewritten: HashMap<AtomId, Vec<Written>>,
}

/// A coil that was solved, and the value of its variable after it, over the
/// value before the rung.
type Written = (NodeIndex, Result<Function, Stop>);

impl Solving {
    pub(super) fn new(network: &Network, walk: &mut Walk<'_>) -> Self {
        Self {
            powers: powers(network, walk),
            rewritten: rewritten(network, walk),
        }
    }

    /// Whether several coils of the rung write the same variable.
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
    pub(super) fn add(&mut self, event: &Event, zone: &Result<Function, Stop>, walk: &Walk<'_>) {
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
    }
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
