use ::scenario::Step;
use recovery::simulation::{
    Extent, Failure, Moment, Row, Side, Simulation, Stop, Subject, failed, findings, moment,
    simulate_within, unknown_names,
};
use source::{Diagnostic, Severity, codes};

use super::Scenario;
use crate::hover::rung_title;
use crate::navigate::{Pair, Target, driving, standing};

/// How often a run in an editor may solve a rung: about a second of work. Who
/// wants more runs `gradus simulate`.
const MOST_SOLVED: u64 = 1_000_000;

/// A run may take so many scans, however many rungs there are.
const FEWEST_SCANS: u64 = 100;

/// It may not take more, however few rungs there are: each may leave a row.
const MOST_SCANS: u64 = 100_000;

/// The scans that a run of a ladder with so many rungs may take.
pub(crate) fn most_scans(rungs: usize) -> u64 {
    let rungs = u64::try_from(rungs).unwrap_or(u64::MAX).max(1);
    (MOST_SOLVED / rungs).clamp(FEWEST_SCANS, MOST_SCANS)
}

/// What came of a scenario.
#[derive(Clone, Debug)]
pub struct Run {
    /// Names that nothing knows.
    pub unknown: Vec<Diagnostic>,
    /// The run; `None` of a scenario that has a mistake, or nothing to run on.
    pub simulation: Option<Simulation>,
}

/// Something to say about a scenario, with the places in the ladder and in the
/// spec that have to do with it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// What is said of the scenario's text.
    pub diagnostic: Diagnostic,
    /// Other places, and what is there.
    pub related: Vec<(Target, String)>,
}

/// What a scenario is run on.
pub fn subject(pair: Pair<'_>) -> Subject<'_> {
    Subject {
        ladder: pair.ladder.map(crate::Ladder::program),
        grafcet: pair.spec.map(|spec| &spec.reading.spec.grafcet),
    }
}

impl Run {
    /// Runs a scenario on a ladder, a spec or both, as long as somebody waits
    /// for it. One that has a mistake is not run: every later step would be
    /// tried in a state that nobody meant.
    pub fn new(scenario: &Scenario, pair: Pair<'_>, wanted: &dyn Fn() -> bool) -> Self {
        let rungs = pair.ladder.map_or(0, |it| it.program().rungs().count());
        let extent = Extent {
            scans: most_scans(rungs),
            wanted,
        };
        Self::within(scenario, pair, extent)
    }

    /// What there is to say of a scenario that is not run, since something that
    /// it runs on is missing.
    pub fn left_out(scenario: &Scenario, pair: Pair<'_>) -> Self {
        let subject = subject(pair);
        let is_there = subject.ladder.is_some() || subject.grafcet.is_some();
        Self {
            unknown: match is_there {
                true => unknown_names(&scenario.reading.scenario, subject),
                false => Vec::new(),
            },
            simulation: None,
        }
    }

    fn within(scenario: &Scenario, pair: Pair<'_>, extent: Extent<'_>) -> Self {
        let left_out = Self::left_out(scenario, pair);
        let is_there = pair.ladder.is_some() || pair.spec.is_some();
        let has_mistakes = !left_out.unknown.is_empty() || !scenario.reading.diagnostics.is_empty();
        let runs = || simulate_within(&scenario.reading.scenario, subject(pair), extent);
        Self {
            simulation: (is_there && !has_mistakes).then(runs),
            ..left_out
        }
    }

    /// Whether it was given up before its end.
    pub fn is_cancelled(&self) -> bool {
        let stopped = self.simulation.as_ref().and_then(|it| it.stopped.as_ref());
        matches!(stopped, Some((_, Stop::Cancelled)))
    }

    /// The row in which a step ended.
    pub fn end_of(&self, step: usize) -> Option<&Row> {
        let rows = self.simulation.as_ref()?.rows.iter();
        rows.rev().find(|row| row.step == step && row.is_last)
    }

    /// The step that a scan was done in, from 0; scans count from 1.
    pub fn step_of(&self, scan: u64) -> Option<usize> {
        let rows = self.simulation.as_ref()?.rows.iter();
        let mut ends = rows.filter(|row| row.is_last);
        let end = ends.find(|row| scan <= row.scan)?;
        (scan > 0).then_some(end.step)
    }

    /// What is in ladder and spec after a scan.
    pub fn moment<'p>(
        &self,
        scenario: &Scenario,
        pair: Pair<'p>,
        scan: u64,
        wanted: &dyn Fn() -> bool,
    ) -> Option<Moment<'p>> {
        self.simulation.as_ref()?;
        moment(&scenario.reading.scenario, subject(pair), scan, wanted)
    }

    /// Everything there is to say about the scenario, in the order of the
    /// places: about its text, about names that nothing knows, and about
    /// expectations that are not met.
    pub fn findings(&self, scenario: &Scenario, pair: Pair<'_>) -> Vec<Finding> {
        let plain = |diagnostic: Diagnostic| Finding {
            diagnostic,
            related: Vec::new(),
        };
        let text = scenario.reading.diagnostics.iter().chain(&self.unknown);
        let mut found: Vec<Finding> = text.cloned().map(plain).collect();
        if let Some(simulation) = &self.simulation {
            let failures = simulation.failures().filter_map(|(row, failure)| {
                let step = scenario.steps().get(row.step)?;
                Some(not_met(step, row, failure, pair))
            });
            found.extend(failures);
            let ended = findings(&scenario.reading.scenario, simulation).into_iter();
            let ended = ended.filter(|it| it.code == codes::SCENARIO_NOT_RUN);
            found.extend(ended.map(|it| match simulation.stopped {
                Some((_, Stop::Enough(_))) => plain(Diagnostic {
                    severity: Severity::Information,
                    ..it.help("`gradus simulate` runs it to its end")
                }),
                _ => plain(it),
            }));
        }
        found.sort_by_key(|it| (it.diagnostic.span, it.diagnostic.code));
        found
    }
}

