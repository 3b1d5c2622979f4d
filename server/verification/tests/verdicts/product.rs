//! What `convert --accept none` writes does what the ladder does.

use std::sync::Arc;

use ladder::Program;
use logic::Budget;
use proof::Limits;
use recovery::conversion::{Accept, decide, spec, unsaid};
use verification::{Refusal, Timing, Verdict, Verification, verify};

use crate::ladders::{Contacts, ladder};
use crate::program::Program as Random;
use crate::{assert_told, program, random, random_text, text, told};

/// The product form of a program, against it.
pub fn product(
    program: &Arc<Program>,
    limits: &Limits,
) -> Result<Verification, verification::Refusal> {
    let budget = Budget::default();
    let analysis = recovery::analyse(program, &budget);
    let decisions = decide(&analysis, &[], &Accept::None);
    let spec = spec(&analysis, &decisions, &budget);
    verify(program, &spec, Timing::Scan, limits)
}

#[test]
fn the_product_form_of_the_neutralization_needs_no_rule() {
    for ladder in ["ladder", "L5X", "xml"] {
        let text = text(&format!("fixtures/neutralization/neutralization.{ladder}"));
        let found = product(&program(&text), &Limits::default()).expect("a translation");
        assert_told(&found.verdict, "equivalent");
        assert_eq!((found.outputs.len(), found.missing.len()), (8, 0));
    }
}

/// The product form of a ladder as text, the verdict about it, and what it does
/// not say exactly.
fn judged(text: &str) -> Judged {
    let program = program(text);
    let budget = Budget::default();
    let analysis = recovery::analyse(&program, &budget);
    let spec = spec(&analysis, &[], &budget);
    let unsaid = unsaid(&analysis, &[], &budget);
    let limits = Limits {
        steps: 30_000_000,
        ..Limits::default()
    };
    Judged {
        verdict: verify(&program, &spec, Timing::Scan, &limits).map(|found| found.verdict),
        inexact: unsaid
            .iter()
            .map(|(name, why)| format!("{name}: {}", why.words()))
            .collect(),
        spec: grafcet::write(&spec),
    }
}

struct Judged {
    verdict: Result<Verdict, Refusal>,
    inexact: Vec<String>,
    spec: String,
}

/// Judges random ladders. The answer is how many there were of which all is
/// said exactly, and how many of these are proved.
fn judge(count: usize, mut ladder: impl FnMut(usize) -> String) -> [usize; 2] {
    let (mut exact, mut proved) = (0, 0);
    for number in 0..count {
        let text = ladder(number);
        let found = judged(&text);
        if !found.inexact.is_empty() {
            continue;
        }
        exact += 1;
        proved += usize::from(matches!(found.verdict, Ok(Verdict::Equivalent)));
        if let Ok(verdict @ Verdict::Different(_)) = &found.verdict {
            panic!("{}\n{text}\n{}", told(verdict), found.spec);
        }
    }
    [exact, proved]
}

#[test]
fn the_product_form_of_random_ladders_is_proved() {
    let mut random = random::Random::new(5);
    let found = judge(400, |_| ladder(&mut random, Contacts::Values));
    // Of two no coil is ever on, so that there is nothing to prove.
    assert_eq!(found, [400, 398]);
    let found = judge(400, |_| ladder(&mut random, Contacts::Edges));
    assert_eq!(found, [308, 308]);
}

#[test]
fn whatever_rungs_hold_the_product_form_differs_for_reasons_that_are_told() {
    let mut random = random::Random::new(6);
    let found = judge(300, |_| random_text::text(&Random::random(&mut random)));
    assert_eq!(found, [30, 25]);
    // The same with values for edges: calls, jumps, zones, timers and numbers.
    let found = judge(300, |_| {
        let text = random_text::text(&Random::random(&mut random));
        let text = text.replace("rise(", "(").replace("fall(", "(");
        text.replace("rising ", "").replace("falling ", "")
    });
    assert_eq!(found, [134, 117]);
}

/// Whether the product form of `ladder` has these rules and is proved.
#[track_caller]
fn assert_said(ladder: &str, rules: &str) {
    let found = judged(&format!("program P\n{ladder}"));
    let text = &found.spec;
    let start = text.find("Transitions:").or_else(|| text.find("Steps:"));
    assert_eq!(&text[start.unwrap_or(0)..], rules, "{text}");
    assert_told(&found.verdict.expect("a translation"), "equivalent");
    assert_eq!(found.inexact, Vec::<String>::new());
}

#[test]
fn a_rung_above_the_coil_that_it_looks_at_sees_it_a_scan_late() {
    assert_said(
        "input a\nrung: c -> d\nrung: a -> c\n",
        "\
Transitions:
c_was_starts: c_was_off*c |- @Xc_was
c_was_ends: Xc_was*/c |- @c_was_off

Steps:
Xc_was: |- d
Always: a |- c
",
    );
}

