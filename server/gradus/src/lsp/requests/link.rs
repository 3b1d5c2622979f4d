//! `textDocument/documentLink`.

use std::sync::Arc;

use ide::Scenario;
use ide::navigate::Side;
use source::Span;
use tower_lsp::ls_types::DocumentLink;

use crate::lsp::document::Document;
use crate::lsp::key::in_folder_of;
use crate::lsp::query::Query;

/// The ways to the texts that belong to the document: from the program's name to
/// the spec, from the grafcet's name to the ladder, from both to scenarios that
/// they name; from a scenario to what it runs on. A text that is not there has no
/// link to it.
pub fn answer(query: &Query) -> Option<Vec<DocumentLink>> {
    let pair = query.pair();
    if let Some(scenario) = query.scenario() {
        return Some(of_scenario(query, scenario));
    }
    let (span, other, what) = match query.side()? {
        Side::Ladder => (
            ide::link_in_ladder(query.ladder()?),
            pair.document(Side::Spec),
            "spec",
        ),
        Side::Spec => (
            ide::link_in_spec(query.spec()?),
            pair.document(Side::Ladder),
            "ladder",
        ),
    };
    let link = span.zip(other);
    let mut links: Vec<DocumentLink> = link
        .map(|(span, other)| link_to(query, span, other, what))
        .into_iter()
        .collect();
    let scenarios = query.world.scenarios_of(&pair);
    if !scenarios.is_empty() {
        let text = query.document.rope.to_string();
        for scenario in &scenarios {
            let name = scenario.key.name();
            let places = ide::namings_of(&text, &name);
            links.extend(places.map(|span| link_to(query, span, scenario, "scenario")));
        }
    }
    Some(links)
}

/// From each file that the scenario names to that file; without one, from its
/// heading to the ladder.
fn of_scenario(query: &Query, scenario: &Scenario) -> Vec<DocumentLink> {
    let world = &query.world;
    let document = |path: &str| world.document(&in_folder_of(&query.document.uri, path)?);
    let named = ide::links_in_scenario(scenario);
    let named = named.filter_map(|(span, path)| Some((span, document(path)?)));
    let mut links: Vec<DocumentLink> = named
        .map(|(span, other)| {
            let what = match other.spec() {
                Some(_) => "spec",
                None => "ladder",
            };
            link_to(query, span, &other, what)
        })
        .collect();
    if scenario.reading.scenario.files.is_empty() {
        let pair = query.pair();
        let ladder = scenario.heading().zip(pair.document(Side::Ladder));
        links.extend(ladder.map(|(span, other)| link_to(query, span, other, "ladder")));
    }
    links
}

fn link_to(query: &Query, span: Span, other: &Arc<Document>, what: &str) -> DocumentLink {
    DocumentLink {
        range: query.range(span),
        target: Some(other.uri.clone()),
        tooltip: Some(format!("Open the {what} {}", other.key.name())),
        data: None,
    }
}
