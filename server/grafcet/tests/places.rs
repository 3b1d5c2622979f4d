//! Where names stand: for hovers and for renaming.

use grafcet::{Places, Role, read};

const TEXT: &str = "\
Step p1, \"Drill up\" for Seq=10
Transition t1
Input m
Output R
Marking p1
Transitions:
t1: p1*(\"Drill up\" + m)*5s/p1 |- @\"Drill up\"
Steps:
p1: m |- R
Environment:
e1: m |- @m
//! accept Seq=10 -> v2 & v3
";

/// The places of the name at the first `mark` of the text, as they are
/// written with the bytes they start at.
fn places_of(mark: &str) -> (Role, Vec<(&'static str, usize)>) {
    let places = read(TEXT).places;
    let at = TEXT.find(mark).expect("the mark");
    let mention = places.mention_at(at).expect("a name");
    let all = places.same_as(mention).map(|place| {
        let range = place.span.range();
        (&TEXT[range.clone()], range.start)
    });
    (mention.role, all.collect())
}

fn starts(places: &[(&str, usize)]) -> Vec<usize> {
    places.iter().map(|(_, start)| *start).collect()
}

#[test]
fn a_step_is_found_as_step_and_as_variable() {
    let (role, places) = places_of("p1");
    assert_eq!(role, Role::Step);
    let expected: Vec<usize> = TEXT.match_indices("p1").map(|(at, _)| at).collect();
    assert_eq!(starts(&places), expected);
}

#[test]
fn quotes_belong_to_the_place_and_parentheses_do_not() {
    let (role, places) = places_of("\"Drill up\"");
    assert_eq!(role, Role::Step);
    assert!(places.iter().all(|(text, _)| *text == "\"Drill up\""));
    assert_eq!(places.len(), 3);
}

#[test]
fn a_variable_is_found_in_rules_and_under_the_next_scan() {
    let (role, places) = places_of("m\nOutput");
    assert_eq!((role, places.len()), (Role::Variable, 5));
}

#[test]
fn a_state_is_found_in_declarations_and_decisions() {
    let (role, places) = places_of("Seq=10");
    assert_eq!(role, Role::State);
    let expected: Vec<usize> = TEXT.match_indices("Seq=10").map(|(at, _)| at).collect();
    assert_eq!(starts(&places), expected);
}

#[test]
fn rules_have_their_label_their_span_and_their_lines() {
    let places: Places = read(TEXT).places;
    let rule = places.transition("t1").expect("t1");
    assert_eq!(
        &TEXT[rule.span.range()],
        "t1: p1*(\"Drill up\" + m)*5s/p1 |- @\"Drill up\""
    );
    assert!(TEXT[rule.lines.range()].ends_with('\n'));
    assert_eq!(places.rules.len(), 3);
    let decision = places.decisions[0];
    assert_eq!(&TEXT[decision.range()], "//! accept Seq=10 -> v2 & v3");
    assert!(places.declaration("e1", Role::Rule).is_some());
}

#[test]
fn rules_write_what_comes_after_them_and_read_the_rest() {
    let text = "\
Step p1, p2
Partial G1
Step q1
Transitions:
t1: p1*m |- @p2
Steps:
p1: p2 |- set R on m
p2: |- force G1{q1}
p2: |- n := n + 1
";
    let places = read(text).places;
    let written: Vec<&str> = places
        .mentions
        .iter()
        .filter(|mention| mention.written)
        .map(|mention| &text[mention.span.range()])
        .collect();
    assert_eq!(written, ["p2", "R", "G1", "q1", "n"]);
}

#[test]
fn sections_reach_to_their_last_rule_and_parts_to_their_last_line() {
    let text = "\
Step p1

Transitions:
t1: p1*m |- @p1
// about t2
t2: p1 |-

// about the part
Partial G1
Step q1
Transitions:

// the end
";
    let places = read(text).places;
    let found: Vec<(&str, bool, &str)> = places
        .sections
        .iter()
        .map(|it| (&*it.title, it.is_part, &text[it.span.range()]))
        .collect();
    assert_eq!(
        found,
        [
            (
                "Transitions",
                false,
                "Transitions:\nt1: p1*m |- @p1\n// about t2\nt2: p1 |-"
            ),
            (
                "G1",
                true,
                "Partial G1\nStep q1\nTransitions:\n\n// the end"
            ),
            ("Transitions", false, "Transitions:"),
        ]
    );
}
