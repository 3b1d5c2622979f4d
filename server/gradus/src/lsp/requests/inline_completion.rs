//! `textDocument/inlineCompletion`: what a spec may say next, as ghost text.

use tower_lsp::ls_types::{
    InlineCompletionItem, InlineCompletionParams, InlineCompletionResponse,
    InlineCompletionTriggerKind,
};

use crate::lsp::query::Query;

/// Lines that somebody leafs through who asks for them.
const MOST: usize = 10;

/// The line that a spec may say next; several if somebody asks for them.
pub fn answer(query: &Query, params: &InlineCompletionParams) -> Option<InlineCompletionResponse> {
    let spec = query.spec()?;
    let pair = query.pair();
    let offset = query.offset(params.text_document_position.position);
    let (span, lines) = ide::next_at(spec, pair.ladder()?, offset, query.weakest(), &query.budget)?;
    // While a list is open, ghost text must go on what is chosen there.
    let chosen = params.context.selected_completion_info.as_ref();
    let fits = |line: &str| chosen.is_none_or(|chosen| line.starts_with(&chosen.text));
    let count = match params.context.trigger_kind {
        InlineCompletionTriggerKind::INVOKED => MOST,
        _ => 1,
    };
    let range = match chosen {
        Some(chosen) => chosen.range,
        None => query.range(span),
    };
    let item = |line: String| InlineCompletionItem {
        insert_text: line,
        filter_text: None,
        range: Some(range),
        command: None,
        insert_text_format: None,
    };
    let lines = lines.into_iter().map(|it| it.line);
    let items: Vec<_> = lines
        .filter(|line| fits(line))
        .take(count)
        .map(item)
        .collect();
    (!items.is_empty()).then_some(InlineCompletionResponse::Array(items))
}
