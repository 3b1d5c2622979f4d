//! Documents that are made from the program stay true. `UPDATE=1` rewrites
//! them.

mod links;

use std::fmt::Write;

use end_to_end::Gradus;

/// Compares a document with what it should be.
#[track_caller]
fn assert_document(relative: &str, expected: &str) {
    let path = end_to_end::path(relative);
    if end_to_end::update_is_asked_for() {
        std::fs::write(&path, expected).expect("a document");
    }
    let written = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(
        written == expected,
        "{relative} is out of date; `UPDATE=1 cargo test -p gradus --test documents` rewrites it"
    );
}

fn answer(arguments: &[&str]) -> String {
    let ended = Gradus::new(env!("CARGO_BIN_EXE_gradus")).run(arguments);
    assert_eq!(ended.status, Some(0), "{}", ended.aside);
    ended.answer
}

#[test]
fn the_command_line_page_is_the_help_of_every_command() {
    assert_document("docs/cli.md", &answer(&["manual", "--format", "markdown"]));
}

#[test]
fn the_diagnostics_page_lists_every_code() {
    let all: serde_json::Value =
        serde_json::from_str(&answer(&["explain", "--json"])).expect("JSON");
    let mut page = String::from(
        "# Diagnostics\n\n\
         Every finding has a code that never changes its meaning. The first digit says what it is about:\n\
         1 the text of a ladder, 2 its meaning, 3 a spec, 4 files, 5 a scenario. `gradus explain CODE` prints the page.\n\n\
         | code | severity | finding |\n|---|---|---|\n",
    );
    for entry in all["codes"].as_array().expect("a list") {
        let word = |key: &str| entry[key].as_str().expect("a text");
        let (code, severity, title) = (word("code"), word("severity"), word("title"));
        // Writing into a string cannot fail.
        let _ = writeln!(
            page,
            "| [{code}](diagnostics/{code}.md) | {severity} | {title} |"
        );
    }
    assert_document("docs/diagnostics.md", &page);
}
