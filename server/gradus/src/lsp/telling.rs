//! What the server tells its client without being asked.
//!
//! Everything here runs in tasks of its own, never in a handler: a client that
//! answers late, or never, holds up nobody.

use std::sync::Arc;
use std::time::Duration;

use logic::{Budget, Cancel};
use serde_json::json;
use tower_lsp::jsonrpc;
use tower_lsp::ls_types::{
    ConfigurationItem, DidChangeWatchedFilesRegistrationOptions, FileSystemWatcher, GlobPattern,
    LSPAny, Registration, ShowDocumentParams,
};

use super::document::Document;
use super::key::FileKey;
use super::progress::{self, Work};
use super::proving;
use super::publish;
use super::query::elsewhere;
use super::requests::command::Done;
use super::server::Shared;
use super::settings;
use super::shown;
use super::status::{self, StatusNotification};
use super::world::Chosen;
use crate::input::CHECKED;
use crate::settings::file;

/// How long the client may take for an answer.
const PATIENCE: Duration = Duration::from_secs(10);

/// Waits for an answer of the client, but not for ever.
pub async fn answer<T>(request: impl Future<Output = jsonrpc::Result<T>>) -> Option<T> {
    tokio::time::timeout(PATIENCE, request).await.ok()?.ok()
}

/// Lets the client do what a command comes to, and gives the command's answer.
pub async fn carry_out(shared: &Arc<Shared>, done: Done) -> jsonrpc::Result<LSPAny> {
    let abilities = shared.state.world().abilities;
    if let Some(edit) = done.edit {
        let applied = answer(shared.client.apply_edit(edit)).await;
        if !applied.is_some_and(|it| it.applied) {
            let message = "the editor did not apply the edit".into();
            return Err(jsonrpc::Error {
                message,
                ..jsonrpc::Error::internal_error()
            });
        }
    }
    if let Some(uri) = done.show.filter(|_| abilities.shows_documents) {
        let shown = ShowDocumentParams {
            uri,
            external: None,
            take_focus: Some(true),
            selection: None,
        };
        answer(shared.client.show_document(shown)).await;
    }
    Ok(done.answer)
}

/// Asks the client to watch the files that matter.
pub fn register(shared: &Arc<Shared>) {
    if !shared.state.world().abilities.watches_files {
        return;
    }
    let shared = Arc::clone(shared);
    tokio::spawn(async move {
        let programs = CHECKED.iter();
        let programs = programs.map(|ending| format!("**/*.{}", in_any_case(ending)));
        let all = programs.chain([format!("**/{}", file::NAME)]);
        let watchers = all.map(|pattern| FileSystemWatcher {
            glob_pattern: GlobPattern::String(pattern),
            kind: None,
        });
        let options = DidChangeWatchedFilesRegistrationOptions {
            watchers: watchers.collect(),
        };
        let registration = Registration {
            id: "gradus-files".to_owned(),
            method: "workspace/didChangeWatchedFiles".to_owned(),
            register_options: serde_json::to_value(options).ok(),
        };
        answer(shared.client.register_capability(vec![registration])).await;
    });
}

/// `l5x` as a pattern that also finds `L5X`.
fn in_any_case(ending: &str) -> String {
    let letter = |c: char| match c.is_ascii_alphabetic() {
        true => format!("[{c}{}]", c.to_ascii_uppercase()),
        false => c.to_string(),
    };
    ending.chars().map(letter).collect()
}

/// Asks the client what the user set, where it can be asked.
pub fn ask_for_settings(shared: &Arc<Shared>) {
    if !shared.state.world().abilities.configuration {
        return;
    }
    let shared = Arc::clone(shared);
    tokio::spawn(async move {
        let section = ConfigurationItem {
            scope_uri: None,
            section: Some("gradus".to_owned()),
        };
        let found = answer(shared.client.configuration(vec![section])).await;
        let Some(settings) = found.and_then(|found| found.into_iter().next()) else {
            return;
        };
        if configure(&shared, &json!({ "gradus": settings })) {
            everything(&shared);
        }
    });
}

/// Takes over what the client sets. Whether it is anything new.
pub fn configure(shared: &Shared, settings: &LSPAny) -> bool {
    let (layer, complaints) = settings::of_client(settings);
    for complaint in complaints {
        shared.log.line(format!("settings: {complaint}"));
    }
    shared.state.change(|world| {
        let changed = *world.settings.client != layer;
        world.settings.client = Arc::new(layer);
        changed
    })
}

/// Shows a scan in ladder and spec, or none any more.
pub fn choose(shared: &Arc<Shared>, chosen: Option<Chosen>) {
    shared.state.change(|world| world.chosen = chosen);
    refresh(shared);
}

/// Tells everything about every open document anew.
pub fn everything(shared: &Arc<Shared>) {
    let world = shared.state.world();
    for key in world.open.keys() {
        proving::changed(shared, key);
        findings(shared, key);
    }
    refresh(shared);
}

/// Tells what is new when the document of `key` has changed: its findings, and
/// those of the documents that depend on it.
pub fn changed(shared: &Arc<Shared>, key: &FileKey) {
    proving::changed(shared, key);
    findings(shared, key);
    let partners = shared.state.world().open_partners(key);
    for partner in &partners {
        findings(shared, &partner.key);
    }
    if !partners.is_empty() {
        shown::ask_again(shared);
    }
    scenarios(shared, key);
    status(shared, key);
}

