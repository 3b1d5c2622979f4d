//! Questions that are too large, and questions that somebody no longer asks.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use logic::Cancel;
use proof::Limits;
use verification::{Refusal, Timing, Verdict, Verification, verify};

use crate::{program, spec, text, told};

/// Rungs whose coils hold each other up: `settled`, each waits for the last.
fn chain(rungs: usize) -> String {
    let mut text = "program Chain\ninput i\noutput c0\nrung: i -> c0\n".to_owned();
    for rung in (1..rungs).rev() {
        text += &format!("rung: c{}*i + c{rung}*/i -> c{rung}\n", rung - 1);
    }
    text
}

/// Steps in a row, each left for the next while `i` is 1: one scan goes through
/// all of them. Beside them `c0` follows the input.
fn row(steps: usize) -> String {
    let list = |sign: &str, count: usize| {
        let names = (0..count).map(|at| format!("{sign}{at}"));
        names.collect::<Vec<String>>().join(", ")
    };
    let mut text = format!(
        "Step O, {}\nTransition {}\nInput i\nOutput c0\nMarking O, X0\n\nTransitions:\n",
        list("X", steps),
        list("t", steps - 1)
    );
    for at in 1..steps {
        text += &format!("t{}: X{}*i |- @X{at}\n", at - 1, at - 1);
    }
    text + "\nSteps:\nO: i |- c0\n"
}

/// `c0` follows the input.
const FOLLOWS: &str = "\
Step X0
Transition t0
Input i
Output c0
Marking X0

Transitions:
t0: X0*0 |- @X0

Steps:
X0: i |- c0
";

#[track_caller]
fn within(ladder: &str, spec_text: &str, timing: Timing, gates: usize) -> Verdict {
    let limits = Limits {
        gates,
        ..Limits::default()
    };
    let found = verify(&program(ladder), &spec(spec_text), timing, &limits);
    found.expect("a translation").verdict
}

#[test]
fn what_is_settled_late_is_unknown_where_its_scans_do_not_fit() {
    let ladder = chain(60);
    assert_eq!(
        told(&within(&ladder, FOLLOWS, Timing::Settled, 100_000)),
        "equivalent"
    );
    let little = within(&ladder, FOLLOWS, Timing::Settled, 3_000);
    assert_eq!(told(&little), "unknown after 0: Limits(Memory)");
}

#[test]
fn a_grafcet_is_unknown_where_its_evolutions_do_not_fit() {
    let ladder = "input i\noutput c0\nrung: i -> c0\n";
    let steps = row(40);
    assert_eq!(
        told(&within(ladder, &steps, Timing::Scan, 100_000)),
        "equivalent"
    );
    let little = within(ladder, &steps, Timing::Scan, 2_000);
    assert_eq!(told(&little), "unknown after 0: Limits(Memory)");
}

#[test]
fn a_ladder_that_does_not_fit_is_refused() {
    let limits = Limits {
        gates: 100,
        ..Limits::default()
    };
    let found = verify(&program(&chain(200)), &spec(FOLLOWS), Timing::Scan, &limits);
    assert_eq!(found.expect_err("a refusal"), Refusal::TooLarge);
}

/// What comes of a question when a cancel comes with the look of this number, and
/// how many looks there are in all.
fn cancelled_at(
    [ladder, spec_text]: [&str; 2],
    timing: Timing,
    look: usize,
) -> (Result<Verification, Refusal>, usize) {
    let looks = Arc::new(AtomicUsize::new(0));
    let counted = looks.clone();
    let limits = Limits {
        cancel: Cancel::when(move || counted.fetch_add(1, Ordering::Relaxed) + 1 == look),
        ..Limits::default()
    };
    let found = verify(&program(ladder), &spec(spec_text), timing, &limits);
    (found, looks.load(Ordering::Relaxed))
}

/// Cancels at more and more distant moments, from the first rung that is
/// translated to the last scan that is replayed.
#[track_caller]
fn stops_at_any_moment(texts: [&str; 2], timing: Timing, expected: &str) {
    let (found, all) = cancelled_at(texts, timing, usize::MAX);
    let verdict = told(&found.expect("a translation").verdict);
    assert!(verdict.contains(expected), "{verdict}");
    let moments = std::iter::successors(Some(1), |moment| Some(moment + moment / 16 + 1));
    for look in moments.take_while(|look| *look <= all) {
        let (found, looks) = cancelled_at(texts, timing, look);
        let is_told = match &found {
            Err(refusal) => *refusal == Refusal::Cancelled,
            // What was seen to happen by then is told.
            Ok(found) => found.is_cancelled() || matches!(found.verdict, Verdict::Different(_)),
        };
        assert!(is_told, "at look {look} of {all}: {found:?}");
        assert!(looks <= look + 20, "{} looks after {look}", looks - look);
    }
}

#[test]
fn a_cancel_stops_translation_and_proof_at_any_moment() {
    let ladder = text("fixtures/neutralization/neutralization.ladder");
    let sequence = text("fixtures/neutralization/sequence.grafcet");
    let texts = [ladder.as_str(), &sequence];
    stops_at_any_moment(texts, Timing::Scan, "equivalent");
    stops_at_any_moment([&chain(20), FOLLOWS], Timing::Settled, "equivalent");
}

#[test]
fn a_cancel_stops_the_replay_of_a_difference_at_any_moment() {
    let ladder = text("fixtures/neutralization/neutralization.ladder");
    let sequence = text("fixtures/neutralization/sequence.grafcet");
    let without = sequence.split("e6:").next().expect("a text");
    stops_at_any_moment([&ladder, without], Timing::Scan, "differ");
    stops_at_any_moment([&ladder, without], Timing::Settled, "differ");
}
