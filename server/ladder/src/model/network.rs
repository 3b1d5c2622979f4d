use std::sync::Arc;

use logic::Name;
use petgraph::Direction;
use petgraph::graph::{DiGraph, NodeIndex};
use petgraph::visit::EdgeRef;
use source::Span;

use super::{Element, ElementKind, Within};

/// Where a wire leaves or arrives at an element.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Default)]
pub enum Port {
    /// The power flow itself: a contact's two ends, a box's `EN` and `ENO`.
    #[default]
    Power,
    /// A named pin of a box.
    Pin(Name),
}

/// A connection from one element to another.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Default)]
pub struct Wire {
    /// Where it leaves its source.
    pub from: Port,
    /// Where it arrives.
    pub to: Port,
    /// Whether it hands over the complement (a negated pin).
    pub negated: bool,
    /// Whether it hands over an edge only (an edge pin).
    pub edge: Option<super::Edge>,
}

/// The power flow of a rung: elements joined by wires, from the left rail on.
///
/// The graph is acyclic and its node order is the order of solving: left to
/// right, top leg first. Several wires that arrive at one port are a parallel
/// connection: the port is on when any of them is. So contacts in series are a
/// chain, and branches need no node of their own.
///
/// A network does not know where it stands: its places count from the origin
/// of its rung. Two rungs that were read from equal texts with equal
/// surroundings have equal networks, and a network that is found again after
/// an edit is the same value ([`Arc::ptr_eq`]). All that can be computed from a
/// network alone, the names of its atoms included, is then the same too.
#[derive(Clone, Debug)]
pub struct Network {
    graph: DiGraph<Element, Wire>,
    /// The origin, if some atom is called after its place in the file: then
    /// networks at different places are different.
    named_from: Option<u32>,
}

impl PartialEq for Network {
    fn eq(&self, other: &Self) -> bool {
        fn wires(it: &Network) -> impl Iterator<Item = impl PartialEq + '_> + '_ {
            let wires = it.graph.edge_indices();
            wires.map(move |at| (it.graph.edge_endpoints(at), it.graph.edge_weight(at)))
        }
        self.named_from == other.named_from
            && self.graph.node_weights().eq(other.graph.node_weights())
            && wires(self).eq(wires(other))
    }
}

impl Network {
    /// The left rail, the first element of every network.
    pub fn rail() -> NodeIndex {
        NodeIndex::new(0)
    }

    /// Elements in the order of solving, the rail first.
    pub fn elements(&self) -> impl Iterator<Item = (NodeIndex, &Element)> {
        self.graph.node_indices().map(|at| (at, &self.graph[at]))
    }

    /// The element at a place of this network.
    pub fn element(&self, at: NodeIndex) -> &Element {
        &self.graph[at]
    }

    /// The wires that arrive at an element with the elements they leave from,
    /// in the order in which they were drawn.
    pub fn arriving(&self, at: NodeIndex) -> Vec<(NodeIndex, &Wire)> {
        let mut wires: Vec<_> = self
            .graph
            .edges_directed(at, Direction::Incoming)
            .map(|edge| (edge.id(), edge.source(), edge.weight()))
            .collect();
        wires.sort_by_key(|(id, ..)| *id);
        wires
            .into_iter()
            .map(|(_, from, wire)| (from, wire))
            .collect()
    }

    /// The wires that leave an element with the elements they lead to.
    pub fn leaving(&self, at: NodeIndex) -> Vec<(NodeIndex, &Wire)> {
        let mut wires: Vec<_> = self
            .graph
            .edges_directed(at, Direction::Outgoing)
            .map(|edge| (edge.id(), edge.target(), edge.weight()))
            .collect();
        wires.sort_by_key(|(id, ..)| *id);
        wires.into_iter().map(|(_, to, wire)| (to, wire)).collect()
    }

    /// Number of elements, the rail included.
    pub fn len(&self) -> usize {
        self.graph.node_count()
    }

    /// Whether there is nothing but the rail.
    pub fn is_empty(&self) -> bool {
        self.len() <= 1
    }

    /// The graph itself, for algorithms of petgraph.
    pub fn graph(&self) -> &DiGraph<Element, Wire> {
        &self.graph
    }

