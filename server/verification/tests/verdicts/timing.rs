//! The two timings, time, and what is left free.

use verification::{Reason, Timing, Verdict};

use crate::{assert_told, told, verified};

/// Two steps whose transition bits stand in rungs of their own, below: the
/// ladder moves a scan after its grafcet.
const BITS: &str = "\
program Bits
input go
output lamp
rung: y1 -> reset x0, set x1
rung: y2 -> reset x1, set x0
rung: /x1*/x0 -> set x0
rung: x0*go -> y1
rung: x1*/go -> y2
rung: x1 -> lamp
";

const STEPS: &str = "\
Step X0, X1
Transition t1, t2
Input go
Output lamp
Marking X0
Transitions:
t1: X0*go |- @X1
t2: X1*/go |- @X0
Steps:
X1: |- lamp
";

#[test]
fn transition_bits_move_one_scan_late_and_agree_when_both_are_settled() {
    let scan = verified(BITS, STEPS, Timing::Scan);
    assert_told(&scan.verdict, "go | - | lamp\ndiffer: lamp");
    let settled = verified(BITS, STEPS, Timing::Settled);
    assert_told(&settled.verdict, "equivalent");
}

#[test]
fn an_oscillator_never_settles() {
    let ladder = "program P\ninput a\noutput q\nrung: a*/q -> q\n";
    let spec = "Step X0\nTransition t\nInput a\nOutput q\nMarking X0\nTransitions:\nt: X0*a |- @X0\nSteps:\nX0: a |- q\n";
    let found = verified(ladder, spec, Timing::Settled);
    assert_told(&found.verdict, "a | q | q\nnever rests");
}

#[test]
fn a_grafcet_without_a_stable_situation_is_no_spec_of_anything() {
    let spec = STEPS.replace("t2: X1*/go", "t2: X1*go");
    let found = verified(BITS, &spec, Timing::Scan);
    let told = told(&found.verdict);
    assert!(
        told.ends_with("never becomes stable: t1, t2, over and over (steps X0, X1)"),
        "{told}"
    );
}

#[test]
fn an_output_that_the_spec_declares_and_never_writes_is_off_there() {
    let ladder = "program P\ninput a\noutput q\noutput r\nrung: a -> q\nrung: a -> r\n";
    let spec = "Step X0\nInput a\nOutput q, r\nMarking X0\nSteps:\nX0: a |- q\n";
    let found = verified(ladder, spec, Timing::Scan);
    assert_told(&found.verdict, "a | q r | q\ndiffer: r");
}

#[test]
fn so_many_evolutions_as_a_scan_takes_are_followed() {
    let mut spec = String::from("Step ");
    let steps: Vec<String> = (0..20).map(|at| format!("X{at}")).collect();
    spec += &steps.join(", ");
    let transitions: Vec<String> = (1..20).map(|at| format!("t{at}")).collect();
    spec += &format!(
        "\nTransition {}\nInput a\nOutput q\nMarking X0\nTransitions:\n",
        transitions.join(", ")
    );
    for at in 1..20 {
        spec += &format!("t{at}: X{}*a |- @X{at}\n", at - 1);
    }
    spec += "Steps:\nX19: |- q\n";
    let ladder = "program P\ninput a\noutput q\nrung: a + q -> q\n";
    assert_told(&verified(ladder, &spec, Timing::Scan).verdict, "equivalent");
    let early = spec.replace("X19: |- q", "X18: |- q");
    assert_told(
        &verified(ladder, &early, Timing::Scan).verdict,
        "a | q | -\ndiffer: q",
    );
}

#[test]
fn a_timer_runs_out_when_it_can_and_the_grafcet_reads_it_from_the_ladder() {
    let ladder = "\
program P
input go
output lamp
rung: go -> TON(t1, 5s)
rung: t1.Q -> lamp
";
    let spec = |receptivity: &str| {
        format!(
            "Step X0, X1\nTransition t, u\nInput go, t1.Q\nOutput lamp\nMarking X0\nTransitions:\n\
             t: X0*{receptivity} |- @X1\nu: X1*/t1.Q |- @X0\nSteps:\nX1: |- lamp\n"
        )
    };
    let found = verified(ladder, &spec("t1.Q"), Timing::Scan);
    assert_told(&found.verdict, "equivalent");
    assert_eq!(found.free.len(), 1);
    // It cannot run out in the scan that starts it.
    let found = verified(ladder, &spec("go*t1.Q*rise(go)"), Timing::Scan);
    assert_told(
        &found.verdict,
        "go | - | -\n5000 ms go | lamp | -\ndiffer: lamp",
    );
}

