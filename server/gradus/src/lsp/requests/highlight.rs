//! `textDocument/documentHighlight`.

use ide::navigate::{self, Access};
use tower_lsp::ls_types::{DocumentHighlight, DocumentHighlightKind, Position};

use crate::lsp::query::Query;

/// The places of the thing at a position, in the same document.
pub fn answer(query: &Query, at: Position) -> Option<Vec<DocumentHighlight>> {
    let (pair, side) = (query.pair(), query.side()?);
    let found = navigate::highlights(pair.looked_at(), side, query.offset(at));
    let shown = found.iter().map(|it| DocumentHighlight {
        range: query.range(it.span),
        kind: Some(match it.access {
            Access::Declared => DocumentHighlightKind::TEXT,
            Access::Read => DocumentHighlightKind::READ,
            Access::Written => DocumentHighlightKind::WRITE,
        }),
    });
    let shown: Vec<_> = shown.collect();
    (!shown.is_empty()).then_some(shown)
}
