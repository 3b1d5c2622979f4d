//! Random specs, and random texts as people leave them.

use grafcet::{
    Action, ActionKind, Chart, Decision, Effect, EnvironmentRule, Grafcet, Instance, Part,
    PartKind, Property, Situation, Spec, Step, StepKind, Transition, Trigger, Variable, Verdict,
    in_next_scan, read, write,
};
use logic::{Atom, Expr, Name, Relation};
use proptest::collection::vec;
use proptest::option;
use proptest::prelude::*;
use proptest::sample::{select, subsequence};

const STEPS: [&str; 9] = [
    "p1",
    "p2",
    "X0",
    "Xv1",
    "étape_3",
    "for",
    "Step",
    "1",
    "Drill.1 up",
];
const VARIABLES: [&str; 9] = [
    "m",
    "ls2",
    "T1.DN",
    "Local:1:I.Data.4",
    "on",
    "activation",
    "Input",
    "5s",
    "%MW3",
];
const LABELS: [&str; 5] = ["t1", "t2", "t_3", "set", "Transitions"];
const PARTS: [&str; 3] = ["G1", "G 2", "until"];
const STATES: [&str; 5] = ["v1", "X.3", "Seq=10", "Milling_1.Index=-2", "a = b"];
const TIMES: [&str; 3] = ["5s", "1m30s", "250ms"];
const COMMENTS: [&str; 4] = ["Fill the tank", "! not a decision", "a // b", "été"];

fn name(names: &'static [&'static str]) -> impl Strategy<Value = Name> {
    select(names).prop_map(Name::from)
}

fn comment() -> impl Strategy<Value = Option<Name>> {
    option::weighted(0.2, name(&COMMENTS))
}

fn expressions(names: &'static [&'static str]) -> impl Strategy<Value = Expr> {
    let comparison = (name(names), 0..3usize, 0..60i32).prop_map(|(left, relation, right)| {
        let relations = [Relation::Equal, Relation::Less, Relation::GreaterOrEqual];
        Expr::comparison(&left, relations[relation], &right.to_string())
    });
    let elapsed = (name(&TIMES), name(names))
        .prop_map(|(time, step)| Expr::Atom(Atom::Elapsed { time, step }));
    let leaf = prop_oneof![
        1 => any::<bool>().prop_map(Expr::Constant),
        8 => name(names).prop_map(Expr::variable),
        1 => comparison,
        1 => elapsed,
    ];
    leaf.prop_recursive(3, 16, 3, |inner| {
        prop_oneof![
            inner.clone().prop_map(Expr::complement),
            vec(inner.clone(), 1..4).prop_map(Expr::And),
            vec(inner.clone(), 1..4).prop_map(Expr::Or),
            inner.prop_map(|inner| Expr::Atom(Atom::Rise(Box::new(inner)))),
        ]
    })
}

fn conditions() -> impl Strategy<Value = Expr> {
    prop_oneof![3 => expressions(&VARIABLES), 1 => expressions(&STEPS)]
}

fn action_kinds() -> impl Strategy<Value = ActionKind> {
    let trigger = prop_oneof![
        Just(Trigger::Activation),
        Just(Trigger::Deactivation),
        conditions().prop_map(Trigger::Event),
    ];
    let effect = prop_oneof![
        Just(Effect::Set),
        Just(Effect::Reset),
        select(vec!["0", "C + 1", "-3 - \"a b\""]).prop_map(|term| Effect::Assign(term.into())),
    ];
    let situation = prop_oneof![
        vec(name(&STEPS), 0..3).prop_map(Situation::Steps),
        Just(Situation::Current),
        Just(Situation::Initial),
    ];
    prop_oneof![
        3 => (option::of(name(&TIMES)), option::of(name(&TIMES)))
            .prop_map(|(delay, limit)| ActionKind::Continuous { delay, limit }),
        2 => (effect, trigger).prop_map(|(effect, on)| ActionKind::Stored { effect, on }),
        1 => situation.prop_map(ActionKind::Forcing),
    ]
}

fn actions() -> impl Strategy<Value = Action> {
    (
        name(&STEPS),
        action_kinds(),
        name(&VARIABLES),
        option::weighted(0.3, conditions()),
        comment(),
    )
        .prop_map(|(step, kind, output, condition, comment)| Action {
            step,
            kind,
            output,
            condition,
            comment,
        })
}

