//! A sequence that shows a difference, as a scenario that shows it again.

use ::scenario::{Expectation, FileName, Scenario, Test, write};
use ::verification::{Step, What};
use logic::notation::quoted;
use logic::{Datum, Name, Relation};
use recovery::simulation::{Extent, Side, Subject, simulate_within};
use source::Span;

use super::line::names_of;
use super::{About, Judged, steps};
use crate::scenario::most_scans;

/// The text of a scenario that goes through the sequence and expects, at its
/// end, what the ladder does: it passes on the ladder, and of a difference it
/// fails on the spec. `files` are what it runs on, as seen from where it will be.
/// `None` if there is no such sequence, or a run of it does not show the same, as
/// where something decides that no scenario can say, or where it takes more scans
/// than an editor runs.
pub fn trace_scenario(judged: Judged<'_>, about: &About, files: &[String]) -> Option<String> {
    let difference = judged.difference(about)?;
    let trace = &difference.trace;
    let last = trace.steps.last()?;
    let after = steps(trace.steps.len(), trace.timing);
    let (names, title): (Vec<Name>, String) = match (about, &difference.what) {
        (About::Property(label), _) => {
            let names = last.ladder.iter().map(|(name, _)| name.clone());
            (
                names.collect(),
                format!("{} violated after {after}", quoted(label)),
            )
        }
        (_, What::Outputs(names)) => {
            let differ = if names.len() == 1 {
                "differs"
            } else {
                "differ"
            };
            let title = format!("{} {differ} after {after}", names_of(names));
            (names.clone(), title)
        }
        (_, What::Unstable(_)) => (all(last), format!("no stable situation after {after}")),
        (_, What::Restless | What::Property) => (all(last), format!("no rest after {after}")),
    };
    let mut scenario = trace.scenario();
    scenario.title = Some(title.into());
    scenario.files = files.iter().map(|file| named(file)).collect();
    scenario.steps.last_mut()?.expected = names
        .iter()
        .filter_map(|name| expected(name, last))
        .collect();
    let text = write(&scenario);
    shows(&::scenario::read(&text).scenario, judged, about).then_some(text)
}

fn all(last: &Step) -> Vec<Name> {
    last.ladder.iter().map(|(name, _)| name.clone()).collect()
}

fn named(file: &str) -> FileName {
    FileName {
        path: file.into(),
        span: Span::default(),
    }
}

/// That a variable is as the ladder has it.
fn expected(name: &Name, last: &Step) -> Option<Expectation> {
    let (_, value) = last.ladder.iter().find(|(it, _)| it == name)?;
    Some(Expectation {
        name: name.clone(),
        test: match value {
            Datum::Bool(true) => Test::On,
            Datum::Bool(false) => Test::Off,
            number => Test::Compares(Relation::Equal, *number),
        },
        span: Span::default(),
        named: Span::default(),
    })
}

/// Whether a run of the scenario passes on the ladder, and of a difference fails
/// on the spec.
fn shows(scenario: &Scenario, judged: Judged<'_>, about: &About) -> bool {
    let program = judged.ladder.program();
    let extent = Extent {
        scans: most_scans(program.rungs().count()),
        wanted: &|| true,
    };
    let ladder = Some(program);
    let alone = Subject {
        ladder,
        grafcet: None,
    };
    let run = simulate_within(scenario, alone, extent);
    if run.stopped.is_some() || run.failures().next().is_some() {
        return false;
    }
    let both = Subject {
        ladder,
        grafcet: Some(&judged.spec.reading.spec.grafcet),
    };
    let run = simulate_within(scenario, both, extent);
    let fails = run.stopped.is_some() || run.failures().any(|(_, it)| it.side == Side::Grafcet);
    fails || matches!(about, About::Property(_))
}

/// A name for the scenario beside a spec called `stem`, the `number`th that is
/// tried: `tank-trace.scenario`, `tank-trace-2.scenario`.
pub fn trace_name(stem: &str, number: u32) -> String {
    match number {
        1 => format!("{stem}-trace.scenario"),
        more => format!("{stem}-trace-{more}.scenario"),
    }
}
