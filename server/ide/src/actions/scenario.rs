//! Actions in a scenario: expect what came out, and look at a scan.

use ::scenario::{Expectation, Step, Test};
use logic::notation::TokenKind;
use logic::{Datum, Relation};
use recovery::simulation::{Failure, Row, Side, Simulation, Wanted, recorded};
use source::{Edit, Fix, Span};

use super::mend::{explaining, fixing};
use super::{Action, ActionKind, Asked, Effect};
use crate::changed::narrowed;
use crate::statement;
use crate::{Run, Scenario, Shows};

/// All that can be done at a place in a scenario, best first. The scan of the
/// step `chosen` is shown in ladder and spec already.
pub fn actions_in_scenario(
    scenario: &Scenario,
    run: &Run,
    chosen: Option<usize>,
    asked: Asked<'_>,
) -> Vec<Action> {
    let mut all = fixing(asked.findings);
    let selected = |step: &Step| {
        let line = statement::line(&scenario.text, step.span.range().start);
        let (start, end) = (asked.span.range().start, asked.span.range().end);
        line.start <= end && start <= line.end
    };
    let steps = scenario.steps().iter().enumerate();
    let steps: Vec<usize> = steps
        .filter(|(_, step)| selected(step))
        .map(|(at, _)| at)
        .collect();
    if let Some(simulation) = &run.simulation {
        for side in [Side::Ladder, Side::Grafcet] {
            all.extend(mending(scenario, simulation, side, &steps));
        }
        all.extend(recording(scenario, simulation, &steps));
    }
    if let [step] = steps[..]
        && let Some(row) = run.end_of(step)
    {
        all.push(looking(row, step, chosen));
    }
    all.extend(explaining(asked.findings));
    all
}

/// Expects what a side does where something else is expected: in the steps that
/// are selected, and, if there are others, everywhere.
fn mending(
    scenario: &Scenario,
    simulation: &Simulation,
    side: Side,
    selected: &[usize],
) -> Vec<Action> {
    let is_wrong = |row: &&Row| row.failures.iter().any(|it| it.side == side);
    let wrong: Vec<&Row> = simulation.rows.iter().filter(is_wrong).collect();
    let here = wrong.iter().copied();
    let here: Vec<&Row> = here.filter(|row| selected.contains(&row.step)).collect();
    if here.is_empty() {
        return Vec::new();
    }
    let word = side.word();
    let mut all = vec![mended(
        scenario,
        side,
        &here,
        format!("Expect what the {word} does"),
    )];
    if here.len() < wrong.len() {
        let title = format!("Expect everywhere what the {word} does");
        all.push(mended(scenario, side, &wrong, title));
    }
    all
}

fn mended(scenario: &Scenario, side: Side, rows: &[&Row], title: String) -> Action {
    let edits = rows.iter().filter_map(|row| {
        let step = scenario.steps().get(row.step)?;
        let mut step = step.clone();
        for failure in row.failures.iter().filter(|it| it.side == side) {
            put_right(&mut step, failure);
        }
        Some(rewritten(scenario, &step))
    });
    let edits = edits.collect();
    Action {
        title: title.clone(),
        kind: ActionKind::Fix,
        preferred: false,
        effect: Effect::Here(Fix { title, edits }),
    }
}

/// Has a step expect what was found instead of what was wanted.
fn put_right(step: &mut Step, failure: &Failure) {
    match failure.wanted {
        Wanted::Test(at, test) => {
            if let Some(expectation) = step.expected.get_mut(at) {
                expectation.test = found(failure.value, Some(test));
            }
        }
        Wanted::Unchanged(_) => step.expected.push(Expectation {
            name: failure.name.clone(),
            test: found(failure.value, None),
            span: Span::default(),
            named: Span::default(),
        }),
    }
}

/// The expectation that a value meets, in the form of the one that it did not.
fn found(value: Datum, wanted: Option<Test>) -> Test {
    match (value, wanted) {
        (Datum::Bool(true), _) => Test::On,
        (Datum::Bool(false), _) => Test::Off,
        (_, Some(Test::Off)) => Test::On,
        (number, _) => Test::Compares(Relation::Equal, number),
    }
}

/// The edit that gives the line of a step its expectations.
fn rewritten(scenario: &Scenario, step: &Step) -> Edit {
    let text = &*scenario.text;
    let tokens = statement::code(text, step.span.range());
    let mut arrow = tokens.iter();
    let arrow = arrow.find(|it| it.kind == TokenKind::DoubleArrow);
    let end = step.span.range().end;
    let expected = ::scenario::expected(step);
    match arrow {
        Some(arrow) => narrowed(text, arrow.span.range().end..end, &format!(" {expected}")),
        None => Edit {
            span: Span::at(end),
            text: format!(" => {expected}"),
        },
    }
}