#[test]
fn the_time_of_a_step_is_free_where_nothing_else_says_it() {
    let ladder = "program P\ninput a\noutput q\nrung: a -> TON(t1, 2s)\nrung: t1.Q -> q\n";
    let spec = |time: &str| {
        format!(
            "Step X0, X1\nTransition t, u\nInput a\nOutput q\nMarking X0\nTransitions:\nt: X0*a |- @X1\nu: X1*/a |- @X0\nSteps:\nX1: {time}/X1 |- q\n"
        )
    };
    // Both count two seconds, and nothing here knows that they are the same.
    let found = verified(ladder, &spec("2s"), Timing::Scan);
    assert!(
        matches!(
            found.verdict,
            Verdict::Unknown {
                why: Reason::Unconfirmed,
                ..
            }
        ),
        "{}",
        told(&found.verdict)
    );
    // One second is another time, and that can be shown.
    let found = verified(ladder, &spec("1s"), Timing::Scan);
    assert_told(&found.verdict, "a | - | -\n1000 ms a | - | q\ndiffer: q");
}

#[test]
fn a_step_register_is_followed_value_by_value() {
    let ladder = "\
program P
input go
output a
output b
internal R : INT
rung: R = 0 * go -> R := 10
rung: R = 10 * /go -> R := 20
rung: R = 20 * go -> R := 0
rung: R = 10 -> a
rung: R = 20 -> b
";
    let spec = "Step X0, X1, X2\nTransition t, u, v\nInput go\nOutput a, b\nMarking X0\nTransitions:\n\
        t: X0*go |- @X1\nu: X1*/go |- @X2\nv: X2*go |- @X0\nSteps:\nX1: |- a\nX2: |- b\n";
    // The grafcet leaves X2 for X0 and goes on at once; the ladder waits a scan.
    assert_told(
        &verified(ladder, spec, Timing::Scan).verdict,
        "go | a | a\n- | b | b\ngo | - | a\ndiffer: a",
    );
    // With its rung above the others the ladder goes on at once too.
    let last = "rung: R = 20 * go -> R := 0\n";
    let moved = ladder
        .replace(last, "")
        .replace("rung: R = 0", &format!("{last}rung: R = 0"));
    assert_told(&verified(&moved, spec, Timing::Scan).verdict, "equivalent");
}

#[test]
fn a_number_that_is_compared_takes_the_values_that_can_be_told_apart() {
    let ladder = "program P\ninput Level : INT\noutput q\nrung: Level > 50 -> q\n";
    let spec = "Step X0\nTransition t\nInput Level\nOutput q\nMarking X0\nTransitions:\nt: X0*Level > 0 |- @X0\nSteps:\nX0: Level > 60 |- q\n";
    assert_told(
        &verified(ladder, spec, Timing::Scan).verdict,
        "Level=51 | q | -\ndiffer: q",
    );
    let same = spec.replace("60", "50");
    assert_told(&verified(ladder, &same, Timing::Scan).verdict, "equivalent");
}

#[test]
fn what_is_not_compared_is_told() {
    let ladder = "program P\ninput a\noutput q\noutput r\nrung: a -> q\nrung: /a -> r\n";
    let spec = |outputs: &str| {
        format!(
            "Step X0\nTransition t\nInput a\nOutput {outputs}\nMarking X0\nTransitions:\nt: X0*a |- @X0\nSteps:\nX0: a |- q\nX0: |- s\n"
        )
    };
    let found = verified(ladder, &spec("q, s"), Timing::Scan);
    assert_told(&found.verdict, "equivalent");
    assert_eq!(
        (found.missing, found.absent),
        (vec!["s".into()], vec!["r".into()])
    );
    let found = verified(
        "program P\ninput a\noutput p\nrung: a -> p\n",
        &spec("q, s"),
        Timing::Scan,
    );
    assert_told(&found.verdict, "unknown after 0: Nothing");
}

#[test]
fn a_bit_of_a_number_that_is_not_followed_is_the_same_on_both_sides() {
    let ladder =
        "program P\ninput w\ninput k\noutput o\noutput p\nrung: w.3 -> o\nrung: w > k -> p\n";
    let spec = "\
        Step X0\nTransition t0\nInput w.3\nOutput o\nMarking X0\n\n\
        Transitions:\nt0: X0*0 |- @X0\n\nSteps:\nX0: w.3 |- o\n";
    let found = verified(ladder, spec, Timing::Scan);
    assert_told(&found.verdict, "equivalent");
}
