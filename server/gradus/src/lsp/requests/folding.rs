//! `textDocument/foldingRange`.

use tower_lsp::ls_types::{FoldingRange, FoldingRangeKind};

use crate::lsp::query::{Query, Text};

/// What can be folded away in the document. Whole lines, since some clients
/// fold nothing else.
pub fn answer(query: &Query) -> Option<Vec<FoldingRange>> {
    let folds = match query.text()? {
        Text::Ladder(ladder) => ide::folds_in_ladder(ladder),
        Text::Spec(spec) => ide::folds_in_spec(spec),
        Text::Scenario(scenario) => ide::folds_in_scenario(scenario),
    };
    let ranges = folds.iter().map(|fold| {
        let range = query.range(fold.span);
        FoldingRange {
            start_line: range.start.line,
            end_line: range.end.line,
            kind: fold.is_comment.then_some(FoldingRangeKind::Comment),
            ..FoldingRange::default()
        }
    });
    Some(ranges.collect())
}
