//! The peak memory of everything from bytes to suggestions, each size in a
//! process of its own.

use std::process::Command;

use bench::memory::peak;
use bench::plant::plant;
use logic::Budget;

use super::{Aim, Row};
use crate::CHILD;

/// The aim for ten thousand rungs, in megabytes.
const MOST: f64 = 100.0;

/// A row for each size; none where the system does not tell the peak.
pub fn rows() -> Vec<Row> {
    let peaks = [1_000, 10_000].map(of_child);
    let [Some(small), Some(large)] = peaks else {
        return Vec::new();
    };
    let megabytes = |bytes: usize| bytes as f64 / 1e6;
    let is = megabytes(large);
    vec![Row {
        what: "peak memory, bytes to suggestions, 10,000 rungs".into(),
        against: "itself, 1,000 rungs".into(),
        ours: format!("{is:.1} MB"),
        peer: format!("{:.1} MB", megabytes(small)),
        ratio: format!("{:.2}", large as f64 / small as f64),
        aim: Aim::Most {
            limit: MOST,
            is,
            unit: " MB",
        },
    }]
}

fn of_child(rungs: usize) -> Option<usize> {
    let own = std::env::current_exe().ok()?;
    let run = Command::new(own).args([CHILD, &rungs.to_string()]).output();
    let text = String::from_utf8(run.ok()?.stdout).ok()?;
    text.trim().parse().ok().filter(|peak| *peak > 0)
}

/// What the child does: everything once, and then looks at its peak.
pub fn of_this_process(rungs: usize) -> Option<usize> {
    let text = plant(rungs);
    let reading = ladder::read(text.as_bytes());
    let analysis = recovery::analyse(&reading.program, &Budget::default());
    let peak = peak();
    std::hint::black_box(analysis);
    peak
}
