//! Hard questions end when they are told to, and say why.

use proof::{Gates, Limits, Netlist, Signal, Status, Verdict, Why, check, compare};

/// A multiplier, its factors exchanged or not: as hard as questions come, for
/// every engine, with enough bits.
fn multiplier(bits: usize, is_exchanged: bool) -> Netlist {
    let mut netlist = Netlist::default();
    let mut factor = |name: &str| -> Vec<Signal> {
        (0..bits)
            .map(|bit| netlist.input(format!("{name}{bit}")))
            .collect()
    };
    let mut factors = [factor("a"), factor("b")];
    if is_exchanged {
        factors.reverse();
    }
    let mut sum = vec![Signal::FALSE; 2 * bits];
    for (shift, &bit) in factors[0].iter().enumerate() {
        let mut carry = Signal::FALSE;
        for (at, &other) in factors[1].iter().enumerate() {
            let product = netlist.and(bit, other);
            let place = &mut sum[shift + at];
            let half = netlist.xor(*place, product);
            let carries = [netlist.and(*place, product), netlist.and(half, carry)];
            *place = netlist.xor(half, carry);
            carry = netlist.any(&carries);
        }
        sum[shift + bits] = carry;
    }
    for (at, bit) in sum.into_iter().enumerate() {
        let latch = netlist.delayed(format!("p{at}"), bit, false);
        netlist.output(format!("p{at}"), latch);
    }
    netlist
}

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
