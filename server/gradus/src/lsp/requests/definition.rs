//! `textDocument/definition` and `textDocument/declaration`.

use ide::navigate::{self, Jump};
use tower_lsp::ls_types::{GotoDefinitionResponse, LocationLink, Position};

use crate::lsp::query::Query;

/// Where the thing at a position gets its value or its meaning.
pub fn definition(query: &Query, at: Position) -> Option<GotoDefinitionResponse> {
    let (pair, offset) = (query.pair(), query.offset(at));
    let pair = pair.looked_at();
    let jump = match query.scenario() {
        Some(scenario) => navigate::definition_in_scenario(scenario, pair, offset)?,
        None => navigate::definition(pair, query.side()?, offset)?,
    };
    said(query, &jump)
}

/// Where the thing at a position is declared.
pub fn declaration(query: &Query, at: Position) -> Option<GotoDefinitionResponse> {
    let (pair, offset) = (query.pair(), query.offset(at));
    let pair = pair.looked_at();
    let jump = match query.scenario() {
        Some(scenario) => navigate::declaration_in_scenario(scenario, pair, offset)?,
        None => navigate::declaration(pair, query.side()?, offset)?,
    };
    said(query, &jump)
}

fn said(query: &Query, jump: &Jump) -> Option<GotoDefinitionResponse> {
    let pair = query.pair();
    if !query.world.abilities.location_links {
        let all = jump.to.iter().filter_map(|target| {
            let document = pair.document(target.side)?;
            Some(query.location(document, target.name))
        });
        return Some(GotoDefinitionResponse::Array(all.collect()));
    }
    let from = query.range(jump.from);
    let all = jump.to.iter().filter_map(|target| {
        let document = pair.document(target.side)?;
        Some(LocationLink {
            origin_selection_range: Some(from),
            target_uri: document.uri.clone(),
            target_range: query.encoding().range(&document.rope, target.whole),
            target_selection_range: query.encoding().range(&document.rope, target.name),
        })
    });
    Some(GotoDefinitionResponse::Link(all.collect()))
}
