use std::collections::HashMap;

use logic::{Budget, Function, notation};
use recovery::conditions::Conditions;

/// `function` in the notation; `None` past the budget.
pub fn said(function: &Function, conditions: &Conditions, budget: &Budget) -> Option<String> {
    let expr = conditions.expr(function, budget).ok()?;
    Some(notation::write(&expr))
}

/// Conditions in the notation, each worked out once: the power at a coil that
/// holds nothing is its value, what starts it and what keeps it.
pub(crate) struct Words<'a> {
    conditions: &'a Conditions,
    budget: &'a Budget,
    known: HashMap<Function, Option<String>>,
}

impl<'a> Words<'a> {
    pub(crate) fn new(conditions: &'a Conditions, budget: &'a Budget) -> Self {
        Self {
            conditions,
            budget,
            known: HashMap::new(),
        }
    }

    /// `function` in the notation; `None` past the budget.
    pub(crate) fn say(&mut self, function: &Function) -> Option<String> {
        if let Some(known) = self.known.get(function) {
            return known.clone();
        }
        let words = said(function, self.conditions, self.budget);
        self.known.insert(function.clone(), words.clone());
        words
    }
}

/// A diagram with more nodes than this has no sum that anybody reads, and one of
/// ten thousand keeps a computer busy for seconds.
const LEGIBLE_NODES: usize = 500;

/// The same of a sum with more products than this.
const LEGIBLE_PRODUCTS: usize = 40;

/// `function` in the notation; `None` where it would be too long to be read.
pub fn legible(function: &Function, conditions: &Conditions, budget: &Budget) -> Option<String> {
    if function.nodes() > LEGIBLE_NODES {
        return None;
    }
    let budget = Budget {
        products: LEGIBLE_PRODUCTS,
        ..budget.clone()
    };
    said(function, conditions, &budget)
}
