//! `textDocument/selectionRange`.

use tower_lsp::ls_types::{Position, Range, SelectionRange};

use crate::lsp::query::{Query, Text};

/// What a growing selection takes, for each position.
pub fn answer(query: &Query, positions: &[Position]) -> Option<Vec<SelectionRange>> {
    let text = query.text()?;
    let grown = positions.iter().map(|at| {
        let offset = query.offset(*at);
        let spans = match text {
            Text::Ladder(ladder) => ide::selections_in_ladder(ladder, offset),
            Text::Spec(spec) => ide::selections_in_spec(spec, offset),
            Text::Scenario(scenario) => ide::selections_in_scenario(scenario, offset),
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
