//! `textDocument/references`.

use ide::navigate::{self, Access};
use tower_lsp::ls_types::{Location, Position};

use crate::lsp::query::Query;

/// Every place of the thing at a position, in the ladder and in the spec; those
/// that declare it only if the client wants them.
pub fn answer(query: &Query, at: Position, declarations: bool) -> Option<Vec<Location>> {
    let (pair, side) = (query.pair(), query.side()?);
    let subject = navigate::subject(pair.looked_at(), side, query.offset(at))?;
    let found = navigate::references(pair.looked_at(), &subject);
    let wanted = found
        .iter()
        .filter(|it| declarations || it.access != Access::Declared);
    let locations = wanted.filter_map(|it| {
        let document = pair.document(it.side)?;
        Some(query.location(document, it.span))
    });
    Some(locations.collect())
}
