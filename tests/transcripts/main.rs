//! Transcripts: documents that show commands and what they answer, checked.
//!
//! Every Markdown file in this folder, and every one in `docs/` that holds a
//! transcript, is one test; so is the README. To add a test, add a file; `docs/testing.md` tells
//! how one is written. `UPDATE=1` rewrites what the commands answer.

mod transcript;

use std::fs;
use std::path::{Path, PathBuf};

use libtest_mimic::{Arguments, Failed, Trial};

const EXECUTABLE: &str = env!("CARGO_BIN_EXE_gradus");

fn main() {
    let arguments = Arguments::from_args();
    let trials = ["tests/transcripts", "docs"]
        .into_iter()
        .flat_map(documents)
        .chain([("README".to_owned(), end_to_end::path("README.md"))])
        .map(|(name, path)| Trial::test(name, move || check(&path)))
        .collect();
    libtest_mimic::run(&arguments, trials).exit();
}

/// The documents in a folder of the repository that hold a transcript, and the
/// names of their tests.
fn documents(folder: &str) -> Vec<(String, PathBuf)> {
    let top = end_to_end::path("");
    let mut found = Vec::new();
    let mut folders = vec![top.join(folder)];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).expect("a folder").flatten() {
            let path = entry.path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|ending| ending == "md")
                && transcript::is_one(&read(&path))
            {
                let name = path.strip_prefix(&top).expect("below the top");
                found.push((name.with_extension("").display().to_string(), path));
            }
        }
    }
    found.sort();
    found
}

fn check(path: &Path) -> Result<(), Failed> {
    let old = read(path);
    let new = transcript::replay(&old, EXECUTABLE);
    if new == old {
        return Ok(());
    }
    if end_to_end::update_is_asked_for() {
        fs::write(path, new)?;
        return Ok(());
    }
    Err(format!("{}\n{}", path.display(), difference(&old, &new)).into())
}

fn read(path: &Path) -> String {
    fs::read_to_string(path).expect("a document in UTF-8")
}

/// The lines that differ: `-` as written, `+` as it is now.
fn difference(old: &str, new: &str) -> String {
    similar::TextDiff::from_lines(old, new)
        .unified_diff()
        .context_radius(4)
        .to_string()
}
