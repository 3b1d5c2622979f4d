//! Guards of real rungs against brute force.

use logic::Budget;

use crate::real_files::{RealFile, drawings, plcopen, rockwell};
use crate::valuations::{Tally, judge};

/// Valuations tried on a rung with too many atoms to try all.
const SAMPLES: usize = 500;

fn judge_all(files: &[RealFile]) {
    if files.is_empty() {
        return;
    }
    let mut tally = Tally::default();
    for file in files {
        for (_, rung) in file.reading.program.rungs() {
            tally += judge(&rung.network, SAMPLES, &Budget::default());
        }
    }
    println!("{} files: {tally:?}", files.len());
    assert!(tally.networks > 0 && tally.valuations > tally.networks);
    assert_eq!(tally.too_large, 0);
}

#[test]
fn power_on_every_rung_of_rockwell_files_is_what_an_interpreter_finds() {
    judge_all(rockwell());
}

#[test]
fn power_on_every_rung_of_plcopen_files_is_what_an_interpreter_finds() {
    judge_all(plcopen());
}

#[test]
fn power_on_every_rung_of_drawings_is_what_an_interpreter_finds() {
    judge_all(drawings());
}
