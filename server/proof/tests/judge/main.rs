//! The engines under judges that share nothing with them.

mod abc;
mod explicit;
mod plan;
mod tool;

use explicit::shortest_difference;
use plan::{Operand, Plan, plans};
use proof::{Limits, Netlist, Verdict, check, compare};
use proptest::prelude::*;

/// What the engines say: the length of the shortest trace, if there is one.
fn verdict(left: &Netlist, right: &Netlist) -> Option<usize> {
    let both = compare(left, right).netlist;
    let report = check(&both, &Limits::default());
    match report.verdict {
        Verdict::Equivalent => None,
        Verdict::Different(difference) => {
            assert!(difference.is_shortest());
            Some(difference.trace.scans())
        }
        Verdict::Unknown { .. } => panic!("so small a system is decided: {report:?}"),
    }
}

fn judged(left: &Plan, right: &Plan, manners: [u64; 2]) -> (Option<usize>, Option<usize>) {
    let built = [left.build(manners[0]), right.build(manners[1])];
    (
        verdict(&built[0], &built[1]),
        shortest_difference(left, right),
    )
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 2_000,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    /// Free latches of the two sides start independently, so that even a copy
    /// may differ; the judge knows.
    #[test]
    fn two_ways_to_build_a_system_are_judged_rightly(
        plan in plans(5, 14),
        manners in any::<[u64; 2]>(),
    ) {
        let (said, is) = judged(&plan, &plan, manners);
        prop_assert_eq!(said, is);
    }

    #[test]
    fn a_system_and_one_with_a_fault_are_judged_rightly(
        plan in plans(5, 14),
        place in any::<u8>(),
        way in any::<(u8, bool)>(),
        manners in any::<[u64; 2]>(),
    ) {
        let faulty = plan.with_fault(place, Operand(way.0, way.1));
        let (said, is) = judged(&plan, &faulty, manners);
        prop_assert_eq!(said, is);
    }
}
