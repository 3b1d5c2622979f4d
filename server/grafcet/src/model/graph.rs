use std::collections::HashMap;

use logic::Name;
use petgraph::graph::{DiGraph, NodeIndex};

use super::Grafcet;

/// A node of a grafcet seen as a graph.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Node {
    /// The step of this name.
    Step(Name),
    /// The transition of this name.
    Transition(Name),
}

impl Grafcet {
    /// The grafcet as a bipartite graph: an edge from each step to the
    /// transitions after it, and from each transition to the steps after it.
    ///
    /// Steps come first, then transitions, each in the order of the model, and
    /// all charts are in it. A step that a transition names but nothing
    /// declares has no node.
    pub fn graph(&self) -> DiGraph<Node, ()> {
        let mut graph = DiGraph::new();
        let mut places: HashMap<&Name, NodeIndex> = HashMap::new();
        for step in self.steps() {
            let node = graph.add_node(Node::Step(step.name.clone()));
            places.entry(&step.name).or_insert(node);
        }
        for transition in self.transitions() {
            let node = graph.add_node(Node::Transition(transition.name.clone()));
            for before in transition.from.iter().filter_map(|step| places.get(step)) {
                graph.add_edge(*before, node, ());
            }
            for after in transition.to.iter().filter_map(|step| places.get(step)) {
                graph.add_edge(node, *after, ());
            }
        }
        graph
    }
}
