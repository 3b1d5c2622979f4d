//! The folders that a client works on.

use std::path::Path;

use tower_lsp::ls_types::{InitializeParams, WorkspaceFoldersChangeEvent};

use super::key::FileKey;

/// The folders that a client begins with. Clients that know of one folder only
/// name it as the root, by its address or, older ones, by its path.
#[expect(deprecated, reason = "clients still name a root")]
pub fn at_first(params: &InitializeParams) -> Vec<FileKey> {
    if let Some(folders) = &params.workspace_folders {
        return folders.iter().map(|it| FileKey::of(&it.uri)).collect();
    }
    let by_address = params.root_uri.as_ref().map(FileKey::of);
    let path = params.root_path.as_deref().filter(|it| !it.is_empty());
    let by_path = || path.map(|it| FileKey::of_path(Path::new(it)));
    by_address.or_else(by_path).into_iter().collect()
}

/// The folders after a change of them.
pub fn changed(folders: &mut Vec<FileKey>, change: &WorkspaceFoldersChangeEvent) {
    let removed: Vec<_> = change
        .removed
        .iter()
        .map(|it| FileKey::of(&it.uri))
        .collect();
    folders.retain(|it| !removed.contains(it));
    folders.extend(change.added.iter().map(|it| FileKey::of(&it.uri)));
}
