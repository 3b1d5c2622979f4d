//! Where test files lie.

use std::path::{Path, PathBuf};

/// A path inside the repository.
pub fn repository(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../..")
        .join(path)
}

/// The XML files of a folder, by name.
pub fn xml_files(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder)
        .unwrap_or_else(|error| panic!("{} cannot be read: {error}", folder.display()));
    let mut files: Vec<_> = entries
        .map(|entry| entry.expect("an entry of the folder").path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "xml"))
        .collect();
    files.sort();
    files
}

/// The real files, in the folder that `GRADUS_CORPUS` names or in
/// `../shared/corpus` beside the repository. `None`, said aloud, where there
/// are none; with `GRADUS_CORPUS` set there must be.
pub fn corpus() -> Option<Vec<PathBuf>> {
    let named = std::env::var_os("GRADUS_CORPUS").map(PathBuf::from);
    let promised = named.is_some();
    let folder = named.unwrap_or_else(|| repository("../shared/corpus"));
    let folder = folder.join("plcopen");
    if !folder.is_dir() {
        assert!(!promised, "there is no corpus in {}", folder.display());
        eprintln!("skipped: no corpus; set GRADUS_CORPUS");
        return None;
    }
    Some(xml_files(&folder))
}
