//! Files that no editor has open.

use std::collections::HashMap;
use std::fs;
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::SystemTime;

use logic::Cancel;

use super::document::Document;
use super::key::FileKey;

/// Files as they were last read. Reading one again costs a look at its size and
/// time only.
#[derive(Debug, Default)]
pub struct Disk {
    files: Mutex<HashMap<FileKey, (Stamp, Arc<Document>)>>,
    /// Ends all work on them.
    until: Cancel,
}

/// What tells whether a file has changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stamp {
    modified: Option<SystemTime>,
    length: u64,
}

/// Files that are kept: those beside open ones, and some more.
const KEPT: usize = 64;

impl Disk {
    /// Files that nobody wants to know of once `cancel` is raised.
    pub fn until(cancel: Cancel) -> Self {
        Self {
            until: cancel,
            ..Self::default()
        }
    }

    /// The file of a key, if it is one, is text, and has no more than `limit`
    /// bytes.
    pub fn read(&self, key: &FileKey, limit: u64) -> Option<Arc<Document>> {
        let stamp = Stamp::of(key, limit)?;
        if let Some((known, document)) = self.lock().get(key)
            && *known == stamp
        {
            return Some(Arc::clone(document));
        }
        let document = Arc::new(Document::closed(key)?.until(self.until.clone()));
        let mut files = self.lock();
        if files.len() >= KEPT {
            files.clear();
        }
        files.insert(key.clone(), (stamp, Arc::clone(&document)));
        Some(document)
    }

    /// Files that differ from `key` only by their ending, which is one of
    /// `endings`.
    pub fn beside(&self, key: &FileKey, endings: &[&str]) -> Vec<FileKey> {
        let Some(path) = key.path() else {
            return Vec::new();
        };
        let entries = path.parent().and_then(|folder| fs::read_dir(folder).ok());
        let mut found: Vec<_> = entries
            .into_iter()
            .flatten()
            .flatten()
            .map(|entry| entry.path())
            .filter(|other| other.file_stem() == path.file_stem())
            .filter(|other| {
                let ending = other.extension().map(|it| it.to_ascii_lowercase());
                ending.is_some_and(|it| endings.iter().any(|known| it == *known))
            })
            .map(|other| FileKey::of_path(&other))
            .collect();
        found.sort();
        found
    }

    /// Files in the folder of `key` that end in `ending`.
    pub fn in_folder(&self, key: &FileKey, ending: &str) -> Vec<FileKey> {
        let folder = key.path().and_then(Path::parent);
        let entries = folder.and_then(|folder| fs::read_dir(folder).ok());
        let paths = entries.into_iter().flatten().flatten();
        let paths = paths.map(|entry| entry.path()).filter(|path| {
            let own = path.extension().map(|it| it.to_ascii_lowercase());
            own.is_some_and(|own| own == ending)
        });
        let mut found: Vec<FileKey> = paths.map(|path| FileKey::of_path(&path)).collect();
        found.sort();
        found
    }

    /// Forgets a file that has changed.
    pub fn forget(&self, key: &FileKey) {
        self.lock().remove(key);
    }

    fn lock(&self) -> std::sync::MutexGuard<'_, HashMap<FileKey, (Stamp, Arc<Document>)>> {
        self.files.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Stamp {
    /// The size and time of a file now, if it is one and has no more than
    /// `limit` bytes.
    pub fn of(key: &FileKey, limit: u64) -> Option<Self> {
        let found = fs::metadata(key.path()?).ok()?;
        (found.is_file() && found.len() <= limit).then(|| Self {
            modified: found.modified().ok(),
            length: found.len(),
        })
    }
}
