use crate::completion::tests::in_spec;
use crate::next::tests::TANK;

const HEAD: &str = "\
Step X1 for v1 // Fill
Step \"my step\" for v2
Transition t1, t2
Input s
Output v1

Transitions:
t1: X1*s |- @\"my step\"
";

#[track_caller]
fn check(text: &str, replaced: &str, first: &[&str]) {
    let (found, typed) = in_spec(TANK, text);
    let found: Vec<&str> = found.iter().map(String::as_str).take(first.len()).collect();
    assert_eq!((found.as_slice(), &*typed), (first, replaced));
}

#[test]
fn a_line_begins_with_what_is_open() {
    check("$0", "", &["//! accept v1 -> v2", "Step", "Transition"]);
    check(
        &format!("{HEAD}$0"),
        "",
        &["//! accept v1 -> v2", "t2: ", "Step"],
    );
}

#[test]
fn a_decision_goes_on_with_what_may_follow() {
    check(
        "//! acc$0",
        "//! acc",
        &["//! accept v1 -> v2", "//! accept ", "//! reject "],
    );
    check("//! accept v1 -> $0", "", &["v2"]);
    check("//! accept $0", "", &["v1", "v2"]);
    check("//! accept v1$0", "v1", &["v1", "v2"]);
    check("//! initial v$0", "v", &["v1", "v2"]);
    check(&format!("{HEAD}//! keep $0"), "", &["t1", "t2"]);
    check("// accept $0", "", &[]);
}

#[test]
fn a_step_stands_for_a_state() {
    check("Step X1 for $0", "", &["v1", "v2"]);
    check("Step X1 $0", "", &["for"]);
    check(&format!("{HEAD}\nMarking $0"), "", &["X1", "\"my step\""]);
}

#[test]
fn an_input_is_one_that_is_not_declared_yet() {
    check("Input s, $0", "", &["ls2", "ls3", "v1"]);
    check("Input s\nInput $0", "", &["ls2", "ls3", "v1"]);
}

#[test]
fn a_rule_leads_from_steps_to_steps() {
    check(
        &format!("{HEAD}t2: $0"),
        "",
        &["X1", "\"my step\"", "s", "v1", "ls2"],
    );
    check(&format!("{HEAD}t2: X1*$0"), "", &["s", "v1", "ls2"]);
    check(&format!("{HEAD}t2: X1 |- $0"), "", &["@X1", "@\"my step\""]);
    check(&format!("{HEAD}t2: X1 |- @$0"), "", &["X1", "\"my step\""]);
}

#[test]
fn an_action_writes_an_output() {
    check(
        &format!("{HEAD}Steps:\n$0"),
        "",
        &["//! accept v1 -> v2", "X1: "],
    );
    check(
        &format!("{HEAD}Steps:\nX1: |- $0"),
        "",
        &["v1", "set ", "reset "],
    );
    check(
        &format!("{HEAD}Steps:\nX1: |- v1 $0"),
        "",
        &["after ", "until "],
    );
    check(
        &format!("{HEAD}Steps:\nX1: |- set v1 on $0"),
        "",
        &["activation", "deactivation"],
    );
}