    /// The network of a rung whose origin is now this one.
    pub(super) fn at(network: &Arc<Self>, origin: u32) -> Arc<Self> {
        match network.named_from {
            None => network.clone(),
            Some(_) => Arc::new(Self {
                graph: network.graph.clone(),
                named_from: Some(origin),
            }),
        }
    }

    /// The first byte of an element, by which atoms without a name are told
    /// apart: counted from the start of the file where any atom of the network
    /// needs that.
    pub(crate) fn mark(&self, at: NodeIndex) -> u32 {
        let origin = self.named_from.unwrap_or_default();
        self.element(at).within.from(origin).start
    }
}

/// A network, and the byte of the file that its places count from.
#[derive(Clone, Debug, PartialEq)]
pub struct Placed {
    /// The network.
    pub network: Arc<Network>,
    pub(super) origin: u32,
}

/// Builds a network, element by element in the order of solving.
///
/// All spans that it is given, those of operands too, are places in the file.
#[derive(Clone, Debug)]
pub struct NetworkBuilder {
    graph: DiGraph<Element, Wire>,
}

impl NetworkBuilder {
    /// A network with nothing but the left rail, drawn at `span`.
    pub fn new(span: Span) -> Self {
        let mut graph = DiGraph::new();
        graph.add_node(Element {
            kind: ElementKind::Rail,
            within: Within::in_file(span),
        });
        Self { graph }
    }

    /// Adds an element, solved after all that were added before it.
    pub fn add(&mut self, kind: ElementKind, span: Span) -> NodeIndex {
        let within = Within::in_file(span);
        self.graph.add_node(Element { kind, within })
    }

    /// Adds an element in series after a parallel connection of `sources`.
    /// Without a source it never gets power.
    pub fn add_after(&mut self, sources: &[NodeIndex], kind: ElementKind, span: Span) -> NodeIndex {
        let element = self.add(kind, span);
        for source in sources {
            self.graph.add_edge(*source, element, Wire::default());
        }
        element
    }

    /// Joins two elements. A wire back to an element solved earlier, or to
    /// itself, would close a circle and is refused: then nothing is drawn and
    /// the answer is `false`.
    #[must_use = "a refused wire needs a diagnostic"]
    pub fn join(&mut self, from: NodeIndex, to: NodeIndex, wire: Wire) -> bool {
        if from >= to {
            return false;
        }
        self.graph.add_edge(from, to, wire);
        true
    }

    /// Number of elements so far.
    pub fn len(&self) -> usize {
        self.graph.node_count()
    }

    /// Whether there is nothing but the rail.
    pub fn is_empty(&self) -> bool {
        self.len() <= 1
    }

    /// The network, whose places now count from its first byte.
    pub fn finish(mut self) -> Placed {
        self.graph.shrink_to_fit();
        let mut origin = u32::MAX;
        self.each_place(|within| origin = origin.min(within.start()));
        self.each_place(|within| *within = within.counted_from(origin));
        let named_from = self.names_a_place().then_some(origin);
        let network = Network {
            graph: self.graph,
            named_from,
        };
        Placed {
            network: Arc::new(network),
            origin,
        }
    }

    fn each_place(&mut self, mut visit: impl FnMut(&mut Within)) {
        for element in self.graph.node_weights_mut() {
            visit(&mut element.within);
            let kind = &mut element.kind;
            kind.each_variable(|operand| visit(&mut operand.within));
            if let Some(operand) = kind.destination_mut() {
                visit(&mut operand.within);
            }
        }
    }

    /// Whether an atom of the network is called after its place.
    fn names_a_place(&self) -> bool {
        let shapes = |kind: &ElementKind| match kind {
            ElementKind::Block(block) => block.shapes_power && block.is_nameless(),
            _ => false,
        };
        let has_nameless_pins = |kind: &ElementKind| match kind {
            ElementKind::Timer(_) | ElementKind::Counter(_) => false,
            ElementKind::Block(block) => block.is_nameless(),
            _ => true,
        };
        let kind = |at: NodeIndex| &self.graph[at].kind;
        let mut wires = self.graph.edge_references();
        self.graph.node_weights().any(|it| shapes(&it.kind))
            || wires.any(|wire| {
                matches!(wire.weight().from, Port::Pin(_)) && has_nameless_pins(kind(wire.source()))
            })
    }
}
