use std::fmt;
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
#[derive(Clone, Default)]
pub struct Cancel(Arc<Flag>);

#[derive(Default)]
struct Flag {
    is_set: AtomicBool,
    asked: Option<Box<dyn Fn() -> bool + Send + Sync>>,
}

impl Cancel {
    /// A flag that is set, besides, when `asked` says so. It is called whenever
    /// running work looks at the flag, and so also tells how often that is.
    pub fn when(asked: impl Fn() -> bool + Send + Sync + 'static) -> Self {
        Self(Arc::new(Flag {
            is_set: AtomicBool::new(false),
            asked: Some(Box::new(asked)),
        }))
    }

    /// Asks to stop.
    pub fn cancel(&self) {
        self.0.is_set.store(true, Ordering::Relaxed);
    }

    /// Whether somebody asked to stop.
    pub fn is_cancelled(&self) -> bool {
        let is_asked = self.0.asked.as_ref().is_some_and(|asked| asked());
        if is_asked {
            self.cancel();
        }
        self.0.is_set.load(Ordering::Relaxed)
    }
}

impl fmt::Debug for Cancel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let is_set = self.0.is_set.load(Ordering::Relaxed);
        f.debug_tuple("Cancel").field(&is_set).finish()
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

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::AtomicUsize;

    #[test]
    fn a_flag_that_asks_stays_set_for_all_who_share_it() {
        let looks = Arc::new(AtomicUsize::new(0));
        let counted = looks.clone();
        let cancel = Cancel::when(move || counted.fetch_add(1, Ordering::Relaxed) == 2);
        let shared = cancel.clone();
        let seen = [&cancel, &shared, &cancel, &shared].map(Cancel::is_cancelled);
        assert_eq!(seen, [false, false, true, true]);
        assert_eq!(looks.load(Ordering::Relaxed), 4);
    }
}
