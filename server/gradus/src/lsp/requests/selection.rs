//! `textDocument/selectionRange`.

use tower_lsp::ls_types::{Position, Range, SelectionRange};

use crate::lsp::query::Query;

/// What a growing selection takes, for each position.
pub fn answer(query: &Query, positions: &[Position]) -> Option<Vec<SelectionRange>> {
    query.side()?;
    let grown = positions.iter().map(|at| {
        let offset = query.offset(*at);
        let spans = match (query.spec(), query.ladder()) {
            (Some(spec), _) => ide::selections_in_spec(spec, offset),
            (None, Some(ladder)) => ide::selections_in_ladder(ladder, offset),
            (None, None) => Vec::new(),
        };
        let mut ranges: Vec<Range> = spans.iter().map(|it| query.range(*it)).collect();
        // A place for each position, even in an empty document.
        if ranges.is_empty() {
            ranges.push(Range::new(*at, *at));
        }
        let outward = ranges.into_iter().rev();
        let nested = outward.fold(None, |parent, range| {
            Some(SelectionRange {
                range,
                parent: parent.map(Box::new),
            })
        });
        nested.unwrap_or_default()
    });
    Some(grown.collect())
}
