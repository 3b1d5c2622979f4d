//! A real program that holds its own truth: a grafcet of 20 steps coded in
//! ladder, and the same grafcet drawn as a chart in the same file.
//!
//! Its routine `Etapes` has a rung for each step bit `X.n`, `Transitions` one
//! for each transition bit `Y.n` and each timer, `Actions` one for each
//! output. What should be recovered is read off their texts here by a few
//! lines that know these three routines and nothing else.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use grafcet::{
    Action, ActionKind, Chart, Difference, Effect, Grafcet, Spec, Step, Transition, Trigger,
    differences,
};
use ladder::Program;
use logic::{Budget, Expr, Function, Name, notation};
use petgraph::algo::is_isomorphic;
use recovery::conversion::{Accept, decide, spec};
use recovery::successions::Evidence;
use recovery::{Analysis, analyse};

/// An instruction of a rung: its mnemonic and its first operand.
type Instruction = (String, String);

/// The text of the file, where there is a corpus.
fn text() -> Option<String> {
    let path = end_to_end::corpus()?.join("l5x/francisboudreau7__l5x_sfc__MainProgram.L5X");
    Some(std::fs::read_to_string(path).expect("a real file can be read"))
}

/// The rungs of a routine, as their instructions.
fn rungs(text: &str, routine: &str) -> Vec<Vec<Instruction>> {
    let start = format!("<Routine Name=\"{routine}\"");
    let (_, rest) = text.split_once(&start).expect("the routine");
    let (body, _) = rest.split_once("</Routine>").expect("its end");
    let rungs = body.split("<![CDATA[").skip(1);
    rungs
        .map(|rung| {
            let (rung, _) = rung.split_once("]]>").expect("the end of a rung");
            rung.split(')').filter_map(instruction).collect()
        })
        .collect()
}

/// `[XIC(Y.3` is `XIC` of `Y.3`.
fn instruction(text: &str) -> Option<Instruction> {
    let (mnemonic, operands) = text.split_once('(')?;
    let operand = operands.split(',').next()?;
    let mnemonic = mnemonic.trim_start_matches(|c: char| !c.is_alphabetic());
    Some((mnemonic.to_owned(), operand.to_owned()))
}

fn operands<'r>(rung: &'r [Instruction], mnemonic: &str) -> Vec<&'r str> {
    let wanted = rung.iter().filter(|(it, _)| it == mnemonic);
    wanted.map(|(_, operand)| operand.as_str()).collect()
}

/// The pairs of steps that a transition bit joins, by the bit: it ends the
/// step before whose own contact it stands as a closed contact, and starts the
/// one whose rung it powers.
fn joined(text: &str) -> BTreeMap<String, (String, String)> {
    let mut ended = BTreeMap::new();
    let mut started = BTreeMap::new();
    for rung in rungs(text, "Etapes") {
        let [step] = operands(&rung, "OTE")[..] else {
            panic!("one step a rung: {rung:?}");
        };
        for bit in operands(&rung, "XIO") {
            assert_eq!(ended.insert(bit.to_owned(), step.to_owned()), None);
        }
        let bits = operands(&rung, "XIC");
        for bit in bits.into_iter().filter(|bit| bit.starts_with("Y.")) {
            assert_eq!(started.insert(bit.to_owned(), step.to_owned()), None);
        }
    }
    assert!(ended.keys().eq(started.keys()));
    let pairs = ended.into_iter().zip(started.into_values());
    pairs.map(|((bit, from), to)| (bit, (from, to))).collect()
}

/// The condition of every transition bit, less the contact of its step.
fn conditions(text: &str) -> BTreeMap<String, Expr> {
    let rungs = rungs(text, "Transitions").into_iter();
    rungs
        .filter_map(|rung| {
            let [bit] = operands(&rung, "OTE")[..] else {
                return None;
            };
            let literals = rung.iter().filter_map(|(mnemonic, operand)| {
                let variable = Expr::variable(operand.as_str());
                match mnemonic.as_str() {
                    "XIC" if !operand.starts_with("X.") => Some(variable),
                    "XIO" => Some(variable.complement()),
                    _ => None,
                }
            });
            Some((bit.to_owned(), Expr::And(literals.collect())))
        })
        .collect()
}

