//! Takes a network apart into conditions in series.
//!
//! A **cut** is a set of elements through which all power to some place flows.
//! Contacts in series are cuts one after the other; the legs of a parallel
//! connection together are one. [`Cuts::before`] finds the nearest cut before
//! a given one, and the condition between them. Where the legs of a network
//! are neatly nested each contact comes out once. A bridge between legs makes
//! the contacts before it come out once for each way across, so the size is
//! bounded.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use petgraph::graph::NodeIndex;

use super::part::{Part, always, complement, edge_of, element, never, parallel, series, variable};
use crate::scan::{own_atom, pin_atom};
use crate::{CounterKind, ElementKind, Gate, Network, Port, Wire};

/// A set of elements, the last solved first.
pub(super) type Cut = Vec<NodeIndex>;

/// Why a condition cannot be written: it would be too long, or nest too
/// deeply.
#[derive(Clone, Copy, Debug)]
pub(super) struct TooTangled;

/// Recursion ends here; the notation nests hardly deeper.
pub(super) const DEEPEST: usize = 100;

/// The cuts of a network that were found so far.
pub(super) struct Cuts<'n> {
    network: &'n Network,
    /// What feeds each element, outputs left out; `None` where a wire
    /// complements, takes an edge or comes from the pin of a box.
    feeds: Vec<Option<Cut>>,
    known: HashMap<Cut, (Cut, Part)>,
    /// How many more elements may be written.
    left: usize,
}

impl<'n> Cuts<'n> {
    /// Nothing is known about the network yet.
    pub(super) fn new(network: &'n Network) -> Self {
        let mut cuts = Self {
            network,
            feeds: Vec::with_capacity(network.len()),
            known: HashMap::new(),
            left: network.len() * 8 + 1000,
        };
        for (at, _) in network.elements() {
            let feed = cuts.feed_of(at);
            cuts.feeds.push(feed);
        }
        cuts
    }

    /// The cut that all power starts from.
    pub(super) fn rail() -> Cut {
        vec![Network::rail()]
    }

    /// What feeds an element, if that can be said without a complement.
    pub(super) fn feed(&self, at: NodeIndex) -> Option<&Cut> {
        self.feeds.get(at.index())?.as_ref()
    }

    /// The nearest cut before `cut`, which is not the rail, and the condition
    /// from there to `cut`.
    pub(super) fn before(&mut self, cut: &Cut, depth: usize) -> Result<(Cut, Part), TooTangled> {
        if let Some((before, part)) = self.known.get(cut) {
            let known = (before.clone(), part.clone());
            self.spend(known.1.size())?;
            return Ok(known);
        }
        if depth > DEEPEST {
            return Err(TooTangled);
        }
        // Follow the legs backwards, the one that was solved last first, until
        // they have all come to the same place.
        let mut legs: BTreeMap<Cut, Vec<(usize, Part)>> = BTreeMap::new();
        for source in cut {
            legs.insert(vec![*source], vec![(source.index(), always())]);
        }
        while let Some((place, mut parts)) = legs.pop_last() {
            parts.sort_by_key(|(order, _)| *order);
            let order = parts.first().map_or(0, |(order, _)| *order);
            let part = parallel(parts.into_iter().map(|(_, part)| part).collect());
            if part.nested > DEEPEST {
                return Err(TooTangled);
            }
            if legs.is_empty() && place != *cut {
                self.spend(part.size())?;
                self.known
                    .insert(cut.clone(), (place.clone(), part.clone()));
                return Ok((place, part));
            }
            self.spend(1)?;
            let (next, part) = match place.as_slice() {
                [only] => self.through(*only, part, depth)?,
                _ => {
                    let (next, before) = self.before(&place, depth + 1)?;
                    (next, series(before, part))
                }
            };
            if part.nested > DEEPEST {
                return Err(TooTangled);
            }
            legs.entry(next).or_default().push((order, part));
        }
        Err(TooTangled)
    }

    /// The condition from the rail to all ends of a network without outputs.
    pub(super) fn at_the_ends(&mut self) -> Result<Part, TooTangled> {
        let ends = self.network.elements().map(|(at, _)| at);
        let ends = ends.filter(|at| self.network.leaving(*at).is_empty());
        let cut = self.shapers(ends);
        self.whole(cut, 0)
    }

