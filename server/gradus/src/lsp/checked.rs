//! The findings in whole folders, for clients that ask for them.
//!
//! Files that differ by their ending only are checked together: a ladder, the
//! spec beside it; and all files of a folder that holds a scenario, which may run
//! on any of them. Of what was found only a number is kept that tells it from
//! anything else, with what the files were: as long as they are that, a client
//! that knows the number is told so and nothing is read. Each group is read by
//! itself and forgotten again, so that a folder may hold more than fits into
//! memory.

use std::collections::{BTreeMap, HashMap, HashSet};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use logic::{Budget, Cancel};
use tower_lsp::ls_types::{Diagnostic, Uri};

use super::disk::Disk;
use super::document::{Contents, Document};
use super::files::{self, Obeyed, Seen};
use super::key::FileKey;
use super::plant::Plant;
use super::publish;
use super::verdicts::UnderWay;
use super::world::World;
use crate::settings::Config;

/// What is known of all files.
#[derive(Debug, Default)]
pub struct Checked {
    groups: Mutex<HashMap<FileKey, Group>>,
    /// Somebody did not want to wait for files that are not open.
    given_up: AtomicBool,
    /// Groups that were read.
    #[cfg(test)]
    read: std::sync::atomic::AtomicUsize,
}

/// What is known of files that are checked together.
#[derive(Clone, Debug)]
struct Group {
    /// What they were, and what the files were that they name elsewhere.
    seen: Vec<(FileKey, Seen)>,
    /// The files that they name elsewhere.
    elsewhere: Vec<FileKey>,
    /// What was set for them.
    config: Config,
    /// How far it was known whether specs among them do what their ladders do.
    judged: Vec<Option<(u64, UnderWay)>>,
    /// What was found then.
    known: Vec<Known>,
}

/// What was found in a file.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Known {
    uri: Uri,
    version: Option<i32>,
    id: String,
}

/// What there is to tell of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// The file.
    pub uri: Uri,
    /// The client's number for what it holds, if it is open.
    pub version: Option<i32>,
    /// What tells these findings from others.
    pub id: Option<String>,
    /// The findings; `None` if they are those that the client has.
    pub found: Option<Vec<Diagnostic>>,
}

/// What a client has been told, by file.
pub type Told = BTreeMap<FileKey, (Uri, String)>;

impl Checked {
    /// Tells `tell` of every file in the client's folders and of every open
    /// document, a group at a time, as long as it wants to hear more and
    /// `stopped` is not raised.
    pub fn check(
        &self,
        world: &World,
        mut told: Told,
        stopped: &Cancel,
        tell: &mut dyn FnMut(Vec<Report>) -> bool,
    ) {
        let wanted = || !stopped.is_cancelled();
        let mut groups: BTreeMap<FileKey, Vec<FileKey>> = BTreeMap::new();
        let all = files::all(world, &wanted);
        let scenarios = all.iter().filter(|it| it.name().ends_with(".scenario"));
        let with_scenarios: HashSet<&Path> = scenarios.filter_map(folder).collect();
        for key in &all {
            let together = folder(key).filter(|it| with_scenarios.contains(it));
            let group = together.map_or_else(|| key.without_ending(), FileKey::of_path);
            groups.entry(group).or_default().push(key.clone());
        }
        let mut obeyed = Obeyed::in_world(world);
        for (stem, keys) in &groups {
            if !wanted() {
                return;
            }
            let config = obeyed.config(&keys[0]);
            let reports = self.reports(world, stem, keys, config, &told, stopped);
            let Some(reports) = reports else {
                // Whatever holds now, it is not that these are gone.
                keys.iter().for_each(|key| drop(told.remove(key)));
                continue;
            };
            for report in &reports {
                told.remove(&FileKey::of(&report.uri));
            }
            if self.is_given_up() {
                // What was passed over may be there.
                keys.iter().for_each(|key| drop(told.remove(key)));
            }
            if !reports.is_empty() && !tell(reports) {
                return;
            }
        }
        if wanted() {
            self.lock().retain(|stem, _| groups.contains_key(stem));
            let gone = told.into_values().map(|(uri, _)| Report {
                uri,
                version: None,
                id: None,
                found: Some(Vec::new()),
            });
            tell(gone.collect());
        }
    }

