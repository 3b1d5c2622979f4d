//! `textDocument/prepareRename` and `textDocument/rename`.

use ide::Refusal;
use tower_lsp::jsonrpc::{Error, ErrorCode, Result};
use tower_lsp::ls_types::{Position, PrepareRenameResponse, WorkspaceEdit};

use crate::lsp::edit::Changes;
use crate::lsp::query::{Query, Text};

/// What can be renamed at a position; an error says why something cannot.
pub fn prepare(query: &Query, at: Position) -> Option<Result<PrepareRenameResponse>> {
    let offset = query.offset(at);
    let pair = query.pair();
    let both = pair.looked_at();
    let found = match query.text()? {
        Text::Ladder(ladder) => ide::renamable_in_ladder(ladder, offset),
        Text::Spec(spec) => ide::renamable_in_spec(spec, both.ladder, offset),
        Text::Scenario(scenario) => ide::renamable_in_scenario(scenario, both, offset),
    }?;
    Some(
        found
            .map(|found| PrepareRenameResponse::RangeWithPlaceholder {
                range: query.range(found.span),
                placeholder: found.name,
            })
            .map_err(refused),
    )
}

/// The edits that rename what stands at a position, in the ladder, in the spec
/// and in the scenarios that run on them, open or not.
pub fn answer(query: &Query, at: Position, new: &str) -> Option<Result<WorkspaceEdit>> {
    let offset = query.offset(at);
    let pair = query.pair();
    let both = pair.looked_at();
    let budget = &query.budget;
    let found = match query.text()? {
        Text::Ladder(ladder) => ide::rename_in_ladder(ladder, both.spec, offset, new, budget),
        Text::Spec(spec) => ide::rename_in_spec(spec, both.ladder, offset, new, budget),
        Text::Scenario(scenario) => ide::rename_in_scenario(scenario, both, offset, new, budget),
    }?;
    let edits = found.and_then(|renaming| {
        let mut changes = Changes::new(format!("Rename {} to {new}", renaming.old));
        if let Some(document) = &pair.ladder {
            changes.edit(document, renaming.ladder.clone());
        }
        if let Some(document) = &pair.spec {
            changes.edit(document, renaming.spec.clone());
        }
        for document in query.world.scenarios_of(&pair) {
            if let Some(scenario) = document.scenario() {
                let edits = ide::edits_in_scenario(scenario, &renaming);
                changes.edit(
                    &document,
                    edits.map_err(|why| in_file(why, &document.key.name()))?,
                );
            }
        }
        Ok(changes.workspace_edit(&query.world))
    });
    Some(edits.map_err(refused))
}

/// A reason that lies in another file than the one that is looked at.
fn in_file(Refusal(why): Refusal, name: &str) -> Refusal {
    Refusal(format!("{name}: {why}"))
}

/// The request was understood, and cannot be done: the client shows why.
fn refused(Refusal(why): Refusal) -> Error {
    Error {
        code: ErrorCode::ServerError(REQUEST_FAILED),
        message: why.into(),
        data: None,
    }
}

/// `RequestFailed` of the protocol.
const REQUEST_FAILED: i64 = -32803;
