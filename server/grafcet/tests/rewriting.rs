//! The spec beside the ladder is the only state of a conversion: what a person
//! wrote stays, and only what has to change does.

use grafcet::{Spec, read, rewrite};

/// Rewrites `text` to say what `wanted` says.
fn check(text: &str, wanted: &str, expected: &str) {
    let target = read(wanted).spec;
    let result = rewrite(text, &target);
    assert_eq!(result, expected);
    assert!(read(&result).spec.says_the_same(&target));
}

const TEXT: &str = "\
// Filling, by hand.
Step X0, Xv1   // both
Step Xv2 for v2 // Drain
Transition t1,t2
Input s   %I0 // Start
Marking X0

Transitions:
// the operator starts it
t1:   X0 * s    |- @Xv1   // with the button
t2: Xv1*(ls2 + ls3) |- @X0

Steps:
Xv1: |- v1
";

/// What [`TEXT`] says, changed.
fn changed(change: impl FnOnce(&mut Spec)) -> String {
    let mut target = read(TEXT).spec;
    change(&mut target);
    let result = rewrite(TEXT, &target);
    assert!(read(&result).spec.says_the_same(&target), "{result}");
    result
}

#[test]
fn what_means_the_same_stays_as_it_was_written() {
    check(
        TEXT,
        "Step X0\nStep Xv1\nStep Xv2 for v2\nTransition t1, t2\nInput s %I0\nMarking X0\n\
         Transitions:\nt1: X0*s |- @Xv1\nt2: Xv1*(ls3 + /(/ls2*/ls3)) |- @X0\nSteps:\nXv1: |- v1\n",
        TEXT,
    );
}

#[test]
fn a_changed_rule_is_replaced_in_place_and_keeps_its_comments() {
    let result = changed(|spec| {
        spec.grafcet.chart.transitions[0].receptivity = logic::Expr::variable("go");
    });
    assert_eq!(
        result,
        TEXT.replace("X0 * s    |-", "X0*go |-")
            .replace("t1:   ", "t1: ")
    );
}

#[test]
fn a_rule_that_vanishes_takes_its_own_comment_along_and_no_other() {
    let result = changed(|spec| {
        spec.grafcet.chart.transitions.remove(0);
    });
    let expected = TEXT
        .replace("t1:   X0 * s    |- @Xv1   // with the button\n", "")
        .replace("Transition t1,t2", "Transition t2");
    assert_eq!(result, expected);
}

#[test]
fn new_rules_come_at_the_end_of_their_section() {
    let result = changed(|spec| {
        let chart = &mut spec.grafcet.chart;
        let rule = grafcet::Transition::new("t3", "X0", "Xv2", logic::Expr::variable("s"));
        chart.transitions.push(rule);
        chart.actions.push(grafcet::Action::continuous("Xv2", "v2"));
    });
    let expected = TEXT
        .replace("t1,t2", "t1,t2, t3")
        .replace("|- @X0\n", "|- @X0\nt3: X0*s |- @Xv2\n")
        .replace("Xv1: |- v1\n", "Xv1: |- v1\nXv2: |- v2\n");
    assert_eq!(result, expected);
}

#[test]
fn missing_sections_are_made() {
    check(
        "Step p1\n",
        "Step p1\nInput a\nMarking p1\nNever:\nn1: a\n//! reject v1 -> v4\n",
        "Step p1\nInput a\nMarking p1\n\nNever:\nn1: a\n\n//! reject v1 -> v4\n",
    );
}

#[test]
fn accepting_writes_one_line_and_taking_it_back_leaves_no_trace() {
    let before = format!("{TEXT}\n//! accept v1 -> v2 // seen\n");
    let decision: grafcet::Decision = grafcet::Verdict::Accept {
        from: "v2".into(),
        to: vec!["v3".into(), "Seq=10".into()],
    }
    .into();
    let mut target = read(&before).spec;
    target.decisions.push(decision);
    let after = rewrite(&before, &target);
    assert_eq!(after, format!("{before}//! accept v2 -> v3 & Seq=10\n"));
    target.decisions.pop();
    assert_eq!(rewrite(&after, &target), before);
}

