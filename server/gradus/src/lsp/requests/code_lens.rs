//! `textDocument/codeLens`.

use ide::{Scenario, Shows};
use serde_json::{Value, json};
use source::Span;
use tower_lsp::ls_types::{CodeLens, Command};

use super::command::OPEN_SPEC;
use super::simulate::{HIDE_SCAN, SHOW_SCAN, SIMULATE};
use super::verify::{self, VERIFY};
use crate::lsp::query::{Pair, Query, Text};

/// The lenses of a document.
pub fn answer(query: &Query) -> Option<Vec<CodeLens>> {
    if !query.config().code_lens.enable {
        return None;
    }
    if let Some(scenario) = query.scenario() {
        return of_scenario(query, scenario);
    }
    let pair = query.pair();
    let weakest = query.weakest();
    let ladder = pair.ladder()?;
    let (lenses, place) = match query.text()? {
        Text::Spec(spec) => (
            ide::lenses_in_spec(spec, ladder, weakest),
            ide::link_in_spec(spec),
        ),
        _ => (
            ide::lenses_in_ladder(ladder, pair.spec().map(|it| &**it), weakest),
            ide::link_in_ladder(ladder),
        ),
    };
    let argument = json!({ "uri": pair.ladder.as_ref()?.uri });
    let lenses = lenses.into_iter();
    let lenses = lenses.map(|it| lens(query, it.span, it.title, OPEN_SPEC, argument.clone()));
    let scenarios = query.world.scenarios_of(&pair).into_iter();
    let scenarios = scenarios.take(MOST_SCENARIOS).filter_map(|scenario| {
        let title = format!("run {}", scenario.key.name());
        Some(lens(
            query,
            place?,
            title,
            SIMULATE,
            json!({ "uri": scenario.uri }),
        ))
    });
    let verdict = verdict(query, &pair, place);
    Some(verdict.into_iter().chain(scenarios).chain(lenses).collect())
}

/// Above a spec: whether it does what its ladder does.
fn verdict(query: &Query, pair: &Pair, place: Option<Span>) -> Option<CodeLens> {
    query.spec()?;
    let standing = query.world.verdicts.standing(pair, &query.config().verify);
    let title = verify::line(&standing);
    let argument = json!({ "uri": query.document.uri });
    Some(lens(query, place?, title, VERIFY, argument))
}

/// Scenarios that are named above the beginning of a ladder or a spec.
const MOST_SCENARIOS: usize = 8;

/// How a scenario went, and which of its scans can be looked at.
fn of_scenario(query: &Query, scenario: &Scenario) -> Option<Vec<CodeLens>> {
    let (plant, run) = query.run()?;
    let uri = &query.document.uri;
    let chosen = query.chosen_step(&run);
    let lenses = ide::lenses_in_scenario(scenario, plant.run_on(), &run, chosen);
    let lenses = lenses.into_iter().map(|it| {
        let line = query.range(it.span).start.line;
        let (command, argument) = match it.shows {
            Shows::Table => (SIMULATE, json!({ "uri": uri })),
            Shows::Scan(_) => (SHOW_SCAN, json!({ "uri": uri, "line": line })),
            Shows::NoScan => (HIDE_SCAN, json!({ "uri": uri })),
        };
        lens(query, it.span, it.title, command, argument)
    });
    Some(lenses.collect())
}

fn lens(query: &Query, at: Span, title: String, command: &str, argument: Value) -> CodeLens {
    let start = query.range(at).start;
    CodeLens {
        range: tower_lsp::ls_types::Range::new(start, start),
        command: Some(Command {
            title,
            command: command.to_owned(),
            arguments: Some(vec![argument]),
        }),
        data: None,
    }
}
