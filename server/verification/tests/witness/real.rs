//! A real program: a grafcet of 20 steps coded in ladder.

use std::collections::BTreeSet;

use grafcet::Verdict as Decided;
use logic::Budget;
use proof::Limits;
use recovery::analyse;
use recovery::conversion::{Accept, decide, spec};
use verification::witness::sights;
use verification::{Timing, Verdict, verify};

#[test]
fn a_conversion_needs_no_expert_where_the_ladder_says_enough() {
    let Some(corpus) = end_to_end::corpus() else {
        return;
    };
    let path = corpus.join("l5x/francisboudreau7__l5x_sfc__MainProgram.L5X");
    let program = ladder::read(&std::fs::read(path).expect("a real file")).program;
    let budget = Budget::default();
    let analysis = analyse(&program, &budget);
    let found = sights(&analysis, &[], &Limits::default()).expect("a translation");
    let analysis = analysis.seeing(found);

    // Every transition of the chart, and nothing else, is seen in a calm plant.
    let decisions = decide(&analysis, &[], &Accept::Witnessed);
    let accepted = |accept: &Accept| -> BTreeSet<(String, String)> {
        let made = decide(&analysis, &[], accept).into_iter();
        let pairs = made.flat_map(|decision| match decision.verdict {
            Decided::Accept { from, to } => {
                let each = to.into_iter().map(|to| (from.to_string(), to.to_string()));
                each.collect()
            }
            _ => Vec::new(),
        });
        pairs.collect()
    };
    assert_eq!(accepted(&Accept::Witnessed).len(), 22);
    assert_eq!(accepted(&Accept::Witnessed), accepted(&Accept::Handovers));

    let spec = spec(&analysis, &decisions, &budget);
    let limits = Limits::default();
    let found = verify(&program, &spec, Timing::Settled, &limits).expect("a translation");
    assert_eq!(found.verdict, Verdict::Equivalent);
}
