//! `textDocument/documentHighlight`.

use ide::navigate::{self, Access};
use tower_lsp::ls_types::{DocumentHighlight, DocumentHighlightKind, Position};

use crate::lsp::query::Query;

/// The places of the thing at a position, in the same document.
pub fn answer(query: &Query, at: Position) -> Option<Vec<DocumentHighlight>> {
    let (pair, offset) = (query.pair(), query.offset(at));
    let pair = pair.looked_at();
    let found = match query.scenario() {
        Some(scenario) => navigate::highlights_in_scenario(scenario, pair, offset),
        None => {
            let found = navigate::highlights(pair, query.side()?, offset).into_iter();
            found.map(|it| (it.span, it.access)).collect()
        }
    };
    let shown = found.iter().map(|(span, access)| DocumentHighlight {
        range: query.range(*span),
        kind: Some(match access {
            Access::Declared => DocumentHighlightKind::TEXT,
            Access::Read => DocumentHighlightKind::READ,
            Access::Written => DocumentHighlightKind::WRITE,
        }),
    });
    let shown: Vec<_> = shown.collect();
    (!shown.is_empty()).then_some(shown)
}
