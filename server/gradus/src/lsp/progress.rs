//! Progress that the client shows of work that takes long.
//!
//! Nearly all work is done before anybody could read what is done. Only what is
//! under way after half a second is shown, until it ends in whatever way.

use std::collections::HashMap;
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use logic::Cancel;
use tokio::sync::oneshot;
use tower_lsp::ls_types::ProgressToken;

use super::key::FileKey;
use super::server::Shared;
use super::telling::answer;

/// What ends sooner is not shown.
const SHORT: Duration = Duration::from_millis(500);

/// What is shown, by its tokens.
#[derive(Debug, Default)]
pub struct Shown {
    next: AtomicU32,
    work: Mutex<HashMap<ProgressToken, Work>>,
}

/// Work that may take long.
#[derive(Clone, Debug)]
pub enum Work {
    /// A document is analysed, for all who ask for it.
    Analysis(FileKey),
    /// Names are looked for in the client's folders. The flag is raised by who
    /// does not want to wait for them.
    Search(Cancel),
    /// The files in the client's folders are checked. The flag is raised by who
    /// does not want that.
    Check(Cancel),
    /// A spec of that name is verified. The flag is raised by who does not want
    /// to wait for it.
    Proof(String, Cancel),
    /// Sequences of inputs are searched for a ladder of that name. The flag is
    /// raised by who does not want to wait for them.
    Sequences(String, Cancel),
}

impl Work {
    fn title(&self) -> String {
        match self {
            Self::Analysis(document) => format!("Analysing {}", document.name()),
            Self::Search(_) => "Reading the names in all files".to_owned(),
            Self::Check(_) => "Checking all files".to_owned(),
            Self::Proof(spec, _) => format!("Verifying {spec}"),
            Self::Sequences(ladder, _) => format!("Searching sequences of {ladder}"),
        }
    }
}

impl Shown {
    /// What a token is about, while its progress is shown.
    pub fn work(&self, token: &ProgressToken) -> Option<Work> {
        self.lock().get(token).cloned()
    }

    fn token(&self) -> ProgressToken {
        let number = self.next.fetch_add(1, Ordering::Relaxed);
        ProgressToken::String(format!("gradus/{number}"))
    }

    fn lock(&self) -> MutexGuard<'_, HashMap<ProgressToken, Work>> {
        self.work.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Says that work is under way, until it is dropped.
#[derive(Debug)]
pub struct UnderWay {
    _open: Option<oneshot::Sender<()>>,
}

/// Shows that `work` is under way, if it takes long and the client can show it.
pub fn under_way(shared: &Arc<Shared>, work: Work) -> UnderWay {
    if !shared.state.world().abilities.progress {
        return UnderWay { _open: None };
    }
    let (open, done) = oneshot::channel();
    tokio::spawn(show(Arc::clone(shared), work, done));
    UnderWay { _open: Some(open) }
}

async fn show(shared: Arc<Shared>, work: Work, mut done: oneshot::Receiver<()>) {
    if tokio::time::timeout(SHORT, &mut done).await.is_ok() {
        return;
    }
    let token = shared.progress.token();
    let title = work.title();
    let asked = answer(shared.client.create_work_done_progress(token.clone()));
    let agreed = tokio::select! {
        biased;
        _ = &mut done => return,
        agreed = asked => agreed.is_some(),
    };
    if !agreed {
        return;
    }
    shared.progress.lock().insert(token.clone(), work);
    let progress = shared.client.progress(token.clone(), title);
    let progress = progress.with_cancel_button().begin().await;
    // Nothing is ever sent: it ends when the other half is dropped.
    let _ = done.await;
    shared.progress.lock().remove(&token);
    progress.finish().await;
}