#[test]
fn a_rung_between_two_that_write_sees_what_the_first_has_written() {
    assert_said(
        "input start\ninput stop\nrung: start -> set w\nrung: w -> motor\nrung: stop -> reset w\n",
        "\
Transitions:
w_starts: w_off*start*/stop |- @Xw
w_ends: Xw*stop |- @w_off
w_was_starts: w_was_off*w |- @Xw_was
w_was_ends: Xw_was*/w |- @w_was_off

Steps:
Xw: |- w
Always: start + Xw_was |- motor
",
    );
}

#[test]
fn contacts_of_one_rung_see_a_coil_of_it_before_and_after() {
    assert_said(
        "input c\nrung: /q -> q, (q*c -> p)\n",
        "\
Transitions:
q_was_starts: q_was_off*q |- @Xq_was
q_was_ends: Xq_was*/q |- @q_was_off

Steps:
Always: /q |- q
Always: c*/Xq_was |- p
",
    );
}

#[test]
fn an_oscillator_reads_itself() {
    assert_said(
        "rung: /b -> b\n",
        "\
Steps:
Always: /b |- b
",
    );
}

#[test]
fn a_memory_that_another_would_lead_astray_has_no_steps() {
    // As `b` ends `x` the rung of `w` sees it off; a step of `w` would be
    // entered while that of `x` is still active.
    assert_said(
        "input a\ninput b\ninput c\nrung: (a + x)*/b -> x\nrung: (x + w)*/c -> w\n",
        "\
Transitions:
x_starts: x_off*a*/b |- @Xx
x_ends: Xx*b |- @x_off

Steps:
Always: Xx*/c + w*/c |- w
",
    );
}

#[test]
fn a_memory_is_not_led_astray_by_what_it_is_never_on_together_with() {
    assert_said(
        "input a\ninput b\ninput c\nrung: a + x*/b -> x\nrung: (c*/a + w)*/x -> w\n",
        "\
Transitions:
x_starts: x_off*a |- @Xx
x_ends: Xx*/a*b |- @x_off
w_starts: w_off*/Xx*/a*c |- @Xw
w_ends: Xw*(Xx) |- @w_off

Steps:
Xw: |- w
",
    );
}

#[test]
fn what_would_start_where_an_edge_is_over_has_no_steps() {
    assert_said(
        "input a\ninput b\nrung: /rise(a) + q*b -> q\n",
        "\
Steps:
Always: /rise(a) + q*b |- q
",
    );
}

#[test]
fn what_is_on_before_the_first_scan_is_so_in_the_spec() {
    assert_said(
        "input a\ninternal x : BOOL = 1\noutput l\nrung: x -> l\nrung: x*/a -> x\n",
        "\
Transitions:
x_ends: Xx*a |- @x_off
x_was_starts: x_was_off*x |- @Xx_was
x_was_ends: Xx_was*/x*begun |- @x_was_off

Steps:
Xx: |- x
Xx_was: |- l
Always: |- begun
",
    );
    assert_said(
        "output b : BOOL = 1\nrung: /b -> b\n",
        "\
Transitions:
First_ends: First*begun |-

Steps:
Always: /b*/First |- b
Always: |- begun
",
    );
}

#[test]
fn a_rung_above_a_timer_sees_its_output_a_scan_late() {
    assert_said(
        "input a\nrung: t.Q -> m\nrung: a -> TON(t, 1s)\n",
        "\
Steps:
Always: fall(t.Q) + t.Q*/rise(t.Q) |- m
",
    );
}

#[test]
fn an_output_that_repeats_states_of_rungs_below_it_keeps_its_value_by_itself() {
    assert_said(
        "input a\ninput b\ninput c\noutput f\nrung: x -> set f\nrung: y -> reset f\n\
         rung: (a + x)*/b -> x\nrung: (b + y)*/c -> y\n",
        "\
Transitions:
x_starts: x_off*a*/b |- @Xx
x_ends: Xx*b |- @x_off
y_starts: y_off*b*/c |- @Xy
y_ends: Xy*c |- @y_off
x_was_starts: x_was_off*x |- @Xx_was
x_was_ends: Xx_was*/x |- @x_was_off
y_was_starts: y_was_off*y |- @Xy_was
y_was_ends: Xy_was*/y |- @y_was_off

Steps:
Xx: |- x
Xy: |- y
Always: f*/Xy_was + Xx_was*/Xy_was |- f
",
    );
}

#[test]
fn what_is_not_said_exactly_is_told_with_the_reason() {
    let found = judged(
        "program P\ninput a\ninput b\nrung: a -> jump over\nrung: rise(b) -> q\nrung label over: b -> r\n",
    );
    assert_eq!(
        found.inexact,
        ["q: it sees an edge in a rung that is not always solved"]
    );
}

#[test]
fn a_number_of_the_last_scan_is_not_compared_with_one_of_the_plant() {
    let found = judged(
        "input n : INT\ninput k : INT\ninput a\nrung: m > n -> q\nrung: m > 4 -> p\nrung: a -> m := k\n",
    );
    assert_eq!(
        found.inexact,
        ["q: it compares `n` with a number of another scan"]
    );
}
