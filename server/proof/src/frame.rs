use crate::classes::Classes;
use crate::graph::Graph;
use crate::limits::{Meter, Why};
use crate::solver::Solver;
use crate::{Gates, Netlist, Signal};

/// One scan of a netlist in which each signal is replaced by the leader of its
/// class: *speculative reduction* (Mony, Baumgartner, Mishchenko, Brayton:
/// Speculative reduction-based scalable redundancy identification, DATE 2009).
///
/// Much of two netlists that compute the same falls together this way. What
/// was replaced, and by what, is listed as an obligation. As long as all
/// obligations before it hold, a replaced signal has its true value; so if all
/// hold, all values are true, and the first that fails, fails truly.
///
/// Gates that constraints depend on are left as they are: were a constraint
/// that is believed to be always 1 replaced by 1, nothing would enforce it.
pub(crate) struct Frame {
    reduced: Vec<Signal>,
    raw: Vec<Signal>,
    /// The inputs, in the netlist's order.
    pub inputs: Vec<Signal>,
    /// Replaced nodes: the node, what it would be, what it was replaced by.
    pub obligations: Vec<(usize, Signal, Signal)>,
}

/// What the latches hold when a scan begins.
pub(crate) enum State<'s> {
    /// Anything that the classes allow.
    Any,
    /// These signals, in the netlist's order.
    Is(&'s [Signal]),
}

/// What the frames of a netlist have in common.
pub(crate) struct Framing<'n> {
    pub netlist: &'n Netlist,
    /// The nodes that constraints depend on within a scan.
    constraining: Vec<bool>,
}

impl<'n> Framing<'n> {
    pub fn new(netlist: &'n Netlist) -> Self {
        let mut constraining = vec![false; netlist.size()];
        let mut open: Vec<usize> = netlist.constraints.iter().map(|it| it.node()).collect();
        while let Some(node) = open.pop() {
            if !std::mem::replace(&mut constraining[node], true)
                && let Some([a, b]) = netlist.graph.gate(node)
            {
                open.extend([a.node(), b.node()]);
            }
        }
        Self {
            netlist,
            constraining,
        }
    }

    /// Whether a node may be replaced by the leader of its class.
    pub fn may_merge(&self, node: usize) -> bool {
        !self.constraining[node] || self.netlist.graph.gate(node).is_none()
    }

    /// Builds a scan in `graph`.
    pub fn frame(
        &self,
        graph: &mut Graph,
        classes: &Classes,
        state: State<'_>,
        meter: &mut Meter,
    ) -> Result<Frame, Why> {
        let netlist = self.netlist;
        meter.fits(graph.len() + netlist.size())?;
        let mut frame = Frame {
            reduced: vec![Signal::FALSE; netlist.size()],
            raw: vec![Signal::FALSE; netlist.size()],
            inputs: netlist.inputs.iter().map(|_| graph.leaf()).collect(),
            obligations: Vec::new(),
        };
        for (input, &leaf) in netlist.inputs.iter().zip(&frame.inputs) {
            frame.raw[input.signal.node()] = leaf;
        }
        if let State::Is(latches) = state {
            for (latch, &signal) in netlist.latches.iter().zip(latches) {
                frame.raw[latch.signal.node()] = signal;
            }
        }
        for node in 1..netlist.size() {
            meter.walk(node, 4)?;
            let leader = classes.0[node];
            let is_merged = leader.node() != node;
            let by = at(&frame.reduced, leader);
            let own = match netlist.graph.gate(node) {
                Some([a, b]) if self.constraining[node] => {
                    let own = graph.and(at(&frame.raw, a), at(&frame.raw, b));
                    frame.raw[node] = own;
                    own
                }
                Some([a, b]) => graph.and(at(&frame.reduced, a), at(&frame.reduced, b)),
                None => {
                    let is_latch =
                        matches!(netlist.leaf(node), Some(crate::netlist::Leaf::Latch(_)));
                    if is_latch && matches!(state, State::Any) {
                        // Nothing else speaks of the latch, so it simply is what
                        // its class says.
                        frame.raw[node] = if is_merged { by } else { graph.leaf() };
                    }
                    frame.raw[node]
                }
            };
            frame.reduced[node] = if is_merged { by } else { own };
            if is_merged {
                frame.obligations.push((node, own, by));
            }
        }
        Ok(frame)
    }

    /// Asserts in `solver` that the constraints hold in the scan.
    pub fn constrain(
        &self,
        frame: &Frame,
        graph: &Graph,
        solver: &mut Solver,
        meter: &mut Meter,
    ) -> Result<(), Why> {
        let mut constraints = self.netlist.constraints.iter();
        constraints.try_for_each(|&it| solver.assert(graph, at(&frame.raw, it), meter))
    }

    /// Asserts in `solver` that the obligations of the scan hold.
    pub fn suppose(
        &self,
        frame: &Frame,
        graph: &mut Graph,
        solver: &mut Solver,
        meter: &mut Meter,
    ) -> Result<(), Why> {
        for &(_, own, by) in &frame.obligations {
            if own != by {
                solver.assert_any(graph, &[own, !by], meter)?;
                solver.assert_any(graph, &[!own, by], meter)?;
            }
        }
        Ok(())
    }
}

impl Frame {
    /// What a signal of the netlist is in this scan.
    pub fn of(&self, signal: Signal) -> Signal {
        at(&self.reduced, signal)
    }

    /// What the latches will hold in the next scan.
    pub fn next(&self, netlist: &Netlist) -> Vec<Signal> {
        let latches = netlist.latches.iter();
        latches.map(|latch| self.of(latch.next)).collect()
    }
}

fn at(places: &[Signal], signal: Signal) -> Signal {
    places[signal.node()].flipped(signal.is_complement())
}
