//! Lenses, hints and findings that are out of date though their document is not.
//!
//! A client asks for those of a document again when that document changes. Those
//! of a spec change with its ladder too, those of a scenario with both, and those
//! of a ladder with the scan that is shown in it. So the client is asked to ask
//! again, once for many changes: when somebody types, that is in the pause.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

use super::server::Shared;
use super::telling::answer;

/// How long nothing changes before the client is asked to ask again.
const PAUSE: Duration = Duration::from_millis(150);

/// How often something has changed.
#[derive(Debug, Default)]
pub struct Changes(AtomicU64);

impl Changes {
    /// Counts a change; gives its number.
    fn count(&self) -> u64 {
        self.0.fetch_add(1, Ordering::Relaxed) + 1
    }

    /// Whether it is the last one so far.
    fn is_last(&self, number: u64) -> bool {
        self.0.load(Ordering::Relaxed) == number
    }
}

/// Asks the client to ask for lenses, hints and findings again, in the next
/// pause.
pub fn ask_again(shared: &Arc<Shared>) {
    let abilities = shared.state.world().abilities;
    let refreshes_findings = abilities.refreshes_diagnostics && abilities.pulls_diagnostics;
    if !abilities.refreshes_lenses && !abilities.refreshes_hints && !refreshes_findings {
        return;
    }
    let shared = Arc::clone(shared);
    let number = shared.changes.count();
    tokio::spawn(async move {
        tokio::time::sleep(PAUSE).await;
        if !shared.changes.is_last(number) {
            return;
        }
        if abilities.refreshes_lenses {
            answer(shared.client.code_lens_refresh()).await;
        }
        if abilities.refreshes_hints {
            answer(shared.client.inlay_hint_refresh()).await;
        }
        if refreshes_findings {
            answer(shared.client.workspace_diagnostic_refresh()).await;
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_many_changes_one_is_the_last() {
        let changes = Changes::default();
        let numbers: Vec<u64> = (0..400).map(|_| changes.count()).collect();
        let last = numbers.iter().filter(|number| changes.is_last(**number));
        assert_eq!(last.count(), 1);
        let next = changes.count();
        assert!(changes.is_last(next) && !changes.is_last(numbers[399]));
    }
}
