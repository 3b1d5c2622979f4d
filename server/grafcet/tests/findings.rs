//! What is said about a text: where, under which code, and how to mend it.

use grafcet::{Reading, read};
use source::LineIndex;

/// The findings, one a line: `line:column code "place" message`.
fn findings(text: &str) -> String {
    let lines = LineIndex::new(text.as_bytes());
    let found = read(text).diagnostics.into_iter().map(|found| {
        let at = lines.locate(text.as_bytes(), found.span.range().start);
        let place = &text[found.span.range()];
        format!(
            "{}:{} {} [{place}] {}",
            at.line, at.column, found.code, found.message
        )
    });
    found.collect::<Vec<_>>().join("\n")
}

fn check(text: &str, expected: &str) {
    let expected: Vec<&str> = expected.lines().map(str::trim).collect();
    assert_eq!(findings(text), expected.join("\n").trim());
}

/// The text with the fix of its first finding made.
fn mended(text: &str) -> String {
    let Reading { diagnostics, .. } = read(text);
    let fix = diagnostics[0].fix.as_ref().expect("a fix");
    let mut out = text.to_owned();
    for edit in fix.edits.iter().rev() {
        out.replace_range(edit.span.range(), &edit.text);
    }
    out
}

#[test]
fn every_error_spoils_its_own_line_only() {
    check(
        "Step p1, p2\nTransition t1, t2\nInput m\nMarking p1\nTransitions:\n\
         t1: p1* |- @p2\nt2: p2*m |- @p1\n",
        "6:9 G3001 [|-] rule t1 not understood: expected a name, `/` or `(`, found `|-`",
    );
}

#[test]
fn a_line_being_typed_takes_nothing_from_the_next() {
    check(
        "Step p1,\nTransition t1\nInput m\nMarking p1\nTransitions:\nt1: p1*m |-\n",
        "1:8 G3001 [,] Step list not understood: expected a name, found the end of the statement",
    );
}

#[test]
fn a_rule_needs_a_section() {
    check(
        "Step p1\nMarking p1\np1: |- R\n",
        "3:1 G3001 [p1] rule p1 not understood: expected `Transitions:`, `Steps:`, \
         `Environment:` or `Never:` before the first rule",
    );
}

#[test]
fn a_forgotten_comma_is_not_an_address() {
    check(
        "Input s ls1\n",
        "1:9 G3001 [ls1] Input list not understood: expected `,`, the end of the line, or an \
         address: `%I0`, or any other in quotes, found `ls1`",
    );
}

#[test]
fn undeclared_names_are_reported_where_they_stand_and_can_be_declared() {
    let text = "Step p1\nTransition t1\nInput a\nMarking p1\nTransitions:\nt1: p1*q |- @p1\n";
    check(
        text,
        "6:8 G3002 [q] q is not declared as an input, an output, an internal variable or a step",
    );
    assert_eq!(mended(text), text.replace("Input a", "Input a, q"));
}

#[test]
fn an_undeclared_step_is_declared_in_its_part() {
    let text = "Step p1\nMarking p1\n\nPartial G1\nStep p2  // waits\nTransition t1\n\
                Transitions:\nt1: p2 |- @p3\n";
    check(text, "8:12 G3002 [p3] p3 is not declared as a step");
    assert_eq!(
        mended(text),
        text.replace("// waits\n", "// waits\nStep p3\n")
    );
}

#[test]
fn addresses_and_steps_of_instances_need_no_declaration() {
    check(
        "Step p1\nTransition t1\nInstance d1 of D\nMarking p1\nTransitions:\n\
         t1: p1*%M3*d1.E0 |- @p1\nReusable D\nStep E0\n",
        "",
    );
}

#[test]
fn a_name_means_one_thing() {
    check(
        "Step p1, a\nInput a\nMarking p1\nTransition t1\nTransitions:\nt1: p1*a |- @p1\n\
         t1: p1 |-\n",
        "2:7 G3003 [a] a is declared already; this declaration does not count\n\
         7:1 G3003 [t1] transition t1 has a rule already; this one does not count",
    );
}

#[test]
fn parameters_belong_to_their_part() {
    check(
        "Step p1\nMarking p1\nReusable A(x)\nReusable B(x)\nSteps:\np1: |- x\n",
        "",
    );
}

#[test]
fn a_grafcet_in_which_nothing_can_happen_is_reported() {
    let text = "Step p1, p2\nTransition t1\nTransitions:\nt1: p1 |- @p2\n";
    check(
        text,
        "1:6 G3004 [p1] no step is active at the start, so nothing can ever happen",
    );
    assert_eq!(
        mended(text),
        "Step p1, p2\nTransition t1\nMarking p1\nTransitions:\nt1: p1 |- @p2\n"
    );
}

#[test]
fn a_source_transition_starts_a_grafcet() {
    check("Step p1\nTransition t1\nTransitions:\nt1: 1 |- @p1\n", "");
}

#[test]
fn a_declared_transition_wants_a_rule() {
    check(
        "Step p1\nMarking p1\nTransition t1\n",
        "3:12 G3005 [t1] transition t1 has no rule",
    );
}

#[test]
fn decisions_must_be_understood() {
    check(
        "//! accept v1 -> v2 &\n//! forget v1\n//! keep t3\n",
        "1:1 G3104 [//! accept v1 -> v2 &] decision not understood: expected the name of a state, found the end of the statement\n\
         2:5 G3104 [forget] decision not understood: expected `accept`, `reject`, `initial`, `keep` or `end`, found `forget`",
    );
}

#[test]
fn a_decision_after_something_else_would_go_unheard() {
    check(
        "Step p1  //! accept v1 -> v2\nMarking p1\n",
        "1:10 G3104 [//! accept v1 -> v2] a decision on the line of something else is a plain comment",
    );
}

#[test]
fn instances_give_a_name_for_each_parameter() {
    check(
        "Step p1\nMarking p1\nInput a\nInstance d1 of D(a), d2 of P\nReusable D(x, y)\nPartial P\n",
        "4:10 G3001 [d1 of D(a)] D takes 2 names, and 1 are given\n\
         4:22 G3002 [d2 of P] P is not declared as a reusable grafcet",
    );
}

#[test]
fn deep_nesting_is_refused_and_does_no_harm() {
    let deep = "(".repeat(100_000);
    let text = format!("Never:\nn1: {deep}\nEnvironment:\ne1: 1 |- {deep}\n");
    let found = findings(&text);
    assert_eq!(found.matches("nests deeper than").count(), 2, "{found}");
}
