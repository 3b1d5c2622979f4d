//! Real programs of other people's, read where they lie (see
//! `end_to_end::corpus`): whatever they hold, the executable answers.

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
