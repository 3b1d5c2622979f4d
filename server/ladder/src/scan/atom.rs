//! Names for atoms that no operand names: output pins, boxes without an
//! instance, and the memories of edges.

use logic::Name;
use petgraph::graph::{EdgeIndex, NodeIndex};

use crate::{Block, ElementKind, Network, Operand, PinDirection};

/// The atom at an output pin of a box: the declared output of a timer or
/// counter for `Q` and its like, else `instance.pin`, or the pin of
/// [`own_atom`] where there is no instance.
pub fn pin_atom(network: &Network, at: NodeIndex, pin: &str) -> Name {
    let of = |instance: &Operand| format!("{}.{pin}", instance.name).into();
    match &network.element(at).kind {
        ElementKind::Timer(timer) if is_output(pin) => timer.output.clone(),
        ElementKind::Timer(timer) => of(&timer.instance),
        ElementKind::Counter(counter) if is_output(pin) => counter.output.clone(),
        ElementKind::Counter(counter) => of(&counter.instance),
        ElementKind::Block(Block {
            instance: Some(instance),
            ..
        }) => of(instance),
        _ => format!("{}.{pin}", own_atom(network, at)).into(),
    }
}

fn is_output(pin: &str) -> bool {
    matches!(pin, "" | "Q" | "DN")
}

/// The atom that says whether a box passes power on which decides so itself:
/// `instance.ENO`, or without an instance its name and inputs, `LIM(0,x,9)`.
/// Where an input comes by wire the place is added, since two such boxes need
/// not agree.
pub fn own_atom(network: &Network, at: NodeIndex) -> Name {
    let element = network.element(at);
    let ElementKind::Block(block) = &element.kind else {
        return format!("element@{}", network.mark(at)).into();
    };
    if let Some(instance) = &block.instance {
        return format!("{}.ENO", instance.name).into();
    }
    let inputs: Vec<&str> = block
        .pins
        .iter()
        .filter(|pin| pin.direction != PinDirection::Output)
        .map(|pin| pin.operand.as_ref().map_or("_", |operand| &operand.name))
        .collect();
    let mut name = format!("{}({})", block.name, inputs.join(","));
    if block.is_nameless() {
        name.push_str(&format!("@{}", network.mark(at)));
    }
    name.into()
}

/// The bit that a one shot compares with: its memory's operand, or a bit of
/// its own, unlike any other of the network.
pub fn memory_atom(network: &Network, at: NodeIndex) -> Name {
    let element = network.element(at);
    match &element.kind {
        ElementKind::OneShot(shot) => shot.memory.as_ref().map(|memory| memory.name.clone()),
        _ => None,
    }
    .unwrap_or_else(|| format!("memory@{}", network.mark(at)).into())
}

/// The bit that an edge pin at the end of a wire compares with, unlike any
/// other of the network.
pub fn wire_memory_atom(network: &Network, wire: EdgeIndex) -> Name {
    let ends = network.graph().edge_endpoints(wire);
    let place = |at: NodeIndex| network.mark(at);
    match ends {
        Some((from, to)) => format!("edge@{}-{}", place(from), place(to)).into(),
        None => "edge".into(),
    }
}
