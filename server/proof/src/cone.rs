//! Cutting out what matters: the gates that some properties depend on, with
//! everything that the environment says.

use logic::Cancel;

use crate::classes::Classes;
use crate::limits::{Why, glance};
use crate::netlist::Leaf;
use crate::{Gates, Initial, Netlist, Signal, Trace};

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

/// What depends on some inputs; see [`Netlist::touched_by`].
#[derive(Clone, Debug)]
pub struct Touched(Vec<bool>);

impl Touched {
    /// Whether the signal does.
    pub fn contains(&self, signal: Signal) -> bool {
        self.0[signal.node()]
    }
}

/// Several parts of a netlist as one of them.
pub(crate) fn joined(parts: &[Cone], cancel: &Cancel) -> Result<Cone, Why> {
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
        all.netlist
            .try_include(&part.netlist, "", |_| glance(cancel, 0))?;
        all.latches.extend(&part.latches);
        all.properties.extend(&part.properties);
    }
    Ok(all)
}

impl Netlist {
    /// What the properties at these places depend on, over any number of
    /// scans, and all constraints with what they depend on. Outputs are left
    /// out: a trace for the part is one for the whole.
    ///
    /// # Errors
    ///
    /// [`Why::Cancelled`].
    pub fn cone(&self, properties: &[usize], cancel: &Cancel) -> Result<Cone, Why> {
        let constraints: Vec<usize> = (0..self.constraints.len()).collect();
        let alone = Classes::alone(self.size());
        Cutter::new(self, &alone).cut(properties, &constraints, cancel)
    }

    /// What depends on any of these inputs, in the same scan or a later one.
    pub fn touched_by(&self, inputs: &[usize]) -> Touched {
        let mut touched = vec![false; self.size()];
        for &at in inputs {
            touched[self.inputs[at].signal.node()] = true;
        }
        loop {
            for node in 0..self.size() {
                if let Some([a, b]) = self.graph.gate(node) {
                    touched[node] |= touched[a.node()] || touched[b.node()];
                }
            }
            let mut grows = false;
            for latch in &self.latches {
                let own = latch.signal.node();
                grows |= touched[latch.next.node()] && !touched[own];
                touched[own] |= touched[latch.next.node()];
            }
            if !grows {
                return Touched(touched);
            }
        }
    }

