//! Random grafcets without parts.

use grafcet::{Action, ActionKind, Chart, Effect, Grafcet, Step, Transition, Trigger, Variable};
use logic::{Atom, Expr, Name, Relation};
use proptest::collection::vec;
use proptest::option;
use proptest::prelude::*;
use proptest::sample::{select, subsequence};

pub const STEPS: [&str; 5] = ["S0", "S1", "S2", "S3", "S4"];
pub const INPUTS: [&str; 3] = ["a", "b", "c"];
pub const OUTPUTS: [&str; 4] = ["x", "y", "z", "n"];

fn names(names: &'static [&'static str]) -> impl Strategy<Value = Name> {
    select(names).prop_map(Name::from)
}

fn times() -> impl Strategy<Value = Name> {
    select(vec!["0ms", "20ms", "30ms"]).prop_map(Name::from)
}

fn expressions() -> impl Strategy<Value = Expr> {
    let number = (names(&["n", "x"]), 0..3usize, 0..4i32).prop_map(|(left, relation, right)| {
        let relations = [Relation::Equal, Relation::Less, Relation::GreaterOrEqual];
        Expr::comparison(&left, relations[relation], &right.to_string())
    });
    let elapsed =
        (times(), names(&STEPS)).prop_map(|(time, step)| Expr::Atom(Atom::Elapsed { time, step }));
    let leaf = prop_oneof![
        1 => any::<bool>().prop_map(Expr::Constant),
        8 => names(&INPUTS).prop_map(Expr::variable),
        2 => names(&STEPS).prop_map(Expr::variable),
        2 => names(&OUTPUTS).prop_map(Expr::variable),
        1 => number,
        2 => elapsed,
    ];
    leaf.prop_recursive(3, 8, 2, |inner| {
        prop_oneof![
            inner.clone().prop_map(Expr::complement),
            vec(inner.clone(), 2).prop_map(Expr::And),
            vec(inner.clone(), 2).prop_map(Expr::Or),
            inner
                .clone()
                .prop_map(|it| Expr::Atom(Atom::Rise(Box::new(it)))),
            inner.prop_map(|it| Expr::Atom(Atom::Fall(Box::new(it)))),
        ]
    })
}

fn transitions() -> impl Strategy<Value = Transition> {
    let steps = || subsequence(STEPS.to_vec(), 0..=2);
    let steps = move || steps().prop_map(|all| all.into_iter().map(Name::from).collect());
    (steps(), steps(), expressions()).prop_map(|(from, to, receptivity): (Vec<_>, Vec<_>, _)| {
        Transition {
            name: "t".into(),
            from,
            to,
            receptivity,
            comment: None,
        }
    })
}

fn actions() -> impl Strategy<Value = Action> {
    let on = prop_oneof![
        Just(Trigger::Activation),
        Just(Trigger::Deactivation),
        expressions().prop_map(Trigger::Event),
    ];
    let effect = prop_oneof![
        Just(Effect::Set),
        Just(Effect::Reset),
        select(vec!["2", "n + 1", "x + y + 1"]).prop_map(|term| Effect::Assign(term.into())),
    ];
    let kind = prop_oneof![
        (
            option::weighted(0.2, times()),
            option::weighted(0.2, times())
        )
            .prop_map(|(delay, limit)| ActionKind::Continuous { delay, limit }),
        (effect, on).prop_map(|(effect, on)| ActionKind::Stored { effect, on }),
    ];
    let condition = option::weighted(0.5, expressions());
    (names(&STEPS), kind, names(&OUTPUTS), condition).prop_map(|(step, kind, output, condition)| {
        Action {
            step,
            kind,
            output,
            condition,
            comment: None,
        }
    })
}

pub fn grafcets() -> impl Strategy<Value = Grafcet> {
    (
        subsequence(STEPS.to_vec(), 1..=3),
        vec(transitions(), 1..7),
        vec(actions(), 0..7),
    )
        .prop_map(|(initial, transitions, actions)| {
            let step = |name: &&str| Step {
                initial: initial.contains(name),
                ..Step::new(*name)
            };
            let variables = |names: &[&str]| names.iter().map(|it| Variable::new(*it)).collect();
            let mut chart = Chart {
                steps: STEPS.iter().map(step).collect(),
                transitions,
                actions,
            };
            for (at, transition) in chart.transitions.iter_mut().enumerate() {
                transition.name = format!("t{at}").into();
            }
            Grafcet {
                inputs: variables(&INPUTS),
                outputs: variables(&OUTPUTS),
                chart,
                ..Grafcet::default()
            }
        })
}
