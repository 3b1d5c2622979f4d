//! Hard questions end when they are told to, and say why.

#[path = "judge/multiplier.rs"]
mod multiplier;

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use logic::Cancel;
use multiplier::multiplier;
use proof::{Gates, Limits, Netlist, Signal, Status, Verdict, Why, check, compare};

fn hard() -> Netlist {
    compare(&multiplier(24, false), &multiplier(24, true)).netlist
}

#[test]
fn a_cancel_ends_a_proof_that_would_run_for_hours() {
    let limits = Limits {
        steps: u64::MAX,
        ..Limits::default()
    };
    let cancel = limits.cancel.clone();
    let running = std::thread::spawn(move || check(&hard(), &limits).verdict);
    std::thread::sleep(std::time::Duration::from_millis(300));
    assert!(!running.is_finished());
    cancel.cancel();
    let verdict = running.join().expect("a verdict");
    assert!(
        matches!(
            verdict,
            Verdict::Unknown {
                why: Why::Cancelled,
                ..
            }
        ),
        "{verdict:?}"
    );
}

/// What comes of a question when a cancel comes with the look of this number, and
/// how many looks there are in all.
fn cancelled_at(question: &Netlist, look: usize) -> (Verdict, usize) {
    let looks = Arc::new(AtomicUsize::new(0));
    let counted = looks.clone();
    let limits = Limits {
        cancel: Cancel::when(move || counted.fetch_add(1, Ordering::Relaxed) + 1 == look),
        ..Limits::default()
    };
    let verdict = check(question, &limits).verdict;
    (verdict, looks.load(Ordering::Relaxed))
}

#[test]
fn at_whatever_moment_a_cancel_comes_next_to_nothing_is_done_after_it() {
    let question = compare(&multiplier(5, false), &multiplier(5, true)).netlist;
    let (verdict, all) = cancelled_at(&question, usize::MAX);
    assert_eq!(verdict, Verdict::Equivalent);
    // Each engine has its turn among so many.
    assert!(all > 1_000, "{all} looks");
    let moments = std::iter::successors(Some(1), |moment| Some(moment + moment / 8 + 1));
    for look in moments.take_while(|look| *look <= all) {
        let (verdict, looks) = cancelled_at(&question, look);
        let is_cancelled = matches!(
            verdict,
            Verdict::Unknown {
                why: Why::Cancelled,
                ..
            }
        );
        assert!(is_cancelled, "at look {look} of {all}: {verdict:?}");
        assert!(looks <= look + 3, "{} looks after {look}", looks - look);
    }
}

#[test]
fn what_is_cancelled_before_it_begins_is_not_begun() {
    let limits = Limits::default();
    limits.cancel.cancel();
    let verdict = check(&hard(), &limits).verdict;
    let expected = Verdict::Unknown {
        clean: 0,
        why: Why::Cancelled,
    };
    assert_eq!(verdict, expected);
}

#[test]
fn steps_are_not_exceeded_and_the_answer_is_the_same_each_time() {
    let limits = Limits {
        steps: 20_000_000,
        ..Limits::default()
    };
    let report = check(&hard(), &limits);
    assert!(
        matches!(
            report.verdict,
            Verdict::Unknown {
                why: Why::Steps,
                ..
            }
        ),
        "{report:?}"
    );
    // What was known so far is told: low bits are easy.
    assert!(
        matches!(report.properties[0].1, Status::Holds(_)),
        "{report:?}"
    );
    assert_eq!(check(&hard(), &limits), report);
}

#[test]
fn no_engine_takes_more_memory_than_the_limits_allow() {
    let limits = Limits {
        steps: 20_000_000,
        gates: 1_000,
        clauses: 1_000,
        nodes: 1_000,
        ..Limits::default()
    };
    let verdict = check(&hard(), &limits).verdict;
    assert!(
        matches!(
            verdict,
            Verdict::Unknown {
                why: Why::Memory | Why::Steps,
                ..
            }
        ),
        "{verdict:?}"
    );
}

#[test]
fn an_environment_without_a_future_violates_nothing() {
    let mut netlist = Netlist::default();
    let input = netlist.input("input");
    let before = netlist.delayed("before", Signal::TRUE, false);
    // Possible in the first scan alone, and only with the input at 1.
    netlist.constrain(!before);
    netlist.constrain(input);
    let late = netlist.and(before, input);
    netlist.never("late", late);
    netlist.never("first", !input);
    let report = check(&netlist, &Limits::default());
    assert_eq!(report.verdict, Verdict::Equivalent, "{report:?}");
}
