//! Continuous actions: outputs that are on while a step is active.
//!
//! They are worked out once a scan, when the situation is stable. The
//! condition of one may read the output of another, and no order of lines may
//! decide what it sees: what others depend on is worked out first. Outputs
//! that depend on each other in a circle see each other as they were last
//! published.

use std::collections::HashMap;
use std::ops::Range;

use petgraph::algo::tarjan_scc;
use petgraph::graph::{DiGraph, NodeIndex};

use super::condition::Condition;
use super::firing;
use super::net::{Continuous, Net, State};

/// The outputs with continuous actions, in the order in which they are met.
#[derive(Default)]
pub(super) struct Outputs {
    list: Vec<Continuous>,
    /// By variable, the place in the list.
    places: HashMap<usize, usize>,
}

impl Outputs {
    /// Adds a continuous action, in whose condition these edges stand.
    pub(super) fn add(
        &mut self,
        variable: usize,
        step: usize,
        condition: Condition,
        edges: Range<usize>,
    ) {
        let at = *self.places.entry(variable).or_insert(self.list.len());
        if at == self.list.len() {
            self.list.push(Continuous {
                variable,
                acts: Vec::new(),
                edges: Vec::new(),
            });
        }
        let output = &mut self.list[at];
        output.acts.push((step, condition));
        output.edges.extend(edges);
    }
}

/// Takes in the outputs, in the order in which they are worked out.
pub(super) fn arrange(net: &mut Net, outputs: Outputs) {
    let outputs = outputs.list;
    net.is_continuous = vec![false; net.variables.len()];
    let mut places = vec![None; net.variables.len()];
    let mut graph: DiGraph<usize, ()> = DiGraph::new();
    for (at, output) in outputs.iter().enumerate() {
        net.is_continuous[output.variable] = true;
        places[output.variable] = Some(graph.add_node(at));
    }
    for (at, output) in outputs.iter().enumerate() {
        for (_, condition) in &output.acts {
            condition.each_variable(&net.edges, &mut |variable| {
                if let Some(Some(place)) = places.get(variable) {
                    graph.add_edge(NodeIndex::new(at), *place, ());
                }
            });
        }
    }
    let mut outputs: Vec<Option<Continuous>> = outputs.into_iter().map(Some).collect();
    // What is pointed at comes first: what others depend on.
    net.continuous = tarjan_scc(&graph)
        .into_iter()
        .map(|circle| {
            let members = circle.into_iter().map(|node| graph[node]);
            members.filter_map(|at| outputs[at].take()).collect()
        })
        .collect();
}

/// Publishes every output that has continuous actions.
pub(super) fn publish(net: &Net, state: &mut State, now: u64) {
    let mut edges = vec![false; net.edges.len()];
    for circle in &net.continuous {
        let places = circle
            .iter()
            .flat_map(|output| output.edges.iter().copied());
        firing::sample(net, state, places, &mut edges, now);
        let view = state.view(&edges, now);
        let acts = |output: &Continuous| {
            let mut acts = output.acts.iter();
            acts.any(|(step, condition)| view.is_active(*step) && condition.holds(&view))
        };
        let values: Vec<bool> = circle.iter().map(acts).collect();
        for (output, acts) in circle.iter().zip(values) {
            let at = output.variable;
            state.values[at] = (acts || state.kept[at]).into();
        }
    }
}
