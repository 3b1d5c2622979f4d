//! Whether the text solves a rung in the order of its network.
//!
//! The notation solves a leg's condition right before what the leg drives. A
//! network may look at all its contacts first; that makes a difference where a
//! contact looks at what an earlier leg writes.

use std::collections::HashMap;

use petgraph::graph::NodeIndex;

use super::Lost;
use super::legs::{Driven, Leg};
use super::part::{Kind, Part};
use crate::Rung;

/// Contacts that the text looks at before or after a write, and the network
/// the other way round.
pub(super) fn changed(rung: &Rung, legs: &[Leg]) -> Vec<Lost> {
    let network = &rung.network;
    let mut writes: HashMap<&str, Vec<NodeIndex>> = HashMap::new();
    for (at, element) in network.elements() {
        for operand in element.kind.writes() {
            writes.entry(&operand.name).or_default().push(at);
        }
    }
    let mut written: HashMap<&str, usize> = HashMap::new();
    let mut lost = Vec::new();
    for at in order(legs) {
        let element = network.element(at);
        for operand in element.kind.reads() {
            let before = writes
                .get(&*operand.name)
                .map_or(0, |all| all.partition_point(|write| *write < at));
            if before != written.get(&*operand.name).copied().unwrap_or(0) {
                lost.push(Lost {
                    span: rung.place(element.within),
                    what: format!("at what moment of the scan `{}` is looked at", operand.name),
                });
            }
        }
        for operand in element.kind.writes() {
            *written.entry(&operand.name).or_default() += 1;
        }
    }
    lost
}

/// The elements in the order of the text.
fn order(legs: &[Leg]) -> Vec<NodeIndex> {
    enum Step<'l> {
        Leg(&'l Leg),
        Output(NodeIndex),
    }
    let mut all = Vec::new();
    let mut steps: Vec<Step<'_>> = legs.first().map(Step::Leg).into_iter().collect();
    while let Some(step) = steps.pop() {
        let leg = match step {
            Step::Output(at) => {
                all.push(at);
                continue;
            }
            Step::Leg(leg) => leg,
        };
        elements(&leg.condition, &mut all);
        for driven in leg.drives.iter().rev() {
            match driven {
                Driven::Output(at) => steps.push(Step::Output(*at)),
                Driven::Leg(number) => steps.extend(legs.get(*number).map(Step::Leg)),
            }
        }
    }
    all
}

fn elements(part: &Part, all: &mut Vec<NodeIndex>) {
    match &part.kind {
        Kind::Element(at) => all.push(*at),
        Kind::Variable(_) => {}
        Kind::Not(inner) | Kind::Edge(_, inner) => elements(inner, all),
        Kind::And(parts) => parts.iter().for_each(|part| elements(part, all)),
        Kind::Or(parts) => parts.iter().for_each(|part| elements(part, all)),
    }
}
