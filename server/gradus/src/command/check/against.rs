//! The ladder that a spec is checked against: the one that is named, or the
//! one beside it.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use ladder::{Format, Program};
use logic::Budget;
use recovery::Analysis;
use recovery::conversion::spec_findings;
use source::Diagnostic;

use crate::file;
use crate::input;
use crate::io::is_standard_input;
use ide::language;

/// What there is to say about a spec that holds `text`, given what is known of
/// its ladder.
pub fn about_spec(text: &str, ladder: Option<&Analysis>, budget: &Budget) -> Vec<Diagnostic> {
    let reading = grafcet::read(text);
    let mut found = match ladder {
        Some(analysis) => spec_findings(analysis, &reading, text, budget),
        None => Vec::new(),
    };
    found.extend(reading.diagnostics);
    found.sort_by_key(|diagnostic| (diagnostic.span, diagnostic.code));
    found
}

/// The ladder beside the spec at `path`: of the files that differ from it only
/// by an ending under which ladders are kept, the first that holds one.
pub fn ladder_beside(path: &Path) -> Option<Arc<Program>> {
    beside(path).into_iter().find_map(|path| {
        let bytes = file::read(&path).ok()?;
        let language::File::Ladder(_) = language::of(&bytes) else {
            return None;
        };
        let program = ladder::read(&bytes).program;
        (program.format != Format::Unknown).then_some(program)
    })
}

/// Files that differ from `path` only by an ending, in the order of
/// [`input::ENDINGS`].
pub fn beside(path: &Path) -> Vec<PathBuf> {
    if is_standard_input(path) {
        return Vec::new();
    }
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let mut found: Vec<(usize, PathBuf)> = fs::read_dir(folder)
        .into_iter()
        .flatten()
        .flatten()
        .map(|entry| entry.path())
        .filter(|other| other.file_stem() == path.file_stem() && other != path)
        .filter_map(|other| Some((input::ending(&other)?, other)))
        .collect();
    found.sort();
    found.into_iter().map(|(_, path)| path).collect()
}