#[test]
fn names_leave_and_join_lists_one_by_one() {
    check(
        "Step p1, p2, p3   // three\nInput a, b\nMarking p1, p2\n",
        "Step p1, p3, p4\nInput b, c\nMarking p1\n",
        "Step p1, p3   // three\nStep p4\nInput b\nInput c\nMarking p1\n",
    );
}

#[test]
fn a_list_over_several_lines_keeps_the_comments_of_what_stays() {
    check(
        "Input s %I0,  // Start\n      ls1 %I1,  // low\n      ls2 %I2   // high\n",
        "Input s %I0\nInput ls2 %I3 // higher\n",
        "Input s %I0,  // Start\n      ls2 %I3   // higher\n",
    );
    check(
        "Input s %I0,  // Start\n      ls1 %I1,  // low\n      ls2 %I2   // high\n",
        "Input s %I0\n",
        "Input s %I0  // Start\n",
    );
}

#[test]
fn a_comment_that_is_wanted_replaces_the_one_there() {
    check(
        "Step p1 // old\nStep p2, p3\nMarking p1\n",
        "Step p1 // new\nStep p2\nStep p3 // three\nMarking p1\n",
        "Step p1 // new\nStep p2\nStep p3  // three\nMarking p1\n",
    );
}

#[test]
fn what_was_not_understood_stays() {
    let text =
        "Step p1\nMarking p1\nTransitions:\nt1: p1* |- oops\n\nstray words\n//! accept a ->\n";
    check(text, "Step p1\nMarking p1\n", text);
    check(
        text,
        "",
        "Transitions:\nt1: p1* |- oops\n\nstray words\n//! accept a ->\n",
    );
}

#[test]
fn line_ends_and_byte_order_mark_stay() {
    check(
        "\u{feff}Step p1\r\nMarking p1\r\n",
        "Step p1\nStep p2 for v2\nMarking p1\nTransition t1\nTransitions:\nt1: p1 |- @p2\n",
        "\u{feff}Step p1\r\nStep p2 for v2\r\nTransition t1\r\nMarking p1\r\n\r\n\
         Transitions:\r\nt1: p1 |- @p2\r\n",
    );
}

#[test]
fn a_name_that_becomes_a_step_changes_what_a_rule_means() {
    // Left alone, the rule would now name p9 as a step before it.
    let mut target =
        read("Step p1\nInput p9\nTransition t1\nMarking p1\nTransitions:\nt1: p9*a |- @p1\n").spec;
    target.grafcet.inputs.clear();
    target.grafcet.chart.steps.push(grafcet::Step::new("p9"));
    let text = "Step p1\nInput p9\nTransition t1\nMarking p1\nTransitions:\nt1: p9*a |- @p1\n";
    assert_eq!(
        rewrite(text, &target),
        "Step p1, p9\nTransition t1\nMarking p1\nTransitions:\nt1: (p9)*a |- @p1\n"
    );
}

#[test]
fn parts_come_and_go_whole() {
    let with_part = format!("{TEXT}\nPartial G1\nStep X20\nMarking X20\n\nSteps:\nX20: |- lamp\n");
    let target = read(&with_part).spec;
    assert_eq!(rewrite(TEXT, &target), with_part);
    assert_eq!(rewrite(&with_part, &read(TEXT).spec), format!("{TEXT}\n\n"));
}

#[test]
fn an_empty_text_becomes_the_canonical_one() {
    let target = read(TEXT).spec;
    assert_eq!(rewrite("", &target), grafcet::write(&target));
    assert_eq!(rewrite("\n\n", &Spec::default()), "\n\n");
}