/// A step of any kind; its name comes later.
fn steps() -> impl Strategy<Value = Step> {
    let kind = prop_oneof![
        6 => Just(StepKind::Plain),
        1 => name(&PARTS).prop_map(StepKind::Macro),
        1 => vec(name(&PARTS), 1..3).prop_map(StepKind::Enclosing),
    ];
    let state = option::weighted(0.3, name(&STATES));
    (
        kind,
        state,
        any::<bool>(),
        option::weighted(0.2, Just(())),
        comment(),
    )
        .prop_map(|(kind, state, initial, link, comment)| Step {
            name: "".into(),
            initial,
            activation_link: link.is_some(),
            state,
            kind,
            comment,
        })
}

fn transitions() -> impl Strategy<Value = Transition> {
    (
        vec(name(&STEPS), 0..3),
        vec(name(&STEPS), 0..3),
        conditions(),
        comment(),
    )
        .prop_map(|(from, to, receptivity, comment)| Transition {
            name: "".into(),
            from,
            to,
            receptivity,
            comment,
        })
}

fn decisions() -> impl Strategy<Value = Decision> {
    let state = || name(&STATES);
    let verdict = prop_oneof![
        (state(), vec(state(), 1..3)).prop_map(|(from, to)| Verdict::Accept { from, to }),
        (state(), state()).prop_map(|(from, to)| Verdict::Reject { from, to }),
        state().prop_map(Verdict::Initial),
        name(&LABELS).prop_map(Verdict::Keep),
        state().prop_map(Verdict::End),
    ];
    (verdict, comment()).prop_map(|(verdict, comment)| Decision { verdict, comment })
}

/// The right side of an environment rule: some names speak of the next scan.
fn next_scan() -> impl Strategy<Value = Expr> {
    fn marked(expr: &Expr, which: &mut impl FnMut() -> bool) -> Expr {
        match expr {
            Expr::Atom(Atom::Variable(name)) if which() => Expr::variable(in_next_scan(name)),
            Expr::Not(inner) => marked(inner, which).complement(),
            Expr::And(parts) => Expr::And(parts.iter().map(|part| marked(part, which)).collect()),
            Expr::Or(parts) => Expr::Or(parts.iter().map(|part| marked(part, which)).collect()),
            other => other.clone(),
        }
    }
    (expressions(&VARIABLES), any::<u32>()).prop_map(|(expr, mut bits)| {
        marked(&expr, &mut || {
            bits = bits.rotate_right(1);
            bits & 1 == 1
        })
    })
}

