use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Why an operation on functions gave no answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Stop {
    /// The answer needs more nodes, or more products, than the budget allows.
    TooLarge,
    /// Somebody asked to stop.
    Cancelled,
}

/// A flag that asks running work to stop. Clones share the flag.
#[derive(Clone, Debug, Default)]
pub struct Cancel(Arc<AtomicBool>);

impl Cancel {
    /// Asks to stop.
    pub fn cancel(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether somebody asked to stop.
    pub fn is_cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// How much an operation may cost.
#[derive(Clone, Debug)]
pub struct Budget {
    /// Most nodes in one diagram.
    pub nodes: usize,
    /// Most products in one printed condition.
    pub products: usize,
    /// Asked before every operation.
    pub cancel: Cancel,
}

impl Default for Budget {
    /// Enough for the largest rung met in real programs (58 contacts) many
    /// times over, little enough that no operation is felt.
    fn default() -> Self {
        Self {
            nodes: 20_000,
            products: 400,
            cancel: Cancel::default(),
        }
    }
}

impl Budget {
    /// Stops if somebody asked to.
    pub fn check(&self) -> Result<(), Stop> {
        if self.cancel.is_cancelled() {
            Err(Stop::Cancelled)
        } else {
            Ok(())
        }
    }
}