/// Tells what is new when it is known how a ladder and its spec of this stem
/// stand: findings in the spec, its lens, the status.
pub fn judged(shared: &Arc<Shared>, stem: &FileKey) {
    // Who waits for findings in whole folders looks again.
    let open = shared.state.change(|world| {
        let of_stem = world.open.keys().filter(|it| it.without_ending() == *stem);
        of_stem.cloned().collect::<Vec<FileKey>>()
    });
    for key in &open {
        findings(shared, key);
    }
    shown::ask_again(shared);
    if let Some(key) = open.first() {
        status(shared, key);
    }
}

/// Tells what is new of the open scenarios that run on the document of `key`:
/// their findings, and that their lenses and hints may be others now. Those of
/// ladder and spec are, too, when it is the scenario of which a scan is shown.
pub fn scenarios(shared: &Arc<Shared>, key: &FileKey) {
    let world = shared.state.world();
    if world.chosen.as_ref().is_some_and(|it| it.scenario == *key) {
        shown::ask_again(shared);
    }
    if !world.open.values().any(|it| it.may_be_scenario()) {
        return;
    }
    let (shared, key) = (Arc::clone(shared), key.clone());
    tokio::spawn(async move {
        // To know what a scenario runs on, it must be read.
        let found = elsewhere(move |_| world.open_scenarios_on(&key)).await;
        let found = found.unwrap_or_default();
        for scenario in &found {
            findings(&shared, &scenario.key);
        }
        if !found.is_empty() {
            shown::ask_again(&shared);
        }
    });
}

/// Tells clients that show it how the ladder and the spec of `key` stand.
fn status(shared: &Arc<Shared>, key: &FileKey) {
    let world = shared.state.world();
    let document = world.open.get(key).cloned();
    let Some(document) = document.filter(|_| world.abilities.status) else {
        return;
    };
    let shared = Arc::clone(shared);
    tokio::spawn(async move {
        let current = Arc::clone(&document);
        let found = elsewhere(move |_| status::of(world, current)).await;
        if let Ok(Some(status)) = found
            && !document.is_outdated()
        {
            let client = &shared.client;
            client.send_notification::<StatusNotification>(status).await;
        }
    });
}

/// Takes back the findings of a document that was closed.
pub fn closed(shared: &Arc<Shared>, document: &Document) {
    let (shared, uri) = (Arc::clone(shared), document.uri.clone());
    let key = document.key.clone();
    shared.tellers.stop(&key);
    if !document.may_be_scenario() {
        proving::closed(&shared, &key);
    }
    tokio::spawn(async move {
        let world = shared.state.world();
        if !world.abilities.pulls_diagnostics && !world.open.contains_key(&key) {
            shared
                .client
                .publish_diagnostics(uri, Vec::new(), None)
                .await;
        }
        for partner in world.open_partners(&key) {
            findings(&shared, &partner.key);
        }
        scenarios(&shared, &key);
    });
}

/// Tells the findings of an open document, unless the client asks for them.
fn findings(shared: &Arc<Shared>, key: &FileKey) {
    let pulls = shared.state.world().abilities.pulls_diagnostics;
    if pulls || !shared.tellers.is_needed(key) {
        return;
    }
    let (shared, key) = (Arc::clone(shared), key.clone());
    tokio::spawn(async move {
        loop {
            shared.output.room().await;
            let in_vain = shared.tellers.round(&key);
            tell(&shared, &key, in_vain).await;
            if shared.tellers.is_done(&key) {
                break;
            }
        }
    });
}

/// Tells the findings of an open document as it is now, unless it is in vain.
async fn tell(shared: &Arc<Shared>, key: &FileKey, in_vain: Cancel) {
    let world = shared.state.world();
    let Some(document) = world.open.get(key).cloned() else {
        return;
    };
    let (uri, version) = (document.uri.clone(), document.version);
    let budget = Budget {
        cancel: in_vain.clone(),
        ..Budget::default()
    };
    let under_way = progress::under_way(shared, Work::Analysis(document.key.clone()));
    let found = elsewhere(move |_| {
        let found = publish::diagnostics(&world, &document, &budget);
        // Of a ladder that changes meanwhile only a part may have been read.
        let used = world.used_by(&document);
        (found, used.iter().any(|it| it.is_outdated()))
    });
    let found = found.await;
    drop(under_way);
    match found {
        Ok((_, is_outdated)) if in_vain.is_cancelled() || is_outdated => {}
        Ok((found, _)) => shared.client.publish_diagnostics(uri, found, version).await,
        Err(error) => shared.log.line(error.message.into_owned()),
    }
}

/// Asks the client to ask again for what depends on settings and on files.
pub fn refresh(shared: &Arc<Shared>) {
    let shared = Arc::clone(shared);
    tokio::spawn(async move {
        let abilities = shared.state.world().abilities;
        let client = &shared.client;
        if abilities.refreshes_lenses {
            answer(client.code_lens_refresh()).await;
        }
        if abilities.refreshes_hints {
            answer(client.inlay_hint_refresh()).await;
        }
        if abilities.refreshes_tokens {
            answer(client.semantic_tokens_refresh()).await;
        }
        if abilities.refreshes_diagnostics && abilities.pulls_diagnostics {
            answer(client.workspace_diagnostic_refresh()).await;
        }
    });
}