    /// The condition from the rail to what feeds an element.
    pub(super) fn input(&mut self, at: NodeIndex, depth: usize) -> Result<Part, TooTangled> {
        if depth > DEEPEST {
            return Err(TooTangled);
        }
        if let Some(cut) = self.feed(at).cloned() {
            return self.whole(cut, depth);
        }
        let mut all = always();
        for port in power_ports(self.network, at) {
            all = series(all, self.arriving(at, port.as_ref(), depth)?);
        }
        Ok(all)
    }

    fn whole(&mut self, mut cut: Cut, depth: usize) -> Result<Part, TooTangled> {
        let mut part = always();
        if cut.is_empty() {
            return Ok(never());
        }
        while cut != Self::rail() {
            let (before, condition) = self.before(&cut, depth + 1)?;
            part = series(condition, part);
            cut = before;
        }
        Ok(part)
    }

    /// Goes back over an element that `part` follows.
    fn through(
        &mut self,
        at: NodeIndex,
        part: Part,
        depth: usize,
    ) -> Result<(Cut, Part), TooTangled> {
        let own = match &self.network.element(at).kind {
            ElementKind::Contact(_) | ElementKind::Comparison(_) | ElementKind::Open => {
                let part = series(element(at), part);
                return match self.feed(at) {
                    Some(cut) if cut.is_empty() => Ok((Self::rail(), never())),
                    Some(cut) => Ok((cut.clone(), part)),
                    None => Ok((Self::rail(), series(self.input(at, depth + 1)?, part))),
                };
            }
            ElementKind::Invert => complement(self.input(at, depth + 1)?),
            ElementKind::OneShot(shot) => {
                let edge = shot.edge;
                edge_of(edge, self.input(at, depth + 1)?)
            }
            ElementKind::Gate(gate) => self.gate(*gate, at, depth + 1)?,
            ElementKind::Block(block) if block.shapes_power => variable(own_atom(self.network, at)),
            _ => self.input(at, depth + 1)?,
        };
        Ok((Self::rail(), series(own, part)))
    }

    fn gate(&mut self, gate: Gate, at: NodeIndex, depth: usize) -> Result<Part, TooTangled> {
        let mut ports: Vec<Port> = Vec::new();
        let mut seen = BTreeSet::new();
        for (_, wire) in self.network.arriving(at) {
            if seen.insert(port_name(&wire.to)) {
                ports.push(wire.to.clone());
            }
        }
        let mut inputs = Vec::new();
        for port in &ports {
            inputs.push(self.arriving(at, Some(port), depth)?);
        }
        Ok(match gate {
            Gate::And => inputs
                .into_iter()
                .rev()
                .fold(always(), |all, input| series(input, all)),
            Gate::Or => parallel(inputs),
            Gate::Xor => {
                let mut odd = never();
                for input in inputs {
                    self.spend(2 * (odd.size() + input.size()))?;
                    let only_odd = series(odd.clone(), complement(input.clone()));
                    let only_input = series(complement(odd), input);
                    odd = parallel(vec![only_odd, only_input]);
                }
                odd
            }
        })
    }

    /// The condition from the rail over all wires to one port, or to any.
    fn arriving(
        &mut self,
        at: NodeIndex,
        port: Option<&Port>,
        depth: usize,
    ) -> Result<Part, TooTangled> {
        let wires: Vec<(NodeIndex, Wire)> = self
            .network
            .arriving(at)
            .into_iter()
            .filter(|(_, wire)| port.is_none_or(|port| wire.to == *port))
            .map(|(from, wire)| (from, wire.clone()))
            .collect();
        let plain = wires.iter().all(|(from, wire)| self.is_plain(*from, wire));
        if plain {
            let cut = self.shapers(wires.iter().map(|(from, _)| *from));
            return self.whole(cut, depth);
        }
        let mut legs = Vec::new();
        for (from, wire) in wires {
            let mut part = match &wire.from {
                Port::Pin(pin) if is_box(&self.network.element(from).kind) => {
                    variable(pin_atom(self.network, from, pin))
                }
                _ => {
                    let cut = self.shapers(std::iter::once(from));
                    self.whole(cut, depth + 1)?
                }
            };
            if let Some(edge) = wire.edge {
                part = edge_of(edge, part);
            }
            legs.push(match wire.negated {
                true => complement(part),
                false => part,
            });
        }
        Ok(parallel(legs))
    }

