//! The settings files that the checked files obey.
//!
//! Of what can be set, only the codes that are left out concern a check; the
//! rest is for editors.

use std::collections::{BTreeMap, HashMap};
use std::path::{Path, PathBuf};
use std::rc::Rc;

use source::Diagnostic;

use crate::io::is_standard_input;
use crate::settings::file::{self, File};

/// The settings files that were met, and by whom.
#[derive(Debug, Default)]
pub struct Obeyed {
    /// What files in each folder obey.
    by_folder: HashMap<PathBuf, Option<Rc<File>>>,
    /// Each settings file, by its place.
    files: BTreeMap<PathBuf, Rc<File>>,
}

impl Obeyed {
    /// Leaves out of what was `found` in the file at `path` what is not to be
    /// reported there. Standard input lies in the folder that the command runs
    /// in.
    pub fn sift(&mut self, path: &Path, found: &mut Vec<Diagnostic>) {
        let folder = match path.parent() {
            Some(folder) if !is_standard_input(path) && folder != Path::new("") => folder,
            _ => Path::new("."),
        };
        if let Some(file) = self.of_folder(folder) {
            let ignored = file.layer.config().diagnostics.ignored();
            found.retain(|it| !ignored.contains(&it.code));
        }
    }

    fn of_folder(&mut self, folder: &Path) -> Option<Rc<File>> {
        if let Some(known) = self.by_folder.get(folder) {
            return known.clone();
        }
        let place = folder.canonicalize().ok();
        let place = place.and_then(|folder| file::nearest(&folder, None));
        let file = place.map(|place| {
            let file = self.files.entry(place);
            Rc::clone(file.or_insert_with_key(|place| Rc::new(file::open(place))))
        });
        self.by_folder.insert(folder.to_owned(), file.clone());
        file
    }

    /// The settings files in which something is wrong, as seen from the folder
    /// that the command runs in.
    pub fn faulty(self) -> impl Iterator<Item = (PathBuf, File)> {
        let here = std::env::current_dir().and_then(|here| here.canonicalize());
        let here = here.unwrap_or_default();
        drop(self.by_folder);
        let files = self.files.into_iter();
        let files = files.map(|(place, file)| (place, Rc::unwrap_or_clone(file)));
        files
            .filter(|(_, file)| !file.findings.is_empty())
            .map(move |(place, file)| (from(&here, &place), file))
    }
}

/// The way from a folder to a file.
fn from(here: &Path, place: &Path) -> PathBuf {
    for (ups, folder) in here.ancestors().enumerate() {
        if let Ok(rest) = place.strip_prefix(folder) {
            let up = std::iter::repeat_n("..", ups);
            return up.map(Path::new).chain([rest]).collect();
        }
    }
    place.to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_files_are_named_from_here() {
        let way = |here: &str, place: &str| from(Path::new(here), Path::new(place));
        assert_eq!(
            way("/plant", "/plant/gradus.toml"),
            Path::new("gradus.toml")
        );
        assert_eq!(
            way("/plant", "/plant/a/gradus.toml"),
            Path::new("a/gradus.toml")
        );
        assert_eq!(
            way("/plant/a", "/plant/gradus.toml"),
            Path::new("../gradus.toml")
        );
        assert_eq!(
            way("/plant/a/b", "/plant/c/gradus.toml"),
            Path::new("../../c/gradus.toml")
        );
    }
}
