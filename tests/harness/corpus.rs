use std::path::PathBuf;

use crate::repository;

/// The folder of real files, `None` on a machine that does not have them.
///
/// They belong to other people, so they are no part of the repository. They are
/// looked for in `$GRADUS_CORPUS`, else in `../shared/corpus` beside the
/// repository. A test that cannot find them says that it was skipped.
///
/// # Panics
///
/// If the folder is missing although `GRADUS_CORPUS` or `CI=true` promises it:
/// a test must not pass there by testing nothing.
pub fn corpus() -> Option<PathBuf> {
    let named = std::env::var_os("GRADUS_CORPUS").map(PathBuf::from);
    let is_promised = named.is_some() || std::env::var_os("CI").is_some_and(|ci| ci == "true");
    let folder = named.unwrap_or_else(|| repository::path("../shared/corpus"));
    if folder.is_dir() {
        return Some(folder);
    }
    let folder = folder.display();
    assert!(
        !is_promised,
        "there is no corpus in {folder}; set GRADUS_CORPUS"
    );
    eprintln!("skipped: no corpus in {folder}; set GRADUS_CORPUS");
    None
}
