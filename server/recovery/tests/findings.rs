//! What conditions reveal, drawn under the source.
//!
//! Every `fixtures/findings/NAME.ladder` has `NAME.txt` beside it: the ladder
//! with its findings under the lines they speak of. Adding a test is adding a
//! file; `UPDATE=1` writes what comes out.

use std::fmt::Write;

use logic::Budget;
use source::{Diagnostic, LineIndex, Span};

/// The source with a line under each line that a finding speaks of.
fn drawn(text: &str, diagnostics: &[Diagnostic]) -> String {
    let index = LineIndex::new(text.as_bytes());
    let locate = |span: Span| index.locate(text.as_bytes(), span.start as usize);
    let mut drawn = String::new();
    for (at, line) in text.lines().enumerate() {
        writeln!(drawn, "{line}").expect("writes to a string");
        for diagnostic in diagnostics {
            let mut places = vec![(
                diagnostic.span,
                format!(
                    "{} {}: {}",
                    diagnostic.severity.word(),
                    diagnostic.code,
                    diagnostic.message
                ),
            )];
            places.extend(
                diagnostic
                    .related
                    .iter()
                    .map(|it| (it.span, format!("{}, see: {}", diagnostic.code, it.message))),
            );
            for (span, message) in places {
                let place = locate(span);
                if place.line == at + 1 {
                    let indent = " ".repeat(place.column - 1);
                    let mark = "^".repeat(text[span.range()].chars().count().max(1));
                    writeln!(drawn, "{indent}{mark} {message}").expect("writes to a string");
                }
            }
        }
    }
    drawn
}

#[test]
fn findings_are_drawn_under_the_rungs_they_speak_of() {
    let folder = end_to_end::path("fixtures/findings");
    let entries = std::fs::read_dir(&folder).expect("the folder of fixtures");
    let mut paths: Vec<_> = entries
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.extension().is_some_and(|it| it == "ladder"))
        .collect();
    paths.sort();
    assert!(!paths.is_empty(), "no fixtures in {}", folder.display());
    for path in paths {
        let text = std::fs::read_to_string(&path).expect("a readable fixture");
        let reading = ladder::read(text.as_bytes());
        let budget = Budget::default();
        let conditions = recovery::conditions::conditions(&reading.program, &budget);
        let mut found = reading.diagnostics.clone();
        found.extend(recovery::findings::findings(
            &reading.program,
            &conditions,
            &budget,
        ));
        let drawn = drawn(&text, &found);
        let expected = path.with_extension("txt");
        if end_to_end::update_is_asked_for() {
            std::fs::write(&expected, drawn).expect("a writable folder");
        } else {
            let expected = std::fs::read_to_string(&expected).expect("what must come out");
            assert_eq!(drawn, expected, "{}", path.display());
        }
    }
}

#[test]
fn of_many_hints_of_one_kind_the_first_are_told_and_the_others_counted() {
    let rungs: String = (0..9)
        .map(|at| format!("rung: q{at} -> y{at}\nrung: a{at} -> q{at}\nrung: q{at} -> z{at}\n"))
        .collect();
    let inputs: String = (0..9).map(|at| format!("input a{at}\n")).collect();
    let program = ladder::read(format!("{inputs}{rungs}").as_bytes()).program;
    let analysis = recovery::analyse(&program, &Budget::default());
    let told: Vec<String> = analysis
        .findings(2)
        .into_iter()
        .map(|it| it.message)
        .collect();
    assert_eq!(
        told,
        [
            "`q0` is read here before rung 1 of main writes it, and again after: the two see different scans",
            "`q1` is read here before rung 4 of main writes it, and again after: the two see different scans (and 7 more like it, which `gradus check --hints` lists)",
        ]
    );
    assert_eq!(analysis.findings(usize::MAX).len(), 9);
}
