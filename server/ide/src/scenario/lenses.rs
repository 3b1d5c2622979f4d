//! What stands above a scenario and its steps: how it went.

use recovery::simulation::{Side, Simulation};
use source::Span;

use super::{Run, Scenario};
use crate::navigate::Pair;

/// A line above a place of a scenario, and what it shows when it is taken.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ScenarioLens {
    /// The place.
    pub span: Span,
    /// What it says.
    pub title: String,
    /// What it shows.
    pub shows: Shows,
}

/// What a lens of a scenario shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shows {
    /// The table of all scans.
    Table,
    /// The last scan of a step, in ladder and spec.
    Scan(usize),
    /// No scan any more.
    NoScan,
}

/// The lenses of a scenario: how it went above its title, and a way to look at
/// the scan above each step that failed. The scan of the step `chosen` is shown
/// already.
pub fn lenses_in_scenario(
    scenario: &Scenario,
    pair: Pair<'_>,
    run: &Run,
    chosen: Option<usize>,
) -> Vec<ScenarioLens> {
    let Some(heading) = scenario.heading() else {
        return Vec::new();
    };
    let mut lenses = vec![ScenarioLens {
        span: heading,
        title: verdict(scenario, pair, run),
        shows: Shows::Table,
    }];
    let Some(simulation) = &run.simulation else {
        return lenses;
    };
    for row in simulation.rows.iter().filter(|row| row.is_last) {
        let Some(step) = scenario.steps().get(row.step) else {
            break;
        };
        let (title, shows) = if chosen == Some(row.step) {
            (
                format!("scan {} is shown: hide it", row.scan),
                Shows::NoScan,
            )
        } else if row.failures.is_empty() {
            continue;
        } else {
            (
                format!("show scan {} in ladder and spec", row.scan),
                Shows::Scan(row.step),
            )
        };
        lenses.push(ScenarioLens {
            span: step.span,
            title,
            shows,
        });
    }
    lenses
}

/// How a scenario went, in a line.
fn verdict(scenario: &Scenario, pair: Pair<'_>, run: &Run) -> String {
    if pair.ladder.is_none() && pair.spec.is_none() {
        return "not run: there is neither a ladder nor a spec".to_owned();
    }
    let Some(simulation) = &run.simulation else {
        let mistakes = scenario.reading.diagnostics.len() + run.unknown.len();
        let word = if mistakes == 1 { "mistake" } else { "mistakes" };
        return format!("not run: {mistakes} {word}");
    };
    let mut parts = went(scenario, pair, simulation);
    let scans = simulation.rows.last().map_or(0, |row| row.scan);
    let word = if scans == 1 { "scan" } else { "scans" };
    parts.push(format!("{scans} {word}"));
    if let Some((_, stop)) = &simulation.stopped {
        let reason = stop.sentence(scenario.reading.scenario.cycle_ms);
        parts.push(format!("stopped: {reason}"));
    } else if pair.ladder.is_some() && pair.spec.is_some() && !simulation.agrees() {
        parts.push("ladder and spec differ".to_owned());
    }
    parts.join(" · ")
}

fn went(scenario: &Scenario, pair: Pair<'_>, simulation: &Simulation) -> Vec<String> {
    let mut steps = scenario.steps().iter();
    if !steps.any(|step| step.only || !step.expected.is_empty()) {
        return vec!["expects nothing".to_owned()];
    }
    let failed = |side: Side| {
        let failures = simulation.failures();
        failures.filter(|(_, failure)| failure.side == side).count()
    };
    let sides = [
        (pair.ladder.is_some(), Side::Ladder),
        (pair.spec.is_some(), Side::Grafcet),
    ];
    let run: Vec<(Side, usize)> = sides
        .into_iter()
        .filter(|(is_run, _)| *is_run)
        .map(|(_, side)| (side, failed(side)))
        .collect();
    let word = match simulation.stopped {
        Some(_) => "as expected so far",
        None => "passes",
    };
    match &run[..] {
        [(_, 0), (_, 0)] => vec![format!("{word} on ladder and spec")],
        sides => sides
            .iter()
            .map(|(side, failures)| match failures {
                0 => format!("{word} on the {}", side.word()),
                1 => format!("1 expectation not met on the {}", side.word()),
                more => format!("{more} expectations not met on the {}", side.word()),
            })
            .collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests_of_runs::{LADDER, SCENARIO, SPEC, Tank};
    use super::*;

    /// `line: title`, lines counted from 1.
    fn shown(ladder: &str, spec: &str, scenario: &str, chosen: Option<usize>) -> Vec<String> {
        let tank = Tank::new(ladder, spec, scenario);
        let lenses = lenses_in_scenario(&tank.scenario, tank.pair(), &tank.run(), chosen);
        let line = |span: Span| scenario[..span.range().start].matches('\n').count() + 1;
        let all = lenses.iter();
        all.map(|lens| format!("{}: {}", line(lens.span), lens.title))
            .collect()
    }

    #[test]
    fn a_scenario_says_how_it_went() {
        let passes = ["1: passes on ladder and spec · 5 scans"];
        assert_eq!(shown(LADDER, SPEC, SCENARIO, None), passes);
        assert_eq!(
            shown(LADDER, "", SCENARIO, None),
            ["1: passes on the ladder · 5 scans"]
        );
        assert_eq!(
            shown("", "", SCENARIO, None),
            ["1: not run: there is neither a ladder nor a spec"]
        );
        assert_eq!(
            shown(LADDER, SPEC, "on s\n", None),
            ["1: expects nothing · 1 scan"]
        );
        assert_eq!(
            shown(LADDER, SPEC, "on s => on v9\non\n", None),
            ["1: not run: 2 mistakes"]
        );
        assert_eq!(
            shown(LADDER, SPEC, "on s => on v1\nwait 1d\n", None),
            [
                "1: as expected so far on ladder and spec · 1 scan · stopped: the step would take \
              8640000 scans of 10ms; say a longer `cycle`"
            ]
        );
        assert_eq!(shown(LADDER, SPEC, "// nothing\n", None), [""; 0]);
    }

    #[test]
    fn a_step_that_failed_can_be_looked_at() {
        let slow = LADDER.replace("/ls2", "/ls3");
        assert_eq!(
            shown(&slow, SPEC, SCENARIO, None),
            [
                "1: 1 expectation not met on the ladder · passes on the spec · 5 scans · ladder \
                 and spec differ",
                "3: show scan 5 in ladder and spec",
            ]
        );
        assert_eq!(
            shown(LADDER, SPEC, SCENARIO, Some(1)),
            [
                "1: passes on ladder and spec · 5 scans",
                "2: scan 4 is shown: hide it"
            ]
        );
    }
}
