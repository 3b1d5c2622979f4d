use std::collections::{BTreeSet, HashMap};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use logic::{AtomId, Budget, Function};

use super::forms::Forms;

/// The forms that the specs of a ladder had, and what they were chosen by.
///
/// As with [sums](super::Sums), to update a spec takes several conversions, and
/// each acceptance another. Clones share what they know.
#[derive(Clone, Debug, Default)]
pub(crate) struct KnownForms(Arc<Mutex<Known>>);

#[derive(Debug, Default)]
struct Known {
    /// The last ones, each with what it depends on.
    forms: Vec<(Key, Arc<Forms>)>,
    memories: HashMap<Memory, bool>,
}

/// The states of sequences, and the nodes that a diagram may have.
type Key = (BTreeSet<AtomId>, usize);

/// A variable, its condition, the variables with steps in that, and the nodes
/// that a diagram may have.
type Memory = (AtomId, Function, Vec<AtomId>, usize);

/// Forms that are kept: those for the decisions of before and of now.
const MOST: usize = 2;

impl KnownForms {
    /// The forms where these states belong to sequences, found by `work` if they
    /// are not known.
    pub(super) fn of(
        &self,
        members: BTreeSet<AtomId>,
        budget: &Budget,
        work: impl FnOnce(BTreeSet<AtomId>) -> Forms,
    ) -> Arc<Forms> {
        let key = (members, budget.nodes);
        if let Some((_, forms)) = self.known().forms.iter().find(|(it, _)| *it == key) {
            return Arc::clone(forms);
        }
        let forms = Arc::new(work(key.0.clone()));
        // Work that was stopped says nothing about the ladder.
        if budget.check().is_ok() {
            let known = &mut self.known().forms;
            if known.len() == MOST {
                known.remove(0);
            }
            known.push((key, Arc::clone(&forms)));
        }
        forms
    }

    /// Whether a memory of this condition can be two steps beside those of
    /// `steps`, found out by `work` if it is not known.
    pub(super) fn is_memory(
        &self,
        own: AtomId,
        said: &Function,
        steps: Vec<AtomId>,
        budget: &Budget,
        work: impl FnOnce() -> bool,
    ) -> bool {
        let key = (own, said.clone(), steps, budget.nodes);
        if let Some(is_memory) = self.known().memories.get(&key) {
            return *is_memory;
        }
        let is_memory = work();
        if budget.check().is_ok() {
            self.known().memories.insert(key, is_memory);
        }
        is_memory
    }

    fn known(&self) -> MutexGuard<'_, Known> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
