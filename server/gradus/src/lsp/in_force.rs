//! The settings files that open documents obey.
//!
//! They are looked at whenever a document is opened or saved, and when the
//! client says that one has changed, so that it does not matter whether the
//! client watches files. What is wrong in one is told as findings in it, open
//! or not, to every client: one that asks for findings asks only for those in
//! documents of its own. When what holds for a document has changed, all
//! findings are told anew.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use tokio::sync::Mutex;
use tower_lsp::ls_types::{Diagnostic, Uri};

use super::document::Document;
use super::key::FileKey;
use super::publish;
use super::query::elsewhere;
use super::server::Shared;
use super::settings::place;
use super::telling;
use super::world::World;
use crate::settings::file::File;

/// What was told last. Whoever looks at the files holds it, so that nothing old
/// overtakes what is new.
#[derive(Debug, Default)]
pub struct InForce(Mutex<Seen>);

/// The settings files at one moment.
#[derive(Clone, Debug, Default, PartialEq)]
struct Seen {
    /// What each open document obeys.
    obeyed: BTreeMap<FileKey, Option<Arc<File>>>,
    /// What is wrong in each file.
    findings: BTreeMap<PathBuf, Vec<Diagnostic>>,
}

/// Why somebody looks at the settings files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cause {
    /// One may have changed.
    Perhaps,
    /// The client says that one has changed.
    Said,
}

/// Looks at the settings files, and tells what is new.
pub fn look(shared: &Arc<Shared>, cause: Cause) {
    let shared = Arc::clone(shared);
    tokio::spawn(async move {
        let mut before = shared.in_force.0.lock().await;
        let world = shared.state.world();
        let Ok(now) = elsewhere(move |_| Seen::of(&world)).await else {
            return;
        };
        let places = before.findings.keys().chain(now.findings.keys());
        let places: BTreeSet<&PathBuf> = places.collect();
        for place in places {
            let found = now.findings.get(place).cloned().unwrap_or_default();
            let told = before.findings.get(place).cloned().unwrap_or_default();
            if let Some(uri) = Uri::from_file_path(place).filter(|_| found != told) {
                shared.client.publish_diagnostics(uri, found, None).await;
            }
        }
        // Findings that are on their way may be from before the change.
        let others = cause == Cause::Said || before.has_changed(&now);
        *before = now;
        drop(before);
        if others {
            telling::everything(&shared);
        }
    });
}

impl Seen {
    fn of(world: &World) -> Self {
        let mut seen = Self::default();
        for key in world.open.keys() {
            let place = place(key, &world.folders);
            let file = place.as_ref().and_then(|it| world.settings.file(it));
            if let (Some(place), Some(file)) = (place, &file) {
                let found = seen.findings.entry(place);
                found.or_insert_with_key(|place| findings(world, place, file));
            }
            seen.obeyed.insert(key.clone(), file);
        }
        seen
    }

    /// Whether documents that were open before obey something else now.
    fn has_changed(&self, now: &Self) -> bool {
        let layer = |file: &Option<Arc<File>>| file.as_ref().map(|it| it.layer.clone());
        let mut open = now.obeyed.iter();
        open.any(|(key, file)| {
            let before = self.obeyed.get(key);
            before.is_some_and(|before| layer(before) != layer(file))
        })
    }
}

/// What is wrong in the settings file at `place`, as the client shows it.
fn findings(world: &World, place: &Path, file: &File) -> Vec<Diagnostic> {
    let Some(uri) = Uri::from_file_path(place) else {
        return Vec::new();
    };
    let text = String::from_utf8_lossy(&file.text);
    let document = Document::new(uri, "toml", None, &text);
    let found = file.findings.iter();
    let shown = found.map(|it| publish::diagnostic(world, &document, it, Vec::new()));
    shown.collect()
}
