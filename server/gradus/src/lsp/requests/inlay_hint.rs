//! `textDocument/inlayHint`.

use tower_lsp::ls_types::{InlayHint, InlayHintLabel, InlayHintTooltip, Range};

use crate::lsp::query::Query;

/// The hints in a range.
pub fn answer(query: &Query, range: Range) -> Option<Vec<InlayHint>> {
    if !query.config().inlay_hints.enable {
        return None;
    }
    let span = query.encoding().span(&query.document.rope, range);
    let hints = match query.spec() {
        Some(spec) => ide::hints_in_spec(spec, query.pair().ladder()?, span),
        None => ide::hints_in_ladder(query.ladder()?, span, &query.budget),
    };
    let hints = hints.into_iter().map(|hint| InlayHint {
        position: query.encoding().position(&query.document.rope, hint.offset),
        label: InlayHintLabel::String(hint.text),
        kind: None,
        text_edits: None,
        tooltip: Some(InlayHintTooltip::String(hint.detail)),
        padding_left: Some(true),
        padding_right: None,
        data: None,
    });
    Some(hints.collect())
}
