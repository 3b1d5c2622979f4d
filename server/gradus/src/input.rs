//! Which files a command is about: the ones named, and what named folders hold.

use std::collections::VecDeque;
use std::fs;
use std::path::{Path, PathBuf};

use crate::file::Unreadable;
use crate::io::is_standard_input;

/// Endings of the files that are checked: ladders, specs and scenarios. Some
/// are used by much else: only the content tells.
pub const CHECKED: &[&str] = &["ladder", "l5x", "l5k", "xml", "txt", "grafcet", "scenario"];

/// Those under which ladders and specs are kept.
pub const ENDINGS: &[&str] = CHECKED.split_at(6).0;

/// Those under which ladders are kept.
pub const LADDER_ENDINGS: &[&str] = ENDINGS.split_at(5).0;

/// A file to look at.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Candidate {
    /// Its path, or `-`.
    pub path: PathBuf,
    /// How it became one.
    pub origin: Origin,
}

impl Candidate {
    /// Whether it is `-`.
    pub fn is_standard_input(&self) -> bool {
        is_standard_input(&self.path)
    }
}

/// How a file came to be looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// Somebody named it.
    Named,
    /// It lies in a folder that somebody named, and may be something else.
    InFolder,
}

/// All files to look at, and the folders that could not be.
#[derive(Debug, Default)]
pub struct Inputs {
    /// In the order of the command line; inside a folder by name.
    pub candidates: Vec<Candidate>,
    /// Folders that may not be looked into.
    pub unreadable: Vec<(PathBuf, Unreadable)>,
}

/// The files that `paths` stand for: each itself, or, if it is a folder, all
/// files in it and below with one of `endings`.
///
/// Hidden files and folders are left out, and symbolic links to folders are
/// not followed, since they can lead in a circle.
pub fn expand(paths: &[PathBuf], endings: &[&str]) -> Inputs {
    expand_while(paths, endings, &|| true)
}

/// The same, as far as it gets while `wanted` holds.
pub fn expand_while(paths: &[PathBuf], endings: &[&str], wanted: &dyn Fn() -> bool) -> Inputs {
    let mut inputs = Inputs::default();
    for path in paths {
        if !is_standard_input(path) && path.is_dir() {
            search(path, endings, wanted, &mut inputs);
        } else {
            inputs.candidates.push(Candidate {
                path: path.clone(),
                origin: Origin::Named,
            });
        }
    }
    inputs
}

/// Adds the files below `root`. Folders are opened one at a time, so that no
/// depth of nesting is too much.
fn search(root: &Path, endings: &[&str], wanted: &dyn Fn() -> bool, inputs: &mut Inputs) {
    let mut found = Vec::new();
    let mut folders = VecDeque::from([root.to_owned()]);
    while let Some(folder) = folders.pop_front().filter(|_| wanted()) {
        let entries = match fs::read_dir(&folder) {
            Ok(entries) => entries,
            Err(error) => {
                inputs.unreadable.push((folder, error.into()));
                continue;
            }
        };
        for entry in entries.flatten() {
            let hidden = entry.file_name().as_encoded_bytes().starts_with(b".");
            match entry.file_type() {
                _ if hidden => {}
                Ok(kind) if kind.is_dir() => folders.push_back(entry.path()),
                Ok(_) if ends_with_one_of(&entry.path(), endings) => found.push(entry.path()),
                _ => {}
            }
        }
    }
    found.sort();
    inputs.unreadable.sort_by(|one, other| one.0.cmp(&other.0));
    let below = |path: PathBuf| Candidate {
        path,
        origin: Origin::InFolder,
    };
    inputs.candidates.extend(found.into_iter().map(below));
}

/// The place among [`ENDINGS`] of the ending that `path` has.
pub fn ending(path: &Path) -> Option<usize> {
    let ending = path.extension()?;
    ENDINGS
        .iter()
        .position(|known| ending.eq_ignore_ascii_case(known))
}

fn ends_with_one_of(path: &Path, endings: &[&str]) -> bool {
    path.extension().is_some_and(|ending| {
        endings
            .iter()
            .any(|known| ending.eq_ignore_ascii_case(known))
    })
}

/// The only ladder in the folder of `path`, if there is just one: what `read`
/// makes of the first file that it takes for a ladder. Files that differ by
/// their endings only are one ladder in several forms.
pub fn only_ladder<T>(path: &Path, read: impl Fn(&Path) -> Option<T>) -> Option<T> {
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let entries = fs::read_dir(folder).ok()?.flatten();
    let mut files: Vec<PathBuf> = entries
        .map(|entry| entry.path())
        .filter(|path| ends_with_one_of(path, LADDER_ENDINGS))
        .collect();
    files.sort_by_key(|path| (path.file_stem().map(ToOwned::to_owned), ending(path)));
    let mut found: Option<(&Path, T)> = None;
    for path in &files {
        match &found {
            Some((first, _)) if first.file_stem() == path.file_stem() => {}
            Some(_) if read(path).is_some() => return None,
            Some(_) => {}
            None => found = read(path).map(|it| (path.as_path(), it)),
        }
    }
    found.map(|(_, it)| it)
}

/// Whether a file of this name may be anything: only the endings `.xml` and
/// `.txt` are shared with the rest of the world.
pub fn may_be_anything(path: &Path) -> bool {
    ends_with_one_of(path, &["xml", "txt"])
}

/// `2 files`: a number and its noun.
pub fn numbered(number: usize, noun: &str) -> String {
    let plural = if number == 1 { "" } else { "s" };
    format!("{number} {noun}{plural}")
}

/// How answers name the file at `path`.
pub fn name(path: &Path) -> String {
    if is_standard_input(path) {
        return "<stdin>".to_owned();
    }
    let plain = path.strip_prefix(".").unwrap_or(path);
    plain.display().to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_stands_for_the_files_below_it_in_the_order_of_their_paths() {
        let folder = tempfile::tempdir().expect("a folder");
        let root = folder.path();
        fs::create_dir_all(root.join("line 2/.git")).expect("folders");
        for file in [
            "z.L5X",
            "a.ladder",
            "a.rs",
            "line 2/m.xml",
            ".x.xml",
            "line 2/.git/b.xml",
        ] {
            fs::write(root.join(file), "").expect("a file");
        }
        let inputs = expand(&[root.to_owned()], ENDINGS);
        let found: Vec<_> = inputs
            .candidates
            .iter()
            .map(|candidate| candidate.path.strip_prefix(root).expect("below"))
            .collect();
        assert_eq!(found, ["a.ladder", "line 2/m.xml", "z.L5X"].map(Path::new));
    }

    #[test]
    fn what_is_named_is_looked_at_whatever_its_ending() {
        let named = expand(&["-".into(), "missing.rs".into()], ENDINGS);
        assert_eq!(named.candidates.len(), 2);
        assert_eq!(named.candidates[1].origin, Origin::Named);
    }
}