/// Deals things out over the main chart and the parts, each with a name of
/// its own.
fn deal<T>(
    names: Vec<&'static str>,
    things: Vec<(usize, T)>,
    charts: &mut [Chart],
    put: impl Fn(&mut Chart, &'static str, T),
) {
    for (name, (at, thing)) in names.into_iter().zip(things) {
        let at = at % charts.len();
        put(&mut charts[at], name, thing);
    }
}

fn variables() -> impl Strategy<Value = Vec<(usize, Variable)>> {
    let address = option::weighted(0.4, select(vec!["%I0", "%QX0.1", "Local:2:O", "I0.3"]));
    let variable = (select(&VARIABLES[..]), address, comment());
    vec((0..3usize, variable), 0..8).prop_map(|all| {
        let mut seen = std::collections::HashSet::new();
        all.into_iter()
            .filter(|(_, (name, _, _))| seen.insert(*name))
            .map(|(kind, (name, address, comment))| {
                let variable = Variable {
                    name: name.into(),
                    address: address.map(Name::from),
                    comment,
                };
                (kind, variable)
            })
            .collect()
    })
}

fn grafcets() -> impl Strategy<Value = Grafcet> {
    let part_kind = prop_oneof![
        Just(PartKind::Partial),
        Just(PartKind::Expansion {
            entry: "p1".into(),
            exit: "Step".into()
        }),
        vec(select(vec!["x", "y"]), 0..1).prop_map(|parameters| PartKind::Reusable {
            parameters: parameters.into_iter().map(Name::from).collect(),
        }),
    ];
    let parts = (subsequence(PARTS.to_vec(), 0..=3), vec(part_kind, 3));
    let charts = (
        (
            subsequence(STEPS.to_vec(), 0..=9),
            vec((0..4usize, steps()), 9),
        ),
        (
            subsequence(LABELS.to_vec(), 0..=5),
            vec((0..4usize, transitions()), 5),
        ),
        vec((0..4usize, actions()), 0..5),
    );
    let instance = (comment(), vec(name(&VARIABLES), 0..2), name(&PARTS));
    (
        option::weighted(0.5, select(vec!["Neutralization", "Truck 1"])),
        variables(),
        parts,
        charts,
        option::weighted(0.2, instance),
    )
        .prop_map(|(name, variables, (parts, kinds), charts, instance)| {
            let mut grafcet = Grafcet {
                name: name.map(Name::from),
                ..Grafcet::default()
            };
            for (kind, variable) in variables {
                match kind {
                    0 => grafcet.inputs.push(variable),
                    1 => grafcet.outputs.push(variable),
                    _ => grafcet.internals.push(variable),
                }
            }
            let mut all = vec![Chart::default(); parts.len() + 1];
            let ((step_names, steps), (labels, transitions), actions) = charts;
            deal(step_names, steps, &mut all, |chart, name, step| {
                chart.steps.push(Step {
                    name: name.into(),
                    ..step
                });
            });
            deal(labels, transitions, &mut all, |chart, name, transition| {
                chart.transitions.push(Transition {
                    name: name.into(),
                    ..transition
                });
            });
            for (at, action) in actions {
                let at = at % all.len();
                all[at].actions.push(action);
            }
            // Leading steps count as steps before the transition only if they
            // are declared.
            let declared: Vec<Name> = all
                .iter()
                .flat_map(|chart| &chart.steps)
                .map(|step| step.name.clone())
                .collect();
            for transition in all.iter_mut().flat_map(|chart| &mut chart.transitions) {
                transition.from.retain(|step| declared.contains(step));
            }
            let mut all = all.into_iter();
            grafcet.chart = all.next().unwrap_or_default();
            grafcet.parts = parts
                .into_iter()
                .zip(kinds)
                .zip(all)
                .map(|((name, kind), chart)| Part {
                    name: name.into(),
                    kind,
                    chart,
                })
                .collect();
            grafcet.instances = instance
                .into_iter()
                .map(|(comment, arguments, of)| Instance {
                    name: "d1".into(),
                    of,
                    arguments,
                    comment,
                })
                .collect();
            grafcet
        })
}

/// Specs of every shape, with names that need care.
pub fn specs() -> impl Strategy<Value = Spec> {
    let environment = vec((expressions(&VARIABLES), next_scan(), comment()), 0..3);
    let never = vec((conditions(), comment()), 0..3);
    (grafcets(), environment, never, vec(decisions(), 0..4)).prop_map(
        |(grafcet, environment, never, decisions)| Spec {
            grafcet,
            environment: environment
                .into_iter()
                .enumerate()
                .map(|(nth, (left, right, comment))| EnvironmentRule {
                    name: format!("e{nth}").into(),
                    left,
                    right,
                    comment,
                })
                .collect(),
            never: never
                .into_iter()
                .enumerate()
                .map(|(nth, (condition, comment))| Property {
                    name: format!("n{nth}").into(),
                    condition,
                    comment,
                })
                .collect(),
            decisions,
        },
    )
}

/// Lines that no canonical text has.
const LINES: [&str; 22] = [
    "",
    "   ",
    "// a remark",
    "//! accept v1 -> ",
    "//! reject v1 -> v4 // why not",
    "t1: p1* ",
    "t9: p1*m |-",
    "p1 |- @p2",
    "Step",
    "Step p9, p8   // two of them",
    "Step p1, 5, p7",
    "Step p7,  // first",
    "     Xv1  // second",
    "Input m, Input",
    "Marking p9, p1",
    "transition t1,  t2,",
    "Transitions:  // again",
    "Steps:",
    "Never:",
    "Partial G1",
    "e0: m |- @m*",
    "p1: m |- set ls2 on deactivation // done",
];

/// Texts as people leave them: a canonical text with lines moved, doubled,
/// broken, commented and put in.
pub fn texts() -> impl Strategy<Value = String> {
    let change = (any::<prop::sample::Index>(), 0..8usize, select(&LINES[..]));
    let style = (
        select(vec!["\n", "\r\n", "\r"]),
        any::<bool>(),
        any::<bool>(),
    );
    (specs(), vec(change, 0..8), style).prop_map(|(spec, changes, (line_end, mark, ends))| {
        let text = write(&spec);
        let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
        for (at, how, line) in changes {
            if lines.is_empty() {
                lines.push(line.to_owned());
            }
            let at = at.index(lines.len());
            match how {
                0 => drop(lines.remove(at)),
                1 => lines.insert(at, lines[at].clone()),
                2 => lines[at] += "  // by hand",
                3 => lines[at] = lines[at].replace('*', " * ").replace(": ", ":   "),
                4 => lines[at] = format!("\t{} ", lines[at].replace(", ", ",\n     ")),
                5 => lines[at] = lines[at].chars().take(lines[at].len() / 2).collect(),
                _ => lines.insert(at, line.to_owned()),
            }
        }
        let mut text = lines.join("\n");
        if ends {
            text.push('\n');
        }
        let text = text.replace('\n', line_end);
        match mark {
            true => format!("\u{feff}{text}"),
            false => text,
        }
    })
}

/// Texts made of the notation's signs in any order.
pub fn sign_soup() -> impl Strategy<Value = String> {
    let signs = select(vec![
        "Step ",
        "Transitions:\n",
        "Steps:\n",
        "Never:\n",
        "Environment:\n",
        "Input ",
        "Marking ",
        "Partial G1\n",
        "Macro ",
        "p1",
        "t1",
        "m",
        ":",
        ",",
        "*",
        "+",
        "/",
        "(",
        ")",
        "@",
        "|-",
        " ",
        "\n",
        "\r",
        "// c\n",
        "//! end ",
        "//! ",
        "5s/",
        "1",
        "-",
        "\"",
        "for",
        "set ",
        "{",
        "é",
        "\u{feff}",
        "t1: p1*m |- @p1\n",
        "Step p1, m\n",
    ]);
    vec(signs, 0..40).prop_map(|signs| signs.concat())
}

/// The lines that were not understood, as they are written. Of a list, what
/// follows the last name that was.
pub fn broken_lines(text: &str) -> Vec<String> {
    let found = read(text).diagnostics.into_iter();
    let broken = found.filter(|found| {
        found.code == source::codes::SPEC_SYNTAX && !found.message.contains("list not understood")
            || found.message.starts_with("decision not understood")
    });
    broken
        .filter_map(|found| {
            let start = text[..found.span.range().start].rfind(['\n', '\r']);
            let start = start.map_or(0, |at| at + 1);
            let line = text[start..].split(['\n', '\r']).next().unwrap_or_default();
            let is_instance = line
                .trim_start_matches(['\u{feff}', '\t'])
                .starts_with("Instance");
            (!is_instance).then(|| line.trim_start_matches('\u{feff}').to_owned())
        })
        .collect()
}

/// Takes some things out of a spec and some of another's in.
pub fn change(target: &mut Spec, removed: usize, other: &Spec) {
    let chart = &mut target.grafcet.chart;
    if !chart.steps.is_empty() {
        chart.steps.remove(removed % chart.steps.len());
    }
    if let Some(transition) = chart.transitions.first_mut() {
        transition.receptivity = Expr::variable("ls2");
    }
    chart
        .actions
        .extend(other.grafcet.chart.actions.iter().cloned());
    if removed.is_multiple_of(2) {
        target.environment.clone_from(&other.environment);
        target.decisions.truncate(removed % 3);
        target.grafcet.inputs.truncate(removed % 4);
    } else {
        target.decisions.extend(other.decisions.iter().cloned());
        target.grafcet.parts.truncate(removed % 3);
    }
    let steps: Vec<Name> = target
        .grafcet
        .steps()
        .map(|step| step.name.clone())
        .collect();
    let grafcet = &mut target.grafcet;
    let charts = grafcet.parts.iter_mut().map(|part| &mut part.chart);
    for chart in charts.chain([&mut grafcet.chart]) {
        for transition in &mut chart.transitions {
            transition.from.retain(|step| steps.contains(step));
        }
    }
}
