//! The layout of the rung notation: one fixture a case, the laid out text
//! beside it.

mod text;

use ladder::text::format;
use text::{fixture, program, said, without_marks};

/// Lays `name.ladder` out; `name.formatted.ladder` must come out.
#[track_caller]
fn check(name: &str) {
    let careless = without_marks(&fixture(&format!("{name}.ladder")));
    let formatted = format(&careless);
    assert_eq!(formatted.text, fixture(&format!("{name}.formatted.ladder")));
    assert_eq!(format(&formatted.text).text, formatted.text);
    assert_eq!(said(&program(&careless)), said(&program(&formatted.text)));
}

#[test]
fn careless_texts_come_out_in_columns() {
    check("ladder/layout");
}

#[test]
fn everything_keeps_its_meaning() {
    check("ladder/everything");
}

#[test]
fn the_fixtures_of_the_project_are_laid_out_already() {
    let text = fixture("neutralization/neutralization.ladder");
    let formatted = format(&text);
    assert_eq!(formatted.text, text);
    assert_eq!(formatted.left, []);
}

#[test]
fn a_statement_that_breaks_the_grammar_is_left_byte_for_byte() {
    let broken = "\t rung:  s   t ->\tv1 //  why \n   // and\t\n  * u   ";
    let text = format!("rung:a->b\n{broken}\n\n\nrung:c->d");
    let formatted = format(&text);
    assert_eq!(
        formatted.text,
        format!("rung: a -> b\n{broken}\n\nrung: c -> d\n")
    );
    let left: Vec<_> = formatted
        .left
        .iter()
        .map(|span| &text[span.range()])
        .collect();
    assert_eq!(left, [broken.trim()]);
}

#[test]
fn the_line_ends_that_prevail_stay_and_so_does_the_byte_order_mark() {
    assert_eq!(
        format("\u{feff}rung:a->b\r\n\r\nrung:c->d\n").text,
        "\u{feff}rung: a -> b\r\n\r\nrung: c -> d\r\n"
    );
    assert_eq!(
        format("rung:a->b\n\rrung:c->d").text,
        "rung: a -> b\n\nrung: c -> d\n"
    );
    assert_eq!(format("").text, "");
    assert_eq!(format(" \n\n").text, "");
}

#[test]
fn places_of_what_was_left_count_the_byte_order_mark() {
    let text = "\u{feff}rung: * -> v1";
    let formatted = format(text);
    assert_eq!(formatted.text, format!("{text}\n"));
    let left: Vec<_> = formatted
        .left
        .iter()
        .map(|span| &text[span.range()])
        .collect();
    assert_eq!(left, ["rung: * -> v1"]);
}

#[test]
fn a_variable_called_as_a_keyword_gets_quotes_where_a_line_begins_with_it() {
    let long = "a_long_name_for_a_coil_that_is_driven_somewhere";
    let text = format!("rung: input -> {long}_1, {long}_2, output");
    let formatted = format(&text).text;
    assert_eq!(
        formatted,
        format!("rung:\n    \"input\"\n    -> {long}_1,\n       {long}_2,\n       \"output\"\n")
    );
}
