use rustc_hash::FxHashMap;

use crate::Signal;
use crate::lanes::{Lanes, Word, zip};

/// Which signals of a netlist may always be equal: for each node the first node
/// of its class, complemented if the two are always each other's complement.
/// The class of node 0 holds the constants. A node that is equal to none before
/// it leads itself.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Classes(pub Vec<Signal>);

impl Classes {
    /// Each of so many nodes by itself.
    pub fn alone(nodes: usize) -> Self {
        Self((0..nodes).map(|node| Signal::new(node, false)).collect())
    }

    /// What a signal is taken to be equal to.
    pub fn leader(&self, signal: Signal) -> Signal {
        self.0[signal.node()].flipped(signal.is_complement())
    }

    /// Takes a node out of its class, unless it leads it.
    pub fn detach(&mut self, node: usize) {
        self.0[node] = Signal::new(node, false);
    }

    /// Splits the classes whose members are not equal in the lanes of `which`.
    pub fn refine(&mut self, lanes: &Lanes<'_>, which: &Word) {
        // The new leader of those in a class that differ from the old one in
        // the same lanes, and how it stood to that.
        let mut split: FxHashMap<(usize, Word), (usize, bool)> = FxHashMap::default();
        for node in 0..self.0.len() {
            let leader = self.0[node];
            if leader.node() == node {
                continue;
            }
            let differs = zip(lanes.node(node), &lanes.value(leader), |a, b| a ^ b);
            let differs = zip(&differs, which, |a, b| a & b);
            if differs == crate::lanes::NONE {
                continue;
            }
            let own = (node, leader.is_complement());
            let (first, complement) = *split.entry((leader.node(), differs)).or_insert(own);
            self.0[node] = Signal::new(first, complement != leader.is_complement());
        }
    }
}
