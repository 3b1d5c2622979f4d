use logic::{Datum, Name, Relation};
use scenario::{Expectation, Scenario, Test};
use source::Span;

use super::{Simulation, Values};

/// The scenario with what came out as its expectations: at each step the
/// outputs that changed, and `only` those. Of a run side by side it is what
/// the ladder did. Steps that were not run are left out.
pub fn recorded(scenario: &Scenario, simulation: &Simulation) -> Scenario {
    let mut steps = Vec::new();
    let mut before = &simulation.start;
    for row in simulation.rows.iter().filter(|row| row.is_last) {
        let Some(step) = scenario.steps.get(row.step) else {
            break;
        };
        let mut step = step.clone();
        step.expected = changed(simulation, before, &row.values);
        step.only = true;
        steps.push(step);
        before = &row.values;
    }
    Scenario {
        steps,
        ..scenario.clone()
    }
}

fn changed(simulation: &Simulation, before: &Values, now: &Values) -> Vec<Expectation> {
    let (names, before, now) = match simulation.ladder.is_empty() {
        true => (&simulation.grafcet, &before.grafcet, &now.grafcet),
        false => (&simulation.ladder, &before.ladder, &now.ladder),
    };
    let all = names.iter().zip(before.iter().zip(now));
    let changed = all.filter(|(_, (before, now))| !before.compares(Relation::Equal, **now));
    changed
        .map(|(name, (_, now))| expectation(name, *now))
        .collect()
}

fn expectation(name: &Name, value: Datum) -> Expectation {
    Expectation {
        name: name.clone(),
        test: match value {
            Datum::Bool(true) => Test::On,
            Datum::Bool(false) => Test::Off,
            number => Test::Compares(Relation::Equal, number),
        },
        span: Span::default(),
        named: Span::default(),
    }
}
