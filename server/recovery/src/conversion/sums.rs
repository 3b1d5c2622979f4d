use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

use logic::{Budget, Expr, Function};

/// Conditions that were written as sums before, in whatever spec of a ladder.
///
/// To update a spec takes several: what the ladder gave for the decisions of
/// before, what it gives for those of now, and the same again to say where the
/// file departs from it. They differ in a few conditions; the rest, and among
/// them all that are too long to be written, are the same. Clones share what
/// they know.
#[derive(Clone, Debug, Default)]
pub(crate) struct Sums(Arc<Mutex<Known>>);

/// The sum of a function within so many nodes and products, if it has one.
type Known = HashMap<(Function, usize, usize), Option<Expr>>;

impl Sums {
    /// What `work` makes of `function` within `budget`, done once for each
    /// function and budget.
    pub(super) fn of(
        &self,
        function: &Function,
        budget: &Budget,
        work: impl FnOnce() -> Option<Expr>,
    ) -> Option<Expr> {
        let key = (function.clone(), budget.nodes, budget.products);
        let known = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(sum) = known().get(&key) {
            return sum.clone();
        }
        let sum = work();
        // Work that was stopped says nothing about the function.
        if budget.check().is_ok() {
            known().insert(key, sum.clone());
        }
        sum
    }
}
