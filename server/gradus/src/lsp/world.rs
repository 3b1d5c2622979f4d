//! All that the server knows at one moment: open documents, settings, the
//! client.
//!
//! The one [`State`] changes in the order in which messages arrive, before any
//! handler waits for anything. Whoever answers a request takes the [`World`] of
//! that moment, which never changes, and works on it elsewhere.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use ide::Run;
use tokio::sync::watch;
use tower_lsp::ls_types::Uri;

use super::abilities::Abilities;
use super::disk::Disk;
use super::document::{Contents, Document};
use super::index::Index;
use super::key::{FileKey, beside};
use super::position::Encoding;
use super::runs::Runs;
use super::settings::Settings;
use super::verdicts::Verdicts;
use crate::input::LADDER_ENDINGS;
use crate::settings::Config;

/// What the server knows at one moment.
#[derive(Clone, Debug, Default)]
pub struct World {
    /// Open documents.
    pub open: BTreeMap<FileKey, Arc<Document>>,
    /// What the user set.
    pub settings: Settings,
    /// What the client can do.
    pub abilities: Arc<Abilities>,
    /// Folders that the client works on.
    pub folders: Vec<FileKey>,
    /// Files that are not open.
    pub disk: Arc<Disk>,
    /// The names in all folders.
    pub index: Arc<Index>,
    /// The client has asked for the end.
    pub is_ending: bool,
    /// What came of scenarios.
    pub runs: Arc<Runs>,
    /// Whether specs do what their ladders do.
    pub verdicts: Arc<Verdicts>,
    /// The scan that is shown in ladder and spec.
    pub chosen: Option<Chosen>,
}

/// A scan of a scenario.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Chosen {
    /// The scenario.
    pub scenario: FileKey,
    /// Which of its scans.
    pub scan: Scan,
}

/// How somebody chose a scan. What is edited later may move it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scan {
    /// The last one of a step, from 0.
    EndOf(usize),
    /// The one of this number, from 1.
    Number(u64),
}

impl Scan {
    /// Its step and its number in a run, if that came so far.
    pub fn in_run(self, run: &Run) -> Option<(usize, u64)> {
        match self {
            Self::EndOf(step) => Some((step, run.end_of(step)?.scan)),
            Self::Number(number) => Some((run.step_of(number)?, number)),
        }
    }
}

impl World {
    /// What columns count.
    pub fn encoding(&self) -> Encoding {
        self.abilities.encoding
    }

    /// The document at an address: as it is open, else as it lies on disk.
    pub fn document(&self, uri: &Uri) -> Option<Arc<Document>> {
        let key = FileKey::of(uri);
        self.file(&key)
    }

    /// The same of a file that is known already.
    pub fn file(&self, key: &FileKey) -> Option<Arc<Document>> {
        let open = self.open.get(key).cloned();
        open.or_else(|| self.on_disk(key))
    }

    /// What is set for a file.
    pub fn config(&self, key: &FileKey) -> Config {
        self.settings.config(key, &self.folders)
    }

    fn on_disk(&self, key: &FileKey) -> Option<Arc<Document>> {
        let limit = self.config(key).max_file_size;
        self.disk.read(key, limit.bytes())
    }

    /// Where the spec of the ladder at `uri` is or would be.
    pub fn spec_place(&self, uri: &Uri) -> Option<Uri> {
        let place = beside(uri, "grafcet")?;
        // The client's own spelling, if it has the document open.
        let open = self.open.get(&FileKey::of(&place));
        Some(open.map_or(place, |document| document.uri.clone()))
    }

    /// The spec beside a ladder.
    pub fn spec_of(&self, ladder: &Document) -> Option<Arc<Document>> {
        let document = self.document(&self.spec_place(&ladder.uri)?)?;
        document.spec().is_some().then_some(document)
    }

    /// The ladder beside a spec: of the files that differ from it by their
    /// ending only, the first that holds one.
    pub fn ladder_of(&self, spec: &Document) -> Option<Arc<Document>> {
        let open = self
            .open
            .values()
            .filter(|it| is_beside(&it.key, &spec.key));
        let on_disk = || {
            let ladders = self.disk.beside(&spec.key, LADDER_ENDINGS);
            let closed = ladders
                .into_iter()
                .filter(|key| !self.open.contains_key(key));
            closed.filter_map(|key| self.on_disk(&key))
        };
        let mut found: Vec<Arc<Document>> = open.cloned().chain(on_disk()).collect();
        found.sort_by_key(|it| rank(&it.key));
        found.into_iter().find(|it| match it.contents() {
            Contents::Ladder(ladder) => ladder.is_known(),
            _ => false,
        })
    }

    /// The open ladders and specs in the folder of the document of `key`.
    pub fn open_beside<'w>(&'w self, key: &'w FileKey) -> impl Iterator<Item = &'w Document> {
        let folder = |key: &FileKey| key.path().and_then(|it| Some(it.parent()?.to_owned()));
        let own = folder(key);
        let open = self.open.values().map(|it| &**it);
        let beside = open.filter(move |it| own.is_some() && folder(&it.key) == own);
        beside.filter(|it| matches!(it.contents(), Contents::Ladder(_) | Contents::Spec(_)))
    }

    /// The document that belongs to this one, if it is open: the spec of a
    /// ladder, the ladders of a spec.
    pub fn open_partners(&self, key: &FileKey) -> Vec<Arc<Document>> {
        let all = self.open.values();
        all.filter(|it| is_beside(&it.key, key)).cloned().collect()
    }
}

/// Whether two files differ by their ending only.
fn is_beside(a: &FileKey, b: &FileKey) -> bool {
    a != b && a.without_ending() == b.without_ending()
}

/// Where a file stands among those beside a spec: by its ending.
fn rank(key: &FileKey) -> (usize, FileKey) {
    let name = key.name().to_ascii_lowercase();
    let ending = name.rsplit('.').next().unwrap_or_default();
    let at = LADDER_ENDINGS.iter().position(|it| *it == ending);
    (at.unwrap_or(LADDER_ENDINGS.len()), key.clone())
}

/// The one changing state of the server.
#[derive(Debug, Default)]
pub struct State {
    world: Mutex<World>,
    changed: watch::Sender<()>,
}

impl State {
    /// What is known now.
    pub fn world(&self) -> World {
        self.lock().clone()
    }

    /// Changes what is known.
    pub fn change<T>(&self, change: impl FnOnce(&mut World) -> T) -> T {
        let changed = change(&mut self.lock());
        self.changed.send_replace(());
        changed
    }

    /// Hears of changes.
    pub fn changes(&self) -> watch::Receiver<()> {
        self.changed.subscribe()
    }

    fn lock(&self) -> MutexGuard<'_, World> {
        // A change that panicked has left a document out, never half of one.
        self.world.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
