//! What a scan does, as decision diagrams.
//!
//! It is kept in parts, one for each few latches, and a variable is quantified
//! away as soon as no further part mentions it (Burch, Clarke, Long: Representing
//! circuits more efficiently in symbolic model checking, DAC 1991). Each latch
//! has two variables next to each other, for before and after the scan, in the
//! order in which a walk down from the properties meets the latches.

use biodivine_lib_bdd::Bdd;

use crate::diagrams::Diagrams;
use crate::limits::{Meter, Why};
use crate::netlist::Leaf;
use crate::{Netlist, Signal};

/// Relations are joined as long as the two have no more nodes than this: every
/// part costs an operation in every scan.
const JOINED: usize = 200;

/// Which variable of the diagrams stands for what.
pub(crate) struct Order {
    /// The variable of each leaf of the netlist; for a latch, before the scan.
    /// The one after the scan comes next to it. `None` where nothing that is
    /// asked about depends on the leaf.
    of_node: Vec<Option<usize>>,
    /// The latches in the order of their variables, by their places.
    latches: Vec<usize>,
    /// Whether a variable is a latch before the scan.
    pub is_latch: Vec<bool>,
    pub variables: usize,
}

impl Order {
    pub fn of(netlist: &Netlist) -> Self {
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

/// What some latches take.
pub(crate) struct Part {
    /// That their variables after the scan are what they take.
    pub relation: Bdd,
    /// Whether a variable is mentioned by no later part.
    pub done: Vec<bool>,
}

/// The diagrams of the first nodes of a netlist. Those that no later gate needs
/// are dropped again, but for what is asked of the whole.
pub(crate) struct Values {
    of: Vec<Bdd>,
    /// By how many it is still needed.
    needed: Vec<u32>,
    nodes: usize,
}

impl Values {
    pub fn new(netlist: &Netlist, diagrams: &Diagrams) -> Self {
        let mut needed = vec![0; netlist.size()];
        for node in 1..netlist.size() {
            for below in netlist.graph.gate(node).into_iter().flatten() {
                needed[below.node()] += 1;
            }
        }
        let next = netlist.latches.iter().map(|latch| latch.next);
        let properties = netlist.properties.iter().map(|it| it.signal);
        for root in next
            .chain(properties)
            .chain(netlist.constraints.iter().copied())
        {
            needed[root.node()] += 1;
        }
        Self {
            of: vec![diagrams.constant(false)],
            needed,
            nodes: 0,
        }
    }

    /// Adds those of all other nodes. After an error the same call goes on where
    /// it stopped.
    pub fn complete(
        &mut self,
        netlist: &Netlist,
        order: &Order,
        diagrams: &Diagrams,
        meter: &mut Meter,
    ) -> Result<(), Why> {
        for node in self.of.len()..netlist.size() {
            let gate = netlist.graph.gate(node);
            let value = match gate {
                Some([a, b]) => diagrams.and(&self.of(a), &self.of(b), meter)?,
                None => order.of_node[node].map_or_else(
                    || diagrams.constant(false),
                    |variable| diagrams.variable(variable),
                ),
            };
            self.nodes += value.size();
            self.of.push(value);
            for below in gate.into_iter().flatten().map(Signal::node) {
                self.needed[below] -= 1;
                if self.needed[below] == 0 {
                    let dropped = std::mem::replace(&mut self.of[below], diagrams.constant(false));
                    self.nodes -= dropped.size();
                }
            }
            if self.nodes > meter.nodes {
                return Err(Why::Memory);
            }
        }
        Ok(())
    }

    /// How many nodes they have in all.
    pub fn nodes(&self) -> usize {
        self.nodes
    }

    fn of(&self, signal: Signal) -> Bdd {
        let own = &self.of[signal.node()];
        if signal.is_complement() {
            own.not()
        } else {
            own.clone()
        }
    }
}

/// A netlist as diagrams.
pub(crate) struct System {
    pub initial: Bdd,
    /// Where the constraints hold.
    pub allowed: Bdd,
    /// For each property, where they do and it is violated.
    pub bad: Vec<Bdd>,
    pub parts: Vec<Part>,
}

impl System {
    /// The system whose gates have these values.
    pub fn new(
        netlist: &Netlist,
        order: &Order,
        diagrams: &Diagrams,
        values: &Values,
        meter: &mut Meter,
    ) -> Result<Self, Why> {
        let mut allowed = diagrams.constant(true);
        for &constraint in &netlist.constraints {
            allowed = diagrams.and(&allowed, &values.of(constraint), meter)?;
        }
        let mut bad = Vec::new();
        for property in &netlist.properties {
            bad.push(diagrams.and(&values.of(property.signal), &allowed, meter)?);
        }
        let mut initial = diagrams.constant(true);
        let mut parts: Vec<Part> = Vec::new();
        // The part that mentions a variable last; those that none mentions are
        // done with the first.
        let mut last = vec![0; order.variables];
        for &at in &order.latches {
            let latch = &netlist.latches[at];
            let variable = order.variable(latch.signal);
            let before = diagrams.variable(variable);
            if let Some(value) = latch.initial.value() {
                let holds = if value { before } else { before.not() };
                initial = diagrams.and(&initial, &holds, meter)?;
            }
            let next = values.of(latch.next);
            let after = diagrams.variable(variable + 1);
            let relation = diagrams.equal(&after, &next, meter)?;
            match parts.last_mut() {
                Some(part) if part.relation.size() + relation.size() <= JOINED => {
                    part.relation = diagrams.and(&part.relation, &relation, meter)?;
                }
                _ => parts.push(Part {
                    relation,
                    done: vec![false; order.variables],
                }),
            }
            for mentioned in next.support_set() {
                last[mentioned.to_index()] = parts.len() - 1;
            }
        }
        for (variable, &place) in last.iter().enumerate() {
            let is_after = variable > 0 && order.is_latch[variable - 1];
            if !is_after && let Some(part) = parts.get_mut(place) {
                part.done[variable] = true;
            }
        }
        Ok(Self {
            initial,
            allowed,
            bad,
            parts,
        })
    }

    /// How many nodes all its diagrams have.
    pub fn nodes(&self) -> usize {
        let parts = self.parts.iter().map(|part| &part.relation);
        let all = parts.chain(&self.bad).chain([&self.initial, &self.allowed]);
        all.map(Bdd::size).sum()
    }
}
