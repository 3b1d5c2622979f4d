//! Guards of real rungs against brute force.

use std::path::PathBuf;

use logic::Budget;

use crate::valuations::{Tally, judge};

/// Valuations tried on a rung with too many atoms to try all.
const SAMPLES: usize = 500;

/// The real files in a folder of the corpus, by name; none where there is no
/// corpus.
pub fn real_files(folder: &str) -> Vec<PathBuf> {
    let Some(corpus) = end_to_end::corpus() else {
        return Vec::new();
    };
    let entries = std::fs::read_dir(corpus.join(folder)).expect("a folder of the corpus");
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.expect("a file").path()).collect();
    files.sort();
    files
}

fn judge_all(folder: &str) {
    let mut tally = Tally::default();
    let files = real_files(folder);
    for file in &files {
        let bytes = std::fs::read(file).expect("a real file can be read");
        let reading = ladder::read(&bytes);
        for (_, rung) in reading.program.rungs() {
            tally += judge(&rung.network, SAMPLES, &Budget::default());
        }
    }
    if files.is_empty() {
        return;
    }
    println!("{folder}: {} files, {tally:?}", files.len());
    assert!(tally.networks > 0 && tally.valuations > tally.networks);
    assert_eq!(tally.too_large, 0);
}

#[test]
fn power_on_every_rung_of_rockwell_files_is_what_an_interpreter_finds() {
    judge_all("l5x");
}

#[test]
fn power_on_every_rung_of_plcopen_files_is_what_an_interpreter_finds() {
    judge_all("plcopen");
}

#[test]
fn power_on_every_rung_of_drawings_is_what_an_interpreter_finds() {
    judge_all("ascii");
}