/// An expectation that is not met: in the ladder the rungs that drive the name
/// have to do with it, in the spec its step, or the actions that write it.
fn not_met(step: &Step, row: &Row, failure: &Failure, pair: Pair<'_>) -> Finding {
    let name = &failure.name;
    let related = match failure.side {
        Side::Ladder => {
            let targets = pair.ladder.map_or(Vec::new(), |it| driving(it, name));
            let told = |target: Target| {
                let ladder = pair.ladder?;
                let place = ladder.rung_at(target.name.range().start)?;
                let message = format!("{} drives {name}", rung_title(ladder, place)?);
                Some((target, message))
            };
            targets.into_iter().filter_map(told).collect()
        }
        Side::Grafcet => pair
            .spec
            .map_or(Vec::new(), |it| standing(it, name))
            .into_iter()
            .map(|target| (target, format!("what the spec says of {name}")))
            .collect(),
    };
    Finding {
        diagnostic: failed(step, row, failure),
        related,
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests_of_runs::{LADDER, SCENARIO, SPEC, Tank};
    use super::*;
    use crate::navigate::Side as Text;

    /// What is said, each with the text that it is said of, and the other places.
    fn said(ladder: &str, spec: &str, scenario: &str) -> Vec<String> {
        let tank = Tank::new(ladder, spec, scenario);
        let found = tank.run().findings(&tank.scenario, tank.pair());
        let line = |it: &Finding| {
            let place = &scenario[it.diagnostic.span.range()];
            let mut line = format!("{place}: {}", it.diagnostic.message);
            for (target, message) in &it.related {
                let text = match target.side {
                    Text::Ladder => ladder,
                    Text::Spec => spec,
                };
                line += &format!(" [{}: {message}]", &text[target.name.range()]);
            }
            line
        };
        found.iter().map(line).collect()
    }

    #[test]
    fn what_fails_is_said_with_the_rung_and_the_action_that_have_to_do_with_it() {
        assert_eq!(said(LADDER, SPEC, SCENARIO), [""; 0]);
        assert_eq!(
            said(LADDER, SPEC, "on s => off %q0, off Xv1, off v1\n"),
            [
                "off %q0: %q0 should be off after scan 1, but the ladder has it on \
                 [v1: rung 0 of main drives %q0]",
                "off Xv1: Xv1 should be off after scan 1, but the spec has it on \
                 [Xv1: what the spec says of Xv1]",
                "off v1: v1 should be off after scan 1, but the ladder has it on \
                 [v1: rung 0 of main drives v1]",
                "off v1: v1 should be off after scan 1, but the spec has it on \
                 [v1: what the spec says of v1]",
            ]
        );
    }

    #[test]
    fn what_has_a_mistake_is_not_run() {
        assert_eq!(
            said(LADDER, "", "on s => off v1\nof ls2\n"),
            ["ls2: line not understood: expected `=` and a value, found `ls2`"]
        );
        assert_eq!(
            said(LADDER, "", "on s => off v1, on V2\n"),
            ["V2: the ladder does not know V2"]
        );
        assert_eq!(said("", "", "on s => off v1\n"), [""; 0]);
    }

    #[test]
    fn a_scan_belongs_to_the_step_that_it_was_done_in() {
        let run = Tank::new(LADDER, SPEC, SCENARIO).run();
        let steps = [0, 1, 2, 3, 4, 5, 6].map(|scan| run.step_of(scan));
        let wanted = [None, Some(0), Some(1), Some(1), Some(1), Some(2), None];
        assert_eq!(steps, wanted);
    }

    #[test]
    fn a_run_that_would_take_long_is_ended_and_says_so() {
        let tank = Tank::new(LADDER, "", "scan 200\nscan 200 => off v1\n");
        let extent = Extent {
            scans: 300,
            wanted: &|| true,
        };
        let run = Run::within(&tank.scenario, tank.pair(), extent);
        let found = run.findings(&tank.scenario, tank.pair());
        let [found] = &found[..] else {
            panic!("{found:?}");
        };
        let message = &found.diagnostic.message;
        assert_eq!(message, "the run was ended after 300 scans");
        assert_eq!(found.diagnostic.severity, Severity::Information);
        let given_up = Run::new(&tank.scenario, tank.pair(), &|| false);
        assert!(given_up.is_cancelled() && !run.is_cancelled());
        let most = [0, 8, 80, 1_000, 100_000].map(most_scans);
        assert_eq!(most, [100_000, 100_000, 12_500, 1_000, 100]);
    }
}
