//! All states that can be reached, as a decision diagram (Burch, Clarke,
//! McMillan, Dill, Hwang: Symbolic model checking: 10^20 states and beyond,
//! LICS 1990).
//!
//! From the initial states on, all next states are computed at once, until no
//! new ones come. What a scan does is kept in parts, one for each latch, and a
//! variable is quantified away as soon as no further part mentions it (Burch,
//! Clarke, Long: Representing circuits more efficiently in symbolic model
//! checking, DAC 1991). Each latch has two variables next to each other, for
//! before and after the scan, in the order in which a walk down from the
//! properties meets the latches.

use biodivine_lib_bdd::Bdd;

use crate::diagrams::Diagrams;
use crate::limits::{Meter, Why};
use crate::netlist::Leaf;
use crate::{Netlist, Signal};

/// What the states that can be reached say about the properties.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Reached {
    /// None of them violates a property under any input; how many there are.
    All(Option<u128>),
    /// Some state that can be reached in so many scans, and in no fewer, does
    /// in the scan after them.
    Violation(usize),
}

/// Computes the states that can be reached, until one violates a property or no
/// new ones come.
pub(crate) fn reach(netlist: &Netlist, meter: &mut Meter) -> Result<Reached, Why> {
    let order = Order::of(netlist);
    let diagrams = Diagrams::new(order.variables)?;
    let system = System::new(netlist, &order, &diagrams, meter)?;
    let mut reached = system.initial.clone();
    let mut front = reached.clone();
    let mut scans = 0;
    loop {
        if !diagrams.and(&front, &system.bad, meter)?.is_false() {
            return Ok(Reached::Violation(scans));
        }
        let mut image = diagrams.and(&front, &system.allowed, meter)?;
        for part in &system.parts {
            image = diagrams.and_exists(&image, &part.relation, &part.done, meter)?;
        }
        let next = match system.parts.is_empty() {
            true => break,
            false => diagrams.one_before(&image)?,
        };
        front = diagrams.and_not(&next, &reached, meter)?;
        if front.is_false() {
            break;
        }
        reached = diagrams.or(&reached, &front, meter)?;
        scans += 1;
    }
    Ok(Reached::All(diagrams.ways(&reached, &order.is_latch)))
}

/// Which variable of the diagrams stands for what.
struct Order {
    /// The variable of each leaf of the netlist; for a latch, before the scan.
    /// The one after the scan comes next to it. `None` where nothing that is
    /// asked about depends on the leaf.
    of_node: Vec<Option<usize>>,
    /// The latches in the order of their variables, by their places.
    latches: Vec<usize>,
    /// Whether a variable is a latch before the scan.
    is_latch: Vec<bool>,
    variables: usize,
}

impl Order {
    fn of(netlist: &Netlist) -> Self {
        let mut order = Self {
            of_node: vec![None; netlist.size()],
            latches: Vec::new(),
            is_latch: Vec::new(),
            variables: 0,
        };
        let latches = netlist.latches.iter().map(|it| it.signal);
        let constraints = netlist.constraints.iter().copied();
        let properties = netlist.properties.iter().map(|it| it.signal);
        let roots = properties.chain(constraints).chain(latches);
        let mut open: Vec<usize> = roots.map(Signal::node).collect();
        open.reverse();
        let mut seen = vec![false; netlist.size()];
        while let Some(node) = open.pop() {
            if std::mem::replace(&mut seen[node], true) {
                continue;
            }
            if let Some([a, b]) = netlist.graph.gate(node) {
                open.extend([b.node(), a.node()]);
            }
            let Some(leaf) = netlist.leaf(node) else {
                continue;
            };
            order.of_node[node] = Some(order.variables);
            match leaf {
                Leaf::Input(_) => order.is_latch.push(false),
                Leaf::Latch(at) => {
                    order.latches.push(at);
                    order.is_latch.extend([true, false]);
                    open.push(netlist.latches[at].next.node());
                }
            }
            order.variables = order.is_latch.len();
        }
        order
    }

    /// The variable of a latch, before the scan.
    fn variable(&self, latch: Signal) -> usize {
        self.of_node[latch.node()].unwrap_or_default()
    }
}

/// What one latch takes.
struct Part {
    /// That its variable after the scan is what it takes.
    relation: Bdd,
    /// Whether a variable is mentioned by no later part.
    done: Vec<bool>,
}

/// A netlist as diagrams.
struct System {
    initial: Bdd,
    /// Where the constraints hold.
    allowed: Bdd,
    /// Where they do and a property is violated.
    bad: Bdd,
    parts: Vec<Part>,
}

impl System {
    fn new(
        netlist: &Netlist,
        order: &Order,
        diagrams: &Diagrams,
        meter: &mut Meter,
    ) -> Result<Self, Why> {
        let gates = Values::new(netlist, order, diagrams, meter)?;
        let mut system = Self {
            initial: diagrams.constant(true),
            allowed: diagrams.constant(true),
            bad: diagrams.constant(false),
            parts: Vec::new(),
        };
        for &constraint in &netlist.constraints {
            system.allowed = diagrams.and(&system.allowed, &gates.of(constraint), meter)?;
        }
        for property in &netlist.properties {
            system.bad = diagrams.or(&system.bad, &gates.of(property.signal), meter)?;
        }
        system.bad = diagrams.and(&system.bad, &system.allowed, meter)?;
        // The part that mentions a variable last; those that none mentions are
        // done with the first.
        let mut last = vec![0; order.variables];
        for (place, &at) in order.latches.iter().enumerate() {
            let latch = &netlist.latches[at];
            let variable = order.variable(latch.signal);
            let before = diagrams.variable(variable);
            if let Some(value) = latch.initial.value() {
                let holds = if value { before } else { before.not() };
                system.initial = diagrams.and(&system.initial, &holds, meter)?;
            }
            let next = gates.of(latch.next);
            for mentioned in next.support_set() {
                last[mentioned.to_index()] = place;
            }
            let after = diagrams.variable(variable + 1);
            let relation = diagrams.equal(&after, &next, meter)?;
            let done = vec![false; order.variables];
            system.parts.push(Part { relation, done });
        }
        for (variable, &place) in last.iter().enumerate() {
            let is_after = variable > 0 && order.is_latch[variable - 1];
            if !is_after && let Some(part) = system.parts.get_mut(place) {
                part.done[variable] = true;
            }
        }
        Ok(system)
    }
}

/// The diagram of every node.
struct Values(Vec<Bdd>);

impl Values {
    fn new(
        netlist: &Netlist,
        order: &Order,
        diagrams: &Diagrams,
        meter: &mut Meter,
    ) -> Result<Self, Why> {
        let mut values = Self(vec![diagrams.constant(false)]);
        let mut nodes = 0;
        for node in 1..netlist.size() {
            let value = match netlist.graph.gate(node) {
                Some([a, b]) => diagrams.and(&values.of(a), &values.of(b), meter)?,
                None => order.of_node[node].map_or_else(
                    || diagrams.constant(false),
                    |variable| diagrams.variable(variable),
                ),
            };
            nodes += value.size();
            if nodes > meter.nodes {
                return Err(Why::Memory);
            }
            values.0.push(value);
        }
        Ok(values)
    }

    fn of(&self, signal: Signal) -> Bdd {
        let own = &self.0[signal.node()];
        if signal.is_complement() {
            own.not()
        } else {
            own.clone()
        }
    }
}