    /// What feeds an element, if one port counts.
    fn feed_of(&self, at: NodeIndex) -> Option<Cut> {
        let ports = power_ports(self.network, at);
        let [port] = ports.as_slice() else {
            return None;
        };
        let wires: Vec<_> = self
            .network
            .arriving(at)
            .into_iter()
            .filter(|(_, wire)| port.as_ref().is_none_or(|port| wire.to == *port))
            .collect();
        let plain = wires.iter().all(|(from, wire)| self.is_plain(*from, wire));
        plain.then(|| self.shapers(wires.iter().map(|(from, _)| *from)))
    }

    /// Whether the wire hands over the power of its source as it is.
    fn is_plain(&self, from: NodeIndex, wire: &Wire) -> bool {
        let from_pin =
            matches!(wire.from, Port::Pin(_)) && is_box(&self.network.element(from).kind);
        !wire.negated && wire.edge.is_none() && !from_pin
    }

    /// The elements that decide the power of `sources`: outputs pass on what
    /// feeds them.
    fn shapers(&self, sources: impl Iterator<Item = NodeIndex>) -> Cut {
        let mut all = BTreeSet::new();
        for source in sources {
            match self.feed(source) {
                Some(feed) if passes(&self.network.element(source).kind) => all.extend(feed),
                _ => {
                    all.insert(source);
                }
            }
        }
        all.into_iter().rev().collect()
    }

    fn spend(&mut self, elements: usize) -> Result<(), TooTangled> {
        self.left = self.left.checked_sub(elements).ok_or(TooTangled)?;
        Ok(())
    }
}

/// The ports of an element that power must arrive at, `None` meaning any: for
/// a box its own input, `EN` or the like, and the power flow where both are
/// wired; for what is no box all wires count alike.
pub(super) fn power_ports(network: &Network, at: NodeIndex) -> Vec<Option<Port>> {
    let own = match &network.element(at).kind {
        ElementKind::Timer(_) => "IN",
        ElementKind::Counter(counter) if counter.kind == CounterKind::Down => "CD",
        ElementKind::Counter(_) => "CU",
        ElementKind::Block(_) => "EN",
        _ => return vec![None],
    };
    let wires = network.arriving(at);
    let is_wired = |port: &Port| wires.iter().any(|(_, wire)| wire.to == *port);
    let ports = [Port::Power, Port::Pin(own.into())];
    let wired: Vec<_> = ports.into_iter().filter(is_wired).map(Some).collect();
    if wired.is_empty() {
        return wires
            .first()
            .map(|(_, wire)| Some(wire.to.clone()))
            .into_iter()
            .collect();
    }
    wired
}

fn port_name(port: &Port) -> &str {
    match port {
        Port::Power => "",
        Port::Pin(name) => name,
    }
}

fn is_box(kind: &ElementKind) -> bool {
    matches!(
        kind,
        ElementKind::Timer(_) | ElementKind::Counter(_) | ElementKind::Block(_)
    )
}

/// Whether an element passes on the power that it gets.
fn passes(kind: &ElementKind) -> bool {
    match kind {
        ElementKind::Rail
        | ElementKind::Contact(_)
        | ElementKind::Comparison(_)
        | ElementKind::Invert
        | ElementKind::Open
        | ElementKind::OneShot(_)
        | ElementKind::Gate(_) => false,
        ElementKind::Block(block) => !block.shapes_power,
        _ => true,
    }
}

/// Whether an element is an output of the rung.
pub(super) fn is_output(kind: &ElementKind) -> bool {
    match kind {
        ElementKind::Block(_) => true,
        ElementKind::Label(_) => false,
        kind => passes(kind),
    }
}
