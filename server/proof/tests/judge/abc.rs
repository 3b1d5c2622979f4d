//! Generated pairs of netlists, judged by ABC.

use std::fs;
use std::path::Path;

use proof::{Limits, Verdict, check, compare};
use proptest::strategy::{Strategy, ValueTree};
use proptest::test_runner::TestRunner;

use super::plan::{Operand, Plan, plans};
use super::tool::{abc, dsec, model_checked};

const PAIRS: usize = 240;

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
