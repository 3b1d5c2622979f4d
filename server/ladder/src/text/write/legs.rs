//! Arranges the outputs of a rung in legs: outputs behind the same condition
//! share it, in the order of solving.

use std::collections::HashMap;

use petgraph::graph::NodeIndex;

use super::cuts::{Cut, Cuts, TooTangled, is_output};
use super::part::{Part, always, series};
use crate::Network;

/// A condition and what it drives.
pub(super) struct Leg {
    /// From the leg around it to here.
    pub(super) condition: Part,
    /// What it drives.
    pub(super) drives: Vec<Driven>,
}

/// What a leg drives.
pub(super) enum Driven {
    /// An output.
    Output(NodeIndex),
    /// A leg, by its number.
    Leg(usize),
}

/// All legs of a network, the rung itself being the first.
pub(super) fn legs(network: &Network) -> Result<Vec<Leg>, TooTangled> {
    let mut cuts = Cuts::new(network);
    let mut legs = vec![Leg {
        condition: always(),
        drives: Vec::new(),
    }];
    // The legs that the next output may still join, with their cuts.
    let mut open: Vec<(Cut, usize)> = vec![(Cuts::rail(), 0)];
    let mut places: HashMap<Cut, usize> = HashMap::from([(Cuts::rail(), 0)]);
    for (at, element) in network.elements() {
        if !is_output(&element.kind) {
            continue;
        }
        let mut new = Vec::new();
        let mut cut = match cuts.feed(at) {
            Some(cut) if !cut.is_empty() => cut.clone(),
            // A condition that is no cut of its own: it shares nothing.
            _ => {
                new.push((vec![at], cuts.input(at, 0)?));
                Cuts::rail()
            }
        };
        let place = loop {
            if let Some(place) = places.get(&cut) {
                break *place;
            }
            let (before, condition) = cuts.before(&cut, 0)?;
            new.push((cut, condition));
            cut = before;
        };
        for (closed, _) in open.drain(place + 1..) {
            places.remove(&closed);
        }
        for (cut, condition) in new.into_iter().rev() {
            let number = legs.len();
            let around = open.last().map_or(0, |(_, leg)| *leg);
            legs[around].drives.push(Driven::Leg(number));
            legs.push(Leg {
                condition,
                drives: Vec::new(),
            });
            places.insert(cut.clone(), open.len());
            open.push((cut, number));
        }
        let last = open.last().map_or(0, |(_, leg)| *leg);
        legs[last].drives.push(Driven::Output(at));
    }
    if let [rung] = legs.as_mut_slice()
        && rung.drives.is_empty()
    {
        rung.condition = cuts.at_the_ends()?;
    }
    join(&mut legs);
    Ok(legs)
}

/// A leg that drives nothing but another leg is that leg with both conditions.
fn join(legs: &mut [Leg]) {
    // Inner legs have greater numbers, so they are joined already.
    for outer in (0..legs.len()).rev() {
        let [Driven::Leg(inner)] = legs[outer].drives.as_slice() else {
            continue;
        };
        let inner = *inner;
        let condition = std::mem::replace(&mut legs[inner].condition, always());
        let drives = std::mem::take(&mut legs[inner].drives);
        let outer = &mut legs[outer];
        let own = std::mem::replace(&mut outer.condition, always());
        outer.condition = series(own, condition);
        outer.drives = drives;
    }
}
