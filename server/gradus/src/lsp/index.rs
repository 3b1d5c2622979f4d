//! The names in whole folders, for finding a thing by its name.
//!
//! The first question reads every file of the client's folders, but analyses
//! none: names stand in the texts. What was found in each is kept with its size
//! and time, so that the next question only looks whether they have changed.
//! Files that are open count as they are in the editor. Whoever stops waiting
//! stops the search too; what was read until then stays known.

use std::collections::{BTreeSet, HashMap};
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError, Weak};

use ide::symbols::{Symbol, SymbolKind};
use tower_lsp::ls_types::{Range, Uri};

use super::disk::Stamp;
use super::document::Document;
use super::key::FileKey;
use super::position::Encoding;
use super::world::World;
use crate::input::{CHECKED, expand_while};

/// A name in a file.
#[derive(Clone, Debug)]
pub struct Entry {
    /// The name.
    pub name: String,
    /// What it names.
    pub kind: SymbolKind,
    /// Where.
    pub range: Range,
    /// What it stands in.
    pub container: Option<Arc<str>>,
}

/// The names of one file.
#[derive(Clone, Debug)]
pub struct Listed {
    /// Its address.
    pub uri: Uri,
    /// Its names, in the order of the text.
    pub entries: Arc<[Entry]>,
}

/// The names of all files, as far as they are known.
#[derive(Debug, Default)]
pub struct Index(Mutex<HashMap<FileKey, (Seen, Listed)>>);

/// What a file was when it was looked at.
#[derive(Clone, Debug)]
enum Seen {
    /// On disk, with this size and time.
    Closed(Stamp),
    /// Open, as this document.
    Open(Weak<Document>),
}

/// Files that are looked at, at most. A folder that holds more is no plant's.
const MOST_FILES: usize = 20_000;

/// Names that are kept, at most.
const MOST_KEPT: usize = 2_000_000;

impl Index {
    /// The names of all open documents and of all files in the client's
    /// folders, by their keys; `None` once the answer is not `wanted` any more.
    pub fn all(&self, world: &World, wanted: &dyn Fn() -> bool) -> Option<Vec<Listed>> {
        let open = world.open.values().filter(|it| is_of_its_own(&it.uri));
        let mut keys: BTreeSet<FileKey> = open.map(|it| it.key.clone()).collect();
        let folders: Vec<PathBuf> = world
            .folders
            .iter()
            .filter_map(|it| it.path().map(PathBuf::from))
            .collect();
        let found = expand_while(&folders, CHECKED, wanted);
        let files = found.candidates.iter().take(MOST_FILES);
        keys.extend(files.map(|it| FileKey::of_path(&it.path)));
        let mut all = Vec::new();
        for key in &keys {
            if !wanted() {
                return None;
            }
            all.extend(self.listed(world, key));
        }
        // What was found until somebody stopped it is not all that there is.
        wanted().then(|| {
            self.forget_all_but(&keys);
            all
        })
    }

    /// The names of one file.
    fn listed(&self, world: &World, key: &FileKey) -> Option<Listed> {
        let (seen, document) = match world.open.get(key) {
            Some(document) => {
                let seen = Seen::Open(Arc::downgrade(document));
                if let Some(known) = self.known(key, &seen) {
                    return Some(known);
                }
                (seen, Arc::clone(document))
            }
            None => {
                let limit = world.config.max_file_size;
                let stamp = Stamp::of(key, limit)?;
                let seen = Seen::Closed(stamp);
                if let Some(known) = self.known(key, &seen) {
                    return Some(known);
                }
                let document = Document::closed(key)?;
                (seen, Arc::new(document))
            }
        };
        let listed = Listed {
            uri: document.uri.clone(),
            entries: entries(&document, world.encoding()).into(),
        };
        self.keep(key, seen, &listed);
        Some(listed)
    }

    fn known(&self, key: &FileKey, seen: &Seen) -> Option<Listed> {
        let files = self.lock();
        let (before, listed) = files.get(key)?;
        let same = match (before, seen) {
            (Seen::Closed(before), Seen::Closed(now)) => before == now,
            (Seen::Open(before), Seen::Open(now)) => before.ptr_eq(now),
            _ => false,
        };
        same.then(|| listed.clone())
    }

    fn keep(&self, key: &FileKey, seen: Seen, listed: &Listed) {
        let mut files = self.lock();
        let kept: usize = files.values().map(|(_, it)| it.entries.len()).sum();
        if kept + listed.entries.len() <= MOST_KEPT {
            files.insert(key.clone(), (seen, listed.clone()));
        }
    }

    fn forget_all_but(&self, keys: &BTreeSet<FileKey>) {
        self.lock().retain(|key, _| keys.contains(key));
    }

    fn lock(&self) -> std::sync::MutexGuard<'_, HashMap<FileKey, (Seen, Listed)>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Whether a document is no other one's view: not made by this server, and no
/// older state of a file that a client compares with.
fn is_of_its_own(uri: &Uri) -> bool {
    let scheme = uri.scheme().as_str();
    !scheme.starts_with("gradus-") && scheme != "git"
}

/// The names in a document that people look for.
fn entries(document: &Document, encoding: Encoding) -> Vec<Entry> {
    let mut entries = Vec::new();
    add(&document.names(), None, document, encoding, &mut entries);
    entries
}

fn add(
    symbols: &[Symbol],
    container: Option<&Arc<str>>,
    document: &Document,
    encoding: Encoding,
    entries: &mut Vec<Entry>,
) {
    for symbol in symbols {
        if symbol.kind.is_looked_for() {
            entries.push(Entry {
                name: symbol.name.clone(),
                kind: symbol.kind,
                range: encoding.range(&document.rope, symbol.span),
                container: container.cloned(),
            });
        }
        let inner = (!symbol.children.is_empty()).then(|| Arc::from(symbol.name.as_str()));
        add(
            &symbol.children,
            inner.as_ref(),
            document,
            encoding,
            entries,
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn world(folder: &std::path::Path) -> World {
        World {
            folders: vec![FileKey::of_path(folder)],
            ..World::default()
        }
    }

    fn names(files: &[Listed]) -> Vec<&str> {
        let entries = files.iter().flat_map(|it| it.entries.iter());
        entries.map(|it| it.name.as_str()).collect()
    }

    #[test]
    fn a_file_is_read_once_as_long_as_it_does_not_change() {
        let folder = tempfile::tempdir().expect("a folder");
        let [one, two] = ["one.ladder", "two.ladder"].map(|name| folder.path().join(name));
        std::fs::write(&one, "rung: a -> b").expect("a file");
        std::fs::write(&two, "rung: a -> c").expect("a file");
        let world = world(folder.path());
        let all = || {
            let found = world.index.all(&world, &|| true);
            found.expect("an answer")
        };
        let first = all();
        assert_eq!(
            names(&first),
            ["main", "rung 0", "b", "main", "rung 0", "c"]
        );
        std::fs::write(&two, "rung: a -> longer").expect("a file");
        let second = all();
        assert!(Arc::ptr_eq(&first[0].entries, &second[0].entries));
        assert_eq!(names(&second[1..]), ["main", "rung 0", "longer"]);
    }

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

    #[test]
    fn who_waits_no_more_gets_nothing_and_leaves_nothing_half_read() {
        let folder = tempfile::tempdir().expect("a folder");
        std::fs::write(folder.path().join("a.ladder"), "rung: a -> b").expect("a file");
        let world = world(folder.path());
        assert!(world.index.all(&world, &|| false).is_none());
        assert!(world.index.lock().is_empty());
    }
}
