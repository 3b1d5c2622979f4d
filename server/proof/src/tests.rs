//! Each engine by itself, under the judge that knows no gates: together they
//! might cover for each other.

#[path = "../tests/judge/explicit.rs"]
mod explicit;
#[path = "../tests/judge/plan.rs"]
pub(crate) mod plan;

use explicit::shortest_difference;
use logic::Cancel;
use plan::{Operand, Plan, plans};
use proptest::prelude::*;

use crate::bounded::{Bounded, Scan};
use crate::classes::Classes;
use crate::cone::Cutter;
use crate::correspondence::corresponding;
use crate::explore::explore;
use crate::frame::Framing;
use crate::induction::Induction;
use crate::limits::{Limits, Meter, Why};
use crate::observers::observe;
use crate::reach::{Reach, Reached};
use crate::{Gates, Netlist, Signal, compare};

/// `motor = (start + motor) * /stop`
pub(crate) fn seal_in() -> Netlist {
    let mut netlist = Netlist::default();
    let start = netlist.input("start");
    let stop = netlist.input("stop");
    let motor = netlist.latch("motor", false);
    let held = netlist.or(start, motor);
    let runs = netlist.and(held, !stop);
    netlist.set_next(motor, runs);
    netlist.output("motor", runs);
    netlist
}

fn meter() -> Meter {
    Meter::new(&Limits::default(), u64::MAX)
}

/// A system and another one, perhaps the same, built in different ways; and
/// after how many scans they differ at the earliest.
fn pairs() -> impl Strategy<Value = (Netlist, Option<usize>)> {
    let fault = prop::option::of((any::<u8>(), any::<u8>(), any::<bool>()));
    (plans(4, 12), fault, any::<[u64; 2]>()).prop_map(|(plan, fault, manners)| {
        let other: Plan = match fault {
            Some((place, number, flag)) => plan.with_fault(place, Operand(number, flag)),
            None => plan.clone(),
        };
        let both = compare(&plan.build(manners[0]), &other.build(manners[1]));
        (both.netlist, shortest_difference(&plan, &other))
    })
}

#[test]
fn inputs_that_nothing_depends_on_have_no_part_in_what_is_reached() {
    let constant = |value: Signal| {
        let mut netlist = Netlist::default();
        netlist.input("a");
        netlist.output("q", value);
        netlist
    };
    let both = compare(&constant(Signal::TRUE), &constant(Signal::TRUE));
    assert_eq!(reached(&both.netlist), Reached::All(Some(1)));
    let both = compare(&constant(Signal::TRUE), &constant(Signal::FALSE));
    assert_eq!(reached(&both.netlist), Reached::Violation(0));
}

/// What is reached of all properties together, in turns that are too short at
/// first.
fn reached(netlist: &Netlist) -> Reached {
    let mut reach = Reach::new(netlist.clone()).expect("few variables");
    let mut steps = 40;
    let all = loop {
        match reach.advance(&mut Meter::new(&Limits::default(), steps)) {
            Ok(all) => break all,
            Err(why) => assert_eq!(why, Why::Steps),
        }
        steps += steps / 2;
    };
    let violations = all.iter().filter_map(|it| match it {
        Reached::Violation(scans) => Some(*scans),
        Reached::All(_) => None,
    });
    let first = violations.min().map(Reached::Violation);
    first.unwrap_or_else(|| all.into_iter().next().unwrap_or(Reached::All(Some(1))))
}

