//! What edges remember.

use std::collections::HashMap;

use petgraph::graph::{EdgeIndex, NodeIndex};
use proof::{Gates, Signal};

use super::store::Store;

/// Where an edge keeps what it saw last.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Memory {
    Element(usize, usize, NodeIndex),
    Wire(usize, usize, EdgeIndex),
}

/// The memories of all edges at one point of a scan, each with its latch.
#[derive(Debug, Default)]
pub(super) struct Memories {
    now: HashMap<Memory, usize>,
    all: Vec<(Signal, Signal)>,
}

impl Memories {
    /// What the memory held; it now holds `now` if the condition holds.
    pub(super) fn remember(
        &mut self,
        memory: Memory,
        now: Signal,
        when: Signal,
        store: &mut Store<'_>,
    ) -> Signal {
        let at = *self.now.entry(memory).or_insert_with(|| {
            let latch = store
                .net
                .latch(format!("edge {}", self.all.len() + 1), false);
            self.all.push((latch, latch));
            self.all.len() - 1
        });
        let before = self.all[at].1;
        self.all[at].1 = store.net.ite(when, now, before);
        before
    }

    /// Ends the scan.
    pub(super) fn end(self, store: &mut Store<'_>) {
        for (latch, next) in self.all {
            store.net.set_next(latch, next);
        }
    }
}
