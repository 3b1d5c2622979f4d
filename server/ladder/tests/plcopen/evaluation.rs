//! A small evaluator of networks, apart from the crate's own, to compare with.
//!
//! It knows what a drawing of contacts, gates and inverters needs: enough for
//! Boolean functions, no time and no memory.

use std::collections::HashMap;

use ladder::{ContactKind, ElementKind, Gate, Network, Port};
use petgraph::visit::EdgeRef;

/// What the network's plain coils get while the variables have these values.
pub fn coils(network: &Network, value: &dyn Fn(&str) -> bool) -> HashMap<String, bool> {
    let graph = network.graph();
    let mut on: Vec<bool> = Vec::new();
    let mut written = HashMap::new();
    for at in graph.node_indices() {
        let mut ports: HashMap<Port, bool> = HashMap::new();
        for wire in graph.edges_directed(at, petgraph::Direction::Incoming) {
            assert!(!wire.weight().negated && wire.weight().edge.is_none());
            *ports.entry(wire.weight().to.clone()).or_default() |= on[wire.source().index()];
        }
        let power = ports.get(&Port::Power).copied().unwrap_or(false);
        let count = ports.values().filter(|on| **on).count();
        on.push(match &network.element(at).kind {
            ElementKind::Rail => true,
            ElementKind::Open => false,
            ElementKind::Invert => !power,
            ElementKind::Contact(contact) => {
                let state = value(&contact.operand.name);
                power
                    && match contact.kind {
                        ContactKind::Open => state,
                        ContactKind::Closed => !state,
                        other => panic!("{other:?} is no function"),
                    }
            }
            ElementKind::Gate(Gate::And) => count > 0 && count == ports.len(),
            ElementKind::Gate(Gate::Or) => count > 0,
            ElementKind::Gate(Gate::Xor) => count % 2 == 1,
            ElementKind::Coil(coil) => {
                written.insert(coil.operand.name.to_string(), power);
                power
            }
            other => panic!("{other:?} is not expected here"),
        });
    }
    written
}