/// Has steps that expect nothing so far expect what came out, and nothing else.
fn recording(scenario: &Scenario, simulation: &Simulation, selected: &[usize]) -> Option<Action> {
    let recorded = recorded(&scenario.reading.scenario, simulation).steps;
    let open = selected.iter().filter_map(|at| {
        let step = scenario.steps().get(*at)?;
        let is_open = !step.only && step.expected.is_empty();
        recorded.get(*at).filter(|_| is_open)
    });
    let edits: Vec<Edit> = open.map(|step| rewritten(scenario, step)).collect();
    let word = match simulation.ladder.is_empty() {
        true => Side::Grafcet.word(),
        false => Side::Ladder.word(),
    };
    let title = format!("Expect what the {word} does, and nothing else");
    (!edits.is_empty()).then(|| Action {
        title: title.clone(),
        kind: ActionKind::Expect,
        preferred: false,
        effect: Effect::Here(Fix { title, edits }),
    })
}

/// Shows the last scan of a step in ladder and spec, or shows it no more.
fn looking(row: &Row, step: usize, chosen: Option<usize>) -> Action {
    let (title, shows) = match chosen == Some(step) {
        true => (format!("Hide scan {}", row.scan), Shows::NoScan),
        false => (
            format!("Show scan {} in ladder and spec", row.scan),
            Shows::Scan(step),
        ),
    };
    Action {
        title,
        kind: ActionKind::Scan,
        preferred: false,
        effect: Effect::Look(shows),
    }
}

#[cfg(test)]
mod tests {
    use logic::Budget;
    use recovery::successions::Evidence;

    use super::*;
    use crate::edited;
    use crate::scenario::tests_of_runs::{LADDER, SCENARIO, SPEC, Tank};

    /// What can be done at `$0`: the title, and the text after it.
    fn offered(ladder: &str, spec: &str, text: &str, chosen: Option<usize>) -> Vec<String> {
        let offset = text.find("$0").expect("a cursor");
        let text = text.replace("$0", "");
        let tank = Tank::new(ladder, spec, &text);
        let run = tank.run();
        let findings = run.findings(&tank.scenario, tank.pair()).into_iter();
        let here = findings.map(|it| it.diagnostic);
        let here: Vec<_> = here.filter(|it| it.span.touches(offset)).collect();
        let asked = Asked {
            span: Span::at(offset),
            findings: &here,
            weakest: Evidence::Possible,
            budget: &Budget::default(),
        };
        let all = actions_in_scenario(&tank.scenario, &run, chosen, asked);
        let shown = all.into_iter().map(|action| match action.effect {
            Effect::Here(fix) => {
                let new = edited(&text, &fix.edits);
                let lines = new.lines().zip(text.lines());
                let lines: Vec<&str> = lines
                    .filter(|(new, old)| new != old)
                    .map(|(new, _)| new)
                    .collect();
                format!("{}: {}", action.title, lines.join(" / "))
            }
            _ => action.title,
        });
        shown.collect()
    }

    #[test]
    fn what_fails_can_be_expected_as_it_is() {
        let wrong = "on s => off v1$0, on Xv1  // Fill\non ls2=>only\n";
        assert_eq!(
            offered(LADDER, SPEC, wrong, None),
            [
                "Expect what the ladder does: on s => on v1, on Xv1  // Fill",
                "Expect everywhere what the ladder does: on s => on v1, on Xv1  // Fill / \
                 on ls2=> only off v1",
                "Expect what the spec does: on s => on v1, on Xv1  // Fill",
                "Expect everywhere what the spec does: on s => on v1, on Xv1  // Fill / \
                 on ls2=> only off v1",
                "Show scan 1 in ladder and spec",
                "Explain G5003: expectation not met",
            ]
        );
    }

    #[test]
    fn a_step_that_expects_nothing_can_be_recorded() {
        assert_eq!(
            offered(LADDER, SPEC, "$0on s  // Fill\n", Some(0)),
            [
                "Expect what the ladder does, and nothing else: on s => only on v1  // Fill",
                "Hide scan 1",
            ]
        );
        assert_eq!(
            offered("", SPEC, "on s\n$0off s\n", None),
            [
                "Expect what the spec does, and nothing else: off s => only",
                "Show scan 2 in ladder and spec",
            ]
        );
    }

    #[test]
    fn numbers_are_expected_as_numbers() {
        let counter = "input a\nrung: a -> n := n + 2\n";
        assert_eq!(
            offered(counter, "", "on a => n = 1, off n, n >$0 5\n", None)[0],
            "Expect what the ladder does: on a => n = 2, on n, n = 2"
        );
    }

    #[test]
    fn a_name_that_is_nearly_right_can_be_put_right() {
        let text = SCENARIO.replacen("on ls2", "on ls$03", 1);
        assert_eq!(
            offered(LADDER, SPEC, &text, None),
            [
                "Write ls2 instead: on ls2 => off v1",
                "Explain G5002: name that nothing in the run knows",
            ]
        );
    }
}
