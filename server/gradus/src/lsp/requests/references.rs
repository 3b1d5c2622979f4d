//! `textDocument/references`.

use ide::navigate::{self, Access};
use tower_lsp::ls_types::{Location, Position};

use crate::lsp::query::Query;

/// Every place of the thing at a position, in the ladder, in the spec and in the
/// scenarios that run on them; those that declare it only if the client wants
/// them.
pub fn answer(query: &Query, at: Position, declarations: bool) -> Option<Vec<Location>> {
    let (pair, offset) = (query.pair(), query.offset(at));
    let both = pair.looked_at();
    let subject = match query.scenario() {
        Some(scenario) => ide::meaning(both, scenario.name_at(offset)?.name)?,
        None => navigate::subject(both, query.side()?, offset)?,
    };
    let found = navigate::references(both, &subject);
    let wanted = found
        .iter()
        .filter(|it| declarations || it.access != Access::Declared);
    let locations = wanted.filter_map(|it| {
        let document = pair.document(it.side)?;
        Some(query.location(document, it.span))
    });
    let scenarios = query.world.scenarios_of(&pair);
    let in_scenarios = scenarios.iter().flat_map(|document| {
        let found = document
            .scenario()
            .map(|it| navigate::references_in_scenario(it, both, &subject));
        let found = found.unwrap_or_default().into_iter();
        found.map(|(span, _)| query.location(document, span))
    });
    Some(locations.chain(in_scenarios).collect())
}
