//! Cutting out what matters: the gates that some properties depend on, with
//! everything that the environment says.

use crate::classes::Classes;
use crate::netlist::Leaf;
use crate::{Gates, Initial, Netlist, Output, Signal, Trace};

/// A part of a netlist, and where its inputs and latches come from.
#[derive(Clone, Debug)]
pub struct Cone {
    /// The part: a netlist of its own.
    pub netlist: Netlist,
    /// For each of its inputs the place in the whole netlist.
    pub inputs: Vec<usize>,
    /// For each of its latches the place in the whole netlist.
    pub latches: Vec<usize>,
    /// For each of its properties the place in the whole netlist.
    pub properties: Vec<usize>,
}

impl Cone {
    /// A part of this cone's netlist as one of the whole netlist.
    pub(crate) fn within(&self, inner: Cone) -> Cone {
        let through = |places: &[usize], inner: &[usize]| -> Vec<usize> {
            inner.iter().map(|&place| places[place]).collect()
        };
        Cone {
            inputs: through(&self.inputs, &inner.inputs),
            latches: through(&self.latches, &inner.latches),
            properties: through(&self.properties, &inner.properties),
            netlist: inner.netlist,
        }
    }

    /// The same trace for the whole netlist: what does not matter is 0.
    pub fn whole(&self, netlist: &Netlist, trace: &Trace) -> Trace {
        let spread = |places: &[usize], values: &[bool], mut whole: Vec<bool>| {
            for (&place, &value) in places.iter().zip(values) {
                whole[place] = value;
            }
            whole
        };
        let initial = netlist.latches.iter();
        let initial = initial.map(|latch| latch.initial == Initial::One).collect();
        Trace {
            initial: spread(&self.latches, &trace.initial, initial),
            inputs: trace
                .inputs
                .iter()
                .map(|scan| spread(&self.inputs, scan, vec![false; netlist.inputs.len()]))
                .collect(),
        }
    }
}

/// Several parts of a netlist as one of them.
pub(crate) fn joined(parts: &[Cone]) -> Cone {
    let mut all = Cone {
        netlist: Netlist::default(),
        inputs: Vec::new(),
        latches: Vec::new(),
        properties: Vec::new(),
    };
    for part in parts {
        for (input, &place) in part.netlist.inputs.iter().zip(&part.inputs) {
            let known = all.netlist.inputs.len();
            all.netlist.input(input.name.clone());
            if all.netlist.inputs.len() > known {
                all.inputs.push(place);
            }
        }
        all.netlist.include(&part.netlist, "");
        all.latches.extend(&part.latches);
        all.properties.extend(&part.properties);
    }
    all
}

/// How a node is needed: through the classes, or as it is.
const MERGED: u8 = 1;
const RAW: u8 = 2;

impl Netlist {
    /// What the properties at these places depend on, over any number of
    /// scans, and all constraints with what they depend on. Outputs that the
    /// part can tell without further gates are kept.
    pub fn cone(&self, properties: &[usize]) -> Cone {
        let constraints: Vec<usize> = (0..self.constraints.len()).collect();
        self.part(properties, &constraints)
    }

    /// The same with the constraints at these places and no others. Fewer
    /// constraints allow more: what is proved of such a part holds of the
    /// whole, but a trace may be forbidden there.
    pub(crate) fn part(&self, properties: &[usize], constraints: &[usize]) -> Cone {
        self.merged_cone(properties, constraints, &Classes::alone(self.size()))
    }

