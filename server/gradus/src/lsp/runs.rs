//! What came of scenarios, worked out once for all who ask.
//!
//! An editor asks for the findings, the lenses and the hints of a scenario at
//! the same time, and again after every change of the scenario, its ladder or
//! its spec. Each is a document that never changes, so a run is right as long as
//! the three are the same; when one is outdated, the run ends by itself.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError, Weak};

use ide::{Run, Scenario};

use super::document::Document;
use super::key::FileKey;
use super::plant::Plant;

/// The runs that are known, by their scenarios.
#[derive(Debug, Default)]
pub struct Runs(Mutex<HashMap<FileKey, Kept>>);

/// A run, and what it was of.
#[derive(Debug)]
struct Kept {
    of: Vec<Weak<Document>>,
    /// Whether nothing that it runs on was missing.
    is_whole: bool,
    run: Arc<OnceLock<Arc<Run>>>,
}

/// Runs that are kept: those of open scenarios, and some more.
const KEPT: usize = 64;

impl Runs {
    /// What comes of the scenario in `document` on a plant.
    pub fn run(&self, document: &Arc<Document>, scenario: &Scenario, plant: &Plant) -> Arc<Run> {
        let slot = self.slot(document, plant);
        let wanted = || !document.is_outdated() && !plant.is_outdated();
        let run = slot.get_or_init(|| {
            Arc::new(match plant.trouble.is_empty() {
                true => Run::new(scenario, plant.run_on(), &wanted),
                false => Run::left_out(scenario, plant.run_on()),
            })
        });
        Arc::clone(run)
    }

    /// The place of a run: the one that is there, if it is of the same three.
    fn slot(&self, document: &Arc<Document>, plant: &Plant) -> Arc<OnceLock<Arc<Run>>> {
        let parts = plant.pair.ladder.iter().chain(&plant.pair.spec);
        let of: Vec<Weak<Document>> = std::iter::once(document)
            .chain(parts)
            .map(Arc::downgrade)
            .collect();
        let is_whole = plant.trouble.is_empty();
        let mut runs = self.lock();
        if let Some(kept) = runs.get(&document.key) {
            let mut pairs = kept.of.iter().zip(&of);
            let same = kept.of.len() == of.len() && kept.is_whole == is_whole;
            if same && pairs.all(|(a, b)| a.ptr_eq(b)) {
                return Arc::clone(&kept.run);
            }
        }
        if runs.len() >= KEPT {
            runs.clear();
        }
        let run = Arc::default();
        let kept = Kept {
            of,
            is_whole,
            run: Arc::clone(&run),
        };
        runs.insert(document.key.clone(), kept);
        run
    }

    fn lock(&self) -> MutexGuard<'_, HashMap<FileKey, Kept>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use std::str::FromStr;

    use tower_lsp::ls_types::Uri;

    use super::*;
    use crate::lsp::query::Pair;

    fn document(name: &str, text: &str) -> Arc<Document> {
        let uri = Uri::from_str(&format!("file:///p/{name}")).expect("an address");
        Arc::new(Document::new(uri, "", Some(1), text))
    }

    fn on(ladder: &Arc<Document>) -> Plant {
        Plant {
            pair: Pair {
                ladder: Some(Arc::clone(ladder)),
                spec: None,
            },
            trouble: Vec::new(),
        }
    }

    #[test]
    fn a_scenario_is_run_once_until_it_or_its_ladder_changes() {
        let ladder = document("a.ladder", "rung: s -> v\n");
        let scenario = document("a.scenario", "on s => off v\n");
        let runs = Runs::default();
        let run = |scenario: &Arc<Document>, plant: &Plant| {
            let text = scenario.scenario().expect("a scenario");
            runs.run(scenario, text, plant)
        };
        let first = run(&scenario, &on(&ladder));
        assert!(Arc::ptr_eq(&first, &run(&scenario, &on(&ladder))));
        let edited = document("a.ladder", "rung: /s -> v\n");
        let second = run(&scenario, &on(&edited));
        let failures = |run: &Run| run.simulation.as_ref().map(|it| it.failures().count());
        assert_eq!((failures(&first), failures(&second)), (Some(1), Some(0)));
        let renewed = Arc::new(scenario.renewed());
        assert!(!Arc::ptr_eq(&second, &run(&renewed, &on(&edited))));
    }

    #[test]
    fn a_run_that_nobody_wants_any_more_ends() {
        let ladder = document("a.ladder", "rung: s -> v\n");
        let scenario = document("a.scenario", "on s => off v\n");
        ladder.outdate();
        let text = scenario.scenario().expect("a scenario");
        let run = Runs::default().run(&scenario, text, &on(&ladder));
        assert!(run.is_cancelled());
    }
}
