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
