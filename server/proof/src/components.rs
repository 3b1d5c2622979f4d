//! What can be looked at separately.
//!
//! A plant's program is many small machines that share buttons. Two parts of a
//! netlist that share nothing but inputs which no constraint speaks of cannot
//! tell anything about each other: whatever one does, the other may do anything.

use logic::Cancel;

use crate::limits::{Why, glance};
use crate::netlist::Leaf;
use crate::{Netlist, Signal};

/// A part of a netlist by the places of its properties and constraints.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Component {
    pub properties: Vec<usize>,
    pub constraints: Vec<usize>,
}

/// The parts of a netlist, in the order of their first properties; parts with
/// constraints alone come last.
pub(crate) fn components(netlist: &Netlist, cancel: &Cancel) -> Result<Vec<Component>, Why> {
    let mut sets = Sets((0..netlist.size()).collect());
    let connects = connecting(netlist, cancel)?;
    for node in 1..netlist.size() {
        glance(cancel, node)?;
        if let Some([a, b]) = netlist.graph.gate(node) {
            for below in [a.node(), b.node()].into_iter().filter(|&it| connects[it]) {
                sets.join(node, below);
            }
        }
    }
    for latch in &netlist.latches {
        let next = latch.next.node();
        if connects[next] {
            sets.join(latch.signal.node(), next);
        }
    }
    let mut of_set: Vec<Option<usize>> = vec![None; netlist.size()];
    let mut components: Vec<Component> = Vec::new();
    let mut component = |signal: Signal, components: &mut Vec<Component>| {
        *of_set[sets.find(signal.node())].get_or_insert_with(|| {
            components.push(Component::default());
            components.len() - 1
        })
    };
    for (place, property) in netlist.properties.iter().enumerate() {
        let at = component(property.signal, &mut components);
        components[at].properties.push(place);
    }
    for (place, &constraint) in netlist.constraints.iter().enumerate() {
        let at = component(constraint, &mut components);
        components[at].constraints.push(place);
    }
    Ok(components)
}

/// Which nodes connect those that they are part of: all but the constant and
/// the inputs on which no constraint depends, in whatever scan.
fn connecting(netlist: &Netlist, cancel: &Cancel) -> Result<Vec<bool>, Why> {
    let mut is_constrained = vec![false; netlist.size()];
    let mut open: Vec<usize> = netlist.constraints.iter().map(|it| it.node()).collect();
    let mut walked = 0;
    while let Some(node) = open.pop() {
        if std::mem::replace(&mut is_constrained[node], true) {
            continue;
        }
        walked += 1;
        glance(cancel, walked)?;
        if let Some([a, b]) = netlist.graph.gate(node) {
            open.extend([a.node(), b.node()]);
        }
        if let Some(Leaf::Latch(at)) = netlist.leaf(node) {
            open.push(netlist.latches[at].next.node());
        }
    }
    let connects = (0..netlist.size()).map(|node| match netlist.leaf(node) {
        Some(Leaf::Input(_)) => is_constrained[node],
        _ => node != 0,
    });
    Ok(connects.collect())
}

/// Sets that are joined: each node leads towards the first of its set.
struct Sets(Vec<usize>);

impl Sets {
    fn find(&mut self, mut node: usize) -> usize {
        while self.0[node] != node {
            self.0[node] = self.0[self.0[node]];
            node = self.0[node];
        }
        node
    }

    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.find(a), self.find(b));
        self.0[a.max(b)] = a.min(b);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Gates;

    /// Two seal-ins that share a stop button.
    fn two() -> Netlist {
        let mut netlist = Netlist::default();
        let stop = netlist.input("stop");
        for name in ["a", "b"] {
            let start = netlist.input(format!("start {name}"));
            let motor = netlist.latch(name, false);
            let held = netlist.or(start, motor);
            let runs = netlist.and(held, !stop);
            netlist.set_next(motor, runs);
            netlist.never(name, runs);
        }
        netlist
    }

    fn found(netlist: &Netlist) -> Vec<(Vec<usize>, Vec<usize>)> {
        let components = components(netlist, &Cancel::default());
        components
            .expect("nobody cancels")
            .into_iter()
            .map(|it| (it.properties, it.constraints))
            .collect()
    }

    #[test]
    fn a_free_button_connects_nothing() {
        assert_eq!(found(&two()), [(vec![0], vec![]), (vec![1], vec![])]);
    }

    #[test]
    fn a_button_that_a_constraint_speaks_of_connects_what_it_is_part_of() {
        let mut netlist = two();
        let (stop, fault) = (netlist.input("stop"), netlist.input("fault"));
        let before = netlist.delayed("stopped", stop, false);
        let rule = netlist.implies(before, fault);
        netlist.constrain(rule);
        let unrelated = netlist.input("unrelated");
        netlist.constrain(unrelated);
        assert_eq!(found(&netlist), [(vec![0, 1], vec![0]), (vec![], vec![1])]);
    }
}
