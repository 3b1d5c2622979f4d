//! The tank of the case study.

use logic::Cancel;
use recovery::simulation::{Subject, simulate};
use verification::{Timing, Verdict};

use crate::{assert_told, program, spec, text, verified};

const LADDER: &str = "fixtures/neutralization/neutralization.ladder";
const SEQUENCE: &str = "fixtures/neutralization/sequence.grafcet";

#[test]
fn the_sequence_does_what_the_ladder_does_in_every_plant_that_obeys_its_rules() {
    let sequence = spec(&text(SEQUENCE));
    let chart = &sequence.grafcet.chart;
    assert_eq!((chart.steps.len(), chart.transitions.len()), (10, 10));
    assert_eq!(sequence.environment.len(), 7);
    assert!(
        sequence
            .environment
            .iter()
            .all(|rule| rule.comment.is_some())
    );
    for ladder in ["ladder", "L5X", "xml"] {
        let ladder = text(&format!("fixtures/neutralization/neutralization.{ladder}"));
        let found = verified(&ladder, &text(SEQUENCE), Timing::Scan);
        assert_told(&found.verdict, "equivalent");
        assert_eq!(found.outputs.len(), 8);
        assert_eq!(
            (found.missing.len(), found.free.len(), found.deadlock),
            (0, 0, None)
        );
    }
}

#[test]
fn without_any_one_of_the_rules_it_does_not() {
    let all = text(SEQUENCE);
    let without = |label: &str| {
        let rule = format!("{label}:");
        let lines = all.lines().filter(|line| !line.starts_with(&rule));
        let fewer: String = lines.map(|line| line.to_owned() + "\n").collect();
        assert_ne!(fewer, all);
        verified(&text(LADDER), &fewer, Timing::Scan).verdict
    };
    // Each time the shortest sequence shows what the rule is about.
    let shortest = [
        (
            "e1",
            "s | v1 | v1
             s ls2 | v2 | v2 h m
             differ: h m",
        ),
        (
            "e2",
            "s | v1 | v1
             s ls2 tl ls1 | v2 m light_tl | v2 m light_tl
             s ls2 ls1 | v2 h m | v2 m
             differ: h",
        ),
        (
            "e3",
            "s | v1 | v1
             s ls2 ls1 | v2 h m | v2 h m
             s ls2 as tl ls1 | v3 m light_tl light_as | v3 m light_tl light_as
             ls2 tl ls1 | v2 v3 m light_tl | v3 m light_tl
             differ: v2",
        ),
        (
            "e4",
            "s | v1 | v1
             s ls2 ls1 | v2 h m | v2 h m
             s ls1 | v1 v2 h m | v2 h m
             differ: v1",
        ),
        (
            "e5",
            "ls2 ls1 | v2 h m | -
             differ: v2 h m",
        ),
        (
            "e6",
            "s | v1 | v1
             s ls2 ls1 | v2 h m | v2 h m
             s ls2 as tl ls1 | v3 m light_tl light_as | v3 m light_tl light_as
             s as tl ls1 | v1 v3 m light_tl light_as | v3 m light_tl light_as
             differ: v1",
        ),
        (
            "e7",
            "as tl ls1 | v3 light_tl light_as | light_tl light_as
             differ: v3",
        ),
    ];
    for (label, expected) in shortest {
        assert_told(&without(label), expected);
    }
}

#[test]
fn the_observed_scenarios_pass_on_both() {
    let (program, sequence) = (program(&text(LADDER)), spec(&text(SEQUENCE)));
    for table in ["table-2", "table-3", "table-4"] {
        let scenario = scenario::read(&text(&format!("fixtures/neutralization/{table}.scenario")));
        assert!(scenario.diagnostics.is_empty());
        let subject = Subject {
            ladder: Some(&program),
            grafcet: Some(&sequence.grafcet),
        };
        let simulation = simulate(&scenario.scenario, subject, &Cancel::default());
        let failures: Vec<String> = simulation.failures().map(|(_, it)| it.sentence()).collect();
        assert_eq!(
            (failures, simulation.agrees()),
            (Vec::new(), true),
            "{table}"
        );
    }
}

/// What is found about a ladder whose drain and other valves must never be
/// open together, in any plant whatever.
fn of_valves(ladder: &str) -> Verdict {
    let spec = "\
        Step X0\nTransition t0\nInput s, v1, v2, v3, v4\nMarking X0\nTransitions:\nt0: X0*s |- @X0\n\
        Never:\nn1: v3*(v1 + v2 + v4)\n";
    let found = verified(ladder, spec, Timing::Scan);
    assert_eq!(found.properties.len(), 1);
    found.properties[0].1.clone()
}

fn is_brief(verdict: &Verdict) -> bool {
    matches!(verdict, Verdict::Different(difference) if difference.is_brief)
}

#[test]
fn the_drain_can_be_open_with_other_valves_in_the_ladder_of_the_paper() {
    let found = of_valves(&text(LADDER));
    assert_told(&found, "s as tl ls1 | v3 v1 | -\nviolated");
    assert!(!is_brief(&found));
}

#[test]
fn interlocks_above_the_rung_that_they_look_at_come_a_scan_late() {
    let ladder = text(LADDER)
        .replace("(s + v1) * /ls2 ", "(s + v1) * /ls2 * /v3 ")
        .replace("(v2 + ls2*/as) * /ls3 ", "(v2 + ls2*/as) * /ls3 * /v3 ");
    let found = of_valves(&ladder);
    assert_told(&found, "s as tl ls1 | v3 v1 | -\nviolated");
    assert!(is_brief(&found));

    let rungs: Vec<&str> = ladder
        .lines()
        .filter(|line| line.starts_with("rung "))
        .collect();
    let drain = rungs
        .iter()
        .find(|rung| rung.contains("-> v3"))
        .expect("the rung of v3");
    let moved = ladder
        .replace(&format!("{drain}\n"), "")
        .replace(rungs[0], &format!("{drain}\n{}", rungs[0]));
    assert_told(&of_valves(&moved), "equivalent");
}
