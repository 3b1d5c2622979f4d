//! `workspace/textDocumentContent`: the text of a virtual document.

use logic::{Budget, Cancel};
use serde::{Deserialize, Serialize};
use tower_lsp::jsonrpc::{Error, Result};
use tower_lsp::ls_types::Uri;

use crate::lsp::virtual_document;
use crate::lsp::world::World;

/// What is asked for.
#[derive(Debug, Deserialize)]
pub struct Params {
    uri: Uri,
}

/// The answer.
#[derive(Debug, Serialize, Deserialize)]
pub struct Content {
    text: String,
}

/// The text of the document that is asked for.
pub fn answer(world: &World, params: &Params, cancel: Cancel) -> Result<Content> {
    let budget = Budget {
        cancel,
        ..Budget::default()
    };
    let made_from = virtual_document::made_from(world, &params.uri);
    let text = virtual_document::text(world, &params.uri, &budget);
    // What is read while it changes is not read to its end.
    if made_from.is_some_and(|document| document.is_outdated()) {
        return Err(Error::content_modified());
    }
    match text {
        Some(text) => Ok(Content { text }),
        None => Err(Error::invalid_params(format!(
            "gradus makes no document {}",
            params.uri.as_str()
        ))),
    }
}
