//! The files of the client's folders, and whether they are what they were.

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::sync::{Arc, Weak};

use tower_lsp::ls_types::Uri;

use super::disk::Stamp;
use super::document::Document;
use super::key::FileKey;
use super::world::World;
use crate::input::{CHECKED, expand_while};
use crate::settings::Config;

/// Files that are looked at, at most. A folder that holds more is no plant's.
const MOST: usize = 20_000;

/// All open documents and all files in the client's folders; fewer once they
/// are not `wanted` any more.
pub fn all(world: &World, wanted: &dyn Fn() -> bool) -> BTreeSet<FileKey> {
    let open = world.open.values().filter(|it| is_of_its_own(&it.uri));
    let mut keys: BTreeSet<FileKey> = open.map(|it| it.key.clone()).collect();
    let folders = world.folders.iter().filter_map(FileKey::path);
    let folders: Vec<PathBuf> = folders.map(PathBuf::from).collect();
    let found = expand_while(&folders, CHECKED, wanted);
    let files = found.candidates.iter().take(MOST);
    keys.extend(files.map(|it| FileKey::of_path(&it.path)));
    keys
}

/// Whether a document is no other one's view: not made by this server, and no
/// older state of a file that a client compares with.
fn is_of_its_own(uri: &Uri) -> bool {
    let scheme = uri.scheme().as_str();
    !scheme.starts_with("gradus-") && scheme != "git"
}

/// What is set for one file after the other. Files that follow each other lie
/// in the same folder mostly, and obey the same.
#[derive(Debug)]
pub struct Obeyed<'a> {
    world: &'a World,
    last: Option<(PathBuf, Config)>,
}

impl<'a> Obeyed<'a> {
    /// What is set in a world.
    pub fn in_world(world: &'a World) -> Self {
        Self { world, last: None }
    }

    /// What is set for a file.
    pub fn config(&mut self, key: &FileKey) -> Config {
        let folder = key.path().and_then(|path| path.parent());
        if let (Some(folder), Some((last, config))) = (folder, &self.last)
            && folder == last
        {
            return config.clone();
        }
        let config = self.world.config(key);
        self.last = folder.map(|folder| (folder.to_owned(), config.clone()));
        config
    }
}

/// What a file was when it was looked at.
#[derive(Clone, Debug)]
pub enum Seen {
    /// On disk, with this size and time.
    Closed(Stamp),
    /// Open, as this document.
    Open(Weak<Document>),
}

impl Seen {
    /// What a file is now, if there is one that the settings let be read.
    pub fn of(world: &World, key: &FileKey, config: &Config) -> Option<Self> {
        match world.open.get(key) {
            Some(document) => Some(Self::Open(Arc::downgrade(document))),
            None => Stamp::of(key, config.max_file_size.bytes()).map(Self::Closed),
        }
    }
}

impl PartialEq for Seen {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Closed(one), Self::Closed(other)) => one == other,
            (Self::Open(one), Self::Open(other)) => one.ptr_eq(other),
            _ => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn views_of_other_documents_are_passed_over() {
        let of_its_own = |text: &str| {
            let uri = std::str::FromStr::from_str(text).expect("an address");
            is_of_its_own(&uri)
        };
        assert!(of_its_own("file:///p/tank.ladder") && of_its_own("untitled:Untitled-1"));
        assert!(!of_its_own("gradus-ladder:/p/tank.L5X.ladder?file"));
        assert!(!of_its_own("git:/p/tank.ladder?HEAD"));
    }
}
