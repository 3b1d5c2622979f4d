//! A real program that holds its own truth: a grafcet of 20 steps coded in
//! ladder, with transition bits that move a scan late.

use std::sync::Arc;

use grafcet::Spec;
use ladder::Program;
use logic::Budget;
use proof::Limits;
use recovery::conversion::{Accept, decide, spec};
use verification::{Timing, Verdict, verify};

use crate::told;

/// The program and what is recovered of it, where there is a corpus.
fn recovered() -> Option<(Arc<Program>, Spec)> {
    let path = end_to_end::corpus()?.join("l5x/francisboudreau7__l5x_sfc__MainProgram.L5X");
    let bytes = std::fs::read(path).expect("a real file can be read");
    let program = ladder::read(&bytes).program;
    let budget = Budget::default();
    let analysis = recovery::analyse(&program, &budget);
    let decisions = decide(&analysis, &[], &Accept::Handovers);
    let spec = spec(&analysis, &decisions, &budget);
    Some((program, spec))
}

#[test]
fn the_chart_of_a_coded_grafcet_is_equal_when_both_are_settled() {
    let Some((program, spec)) = recovered() else {
        return;
    };
    let limits = Limits::default();
    let found = verify(&program, &spec, Timing::Settled, &limits).expect("a translation");
    assert_eq!(told(&found.verdict), "equivalent");
    assert_eq!(
        (found.outputs.len(), found.missing.len(), found.rules),
        (9, 0, 0)
    );
    assert_eq!(found.deadlock, None);
}

#[test]
fn after_every_scan_it_is_not_since_transition_bits_move_late() {
    let Some((program, spec)) = recovered() else {
        return;
    };
    let limits = Limits::default();
    let found = verify(&program, &spec, Timing::Scan, &limits).expect("a translation");
    let Verdict::Different(difference) = &found.verdict else {
        panic!("{}", told(&found.verdict));
    };
    assert!(difference.is_shortest);
    assert_eq!(difference.trace.steps.len(), 1);
}

#[test]
fn a_chart_with_a_fault_is_told_from_it() {
    let Some((program, mut spec)) = recovered() else {
        return;
    };
    // The valve stays open: nothing resets it any more.
    let actions = &mut spec.grafcet.chart.actions;
    let before = actions.len();
    actions.retain(|action| !(&*action.output == "V" && &*action.step == "XX.17"));
    assert_eq!(actions.len(), before - 1);
    let limits = Limits::default();
    let found = verify(&program, &spec, Timing::Settled, &limits).expect("a translation");
    assert_eq!(
        told(&found.verdict),
        "\
pp f0 start f1 | F D | F D
3000 ms pp f0 start d1 f1 | F D | F D
1500 ms pp f0 start d1 f1 | F | F
500 ms pp f0 start d1 e1 f1 | E | E
1250 ms pp f0 start d1 e1 f1 a0 b1 | B V | B V
500 ms pp f0 start d1 e1 f1 a0 b1 b0 a1 | B | B V
differ: V"
    );
}
