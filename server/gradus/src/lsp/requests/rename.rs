//! `textDocument/prepareRename` and `textDocument/rename`.

use ide::Refusal;
use tower_lsp::jsonrpc::{Error, ErrorCode, Result};
use tower_lsp::ls_types::{Position, PrepareRenameResponse, WorkspaceEdit};

use crate::lsp::edit::Changes;
use crate::lsp::query::Query;

/// What can be renamed at a position; an error says why something cannot.
pub fn prepare(query: &Query, at: Position) -> Option<Result<PrepareRenameResponse>> {
    let offset = query.offset(at);
    let found = match query.spec() {
        Some(spec) => {
            let pair = query.pair();
            ide::renamable_in_spec(spec, pair.ladder().map(|it| &**it), offset)
        }
        None => ide::renamable_in_ladder(query.ladder()?, offset),
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

/// The edits that rename what stands at a position, in the ladder and in the
/// spec beside it.
pub fn answer(query: &Query, at: Position, new: &str) -> Option<Result<WorkspaceEdit>> {
    let offset = query.offset(at);
    let pair = query.pair();
    let spec = pair.spec().map(|it| &**it);
    let ladder = pair.ladder().map(|it| &**it);
    let found = match query.spec() {
        Some(spec) => ide::rename_in_spec(spec, ladder, offset, new, &query.budget),
        None => ide::rename_in_ladder(ladder?, spec, offset, new, &query.budget),
    }?;
    let edits = found.map(|renaming| {
        let mut changes = Changes::new(format!("Rename {} to {new}", renaming.old));
        if let Some(document) = &pair.ladder {
            changes.edit(document, renaming.ladder);
        }
        if let Some(document) = &pair.spec {
            changes.edit(document, renaming.spec);
        }
        changes.workspace_edit(&query.world)
    });
    Some(edits.map_err(refused))
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
