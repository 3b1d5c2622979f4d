//! ABC (Berkeley Logic Synthesis and Verification Group) as judge: it reads the
//! files that are written here and comes to its own verdict.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use proof::{Limits, Netlist, Verdict, aiger, blif, check, compare};
use proptest::strategy::{Strategy, ValueTree};
use proptest::test_runner::TestRunner;

use super::plan::{Operand, Plan, plans};

const PAIRS: usize = 240;

/// How to run ABC, or `None` after saying that it cannot be had. Where
/// `CI=true`, somebody counts on it.
fn abc() -> Option<PathBuf> {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("abc");
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/judge/bring-abc");
    let brought = Command::new("bash").arg(script).arg(&folder).output();
    if brought.is_ok_and(|output| output.status.success()) {
        return Some(folder.join("abc"));
    }
    let is_ci = std::env::var("CI").is_ok_and(|value| value == "true");
    assert!(!is_ci, "berkeley-abc cannot be had, and CI=true demands it");
    eprintln!("skipped: berkeley-abc cannot be had");
    None
}

fn answer(abc: &Path, folder: &Path, commands: &str) -> String {
    let output = Command::new(abc)
        .current_dir(folder)
        .args(["-q", commands])
        .output()
        .expect("abc runs");
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// Whether ABC's sequential equivalence check finds the two equal.
fn dsec(abc: &Path, folder: &Path, sides: [&Netlist; 2]) -> bool {
    for (side, name) in sides.into_iter().zip(["left", "right"]) {
        fs::write(
            folder.join(name).with_extension("blif"),
            blif::text(side, name),
        )
        .expect("written");
    }
    let answer = answer(abc, folder, "dsec left.blif right.blif");
    match answer {
        it if it.contains("are NOT EQUIVALENT") => false,
        it if it.contains("are equivalent") => true,
        it => panic!("dsec came to no verdict: {it}"),
    }
}

/// After how many scans ABC says that a property is violated at the earliest,
/// if `bound` scans are enough; or that none ever is.
fn model_checked(abc: &Path, folder: &Path, both: &Netlist, bound: Option<usize>) -> Option<usize> {
    fs::write(folder.join("both.aig"), aiger::binary(&both.plain())).expect("written");
    let engine = match bound {
        Some(scans) => format!("bmc3 -F {scans}"),
        None => "pdr".to_owned(),
    };
    let commands = format!("read both.aig; orpos; {engine}; print_status");
    let answer = answer(abc, folder, &commands);
    let status = answer.split("Status = ").nth(1).unwrap_or(&answer);
    if status.starts_with('0') {
        let frame = status
            .split("Frame =")
            .nth(1)
            .and_then(|it| it.split_whitespace().next());
        let frame: usize = frame.and_then(|it| it.parse().ok()).expect(&answer);
        return Some(frame + 1);
    }
    assert!(
        status.starts_with('1') || bound.is_some(),
        "no verdict: {answer}"
    );
    None
}

fn has_free(plan: &Plan) -> bool {
    plan.latches.iter().any(|(initial, _)| initial.is_none())
}

#[test]
fn abc_agrees_on_generated_pairs() {
    let Some(abc) = abc() else { return };
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("abc-pairs");
    fs::create_dir_all(&folder).expect("a folder");
    let mut runner = TestRunner::deterministic();
    let faults = (
        proptest::option::weighted(0.6, proptest::num::u8::ANY),
        proptest::num::u8::ANY,
        proptest::bool::ANY,
        [proptest::num::u64::ANY, proptest::num::u64::ANY],
    );
    let strategy = (plans(10, 40), faults);
    let (mut judged, mut equal, mut deep, mut by_dsec) = (0, 0, 0, 0);
    while judged < PAIRS {
        let tree = strategy.new_tree(&mut runner).expect("a pair");
        let (plan, (fault, number, flag, manners)) = tree.current();
        let other = match fault {
            Some(place) => plan.with_fault(place, Operand(number, flag)),
            None => plan.clone(),
        };
        let [left, right] = [plan.build(manners[0]), other.build(manners[1])];
        let both = compare(&left, &right).netlist;
        if both
            .properties()
            .iter()
            .all(|it| it.signal == proof::Signal::FALSE)
        {
            // Equal by construction: nothing to judge.
            continue;
        }
        judged += 1;
        let said = match check(&both, &Limits::default()).verdict {
            Verdict::Equivalent => None,
            Verdict::Different(it) => Some(it.trace.scans()),
            Verdict::Unknown { .. } => panic!("pair {judged} is not decided"),
        };
        let says = model_checked(&abc, &folder, &both, said);
        assert_eq!(said, says, "pair {judged}: {plan:?} and {other:?}");
        let is_free = has_free(&plan) || has_free(&other);
        if !is_free && (fault.is_none() || plan.constraints.is_empty()) {
            // Each file stands for itself there: free latches of the two sides
            // would be one, and a constraint that the fault changed would bind
            // its own side alone.
            by_dsec += 1;
            let is_equal = dsec(&abc, &folder, [&left, &right]);
            assert_eq!(
                said.is_none(),
                is_equal,
                "pair {judged}: {plan:?} and {other:?}"
            );
        }
        equal += usize::from(said.is_none());
        deep += usize::from(said.is_some_and(|scans| scans > 1));
    }
    println!(
        "{judged} pairs judged, {by_dsec} of them by dsec too: {equal} equal, {deep} differ after the first scan"
    );
    assert!(
        equal >= 60 && deep >= 20 && by_dsec >= 60,
        "the pairs are lopsided"
    );
}