/// Deeper than any difference of systems so small.
const DEEP: usize = 80;

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 250,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn bounded_search_finds_the_shortest_trace((netlist, shortest) in pairs()) {
        let mut bounded = Bounded::new(&netlist);
        let mut found = None;
        while bounded.clean < DEEP && found.is_none() {
            match bounded.advance(|_| true, &mut meter()).expect("small") {
                Scan::Clean => {}
                Scan::Violated(trace) => found = Some(trace.scans()),
                Scan::Forbidden => break,
            }
        }
        prop_assert_eq!(found, shortest);
    }

    #[test]
    fn reachability_tells_when_the_first_difference_comes((netlist, shortest) in pairs()) {
        match reached(&netlist) {
            Reached::All(states) => {
                prop_assert_eq!(shortest, None);
                prop_assert!(states.is_some_and(|states| states > 0));
            }
            Reached::Violation(scans) => prop_assert_eq!(Some(scans + 1), shortest),
        }
    }

    /// Random runs find only what is there; what they do not see is proved or
    /// refuted by others.
    #[test]
    fn random_runs_end_in_a_difference((netlist, shortest) in pairs()) {
        let explored = explore(&netlist, &mut meter()).expect("small");
        if let Some(trace) = explored.trace {
            let seen = crate::replay(&netlist, &trace).violation;
            prop_assert_eq!(seen.map(|(scan, _)| scan + 1), Some(trace.scans()));
            prop_assert!(shortest.is_some_and(|shortest| shortest <= trace.scans()));
        }
    }

    /// Even if every signal is a candidate to be equal to every other, only
    /// what is true is left; and what is merged then behaves as before.
    #[test]
    fn what_corresponds_is_equal((netlist, shortest) in pairs(), blind in any::<bool>()) {
        let mut netlist = netlist;
        let mut explored = explore(&netlist, &mut meter()).expect("small");
        observe(&mut netlist, &explored, &mut meter()).expect("small");
        explored.take_in(&netlist, &mut meter()).expect("small");
        let candidates = match blind {
            true => Classes(vec![Signal::FALSE; netlist.size()]),
            false => explored.classes(),
        };
        let framing = Framing::new(&netlist);
        let classes = corresponding(&framing, candidates, &mut meter()).expect("small");
        let all: Vec<usize> = (0..netlist.properties.len()).collect();
        let constraints: Vec<usize> = (0..netlist.constraints.len()).collect();
        let merged = Cutter::new(&netlist, &classes).cut(&all, &constraints, &Cancel::default());
        let merged = merged.expect("nobody cancels");
        let reached = reached(&merged.netlist);
        match shortest {
            None => prop_assert!(matches!(reached, Reached::All(_))),
            Some(scans) => prop_assert_eq!(reached, Reached::Violation(scans - 1)),
        }
    }

    /// Whatever induction proves from as many scans as are known to be good
    /// holds; the classes that it supposes may be the trivial ones.
    #[test]
    fn induction_proves_only_what_holds((netlist, shortest) in pairs(), alone in any::<bool>()) {
        let framing = Framing::new(&netlist);
        let classes = match alone {
            true => Classes::alone(netlist.size()),
            false => {
                let candidates = explore(&netlist, &mut meter()).expect("small").classes();
                corresponding(&framing, candidates, &mut meter()).expect("small")
            }
        };
        let mut induction = Induction::new(&framing, &classes);
        let all: Vec<usize> = (0..netlist.properties.len()).collect();
        while induction.scans < 6 && shortest.is_none_or(|it| induction.scans < it) {
            let proved = induction.advance(&all, &mut meter()).expect("small");
            if proved.len() == all.len() {
                prop_assert_eq!(shortest, None);
            }
        }
    }
}

#[test]
fn induction_ends_where_one_of_two_properties_is_always_violated() {
    let mut netlist = Netlist::default();
    let on = netlist.input("on");
    netlist.never("on", on);
    netlist.never("off", !on);
    let framing = Framing::new(&netlist);
    let classes = Classes::alone(netlist.size());
    let mut induction = Induction::new(&framing, &classes);
    let proved = induction.advance(&[0, 1], &mut meter());
    assert_eq!(proved, Ok(Vec::new()));
}

/// The share of equal pairs that each way to prove them can do alone: a way
/// that proves nothing would pass every other test.
#[test]
fn every_way_to_prove_proves_something() {
    use proptest::strategy::ValueTree;
    use proptest::test_runner::TestRunner;
    let mut runner = TestRunner::deterministic();
    let (mut equal, mut corresponded, mut induced) = (0, 0, 0);
    while equal < 60 {
        let (netlist, shortest) = pairs().new_tree(&mut runner).expect("a pair").current();
        let is_open = netlist
            .properties
            .iter()
            .any(|it| it.signal != Signal::FALSE);
        if shortest.is_some() || !is_open {
            continue;
        }
        equal += 1;
        let framing = Framing::new(&netlist);
        let candidates = explore(&netlist, &mut meter()).expect("small").classes();
        let classes = corresponding(&framing, candidates, &mut meter()).expect("small");
        let mut properties = netlist.properties.iter();
        let is_proved = properties.all(|it| classes.leader(it.signal) == Signal::FALSE);
        corresponded += usize::from(is_proved);
        let alone = Classes::alone(netlist.size());
        let mut induction = Induction::new(&framing, &alone);
        let all: Vec<usize> = (0..netlist.properties.len()).collect();
        let is_proved = (0..8).any(|_| {
            let proved = induction.advance(&all, &mut meter()).expect("small");
            proved.len() == all.len()
        });
        induced += usize::from(is_proved);
    }
    assert!(corresponded > 40, "{corresponded} of {equal}");
    assert!(induced > 20, "{induced} of {equal}");
}
