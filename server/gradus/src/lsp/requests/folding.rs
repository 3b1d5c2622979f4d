//! `textDocument/foldingRange`.

use tower_lsp::ls_types::{FoldingRange, FoldingRangeKind};

use crate::lsp::query::Query;

/// What can be folded away in the document. Whole lines, since some clients
/// fold nothing else.
pub fn answer(query: &Query) -> Option<Vec<FoldingRange>> {
    let folds = match query.spec() {
        Some(spec) => ide::folds_in_spec(spec),
        None => ide::folds_in_ladder(query.ladder()?),
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
