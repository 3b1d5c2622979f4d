use std::collections::BTreeSet;

use logic::notation::{quoted, time};
use logic::{Datum, Name};
use scenario::{Scenario, Step, Test};
use source::{Diagnostic, Edit, Span, codes};

use super::sides::{Names, Spec};
use super::spelling::nearest;
use super::{Failure, Row, Simulation, Stop, Subject, Wanted};

/// The names in `scenario` that nothing in `subject` knows.
pub fn unknown(scenario: &Scenario, subject: Subject<'_>) -> BTreeSet<Name> {
    let ladder = subject.ladder.map(Names::new);
    let spec = subject.grafcet.map(Spec::new);
    let is_known = |name: &str| {
        ladder.as_ref().is_some_and(|names| names.knows(name))
            || spec.as_ref().is_some_and(|spec| spec.machine.knows(name))
    };
    let names = names(scenario).map(|(name, _)| name);
    names.filter(|name| !is_known(name)).cloned().collect()
}

/// The same as findings about the scenario's text.
pub fn unknown_names(scenario: &Scenario, subject: Subject<'_>) -> Vec<Diagnostic> {
    let who = match (subject.ladder, subject.grafcet) {
        (Some(_), Some(_)) => "neither the ladder nor the spec knows",
        (None, Some(_)) => "the spec does not know",
        _ => "the ladder does not know",
    };
    let unknown = unknown(scenario, subject);
    names(scenario)
        .filter(|(name, _)| unknown.contains(*name))
        .map(|(name, span)| {
            let message = format!("{who} {}", quoted(name));
            let found = Diagnostic::new(codes::SCENARIO_NAME_UNKNOWN, span, message);
            match nearest(name, subject) {
                Some(known) => {
                    let text = scenario::spelled(&known);
                    let title = format!("Write {text} instead");
                    let edits = vec![Edit { span, text }];
                    found
                        .help(format!("did you mean {}?", quoted(&known)))
                        .fix(title, edits)
                }
                None => found.help("correct the spelling; capital and small letters differ"),
            }
        })
        .collect()
}

/// The names that a scenario's steps mention, and where.
fn names(scenario: &Scenario) -> impl Iterator<Item = (&Name, Span)> {
    scenario.steps.iter().flat_map(|step| {
        let changes = step.changes.iter().map(|it| (&it.name, it.span));
        changes.chain(step.expected.iter().map(|it| (&it.name, it.named)))
    })
}

/// What came of `scenario`, as findings about its text: expectations that were
/// not met, and why the run ended early.
pub fn findings(scenario: &Scenario, simulation: &Simulation) -> Vec<Diagnostic> {
    let failures = simulation.failures().filter_map(|(row, failure)| {
        let step = scenario.steps.get(row.step)?;
        Some(failed(step, row, failure))
    });
    let mut found: Vec<Diagnostic> = failures.collect();
    if let Some((at, stop)) = &simulation.stopped
        && let Some(step) = scenario.steps.get(*at)
    {
        let message = stop.sentence(scenario.cycle_ms);
        found.push(Diagnostic::new(codes::SCENARIO_NOT_RUN, step.span, message));
    }
    found
}

/// What is said of `failure` of `step`, which was seen in `row`.
pub fn failed(step: &Step, row: &Row, failure: &Failure) -> Diagnostic {
    let span: Span = match failure.wanted {
        Wanted::Test(at, _) => step.expected.get(at).map_or(step.span, |it| it.span),
        Wanted::Unchanged(_) => step.span,
    };
    let sentence = failure.sentence_when(&format!(" after scan {}", row.scan));
    Diagnostic::new(codes::EXPECTATION_FAILED, span, sentence)
}

impl Failure {
    /// `v1 should be on, but the ladder has it off`.
    pub fn sentence(&self) -> String {
        self.sentence_when("")
    }

    fn sentence_when(&self, when: &str) -> String {
        let name = quoted(&self.name);
        let has = format!("the {} has it {}", self.side.word(), shown(self.value));
        match self.wanted {
            Wanted::Test(_, Test::On) => format!("{name} should be on{when}, but {has}"),
            Wanted::Test(_, Test::Off) => format!("{name} should be off{when}, but {has}"),
            Wanted::Test(_, Test::Compares(relation, number)) => {
                let sign = relation.sign();
                format!("{name} should be {sign} {number}{when}, but {has}")
            }
            Wanted::Unchanged(before) => {
                format!("{name} should stay {}{when}, but {has}", shown(before))
            }
        }
    }
}

impl Stop {
    /// What happened, where a scan takes `cycle_ms`.
    pub fn sentence(&self, cycle_ms: u64) -> String {
        match self {
            Self::Unstable(unstable) => format!("the spec {unstable}"),
            Self::Restless => {
                "ladder and spec do not come to rest: something changes in every scan".to_owned()
            }
            Self::TooLong(scans) => {
                let cycle = time(cycle_ms);
                format!("the step would take {scans} scans of {cycle}; say a longer `cycle`")
            }
            Self::Enough(scans) => format!("the run was ended after {scans} scans"),
            Self::Cancelled => "the run was stopped".to_owned(),
        }
    }
}

/// A value as sentences say it.
fn shown(value: Datum) -> Name {
    match value {
        Datum::Bool(true) => "on".into(),
        Datum::Bool(false) => "off".into(),
        number => number.to_string().into(),
    }
}