    /// The cone, each signal replaced by the leader of its class.
    ///
    /// The classes hold in every scan that the constraints allow. Whether they
    /// allow a scan must therefore not be computed by help of the classes, or a
    /// constraint that they know to be always 1 would be gone: the gates of
    /// constraints stay what they are.
    pub(crate) fn merged_cone(
        &self,
        properties: &[usize],
        constraints: &[usize],
        classes: &Classes,
    ) -> Cone {
        let needed = self.needed(properties, constraints, classes);
        let mut part = Netlist::default();
        let mut cone = Cone {
            netlist: Netlist::default(),
            inputs: Vec::new(),
            latches: Vec::new(),
            properties: properties.to_vec(),
        };
        let mut merged = vec![Signal::FALSE; self.size()];
        let mut raw = vec![Signal::FALSE; self.size()];
        let of = |places: &[Signal], signal: Signal| {
            places[signal.node()].flipped(signal.is_complement())
        };
        for node in 1..self.size() {
            let leader = classes.0[node];
            let is_merged = needed[node] & MERGED != 0;
            let is_raw = needed[node] & RAW != 0;
            let stays = is_raw || is_merged && leader.node() == node;
            match self.leaf(node) {
                Some(Leaf::Input(at)) if stays => {
                    raw[node] = part.input(self.inputs[at].name.clone());
                    cone.inputs.push(at);
                }
                Some(Leaf::Latch(at)) if stays => {
                    let latch = &self.latches[at];
                    raw[node] = part.latch(latch.name.clone(), latch.initial);
                    cone.latches.push(at);
                }
                _ => {}
            }
            if let Some([a, b]) = self.graph.gate(node) {
                if is_raw {
                    raw[node] = part.and(of(&raw, a), of(&raw, b));
                }
                if is_merged && leader.node() == node {
                    merged[node] = part.and(of(&merged, a), of(&merged, b));
                }
            } else if leader.node() == node {
                merged[node] = raw[node];
            }
            if is_merged && leader.node() != node {
                merged[node] = of(&merged, leader);
            }
        }
        for &at in &cone.latches {
            let latch = &self.latches[at];
            part.set_next(raw[latch.signal.node()], of(&merged, latch.next));
        }
        for &at in constraints {
            part.constrain(of(&raw, self.constraints[at]));
        }
        for &at in properties {
            let Output { name, signal } = &self.properties[at];
            part.never(name.clone(), of(&merged, *signal));
        }
        for Output { name, signal } in &self.outputs {
            let root = classes.leader(*signal).node();
            if root == 0 || needed[root] & MERGED != 0 {
                let signal = classes.leader(*signal);
                part.output(name.clone(), of(&merged, signal));
            }
        }
        cone.netlist = part;
        cone
    }

    fn needed(&self, properties: &[usize], constraints: &[usize], classes: &Classes) -> Vec<u8> {
        let mut needed = vec![0_u8; self.size()];
        let mut open: Vec<(usize, u8)> = Vec::new();
        open.extend(
            properties
                .iter()
                .map(|&at| (self.properties[at].signal.node(), MERGED)),
        );
        open.extend(
            constraints
                .iter()
                .map(|&at| (self.constraints[at].node(), RAW)),
        );
        while let Some((node, way)) = open.pop() {
            if needed[node] & way != 0 {
                continue;
            }
            let is_first = needed[node] == 0;
            needed[node] |= way;
            let leader = classes.0[node].node();
            if way == MERGED && leader != node {
                open.push((leader, MERGED));
                continue;
            }
            if let Some([a, b]) = self.graph.gate(node) {
                open.extend([(a.node(), way), (b.node(), way)]);
            }
            if let Some(Leaf::Latch(at)) = self.leaf(node)
                && (is_first || leader != node)
            {
                open.push((self.latches[at].next.node(), MERGED));
            }
        }
        needed
    }

    /// The inputs and latches that a signal depends on within a scan, as nodes.
    pub(crate) fn leaves_below(&self, signal: Signal) -> Vec<usize> {
        let mut seen = rustc_hash::FxHashSet::default();
        let mut open = vec![signal.node()];
        let mut leaves = Vec::new();
        while let Some(node) = open.pop() {
            if !seen.insert(node) {
                continue;
            }
            match self.graph.gate(node) {
                Some([a, b]) => open.extend([a.node(), b.node()]),
                None if node != 0 => leaves.push(node),
                None => {}
            }
        }
        leaves
    }
}
