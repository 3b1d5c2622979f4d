//! Real files, read in place.

use std::fs;
use std::path::PathBuf;

/// A real file.
#[derive(Clone, Debug)]
pub struct RealFile {
    /// Its name without the folders above.
    pub name: String,
    /// What it holds.
    pub bytes: Vec<u8>,
}

/// The files of one folder of the corpus, in the order of their names; none
/// where there is no corpus.
pub fn files(folder: &str) -> Vec<RealFile> {
    let Some(corpus) = end_to_end::corpus() else {
        return Vec::new();
    };
    let mut paths: Vec<PathBuf> = fs::read_dir(corpus.join(folder))
        .into_iter()
        .flatten()
        .filter_map(|entry| Some(entry.ok()?.path()))
        .collect();
    paths.sort();
    let read = |path: PathBuf| {
        let name = path.file_name()?.to_string_lossy().into_owned();
        let bytes = fs::read(&path).ok()?;
        Some(RealFile { name, bytes })
    };
    paths.into_iter().filter_map(read).collect()
}