    /// The inputs and latches that a signal depends on within a scan, as nodes,
    /// as far as they are found among so many nodes.
    pub(crate) fn leaves_below(&self, signal: Signal, most: usize) -> Vec<usize> {
        let mut seen = rustc_hash::FxHashSet::default();
        let mut open = vec![signal.node()];
        let mut leaves = Vec::new();
        while let Some(node) = open.pop() {
            if seen.len() == most || !seen.insert(node) {
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

/// How a node is needed: through the classes, or as it is.
const MERGED: u8 = 1;
const RAW: u8 = 2;

/// Cuts parts out of a netlist, each signal replaced by the leader of its
/// class. A cut costs as much as the part is large.
///
/// The classes hold in every scan that the constraints allow. Whether they allow
/// a scan must therefore not be computed by help of the classes, or a constraint
/// that they know to be always 1 would be gone: the gates of constraints stay
/// what they are.
pub(crate) struct Cutter<'n> {
    netlist: &'n Netlist,
    classes: &'n Classes,
    needed: Vec<u8>,
    /// Where the needed nodes are in the part, by both ways.
    merged: Vec<Signal>,
    raw: Vec<Signal>,
}

impl<'n> Cutter<'n> {
    pub fn new(netlist: &'n Netlist, classes: &'n Classes) -> Self {
        Self {
            netlist,
            classes,
            needed: vec![0; netlist.size()],
            merged: vec![Signal::FALSE; netlist.size()],
            raw: vec![Signal::FALSE; netlist.size()],
        }
    }

    /// The part of these properties and these constraints. Fewer constraints
    /// allow more: what is proved of such a part holds of the whole, but a trace
    /// may be forbidden there.
    ///
    /// After an error nothing more can be cut.
    pub fn cut(
        &mut self,
        properties: &[usize],
        constraints: &[usize],
        cancel: &Cancel,
    ) -> Result<Cone, Why> {
        let nodes = self.need(properties, constraints, cancel)?;
        let mut cone = Cone {
            netlist: Netlist::default(),
            inputs: Vec::new(),
            latches: Vec::new(),
            properties: properties.to_vec(),
        };
        for (at, &node) in nodes.iter().enumerate() {
            glance(cancel, at)?;
            self.place(node, &mut cone);
        }
        let part = &mut cone.netlist;
        for &at in &cone.latches {
            let latch = &self.netlist.latches[at];
            let own = self.raw[latch.signal.node()];
            part.set_next(own, at_place(&self.merged, latch.next));
        }
        for &at in constraints {
            part.constrain(at_place(&self.raw, self.netlist.constraints[at]));
        }
        for &at in properties {
            let property = &self.netlist.properties[at];
            part.never(
                property.name.clone(),
                at_place(&self.merged, property.signal),
            );
        }
        for node in nodes {
            self.needed[node] = 0;
        }
        Ok(cone)
    }

    /// Puts a node into the part, after those that it needs.
    fn place(&mut self, node: usize, cone: &mut Cone) {
        let netlist = self.netlist;
        let leader = self.classes.0[node];
        let is_merged = self.needed[node] & MERGED != 0;
        let is_raw = self.needed[node] & RAW != 0;
        let leads = leader.node() == node;
        let part = &mut cone.netlist;
        if let Some([a, b]) = netlist.graph.gate(node) {
            if is_raw {
                self.raw[node] = part.and(at_place(&self.raw, a), at_place(&self.raw, b));
            }
            if is_merged && leads {
                self.merged[node] = part.and(at_place(&self.merged, a), at_place(&self.merged, b));
            }
        } else if is_raw || leads {
            match netlist.leaf(node) {
                Some(Leaf::Input(at)) => {
                    self.raw[node] = part.input(netlist.inputs[at].name.clone());
                    cone.inputs.push(at);
                }
                Some(Leaf::Latch(at)) => {
                    let latch = &netlist.latches[at];
                    self.raw[node] = part.latch(latch.name.clone(), latch.initial);
                    cone.latches.push(at);
                }
                None => {}
            }
            self.merged[node] = self.raw[node];
        }
        if is_merged && !leads {
            self.merged[node] = at_place(&self.merged, leader);
        }
    }

    /// Marks what is needed and lists it in the netlist's order.
    fn need(
        &mut self,
        properties: &[usize],
        constraints: &[usize],
        cancel: &Cancel,
    ) -> Result<Vec<usize>, Why> {
        let netlist = self.netlist;
        let mut nodes = Vec::new();
        let mut open: Vec<(usize, u8)> = Vec::new();
        let properties = properties.iter().map(|&at| netlist.properties[at].signal);
        let constraints = constraints.iter().map(|&at| netlist.constraints[at]);
        open.extend(properties.map(|it| (it.node(), MERGED)));
        open.extend(constraints.map(|it| (it.node(), RAW)));
        while let Some((node, way)) = open.pop() {
            if self.needed[node] & way != 0 {
                continue;
            }
            let is_first = self.needed[node] == 0;
            if is_first {
                glance(cancel, nodes.len())?;
                nodes.push(node);
            }
            self.needed[node] |= way;
            let leader = self.classes.0[node].node();
            if way == MERGED && leader != node {
                open.push((leader, MERGED));
                continue;
            }
            if let Some([a, b]) = netlist.graph.gate(node) {
                open.extend([(a.node(), way), (b.node(), way)]);
            }
            if let Some(Leaf::Latch(at)) = netlist.leaf(node)
                && (is_first || leader != node)
            {
                open.push((netlist.latches[at].next.node(), MERGED));
            }
        }
        nodes.sort_unstable();
        Ok(nodes)
    }
}

fn at_place(places: &[Signal], signal: Signal) -> Signal {
    places[signal.node()].flipped(signal.is_complement())
}
