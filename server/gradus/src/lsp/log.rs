//! What the server did, for a report of a fault.

use std::collections::VecDeque;
use std::io::Write;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};

/// Lines that are kept.
const KEPT: usize = 200;

/// The last lines of the log. Clones share them.
#[derive(Clone, Debug)]
pub struct Log {
    lines: Arc<Mutex<VecDeque<String>>>,
    /// To standard error.
    errors: SyncSender<String>,
}

impl Log {
    /// Begins a log. Clients show what a server writes on standard error, so
    /// the lines go there too, from a thread of their own: a client that does
    /// not read them holds up nobody.
    pub fn start() -> Self {
        let (errors, queue) = sync_channel(KEPT);
        std::thread::spawn(move || pump(&queue));
        Self {
            lines: Arc::default(),
            errors,
        }
    }

    /// Adds a line.
    pub fn line(&self, text: impl Into<String>) {
        let text = text.into();
        // Lines that nobody reads are left out on standard error.
        let _ = self.errors.try_send(text.clone());
        let mut lines = self.lines.lock().unwrap_or_else(PoisonError::into_inner);
        if lines.len() == KEPT {
            lines.pop_front();
        }
        lines.push_back(text);
    }

    /// The lines, oldest first.
    pub fn lines(&self) -> Vec<String> {
        let lines = self.lines.lock().unwrap_or_else(PoisonError::into_inner);
        lines.iter().cloned().collect()
    }
}

fn pump(queue: &Receiver<String>) {
    while let Ok(line) = queue.recv() {
        // A client may have closed it.
        let _ = writeln!(std::io::stderr(), "{line}");
    }
}
