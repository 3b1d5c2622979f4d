//! Real files, read once for all judges. They lie outside the repository; see
//! `end_to_end::corpus`.

use std::sync::OnceLock;

use ladder::Reading;

/// A real file and what reading it gives.
pub struct RealFile {
    /// Its name, without its folder.
    pub name: String,
    /// What was read.
    pub reading: Reading,
}

/// L5X files, by name; none where there is no corpus.
pub fn rockwell() -> &'static [RealFile] {
    static FILES: OnceLock<Vec<RealFile>> = OnceLock::new();
    FILES.get_or_init(|| read("l5x"))
}

/// PLCopen XML files.
pub fn plcopen() -> &'static [RealFile] {
    static FILES: OnceLock<Vec<RealFile>> = OnceLock::new();
    FILES.get_or_init(|| read("plcopen"))
}

/// Drawings with characters.
pub fn drawings() -> &'static [RealFile] {
    static FILES: OnceLock<Vec<RealFile>> = OnceLock::new();
    FILES.get_or_init(|| read("ascii"))
}

fn read(folder: &str) -> Vec<RealFile> {
    let Some(corpus) = end_to_end::corpus() else {
        return Vec::new();
    };
    let entries = std::fs::read_dir(corpus.join(folder)).expect("a folder of the corpus");
    let mut files: Vec<RealFile> = entries
        .map(|entry| {
            let path = entry.expect("a file").path();
            let name = path.file_name().expect("a name").to_string_lossy();
            let bytes = std::fs::read(&path).expect("a real file can be read");
            RealFile {
                name: name.into_owned(),
                reading: ladder::read(&bytes),
            }
        })
        .collect();
    files.sort_by(|a, b| a.name.cmp(&b.name));
    files
}
