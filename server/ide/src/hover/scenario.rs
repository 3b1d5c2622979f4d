//! The thing under the pointer in a scenario.

use grafcet::Role;
use logic::{Budget, Datum, Name};
use source::Span;

use super::ladder::of_variable;
use super::spec::{of_step, of_value};
use super::{Block, Hover};
use crate::navigate::Pair;
use crate::scenario::{fields, variable};
use crate::{Run, Scenario, StepName};

/// A run, and what it was of.
#[derive(Clone, Copy, Debug)]
pub struct RunOn<'r> {
    /// The ladder, the spec or both that ran.
    pub run_on: Pair<'r>,
    /// What came of it.
    pub run: &'r Run,
}

/// What is known of the thing at the byte `offset` of a scenario: a name, as the
/// ladder or the spec tells of it, with its value after that step; elsewhere in
/// a step how its last scan ended.
pub fn hover_in_scenario(
    scenario: &Scenario,
    pair: Pair<'_>,
    own: RunOn<'_>,
    offset: usize,
    budget: &Budget,
) -> Option<Hover> {
    let RunOn { run_on, run } = own;
    let Some(named) = scenario.name_at(offset) else {
        return of_scenario_step(scenario, run_on, run, offset);
    };
    let mut hover = of_name(pair, named.name, budget)?;
    hover.span = named.span;
    let values = values(scenario, run_on, run, named, budget);
    hover.blocks.splice(0..0, values);
    Some(hover)
}

fn of_name(pair: Pair<'_>, name: &Name, budget: &Budget) -> Option<Hover> {
    if let Some(ladder) = pair.ladder
        && let Some(known) = variable(ladder, name)
    {
        return Some(of_variable(
            ladder,
            pair.spec,
            &known,
            Span::default(),
            budget,
        ));
    }
    let spec = pair.spec?;
    let places = &spec.reading.places;
    if let Some(step) = places.declaration(name, Role::Step) {
        return of_step(spec, pair.ladder, step, budget);
    }
    let mut mentions = places.mentions.iter();
    let variable = mentions.find(|it| it.role == Role::Variable && it.name == *name)?;
    of_value(spec, pair.ladder, variable, budget)
}

/// The value of a name in ladder and spec after the step that it stands in.
fn values(
    scenario: &Scenario,
    pair: Pair<'_>,
    run: &Run,
    named: StepName<'_>,
    budget: &Budget,
) -> Vec<Block> {
    let wanted = || !budget.cancel.is_cancelled();
    let row = run.end_of(named.step);
    let moment = row.and_then(|row| run.moment(scenario, pair, row.scan, &wanted));
    let (Some(row), Some(moment)) = (row, moment) else {
        return Vec::new();
    };
    let sides = [
        ("ladder", moment.in_ladder(named.name)),
        ("spec", moment.in_grafcet(named.name)),
    ];
    let known = sides
        .into_iter()
        .filter_map(|(side, value)| Some((side, shown(value?))));
    let known: Vec<(&'static str, String)> = known.collect();
    match known.is_empty() {
        true => Vec::new(),
        false => vec![
            Block::Text(format!("After scan {}:", row.scan)),
            Block::Fields(known),
        ],
    }
}

fn shown(value: Datum) -> String {
    match value {
        Datum::Bool(true) => "on".to_owned(),
        Datum::Bool(false) => "off".to_owned(),
        number => number.to_string(),
    }
}

/// How the last scan of a step ended.
fn of_scenario_step(
    scenario: &Scenario,
    pair: Pair<'_>,
    run: &Run,
    offset: usize,
) -> Option<Hover> {
    let at = scenario.step_at(offset)?;
    let step = scenario.steps().get(at)?;
    if !step.span.touches(offset) {
        return None;
    }
    let row = run.end_of(at)?;
    let simulation = run.simulation.as_ref()?;
    let mut blocks = vec![Block::Fields(fields(simulation, pair, row))];
    let failures = row.failures.iter();
    blocks.extend(failures.map(|it| Block::Text(it.sentence())));
    Some(Hover {
        span: step.span,
        name: ::scenario::done(step),
        address: None,
        summary: step.comment.as_deref().unwrap_or_default().to_owned(),
        blocks,
        terms: Vec::new(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::tests_of_runs::{LADDER, SPEC, Tank};

    /// What is shown at `$0`.
    fn shown_at(text: &str) -> Option<String> {
        let offset = text.find("$0").expect("a cursor");
        let tank = Tank::new(LADDER, SPEC, &text.replace("$0", ""));
        let budget = Budget::default();
        let run = tank.run();
        let own = RunOn {
            run_on: tank.pair(),
            run: &run,
        };
        let hover = hover_in_scenario(&tank.scenario, tank.pair(), own, offset, &budget)?;
        Some(hover.plain())
    }

    #[test]
    fn a_name_is_what_the_ladder_says_of_it_and_has_a_value() {
        let shown = shown_at("on s => on v$01\non ls2 => off v1\n").expect("a hover");
        let begins = "v1  %Q0\nholds a state (seal-in)\n\nAfter scan 1:\n\nladder       on\n\
                      spec         on\n\nturns on     s*/ls2\n";
        assert!(shown.starts_with(begins), "{shown}");
        let shown = shown_at("on s => on v1\non ls2 => off %Q$00\n").expect("a hover");
        assert!(
            shown.contains("After scan 2:\n\nladder       off\n\n"),
            "{shown}"
        );
    }

    #[test]
    fn a_step_of_the_spec_is_active_or_not() {
        let shown = shown_at("on s => on X$0v1\n").expect("a hover");
        assert!(
            shown.starts_with("Xv1\nstep for v1\n\nAfter scan 1:\n\nspec         on\n"),
            "{shown}"
        );
        assert_eq!(shown_at("on nothi$0ng\n"), None);
    }

    #[test]
    fn elsewhere_in_a_step_its_last_scan_is_shown() {
        let shown = shown_at("on s, scan 2 $0=> off v1  // Start\n").expect("a hover");
        assert_eq!(
            shown,
            "on s, scan 2\nStart\n\nscan          2, at 20ms\nladder        v1\n\
             active steps  Xv1\nspec          v1\n\n\
             v1 should be off, but the ladder has it on\n\n\
             v1 should be off, but the spec has it on"
        );
        assert_eq!(shown_at("// x$0\non s\n"), None);
    }
}