/// What the file's texts say the transitions are: their steps and conditions.
fn transitions(text: &str) -> BTreeMap<(String, String), Expr> {
    let mut conditions = conditions(text);
    let joined = joined(text);
    assert!(joined.keys().eq(conditions.keys()));
    let mut condition = |bit: &str| conditions.remove(bit).expect("every bit has one");
    joined
        .into_iter()
        .map(|(bit, pair)| (pair, condition(&bit)))
        .collect()
}

/// What the file's texts say the steps do: step, instruction, output.
fn actions(text: &str) -> BTreeSet<(String, String, String)> {
    let rungs = rungs(text, "Actions").into_iter();
    rungs
        .flat_map(|rung| {
            let (steps, outputs): (Vec<_>, Vec<_>) = rung
                .into_iter()
                .partition(|(mnemonic, _)| mnemonic == "XIC");
            let [(mnemonic, output)] = &outputs[..] else {
                panic!("one output a rung: {outputs:?}");
            };
            let of = |(_, step): Instruction| (step, mnemonic.clone(), output.clone());
            steps.into_iter().map(of).collect::<Vec<_>>()
        })
        .collect()
}

fn program(text: &str) -> Arc<Program> {
    ladder::read(text.as_bytes()).program
}

/// The spec with every handover accepted.
fn accepted(analysis: &Analysis) -> Spec {
    let budget = Budget::default();
    let decisions = decide(analysis, &[], &Accept::Handovers);
    spec(analysis, &decisions, &budget)
}

/// The state of the ladder that a step stands for.
fn state_of(spec: &Spec, step: &str) -> String {
    let step = spec.grafcet.step(step).expect("a step of the spec");
    step.state.as_deref().expect("it stands for a state").into()
}

#[test]
fn handovers_are_the_transitions_of_the_chart_and_no_others() {
    let Some(text) = text() else { return };
    let program = program(&text);
    let analysis = analyse(&program, &Budget::default());
    let expected = transitions(&text);
    assert_eq!(expected.len(), 22);

    let found: Vec<_> = analysis
        .successions()
        .iter()
        .filter(|it| it.evidence != Evidence::Possible)
        .collect();
    assert!(found.iter().all(|it| it.evidence == Evidence::Handover));
    let pairs: Vec<_> = found
        .iter()
        .map(|it| (it.from.to_string(), it.to.to_string()))
        .collect();
    assert_eq!(
        pairs.iter().cloned().collect::<BTreeSet<_>>(),
        expected.keys().cloned().collect()
    );
    assert_eq!(pairs.len(), 22);

    let mut atoms = analysis.conditions.atoms.clone();
    for (handover, pair) in found.iter().zip(&pairs) {
        let expected = Function::of(&expected[pair], &mut atoms, &Budget::default());
        assert_eq!(handover.condition, expected.ok(), "{pair:?}");
    }
    assert_eq!(atoms.len(), analysis.conditions.atoms.len());
}

#[test]
fn the_group_of_its_steps_is_a_sequence() {
    let Some(text) = text() else { return };
    let program = program(&text);
    let analysis = analyse(&program, &Budget::default());
    let [group] = analysis.groups() else {
        panic!("one group: {:?}", analysis.groups());
    };
    assert!(group.sequence, "{}", group.reason);
    assert_eq!(group.states.len(), 20);
}

/// The drawn chart as a grafcet, its conditions in the project's notation.
fn drawn(program: &Program) -> Grafcet {
    let [chart] = &program.charts[..] else {
        panic!("one chart");
    };
    let name = |place: &usize| chart.steps[*place].name.clone();
    let steps = chart.steps.iter().map(|step| Step {
        initial: step.initial,
        ..Step::new(step.name.clone())
    });
    let transitions = chart.transitions.iter().map(|transition| Transition {
        name: transition.name.clone(),
        from: transition.from.iter().map(name).collect(),
        to: transition.to.iter().map(name).collect(),
        receptivity: condition(&transition.condition),
        comment: None,
    });
    Grafcet {
        chart: Chart {
            steps: steps.collect(),
            transitions: transitions.collect(),
            actions: Vec::new(),
        },
        ..Grafcet::default()
    }
}

/// A condition of the chart's structured text. Every step of a chart is a
/// timer of its own: where the ladder has `T2.DN` the chart has `Step_002.DN`.
fn condition(text: &str) -> Expr {
    let text = text.trim_end_matches(';').to_lowercase();
    let factors = text.split(" and ").map(|factor| {
        let (sign, rest) = match factor.trim().strip_prefix("not") {
            Some(rest) => ("/", rest),
            None => ("", factor),
        };
        let name = rest.trim_matches(|c: char| " ()".contains(c));
        let timer = name
            .strip_prefix("step_")
            .and_then(|it| it.strip_suffix(".dn"));
        let name = match timer {
            Some(number) => format!("T{}.DN", number.parse::<u32>().expect("a number")),
            None if name == "bonsens" => "Bonsens".to_owned(),
            None => name.to_owned(),
        };
        notation::parse(&format!("{sign}{name}")).expect("a literal")
    });
    Expr::And(factors.collect())
}