    /// What there is to tell of a group; `None` if it could not be found out.
    fn reports(
        &self,
        world: &World,
        stem: &FileKey,
        keys: &[FileKey],
        config: Config,
        told: &Told,
        stopped: &Cancel,
    ) -> Option<Vec<Report>> {
        let see = |key: &FileKey| {
            let seen = Seen::of(world, key, &config)?;
            Some((key.clone(), seen))
        };
        let mut seen: Vec<(FileKey, Seen)> = keys.iter().filter_map(see).collect();
        let judged = keys.iter();
        let judged = judged.map(|key| world.verdicts.state(&key.without_ending()));
        let judged: Vec<_> = judged.collect();
        if let Some(group) = self.lock().get(stem)
            && let further = group.elsewhere.iter().filter_map(see)
            && seen
                .iter()
                .cloned()
                .chain(further)
                .eq(group.seen.iter().cloned())
            && group.config == config
            && group.judged == judged
            && let Some(reports) = group.as_told(told)
        {
            return Some(reports);
        }
        let is_given_up = self.is_given_up();
        let only_open = !config.diagnostics.workspace || is_given_up;
        #[cfg(test)]
        self.read.fetch_add(1, Ordering::Relaxed);
        let own = World {
            disk: Arc::new(Disk::until(stopped.clone())),
            ..world.clone()
        };
        let there = seen.iter().map(|(key, _)| key);
        let (looked_at, passed_over): (Vec<_>, Vec<_>) =
            there.partition(|key| !only_open || world.open.contains_key(key));
        let documents = looked_at.into_iter().filter_map(|key| own.file(key));
        let documents: Vec<Arc<Document>> = documents.collect();
        let budget = Budget {
            cancel: stopped.clone(),
            ..Budget::default()
        };
        let (mut reports, mut known) = (Vec::new(), Vec::new());
        let mut add = |key: &FileKey, uri: Uri, version: Option<i32>, found: Vec<Diagnostic>| {
            let id = number(&found);
            let has_it = told.get(key).is_some_and(|(_, has)| *has == id);
            known.push(Known {
                uri: uri.clone(),
                version,
                id: id.clone(),
            });
            reports.push(Report {
                uri,
                version,
                id: Some(id),
                found: (!has_it).then_some(found),
            });
        };
        for document in &documents {
            if matches!(document.contents(), Contents::Foreign) {
                continue;
            }
            let found = publish::diagnostics(&own, document, &budget);
            let uri = document.uri.clone();
            add(&document.key, uri, document.version, found);
        }
        if !is_given_up {
            // VS Code keeps what it was told of a document that it has closed
            // until it is told that there is nothing.
            for key in passed_over {
                if let Some(uri) = key.uri() {
                    add(key, uri, None, Vec::new());
                }
            }
        }
        // Of a text that changes meanwhile only a part may have been read.
        let open = seen.iter().filter_map(|(key, _)| world.open.get(key));
        if stopped.is_cancelled() || open.into_iter().any(|it| it.is_outdated()) {
            return None;
        }
        if !is_given_up {
            let plants = documents.iter().filter_map(|it| Plant::of(&own, it));
            let named = plants
                .flat_map(|it| [it.pair.ladder, it.pair.spec])
                .flatten();
            let named = named
                .map(|it| it.key.clone())
                .filter(|it| !keys.contains(it));
            let elsewhere: Vec<FileKey> = named.collect();
            seen.extend(elsewhere.iter().filter_map(see));
            let group = Group {
                seen,
                elsewhere,
                config,
                judged,
                known,
            };
            self.lock().insert(stem.clone(), group);
        }
        Some(reports)
    }

    /// Files that are not open and not known are not looked at from now on.
    pub fn give_up(&self) {
        self.given_up.store(true, Ordering::Relaxed);
    }

    fn is_given_up(&self) -> bool {
        self.given_up.load(Ordering::Relaxed)
    }

    /// They are again: something has changed about them.
    pub fn begin_anew(&self) {
        self.given_up.store(false, Ordering::Relaxed);
    }

