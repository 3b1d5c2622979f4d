//! The guards of all real rungs, built by two libraries of decision diagrams.

use bench::diagrams::{Own, build};
use bench::guards::of_corpus;
use bench::measure::{in_turn, time};

use super::{Aim, Row};

const ROUNDS: usize = 9;

/// How many guards each library refuses, and the time for the others.
pub fn rows() -> Vec<Row> {
    let Some(guards) = of_corpus() else {
        return Vec::new();
    };
    let (rungs, peer) = (&guards.rungs, &guards.peer);
    let mut ours = || {
        let library = Own::default();
        time(|| {
            rungs
                .iter()
                .map(|rung| build(rung, &library))
                .collect::<Vec<_>>()
        })
    };
    let mut theirs = || {
        peer.forget();
        time(|| {
            rungs
                .iter()
                .map(|rung| build(rung, peer))
                .collect::<Vec<_>>()
        })
    };
    let mut rows = Vec::new();
    if let [ours, theirs] = in_turn(ROUNDS, &mut [&mut ours, &mut theirs])[..] {
        let what = format!(
            "building {} guards of {} real rungs",
            guards.measured(),
            rungs.len()
        );
        rows.push(Row::times(what, "OxiDD", (ours, theirs), None));
    }
    rows.push(Row {
        what: "nodes of these guards".into(),
        against: "OxiDD, which shares them".into(),
        ours: guards.nodes.to_string(),
        peer: guards.nodes_of_peer.to_string(),
        ratio: format!("{:.2}", guards.nodes as f64 / guards.nodes_of_peer as f64),
        aim: Aim::None,
    });
    rows.push(Row {
        what: format!("refused, of all {} guards", guards.all),
        against: "OxiDD".into(),
        ours: guards.refused.to_string(),
        peer: guards.refused_by_peer.to_string(),
        ratio: "-".into(),
        aim: Aim::None,
    });
    rows
}