/// Which step of `right` each step of `left` is, found by walking both from
/// their initial steps along transitions of equal conditions.
fn paired(left: &Grafcet, right: &Grafcet) -> BTreeMap<Name, Name> {
    let initial = |grafcet: &Grafcet| {
        let steps: Vec<Name> = grafcet.initial_steps().map(|it| it.name.clone()).collect();
        let [only] = &steps[..] else {
            panic!("one initial step: {steps:?}");
        };
        only.clone()
    };
    let meaning = |expr: &Expr| {
        let mut literals = Vec::new();
        match expr {
            Expr::And(parts) => literals.extend(parts.iter().map(Expr::to_string)),
            other => literals.push(other.to_string()),
        }
        literals.sort();
        literals
    };
    let follower = |transition: &Transition| transition.to.first().expect("a step").clone();
    let mut pairs = BTreeMap::from([(initial(left), initial(right))]);
    let mut waiting = vec![(initial(left), initial(right))];
    while let Some((here, there)) = waiting.pop() {
        for transition in left.transitions().filter(|it| it.from.contains(&here)) {
            let same = right.transitions().find(|it| {
                it.from.contains(&there)
                    && meaning(&it.receptivity) == meaning(&transition.receptivity)
            });
            let same = same.unwrap_or_else(|| panic!("{transition:?} is drawn too"));
            let pair = (follower(transition), follower(same));
            if pairs.insert(pair.0.clone(), pair.1.clone()).is_none() {
                waiting.push(pair);
            }
        }
    }
    pairs
}

#[test]
fn the_recovered_chart_is_the_one_that_is_drawn_in_the_file() {
    let Some(text) = text() else { return };
    let program = program(&text);
    let spec = accepted(&analyse(&program, &Budget::default()));
    let drawn = drawn(&program);
    assert_eq!(drawn.steps().count(), 20);
    assert!(is_isomorphic(&spec.grafcet.graph(), &drawn.graph()));

    let pairs = paired(&spec.grafcet, &drawn);
    assert_eq!(pairs.len(), 20);
    assert_eq!(
        differences(&spec.grafcet, &drawn, &pairs),
        Vec::<Difference>::new()
    );
    for (step, other) in &pairs {
        let state = state_of(&spec, step);
        let number: usize = state.trim_start_matches("X.").parse().expect("a number");
        assert_eq!(**other, format!("Step_{number:03}"));
    }
}

#[test]
fn the_step_that_the_first_scan_sets_is_initial() {
    let Some(text) = text() else { return };
    let program = program(&text);
    let spec = accepted(&analyse(&program, &Budget::default()));
    let initial: Vec<String> = spec
        .grafcet
        .initial_steps()
        .map(|step| state_of(&spec, &step.name))
        .collect();
    assert_eq!(initial, ["X.0"]);
}

/// The instruction that an action without conditions was written with.
fn mnemonic(action: &Action) -> &'static str {
    assert_eq!(action.condition, None, "{action:?}");
    match &action.kind {
        ActionKind::Continuous {
            delay: None,
            limit: None,
        } => "OTE",
        ActionKind::Stored {
            effect: Effect::Set,
            on: Trigger::Activation,
        } => "OTL",
        ActionKind::Stored {
            effect: Effect::Reset,
            on: Trigger::Activation,
        } => "OTU",
        other => panic!("no instruction writes {other:?}"),
    }
}

#[test]
fn actions_are_those_of_the_routine_with_their_kinds() {
    let Some(text) = text() else { return };
    let program = program(&text);
    let spec = accepted(&analyse(&program, &Budget::default()));
    let found: BTreeSet<(String, String, String)> = spec
        .grafcet
        .actions()
        .map(|action| {
            let state = state_of(&spec, &action.step);
            (
                state,
                mnemonic(action).to_owned(),
                action.output.to_string(),
            )
        })
        .collect();
    assert_eq!(spec.grafcet.actions().count(), 19);
    assert_eq!(found, actions(&text));
}
