use crate::{Netlist, Signal};

/// What is plain of each node when some signals are supposed: 0, 1, or open.
#[derive(Clone, Debug)]
pub struct Supposed(Vec<Option<bool>>);

impl Netlist {
    /// What follows plainly, gate by gate, in a scan in which these inputs and
    /// latches have these values. What is not plain may still be impossible.
    pub fn suppose(&self, leaves: impl IntoIterator<Item = (Signal, bool)>) -> Supposed {
        let mut known = Supposed(vec![None; self.size()]);
        known.0[0] = Some(false);
        for (leaf, value) in leaves {
            known.0[leaf.node()] = Some(value != leaf.is_complement());
        }
        for node in 0..self.size() {
            if let Some([a, b]) = self.graph.gate(node) {
                known.0[node] = match (known.of(a), known.of(b)) {
                    (Some(false), _) | (_, Some(false)) => Some(false),
                    (Some(true), Some(true)) => Some(true),
                    _ => None,
                };
            }
        }
        known
    }
}

impl Supposed {
    /// The value of a signal, if it is plain.
    pub fn of(&self, signal: Signal) -> Option<bool> {
        self.0[signal.node()].map(|value| value != signal.is_complement())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Gates;

    #[test]
    fn what_is_supposed_goes_through_gates() {
        let mut netlist = Netlist::default();
        let [a, b] = ["a", "b"].map(|name| netlist.input(name));
        let both = netlist.and(a, b);
        let either = netlist.or(a, b);
        let known = netlist.suppose([(a, false)]);
        assert_eq!(known.of(both), Some(false));
        assert_eq!(known.of(either), None);
        assert_eq!(known.of(!a), Some(true));
        assert_eq!(known.of(Signal::TRUE), Some(true));
    }
}