    fn lock(&self) -> MutexGuard<'_, HashMap<FileKey, Group>> {
        self.groups.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Group {
    /// What there is to tell if nothing has changed, to a client that knows
    /// what was found.
    fn as_told(&self, told: &Told) -> Option<Vec<Report>> {
        let reports = self.known.iter().map(|known| {
            let (_, has) = told.get(&FileKey::of(&known.uri))?;
            (*has == known.id).then(|| Report {
                uri: known.uri.clone(),
                version: known.version,
                id: Some(known.id.clone()),
                found: None,
            })
        });
        reports.collect()
    }
}

/// The folder of a file.
fn folder(key: &FileKey) -> Option<&Path> {
    key.path()?.parent()
}

/// What tells findings from others.
fn number(found: &[Diagnostic]) -> String {
    let mut hasher = DefaultHasher::new();
    serde_json::json!(found).to_string().hash(&mut hasher);
    format!("{:016x}", hasher.finish())
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    const LADDER: &str = "input a\nrung: a -> b\n";
    const TWICE: &str = "input a\nrung: a -> b\nrung: a -> b\n";
    const SPEC: &str = "Grafcet Tank\nStep Xv1 for v1\nMarking Xv1\n";

    struct Folder(tempfile::TempDir, World);

    impl Folder {
        fn new() -> Self {
            let folder = tempfile::tempdir().expect("a folder");
            let world = World {
                folders: vec![FileKey::of_path(folder.path())],
                ..World::default()
            };
            Self(folder, world)
        }

        fn path(&self) -> &Path {
            self.0.path()
        }

        fn write(&self, name: &str, text: &str) {
            let path = self.path().join(name);
            fs::create_dir_all(path.parent().expect("a folder")).expect("folders");
            fs::write(path, text).expect("a file");
        }

        /// Checks all; every report as `NAME findings`, `NAME as before`.
        fn check(&self, checked: &Checked, told: &mut Told) -> Vec<String> {
            let mut said = Vec::new();
            let before = std::mem::take(told);
            checked.check(&self.1, before, &Cancel::default(), &mut |reports| {
                for report in reports {
                    let key = FileKey::of(&report.uri);
                    said.push(match &report.found {
                        Some(found) => format!("{} {}", key.name(), found.len()),
                        None => format!("{} as before", key.name()),
                    });
                    if let Some(id) = report.id {
                        told.insert(key, (report.uri, id));
                    }
                }
                true
            });
            said
        }
    }

    fn read(checked: &Checked) -> usize {
        checked.read.swap(0, Ordering::Relaxed)
    }

    #[test]
    fn a_scenario_is_checked_with_all_that_it_may_run_on() {
        let folder = Folder::new();
        let (checked, mut told) = (Checked::default(), Told::new());
        folder.write("plant/a.ladder", LADDER);
        folder.write(
            "full.scenario",
            "scenario Full\nfor \"plant/a.ladder\"\non a => on b\n",
        );
        folder.write("empty.scenario", "scenario Empty\non a => off b\n");
        let first = folder.check(&checked, &mut told);
        let expected = ["empty.scenario 0", "full.scenario 0", "a.ladder 0"];
        assert_eq!(first, expected);
        // What is named in another folder counts.
        folder.write("plant/a.ladder", "input a\nrung: a*/b -> c\n");
        let second = folder.check(&checked, &mut told);
        assert_eq!(second[1], "full.scenario 1");
        // So does what a scenario that names nothing finds beside itself.
        folder.write("b.ladder", LADDER);
        let third = folder.check(&checked, &mut told);
        assert_eq!(third[..2], ["b.ladder 0", "empty.scenario 1"]);
        assert_eq!(read(&checked), 5);
        folder.check(&checked, &mut told);
        assert_eq!(read(&checked), 0);
    }

    #[test]
    fn nothing_is_read_again_that_is_what_it_was() {
        let folder = Folder::new();
        let (checked, mut told) = (Checked::default(), Told::new());
        folder.write("a.ladder", LADDER);
        folder.write("b.ladder", LADDER);
        folder.write("b.grafcet", SPEC);
        folder.write("c.xml", "<html/>");
        let first = folder.check(&checked, &mut told);
        assert_eq!(first, ["a.ladder 0", "b.grafcet 1", "b.ladder 0"]);
        assert_eq!(read(&checked), 3);
        let second = folder.check(&checked, &mut told);
        let same = [
            "a.ladder as before",
            "b.grafcet as before",
            "b.ladder as before",
        ];
        assert_eq!(
            (second, read(&checked)),
            (same.map(str::to_owned).to_vec(), 0)
        );
        folder.write("a.ladder", TWICE);
        let third = folder.check(&checked, &mut told);
        assert_eq!(
            third,
            ["a.ladder 1", "b.grafcet as before", "b.ladder as before"]
        );
        assert_eq!(read(&checked), 1);
        // The ladder beside a spec is part of what is found in it.
        folder.write("b.ladder", "input s\ninput e\nrung: (s + v1) * /e -> v1\n");
        let fourth = folder.check(&checked, &mut told);
        assert_eq!(fourth[1..], ["b.grafcet 0", "b.ladder as before"]);
        assert_eq!(read(&checked), 1);
        fs::remove_file(folder.path().join("a.ladder")).expect("a file removed");
        let fifth = folder.check(&checked, &mut told);
        assert_eq!(fifth[2..], ["a.ladder 0"]);
        assert_eq!(told.len(), 2);
    }

    #[test]
    fn a_client_that_has_forgotten_is_told_again() {
        let folder = Folder::new();
        folder.write("a.ladder", TWICE);
        let checked = Checked::default();
        for _ in 0..2 {
            let found = folder.check(&checked, &mut Told::new());
            assert_eq!((found, read(&checked)), (vec!["a.ladder 1".to_owned()], 1));
        }
    }

    #[test]
    fn settings_are_part_of_what_is_found() {
        let folder = Folder::new();
        let (checked, mut told) = (Checked::default(), Told::new());
        folder.write("one/a.ladder", TWICE);
        folder.write("two/b.ladder", TWICE);
        assert_eq!(
            folder.check(&checked, &mut told),
            ["a.ladder 1", "b.ladder 1"]
        );
        folder.write("two/gradus.toml", "diagnostics.ignore = [\"G2002\"]\n");
        let said = folder.check(&checked, &mut told);
        assert_eq!(said, ["a.ladder as before", "b.ladder 0"]);
        folder.write("two/gradus.toml", "diagnostics.workspace = false\n");
        let said = folder.check(&checked, &mut told);
        // No findings are no findings, whatever the reason.
        assert_eq!(said, ["a.ladder as before", "b.ladder as before"]);
        folder.write("two/gradus.toml", "");
        assert_eq!(folder.check(&checked, &mut told)[1..], ["b.ladder 1"]);
        folder.write("two/gradus.toml", "diagnostics.workspace = false\n");
        assert_eq!(folder.check(&checked, &mut told)[1..], ["b.ladder 0"]);
    }

    #[test]
    fn what_is_given_up_is_neither_looked_at_nor_taken_back() {
        let folder = Folder::new();
        let (checked, mut told) = (Checked::default(), Told::new());
        folder.write("a.ladder", TWICE);
        assert_eq!(folder.check(&checked, &mut told), ["a.ladder 1"]);
        checked.give_up();
        folder.write("a.ladder", LADDER);
        folder.write("b.ladder", LADDER);
        assert_eq!(folder.check(&checked, &mut told.clone()), [""; 0]);
        checked.begin_anew();
        assert_eq!(
            folder.check(&checked, &mut told),
            ["a.ladder 0", "b.ladder 0"]
        );
    }

    #[test]
    fn who_stops_it_is_told_nothing_of_what_is_gone() {
        let folder = Folder::new();
        let gone = folder.path().join("gone.ladder");
        let uri = Uri::from_file_path(&gone).expect("an address");
        let told = Told::from([(FileKey::of_path(&gone), (uri, String::new()))]);
        let stopped = Cancel::default();
        stopped.cancel();
        let checked = Checked::default();
        checked.check(&folder.1, told, &stopped, &mut |reports| {
            panic!("{reports:?}")
        });
    }
}
