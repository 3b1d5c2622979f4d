//! What scenarios run on, and which scenarios run on a ladder or a spec.
//!
//! A scenario runs on the files that its `for` line names, or on those of its
//! name beside it, or on the only ladder in its folder and its spec, as `gradus
//! simulate` has it; unsaved texts count. Beyond that
//! it belongs to the pair of which one of these is a part: names lead to both.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use ide::navigate;
use source::Diagnostic;
use tower_lsp::ls_types::Uri;

use super::document::{Contents, Document};
use super::key::{FileKey, in_folder_of};
use super::query::Pair;
use super::world::World;
use crate::file;
use crate::input;
use crate::subject::{Misfit, unreadable};

/// What a scenario runs on.
#[derive(Clone, Debug, Default)]
pub struct Plant {
    /// The ladder, and the spec.
    pub pair: Pair,
    /// What is wrong with the files that the scenario names.
    pub trouble: Vec<Diagnostic>,
}

impl Plant {
    /// What the scenario in `document` runs on; `None` if that holds none.
    pub fn of(world: &World, document: &Document) -> Option<Self> {
        let scenario = document.scenario()?;
        let files = &scenario.reading.scenario.files;
        let mut plant = Self::default();
        if files.is_empty() {
            plant.pair.ladder = world.ladder_of(document);
            plant.pair.spec = world.spec_of(document);
            if plant.pair.ladder.is_none() && plant.pair.spec.is_none() {
                plant.pair = only_pair(world, document).unwrap_or_default();
            }
            return Some(plant);
        }
        for named in files {
            let found = in_folder_of(&document.uri, &named.path).ok_or_else(missing);
            let found = found.and_then(|uri| plant.add(world, &uri));
            if let Err(trouble) = found {
                let told = unreadable(&named.path, named.span, &trouble);
                plant.trouble.push(told);
            }
        }
        Some(plant)
    }

    /// Adds the file at an address, or says why it cannot be a part.
    fn add(&mut self, world: &World, uri: &Uri) -> Result<(), String> {
        let Some(document) = world.document(uri) else {
            return Err(why_not(FileKey::of(uri).path()));
        };
        let place = match document.contents() {
            Contents::Ladder(ladder) if ladder.is_known() => (&mut self.pair.ladder, "ladder"),
            Contents::Spec(_) => (&mut self.pair.spec, "spec"),
            _ => return Err(Misfit::Other.sentence()),
        };
        match place {
            (Some(_), kind) => Err(Misfit::Second(kind).sentence()),
            (place, _) => {
                *place = Some(document);
                Ok(())
            }
        }
    }

    /// What it is run on, as it is looked at.
    pub fn run_on(&self) -> navigate::Pair<'_> {
        self.pair.looked_at()
    }

    /// The pair that it belongs to: what it runs on, and what lies beside that.
    pub fn belongs_to(self, world: &World) -> Pair {
        let Pair { ladder, spec } = self.pair;
        let beside_spec = || world.ladder_of(spec.as_ref()?);
        let beside_ladder = || world.spec_of(ladder.as_ref()?);
        Pair {
            ladder: ladder.clone().or_else(beside_spec),
            spec: spec.clone().or_else(beside_ladder),
        }
    }

    /// The documents of which one is newer already.
    pub fn is_outdated(&self) -> bool {
        let parts = self.pair.ladder.iter().chain(&self.pair.spec);
        parts.into_iter().any(|document| document.is_outdated())
    }
}

/// The only ladder in the folder of a document, and the spec beside it.
fn only_pair(world: &World, document: &Document) -> Option<Pair> {
    let ladder = input::only_ladder(document.key.path()?, |path| {
        let document = world.document(&FileKey::of_path(path).uri()?)?;
        let is_known = document.ladder().is_some_and(|it| it.is_known());
        is_known.then_some(document)
    })?;
    Some(Pair {
        spec: world.spec_of(&ladder),
        ladder: Some(ladder),
    })
}

fn missing() -> String {
    "there is no such file".to_owned()
}

/// Why a file could not be had.
fn why_not(path: Option<&Path>) -> String {
    match path.map(file::read) {
        Some(Err(reason)) => reason.diagnostic().message,
        Some(Ok(_)) => "the file is no text, or larger than files may be here".to_owned(),
        None => missing(),
    }
}

impl World {
    /// The scenarios that belong to a pair: those that are open, wherever they
    /// are, and those in the folders of the ladder and the spec.
    pub fn scenarios_of(&self, pair: &Pair) -> Vec<Arc<Document>> {
        let mut found: BTreeMap<FileKey, Arc<Document>> = BTreeMap::new();
        let keys = pair.ladder.iter().chain(&pair.spec).map(|it| &it.key);
        for key in keys {
            for other in self.disk.in_folder(key, "scenario") {
                let is_known = self.open.contains_key(&other) || found.contains_key(&other);
                if !is_known
                    && let Some(it) = self
                        .disk
                        .read(&other, self.config(&other).max_file_size.bytes())
                {
                    found.insert(other, it);
                }
            }
        }
        let open = self.open.iter().filter(|(_, it)| it.may_be_scenario());
        found.extend(open.map(|(key, it)| (key.clone(), Arc::clone(it))));
        let same = |a: &Option<Arc<Document>>, b: &Option<Arc<Document>>| match (a, b) {
            (Some(a), Some(b)) => a.key == b.key,
            _ => false,
        };
        found.retain(|_, document| {
            Plant::of(self, document).is_some_and(|plant| {
                let own = plant.belongs_to(self);
                same(&own.ladder, &pair.ladder) || same(&own.spec, &pair.spec)
            })
        });
        found.into_values().collect()
    }

    /// The open scenarios that run on the document of `key`.
    pub fn open_scenarios_on(&self, key: &FileKey) -> Vec<Arc<Document>> {
        let runs_on = |document: &&Arc<Document>| {
            let plant = document
                .may_be_scenario()
                .then(|| Plant::of(self, document))
                .flatten();
            plant.is_some_and(|plant| {
                let mut parts = plant.pair.ladder.iter().chain(&plant.pair.spec);
                parts.any(|it| it.key == *key)
            })
        };
        self.open.values().filter(runs_on).cloned().collect()
    }

    /// The open documents that what is said of `document` depends on.
    pub fn used_by(&self, document: &Arc<Document>) -> Vec<Arc<Document>> {
        let mut used = match Plant::of(self, document) {
            Some(plant) => {
                let Pair { ladder, spec } = plant.belongs_to(self);
                ladder.into_iter().chain(spec).collect()
            }
            None => self.open_partners(&document.key),
        };
        used.push(Arc::clone(document));
        used
    }
}
