//! Who tells the findings of a document.
//!
//! A document changes faster than its findings can be found, or than the client
//! reads them, and the findings of a spec change with its ladder too. So each
//! document has one teller at most. What happens while it is at work only makes
//! it begin anew: then nothing old can overtake what is new, and no queue grows.

use std::collections::HashMap;
use std::sync::{Mutex, MutexGuard, PoisonError};

use logic::Cancel;

use super::key::FileKey;

/// The tellers at work.
#[derive(Debug, Default)]
pub struct Tellers(Mutex<HashMap<FileKey, Teller>>);

/// One of them.
#[derive(Debug, Default)]
struct Teller {
    /// The document, or one that it depends on, has changed meanwhile.
    is_behind: bool,
    /// Raised when what it works out now is old already.
    work: Cancel,
}

impl Tellers {
    /// Says that the findings of a document may be others now. Whether somebody
    /// has to begin telling them; else the one who does it begins anew.
    pub fn is_needed(&self, key: &FileKey) -> bool {
        let mut all = self.lock();
        if let Some(teller) = all.get_mut(key) {
            teller.is_behind = true;
            teller.work.cancel();
            return false;
        }
        all.insert(key.clone(), Teller::default());
        true
    }

    /// Begins a round; it is in vain when the flag is raised.
    pub fn round(&self, key: &FileKey) -> Cancel {
        let teller = Teller::default();
        let work = teller.work.clone();
        self.lock().insert(key.clone(), teller);
        work
    }

    /// Says that nobody wants the findings that are worked out now.
    pub fn stop(&self, key: &FileKey) {
        if let Some(teller) = self.lock().get(key) {
            teller.work.cancel();
        }
    }

    /// Ends a round. Whether it was the last; else another must begin.
    pub fn is_done(&self, key: &FileKey) -> bool {
        let mut all = self.lock();
        let is_done = all.get(key).is_none_or(|teller| !teller.is_behind);
        if is_done {
            all.remove(key);
        }
        is_done
    }

    fn lock(&self) -> MutexGuard<'_, HashMap<FileKey, Teller>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    #[test]
    fn many_changes_make_one_more_round() {
        let (tellers, key) = (Tellers::default(), FileKey::of_path(Path::new("/a")));
        assert!(tellers.is_needed(&key));
        let first = tellers.round(&key);
        assert!((0..400).all(|_| !tellers.is_needed(&key)));
        assert!(first.is_cancelled() && !tellers.is_done(&key));
        let second = tellers.round(&key);
        assert!(!second.is_cancelled() && tellers.is_done(&key));
        assert!(tellers.is_needed(&key));
    }

    #[test]
    fn what_nobody_wants_is_not_begun_anew() {
        let (tellers, key) = (Tellers::default(), FileKey::of_path(Path::new("/a")));
        assert!(tellers.is_needed(&key));
        let work = tellers.round(&key);
        tellers.stop(&key);
        assert!(work.is_cancelled() && tellers.is_done(&key));
    }

    #[test]
    fn each_document_has_its_own() {
        let tellers = Tellers::default();
        let [a, b] = ["/a", "/b"].map(|path| FileKey::of_path(Path::new(path)));
        assert!(tellers.is_needed(&a) && tellers.is_needed(&b));
        let work = tellers.round(&a);
        assert!(!tellers.is_needed(&b) && !work.is_cancelled());
    }
}
