//! `textDocument/documentLink`.

use ide::navigate::Side;
use tower_lsp::ls_types::DocumentLink;

use crate::lsp::query::Query;

/// The way to the text beside the document: from the program's name to the
/// spec, from the grafcet's name to the ladder. A text that is not there has
/// no link to it.
pub fn answer(query: &Query) -> Option<Vec<DocumentLink>> {
    let pair = query.pair();
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
    let link = span.zip(other).map(|(span, other)| DocumentLink {
        range: query.range(span),
        target: Some(other.uri.clone()),
        tooltip: Some(format!("Open the {what} {}", other.key.name())),
        data: None,
    });
    Some(link.into_iter().collect())
}
