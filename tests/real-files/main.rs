//! Real programs of other people's, read where they lie (see
//! `end_to_end::corpus`): whatever they hold, the executable answers.

use std::path::{Path, PathBuf};

use end_to_end::{Gradus, corpus};
use serde_json::Value;

#[test]
fn every_real_file_is_checked_and_every_finding_has_its_place() {
    let Some(corpus) = corpus() else { return };
    let gradus = Gradus::new(env!("CARGO_BIN_EXE_gradus"));
    let ended = gradus.run(&["check", "--json", &corpus.display().to_string()]);
    assert!(
        matches!(ended.status, Some(0 | 1)),
        "{:?}: {}",
        ended.status,
        ended.aside
    );
    let answer: Value = serde_json::from_str(&ended.answer).expect("one document");
    let found = answer["diagnostics"].as_array().expect("a list");
    assert!(
        !found.is_empty(),
        "the corpus is known to hold odd programs"
    );
    for finding in found {
        let file = finding["file"].as_str().expect("a file");
        let length = std::fs::metadata(file).expect("the file").len();
        let end = finding["span"]["end"].as_u64().expect("an offset");
        assert!(end <= length, "{file}: {finding}");
    }
}

/// Larger files take minutes in a build without optimisation.
const MOST_BYTES: u64 = 300_000;

/// The real files that are not large.
fn small_files(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).expect("a folder").flatten() {
            let path = entry.path();
            if path.is_dir() {
                folders.push(path);
            } else if entry.metadata().expect("metadata").len() <= MOST_BYTES {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}

#[test]
fn the_spec_of_every_real_ladder_reads_back_and_agrees_with_it() {
    let Some(corpus) = corpus() else { return };
    let gradus = Gradus::new(env!("CARGO_BIN_EXE_gradus"));
    let mut converted = 0;
    for (at, path) in small_files(&corpus).iter().enumerate() {
        let ladder = path.to_str().expect("a readable path");
        let spec = format!("{at}.grafcet");
        let convert = |more: &[&str]| {
            let ended = gradus.run(&[&["convert", ladder, "-o", &spec, "--json"], more].concat());
            assert!(
                matches!(ended.status, Some(0..=2)),
                "{ladder}: {}",
                ended.aside
            );
            ended
        };
        let first = convert(&["--accept", "handover"]);
        if first.status == Some(2) {
            // No ladder: nothing may have been written.
            assert!(!gradus.folder().join(&spec).exists(), "{ladder}");
            continue;
        }
        converted += 1;
        let again = convert(&[]);
        let answer: Value = serde_json::from_str(&again.answer).expect("one document");
        assert_eq!(answer["state"], "unchanged", "{ladder}");
        let no_finding = Value::Array(Vec::new());
        assert_eq!(answer["diagnostics"], no_finding, "{ladder}");
    }
    assert!(converted > 50, "only {converted} ladders were found");
}
