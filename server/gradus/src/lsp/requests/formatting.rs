//! `textDocument/formatting`, `rangeFormatting` and `onTypeFormatting`.

use ide::Extent;
use tower_lsp::ls_types::{Position, Range, TextEdit};

use crate::lsp::edit::text_edits;
use crate::lsp::query::{Query, Text};

/// The edits that lay a whole document out.
pub fn document(query: &Query) -> Option<Vec<TextEdit>> {
    edits(query, Extent::Whole)
}

/// The edits that lay out the statements that a range touches.
pub fn range(query: &Query, range: Range) -> Option<Vec<TextEdit>> {
    let span = query.encoding().span(&query.document.rope, range);
    edits(query, Extent::Statements(span))
}

/// The edits that lay out the line above the one that was just begun.
pub fn on_type(query: &Query, at: Position) -> Option<Vec<TextEdit>> {
    let above = Position::new(at.line.checked_sub(1)?, 0);
    edits(query, Extent::Line(query.offset(above)))
}

fn edits(query: &Query, extent: Extent) -> Option<Vec<TextEdit>> {
    let edits = match query.text()? {
        Text::Ladder(ladder) => ide::lay_out_ladder(ladder, extent)?,
        Text::Spec(spec) => ide::lay_out_spec(spec, extent),
        Text::Scenario(scenario) => ide::lay_out_scenario(scenario, extent),
    };
    Some(text_edits(&query.document.rope, &edits, query.encoding()))
}
