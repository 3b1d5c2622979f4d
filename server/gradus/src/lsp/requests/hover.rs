//! `textDocument/hover`.

use tower_lsp::ls_types::{Hover, HoverContents, MarkupContent, MarkupKind, Position};

use crate::lsp::query::Query;

/// What is known of the thing at a position.
pub fn answer(query: &Query, at: Position) -> Option<Hover> {
    let offset = query.offset(at);
    let pair = query.pair();
    let hover = match query.spec() {
        Some(spec) => {
            ide::hover_in_spec(spec, pair.ladder().map(|it| &**it), offset, &query.budget)
        }
        None => ide::hover_in_ladder(
            query.ladder()?,
            pair.spec().map(|it| &**it),
            offset,
            &query.budget,
        ),
    }?;
    let (kind, value) = match query.world.abilities.markdown {
        true => (MarkupKind::Markdown, hover.markdown()),
        false => (MarkupKind::PlainText, hover.plain()),
    };
    Some(Hover {
        contents: HoverContents::Markup(MarkupContent { kind, value }),
        range: Some(query.range(hover.span)),
    })
}
