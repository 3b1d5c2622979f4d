use std::path::{Path, PathBuf};

/// A path in the repository, from its top.
pub fn path(relative: &str) -> PathBuf {
    let tests = Path::new(env!("CARGO_MANIFEST_DIR"));
    let top = tests.parent().expect("`tests` lies in the repository");
    top.join(relative)
}

/// Whether expected outputs are to be rewritten as they are now: `UPDATE=1`.
pub fn update_is_asked_for() -> bool {
    std::env::var_os("UPDATE").is_some_and(|value| value == "1")
}
