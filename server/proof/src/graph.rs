use rustc_hash::FxHashMap;

use crate::{Gates, Signal};

/// An and-inverter graph: leaves, and gates that are the conjunction of two
/// signals.
///
/// Node 0 is the constant 0. A gate comes after the nodes that it needs, so a
/// pass over the nodes in their order is an evaluation, and nothing here ever
/// recurses. Gates are unique: two that are built from the same signals are
/// one node, which makes many equalities true by construction.
#[derive(Clone, Debug)]
pub(crate) struct Graph {
    /// What each node is made of; a leaf is made of `LEAF` twice.
    gates: Vec<[Signal; 2]>,
    known: FxHashMap<[Signal; 2], u32>,
}

const LEAF: Signal = Signal::new(u32::MAX as usize >> 1, true);

impl Default for Graph {
    fn default() -> Self {
        Self {
            gates: vec![[LEAF; 2]],
            known: FxHashMap::default(),
        }
    }
}

impl Graph {
    /// A new leaf.
    pub fn leaf(&mut self) -> Signal {
        self.gates.push([LEAF; 2]);
        Signal::new(self.gates.len() - 1, false)
    }

    /// Number of nodes, the constant included.
    pub fn len(&self) -> usize {
        self.gates.len()
    }

    /// The two signals whose conjunction the node is, unless it is a leaf.
    pub fn gate(&self, node: usize) -> Option<[Signal; 2]> {
        let gate = self.gates[node];
        (gate[0] != LEAF).then_some(gate)
    }

    /// The value of every node, where `leaf` says those of the leaves.
    pub fn values(&self, leaf: impl Fn(Signal) -> bool) -> Vec<bool> {
        let mut values = vec![false; self.len()];
        for node in 1..self.len() {
            let value = |signal: Signal| values[signal.node()] != signal.is_complement();
            values[node] = match self.gate(node) {
                Some([a, b]) => value(a) && value(b),
                None => leaf(Signal::new(node, false)),
            };
        }
        values
    }

    /// Rules that look one gate deeper than the two signals: what the pair
    /// can be replaced by.
    fn rewritten(&self, a: Signal, b: Signal) -> Option<Rewritten> {
        use Rewritten::{Pair, Single};
        let inside = self.gate(a.node())?;
        for (part, other) in [(inside[0], inside[1]), (inside[1], inside[0])] {
            match a.is_complement() {
                // x*y*x = x*y, and x*y*/x = 0
                false if b == part => return Some(Single(a)),
                false if b == !part => return Some(Single(Signal::FALSE)),
                // /(x*y)*/x = /x, and /(x*y)*x = x*/y
                true if b == !part => return Some(Single(b)),
                true if b == part => return Some(Pair(part, !other)),
                _ => {}
            }
        }
        // x*y * /x*z = 0
        if let Some(within) = self.gate(b.node())
            && !a.is_complement()
            && !b.is_complement()
            && inside.iter().any(|&part| within.contains(&!part))
        {
            return Some(Single(Signal::FALSE));
        }
        None
    }
}

enum Rewritten {
    Single(Signal),
    Pair(Signal, Signal),
}

impl Gates for Graph {
    fn and(&mut self, a: Signal, b: Signal) -> Signal {
        let (mut a, mut b) = (a, b);
        loop {
            (a, b) = (a.min(b), a.max(b));
            if a == Signal::FALSE || a == !b {
                return Signal::FALSE;
            }
            if a == Signal::TRUE || a == b {
                return b;
            }
            match self.rewritten(a, b).or_else(|| self.rewritten(b, a)) {
                None => break,
                Some(Rewritten::Single(signal)) => return signal,
                Some(Rewritten::Pair(left, right)) => (a, b) = (left, right),
            }
        }
        let next = self.gates.len() as u32;
        let node = *self.known.entry([a, b]).or_insert(next);
        if node == next {
            self.gates.push([a, b]);
        }
        Signal::new(node as usize, false)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_the_same_by_construction_is_one_signal() {
        let mut graph = Graph::default();
        let [x, y, z] = [(); 3].map(|()| graph.leaf());
        let xy = graph.and(x, y);
        assert_eq!(graph.and(y, x), xy);
        assert_eq!(graph.and(x, !x), Signal::FALSE);
        assert_eq!(graph.and(xy, x), xy);
        assert_eq!(graph.and(xy, !y), Signal::FALSE);
        assert_eq!(graph.and(!xy, !y), !y);
        let x_without_y = graph.and(x, !y);
        assert_eq!(graph.and(x, !xy), x_without_y);
        let without = graph.and(!x, z);
        assert_eq!(graph.and(xy, without), Signal::FALSE);
        assert_eq!(graph.ite(x, y, y), y);
        assert_eq!(graph.any(&[]), Signal::FALSE);
        assert_eq!(graph.all(&[x, Signal::TRUE, x]), x);
        assert_eq!(graph.equal(z, z), Signal::TRUE);
    }
}
