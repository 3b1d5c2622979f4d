//! The model: graphs, comparison, instances, conditions of actions.

use std::collections::BTreeMap;

use grafcet::{Difference, Grafcet, Node, PartKind, differences, read};
use logic::Name;

fn grafcet(rules: &str) -> Grafcet {
    read(rules).spec.grafcet
}

const TRUCK: &str = "Step a, b\nTransition t1, t2\nMarking a\nTransitions:\n\
                     t1: a*m |- @b\nt2: b*(x + y) |- @a\n";

#[test]
fn a_graph_leads_from_step_to_transition_to_step() {
    let graph = grafcet(TRUCK).graph();
    let name = |at| match &graph[at] {
        Node::Step(name) | Node::Transition(name) => name.to_string(),
    };
    let arcs = graph
        .edge_indices()
        .filter_map(|arc| graph.edge_endpoints(arc));
    let arcs: Vec<String> = arcs
        .map(|(from, to)| format!("{}-{}", name(from), name(to)))
        .collect();
    assert_eq!(arcs, ["a-t1", "t1-b", "b-t2", "t2-a"]);
}

#[test]
fn charts_are_the_same_up_to_names_and_order() {
    let other = grafcet(
        "Step q2, q1\nTransition k, l\nMarking q1\nTransitions:\n\
         k: q2*/(/x*/y) |- @q1\nl: q1*m |- @q2\n",
    );
    let names: [(Name, Name); 2] = [("a".into(), "q1".into()), ("b".into(), "q2".into())];
    assert_eq!(
        differences(&grafcet(TRUCK), &other, &BTreeMap::from(names)),
        []
    );
}

#[test]
fn every_difference_is_named() {
    let other = grafcet(
        "Step a, b, c\nTransition t1, t2, t3\nMarking b\nTransitions:\n\
         t1: a*n |- @b\nt3: b |- @c\n",
    );
    let names = |list: &[&str]| list.iter().map(|name| Name::from(*name)).collect();
    assert_eq!(
        differences(&grafcet(TRUCK), &other, &BTreeMap::new()),
        [
            Difference::StepOnlyRight("c".into()),
            Difference::Initial("a".into()),
            Difference::Initial("b".into()),
            Difference::TransitionOnlyLeft {
                from: names(&["b"]),
                to: names(&["a"])
            },
            Difference::TransitionOnlyRight {
                from: names(&["b"]),
                to: names(&["c"])
            },
            Difference::Receptivity {
                from: names(&["a"]),
                to: names(&["b"]),
                left: logic::Expr::variable("m"),
                right: logic::Expr::variable("n"),
            },
        ]
    );
}

#[test]
fn an_instance_is_a_copy_with_names_of_its_own() {
    let written_out = grafcet(
        "Instance d1 of Drill(s, v1)\nReusable Drill(go, motor)\nStep E0, E1\nTransition t1\n\
         Marking E0\nTransitions:\nt1: E0*go*5s/E0 |- @E1\nSteps:\nE1: |- motor := motor + 1\n",
    )
    .instantiated()
    .into_owned();
    assert!(written_out.instances.is_empty());
    let [copy] = &written_out.parts[..] else {
        panic!("one part, not {:?}", written_out.parts);
    };
    assert_eq!((&*copy.name, &copy.kind), ("d1", &PartKind::Partial));
    let t1 = copy.chart.transition("d1.t1").expect("t1");
    assert_eq!((&*t1.from[0], &*t1.to[0]), ("d1.E0", "d1.E1"));
    assert_eq!(t1.receptivity.to_string(), "s*5s/d1.E0");
    assert_eq!(grafcet::action_text(&copy.chart.actions[0]), "v1 := v1 + 1");
    assert!(copy.chart.steps[0].initial);
}

#[test]
fn delays_and_limits_are_conditions() {
    let chart = grafcet("Step p1\nSteps:\np1: a |- R after 2s until 9s\n").chart;
    let condition = chart.actions[0].whole_condition().expect("a condition");
    assert_eq!(condition.to_string(), "2s/p1*/9s/p1*a");
}
