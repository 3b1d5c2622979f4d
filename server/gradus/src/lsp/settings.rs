//! What is set for each file: by the client, and by the nearest `gradus.toml`,
//! which hides what the client says.
//!
//! The file comes first because clients send what is usual along with what the
//! user chose, so that nobody could tell the two apart; and so that all who
//! work on a plant are shown the same, by whatever editor, and by
//! `gradus check`.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use serde_json::Value;

use super::disk::Stamp;
use super::key::FileKey;
use crate::settings::file::{self, File};
use crate::settings::{Complaint, Config, Layer, Wrong};

/// What is set.
#[derive(Clone, Debug, Default)]
pub struct Settings {
    /// By the client.
    pub client: Arc<Layer>,
    files: Arc<Files>,
}

/// Settings files as they were last read. Looking at one again costs a look at
/// its size and time only.
#[derive(Debug, Default)]
struct Files(Mutex<HashMap<PathBuf, (Stamp, Arc<File>)>>);

impl Settings {
    /// What is set for a file, if the client works on `folders`.
    pub fn config(&self, key: &FileKey, folders: &[FileKey]) -> Config {
        match place(key, folders).and_then(|place| self.file(&place)) {
            Some(file) => self.client.under(&file.layer).config(),
            None => self.client.config(),
        }
    }

    /// The settings file at `place`, if there is one.
    pub fn file(&self, place: &Path) -> Option<Arc<File>> {
        let stamp = Stamp::of(&FileKey::of_path(place), u64::MAX)?;
        let known = self.files.known(place, stamp);
        Some(known.unwrap_or_else(|| {
            let file = Arc::new(file::open(place));
            self.files.keep(place, stamp, &file);
            file
        }))
    }

    /// Forgets a settings file that has changed.
    pub fn forget(&self, key: &FileKey) {
        if let Some(place) = key.path() {
            self.files.lock().remove(place);
        }
    }
}

impl Files {
    fn known(&self, place: &Path, stamp: Stamp) -> Option<Arc<File>> {
        let files = self.lock();
        let (before, file) = files.get(place)?;
        (*before == stamp).then(|| Arc::clone(file))
    }

    fn keep(&self, place: &Path, stamp: Stamp, file: &Arc<File>) {
        self.lock()
            .insert(place.to_owned(), (stamp, Arc::clone(file)));
    }

    fn lock(&self) -> MutexGuard<'_, HashMap<PathBuf, (Stamp, Arc<File>)>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Where the settings file for a file is: beside it or above, up to the
/// outermost of `folders` that it lies in; up to the top if it lies in none.
pub fn place(key: &FileKey, folders: &[FileKey]) -> Option<PathBuf> {
    let folder = key.path()?.parent()?;
    let tops = folders.iter().filter_map(FileKey::path);
    let around = tops.filter(|top| folder.starts_with(top));
    let top = around.min_by_key(|top| top.components().count());
    file::nearest(folder, top)
}

/// What a client sets, and what of it makes no sense. Some clients send the
/// section, some the object that it is in. Keys that the server does not know
/// are the client's own.
pub fn of_client(value: &Value) -> (Layer, Vec<Complaint>) {
    let section = value.get("gradus").unwrap_or(value);
    let Some(settings) = section.as_object() else {
        return (Layer::default(), Vec::new());
    };
    let (layer, mut complaints) = Layer::read(settings);
    complaints.retain(|complaint| matches!(complaint.wrong, Wrong::Value { .. }));
    (layer, complaints)
}

#[cfg(test)]
mod tests {
    use std::fs;

    use serde_json::json;

    use super::*;
    use crate::settings::Weakest;

    #[test]
    fn what_is_missing_is_as_usual() {
        let (layer, complaints) = of_client(&json!({ "codeLens": { "enable": false } }));
        let config = layer.config();
        assert!(!config.code_lens.enable && config.inlay_hints.enable);
        assert_eq!(complaints, []);
        assert_eq!(of_client(&Value::Null).0.config(), Config::default());
    }

    #[test]
    fn one_wrong_setting_costs_only_itself() {
        let settings = json!({ "gradus": {
            "maxFileSize": "much",
            "suggestions": { "evidence": "handover" },
            "trace": { "server": "off" },
        }});
        let (layer, complaints) = of_client(&settings);
        assert_eq!(layer.config().max_file_size.bytes(), 64 << 20);
        assert_eq!(layer.config().suggestions.evidence, Weakest::Handover);
        let said: Vec<_> = complaints.iter().map(ToString::to_string).collect();
        assert_eq!(
            said,
            [r#"`maxFileSize` is "much"; expected a whole number, 1 or more"#]
        );
    }

    #[test]
    fn the_nearest_file_counts_and_none_above_the_clients_folder() {
        let root = tempfile::tempdir().expect("a folder");
        let path = |name: &str| root.path().join(name);
        fs::create_dir_all(path("plant/line/cell")).expect("folders");
        for folder in ["", "plant/line"] {
            fs::write(path(folder).join(file::NAME), "").expect("a file");
        }
        let of = |program: &str, folders: &[&str]| {
            let folders = folders.iter().map(|it| FileKey::of_path(&path(it)));
            let folders: Vec<_> = folders.collect();
            let place = place(&FileKey::of_path(&path(program)), &folders)?;
            let place = place.strip_prefix(root.path()).expect("below");
            Some(place.to_string_lossy().into_owned())
        };
        let found = |name: &str| Some(name.to_owned());
        assert_eq!(
            of("plant/line/cell/a.ladder", &[]),
            found("plant/line/gradus.toml")
        );
        assert_eq!(of("plant/a.ladder", &[]), found("gradus.toml"));
        assert_eq!(of("plant/a.ladder", &["plant"]), None);
        assert_eq!(
            of("plant/line/a.ladder", &["plant"]),
            found("plant/line/gradus.toml")
        );
        // Of two folders, the outer one.
        assert_eq!(
            of("plant/line/cell/a.ladder", &["plant/line/cell", "plant"]),
            found("plant/line/gradus.toml")
        );
        assert_eq!(of("plant/line/cell/a.ladder", &["plant/line/cell"]), None);
    }

    #[test]
    fn a_file_hides_what_the_client_says() {
        let folder = tempfile::tempdir().expect("a folder");
        let text = "codeLens.enable = true\ndiagnostics.ignore = [\"G2002\"]\n";
        fs::write(folder.path().join(file::NAME), text).expect("a file");
        let client = json!({
            "codeLens": { "enable": false },
            "diagnostics": { "enable": false, "ignore": ["G2004"] },
        });
        let settings = Settings {
            client: Arc::new(of_client(&client).0),
            files: Arc::default(),
        };
        let config = settings.config(&FileKey::of_path(&folder.path().join("a.ladder")), &[]);
        assert!(config.code_lens.enable && !config.diagnostics.enable);
        assert_eq!(config.diagnostics.ignore, ["G2002"]);
    }
}
