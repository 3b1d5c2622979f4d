//! What tells one file from another.
//!
//! Clients spell the same file in several ways: `file:///c%3A/x` and
//! `file:///C:/x`, `%20` or a space, a path with `..` in it. As texts they
//! differ, so documents are kept by a key in which they do not.

use std::path::{Component, Path, PathBuf};
use std::str::FromStr;

use percent_encoding::{AsciiSet, CONTROLS, percent_decode_str, utf8_percent_encode};
use tower_lsp::ls_types::Uri;

/// A file, however its address is spelled.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum FileKey {
    /// A file of this computer.
    Path(PathBuf),
    /// A document that only the client knows: its address, decoded.
    Elsewhere(String),
}

impl FileKey {
    /// The key of an address.
    pub fn of(uri: &Uri) -> Self {
        let is_file = uri.scheme().as_str().eq_ignore_ascii_case("file");
        match uri.to_file_path().filter(|_| is_file) {
            Some(path) => Self::of_path(&path),
            None => Self::Elsewhere(percent_decode_str(uri.as_str()).decode_utf8_lossy().into()),
        }
    }

    /// The key of a path.
    pub fn of_path(path: &Path) -> Self {
        let mut plain = PathBuf::new();
        for component in path.components() {
            match component {
                Component::CurDir => {}
                Component::ParentDir => {
                    plain.pop();
                }
                Component::Prefix(prefix) => {
                    plain.push(prefix.as_os_str().to_string_lossy().to_uppercase());
                }
                other => plain.push(other),
            }
        }
        Self::Path(plain)
    }

    /// Where the file is on this computer.
    pub fn path(&self) -> Option<&Path> {
        match self {
            Self::Path(path) => Some(path),
            Self::Elsewhere(_) => None,
        }
    }

    /// Its name, without folders.
    pub fn name(&self) -> String {
        let text = match self {
            Self::Path(path) => path.to_string_lossy(),
            Self::Elsewhere(text) => text.as_str().into(),
        };
        let name = text.rsplit(['/', '\\', ':']).next().unwrap_or_default();
        name.to_owned()
    }

    /// What it has in common with the files that differ from it by their ending
    /// only; of an address without an ending, all of it.
    pub fn without_ending(&self) -> Self {
        match self {
            Self::Path(path) => Self::Path(path.with_extension("")),
            Self::Elsewhere(text) => {
                let stem = text
                    .rsplit_once('.')
                    .map_or(text.as_str(), |(stem, _)| stem);
                Self::Elsewhere(stem.to_owned())
            }
        }
    }

    /// Its address in the usual spelling.
    pub fn uri(&self) -> Option<Uri> {
        match self {
            Self::Path(path) => Uri::from_file_path(path),
            Self::Elsewhere(text) => Uri::from_str(text).ok(),
        }
    }
}

/// The address beside `uri` whose last part ends in `ending` instead.
pub fn beside(uri: &Uri, ending: &str) -> Option<Uri> {
    let text = uri.as_str();
    let text = &text[..text.find(['?', '#']).unwrap_or(text.len())];
    let name = text.rfind('/').map_or(0, |slash| slash + 1);
    let stem = text[name..].rfind('.').map_or(text.len(), |dot| name + dot);
    if stem == name {
        return None;
    }
    Uri::from_str(&format!("{}.{ending}", &text[..stem])).ok()
}

/// Signs of a path that mean something else in an address.
const ODD: &AsciiSet = &CONTROLS
    .add(b' ')
    .add(b'"')
    .add(b'#')
    .add(b'%')
    .add(b'<')
    .add(b'>')
    .add(b'?')
    .add(b'[')
    .add(b']')
    .add(b'^')
    .add(b'`')
    .add(b'{')
    .add(b'|')
    .add(b'}');

/// The address of the file at `path`, seen from the folder of `uri`.
pub fn in_folder_of(uri: &Uri, path: &str) -> Option<Uri> {
    match FileKey::of(uri) {
        FileKey::Path(own) => FileKey::of_path(&own.parent()?.join(path)).uri(),
        FileKey::Elsewhere(_) => {
            let text = uri.as_str();
            let text = &text[..text.find(['?', '#']).unwrap_or(text.len())];
            let folder = &text[..text.rfind('/')? + 1];
            Uri::from_str(&format!("{folder}{}", utf8_percent_encode(path, ODD))).ok()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn uri(text: &str) -> Uri {
        Uri::from_str(text).expect("an address")
    }

    #[track_caller]
    fn same(a: &str, b: &str) {
        assert_eq!(FileKey::of(&uri(a)), FileKey::of(&uri(b)));
    }

    #[test]
    fn spellings_of_one_file_are_one_key() {
        same(
            "file:///tmp/a%20b.ladder",
            "file:///tmp/./x/../a%20b.ladder",
        );
        same("FILE:///tmp/%61.ladder", "file:///tmp/a.ladder");
        same("untitled:a%2Db", "untitled:a-b");
    }

    #[test]
    fn what_is_no_file_has_no_path() {
        let key = FileKey::of(&uri("vscode-vfs://github/a/tank.ladder"));
        assert_eq!(key.path(), None);
        assert_eq!(key.name(), "tank.ladder");
    }

    #[test]
    fn a_file_is_found_in_the_folder_of_another() {
        let found = |uri: &str, path: &str| {
            let found = in_folder_of(&self::uri(uri), path);
            found.map(|it| it.as_str().to_owned())
        };
        assert_eq!(
            found("file:///p/fill.scenario", "../q/a b.ladder").as_deref(),
            Some("file:///q/a%20b.ladder")
        );
        assert_eq!(
            found("vscode-vfs://github/p/fill.scenario?x", "a b.ladder").as_deref(),
            Some("vscode-vfs://github/p/a%20b.ladder")
        );
        assert_eq!(found("untitled:Untitled-1", "a.ladder"), None);
    }

    #[test]
    fn the_spec_is_beside_the_ladder_wherever_that_is() {
        let beside = |text: &str| beside(&uri(text), "grafcet").map(|it| it.as_str().to_owned());
        let file = Some("file:///p/a.b.grafcet".to_owned());
        assert_eq!(beside("file:///p/a.b.L5X"), file);
        let vfs = Some("vscode-vfs://github/a/tank.grafcet".to_owned());
        assert_eq!(beside("vscode-vfs://github/a/tank.ladder?x=1"), vfs);
        assert_eq!(
            beside("file:///p/tank"),
            Some("file:///p/tank.grafcet".to_owned())
        );
    }
}
