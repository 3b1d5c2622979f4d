//! Whether specs do what their ladders do, as far as that is known now.
//!
//! A proof takes longer than anybody types, so it is worked out in the background
//! ([`proving`](super::proving)) and kept here with the [`Question`] that it
//! answers. As long as ladder and spec ask the same question, whatever was typed
//! meanwhile, the answer holds; when they ask another one nothing is told of it
//! any more, at once.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use ide::{Question, Verdict};
use logic::Cancel;
use verification::Verdict::Unknown;
use verification::{Reason, Refusal, Timing};

use super::key::FileKey;
use super::query::Pair;
use super::world::World;
use crate::settings::Verify;

/// What is known of all pairs, each by what its two files have in common.
#[derive(Debug, Default)]
pub struct Verdicts(Mutex<HashMap<FileKey, Entry>>);

/// What is known of a pair.
#[derive(Debug, Default)]
struct Entry {
    /// How often something about it has changed.
    changes: u64,
    /// Raised when what is worked out now is old already, or nobody wants it.
    work: Cancel,
    under_way: UnderWay,
    known: Option<Known>,
}

/// Who finds out how a pair stands.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum UnderWay {
    /// Nobody.
    #[default]
    No,
    /// The background, or it will in the next pause.
    Background,
    /// Somebody who has asked.
    Asked,
}

/// An answer, with what was asked.
#[derive(Clone, Debug)]
pub struct Known {
    /// What was asked.
    pub question: Question,
    /// When outputs were compared.
    pub timing: Timing,
    /// How much work was allowed, in millions of steps.
    pub effort: u64,
    /// What came of it.
    pub outcome: Outcome,
}

/// What came of a question.
#[derive(Clone, Debug)]
pub enum Outcome {
    /// This is the answer.
    Found(Arc<Verdict>),
    /// Somebody did not want to wait for it.
    Stopped,
    /// One of the two texts has errors: what can be read of it is not what is
    /// meant.
    Mistaken,
}

impl Known {
    /// Whether so much work would find nothing else: it is decided, or as much was
    /// done already.
    pub fn is_found(&self, effort: u64) -> bool {
        match &self.outcome {
            Outcome::Found(verdict) => self.effort >= effort || is_decided(verdict),
            Outcome::Stopped | Outcome::Mistaken => false,
        }
    }
}

/// Whether more work would find nothing else.
fn is_decided(verdict: &Verdict) -> bool {
    match verdict {
        Ok(found) => {
            let properties = found.properties.iter().map(|(_, verdict)| verdict);
            let mut all = std::iter::once(&found.verdict).chain(properties);
            all.all(|it| {
                !matches!(
                    it,
                    Unknown {
                        why: Reason::Limits(_),
                        ..
                    }
                )
            })
        }
        Err(Refusal::TooLarge | Refusal::TooManyValues | Refusal::Cancelled) => false,
        Err(_) => true,
    }
}

/// What was found about a pair, if that is known.
pub fn verdict(world: &World, pair: &Pair) -> Option<Arc<Verdict>> {
    let settings = world.config(&pair.spec.as_ref()?.key).verify;
    match world.verdicts.standing(pair, &settings) {
        Standing::Known(Outcome::Found(verdict)) => Some(verdict),
        _ => None,
    }
}

/// How a pair stands.
#[derive(Clone, Debug)]
pub enum Standing {
    /// It is being found out.
    Open,
    /// This is known.
    Known(Outcome),
    /// Nobody has asked.
    Unasked,
}

/// A change of a pair, or a question about it, by its number.
#[derive(Clone, Debug)]
pub struct Turn {
    stem: FileKey,
    number: u64,
    /// Raised when nobody waits for the outcome any more.
    pub work: Cancel,
}

impl Verdicts {
    /// Says that something about the pair of `stem` has changed, or is asked: what
    /// is worked out about it is in vain.
    pub fn begin(&self, stem: &FileKey, under_way: UnderWay) -> Turn {
        let mut all = self.lock();
        let entry = all.entry(stem.clone()).or_default();
        entry.work.cancel();
        entry.changes += 1;
        entry.work = Cancel::default();
        entry.under_way = under_way;
        Turn {
            stem: stem.clone(),
            number: entry.changes,
            work: entry.work.clone(),
        }
    }

    /// Ends a turn with what came of it, or without anything new. Whether nothing
    /// has changed meanwhile.
    pub fn end(&self, turn: &Turn, known: Option<Known>) -> bool {
        let mut all = self.lock();
        let entry = all.get_mut(&turn.stem);
        let Some(entry) = entry.filter(|it| it.changes == turn.number) else {
            return false;
        };
        entry.under_way = UnderWay::No;
        if known.is_some() {
            entry.known = known;
        }
        true
    }

    /// Ends a turn of which nobody wants the outcome. Whether it was under way.
    pub fn abandon(&self, turn: &Turn) -> bool {
        turn.work.cancel();
        let mut all = self.lock();
        let entry = all.get_mut(&turn.stem);
        let open = entry.filter(|it| it.changes == turn.number && it.under_way != UnderWay::No);
        open.map(|entry| entry.under_way = UnderWay::No).is_some()
    }

    /// What tells how the pair of `stem` stands from how it stood at another time.
    pub fn state(&self, stem: &FileKey) -> Option<(u64, UnderWay)> {
        let all = self.lock();
        all.get(stem).map(|entry| (entry.changes, entry.under_way))
    }

    /// Forgets the pair of `stem`.
    pub fn forget(&self, stem: &FileKey) {
        if let Some(entry) = self.lock().remove(stem) {
            entry.work.cancel();
        }
    }

    /// Has all work end.
    pub fn stop(&self) {
        self.lock().values().for_each(|entry| entry.work.cancel());
    }

    /// The kept answer to the question that a pair asks, if it was asked with
    /// this timing.
    pub fn known(&self, pair: &Pair, timing: Timing) -> Option<Known> {
        let (ladder, spec) = (pair.ladder()?, pair.spec()?);
        let stem = pair.spec.as_ref()?.key.without_ending();
        let known = self.lock().get(&stem)?.known.clone()?;
        let same = known.timing == timing && known.question == Question::of(ladder, spec);
        same.then_some(known)
    }

    /// How a pair stands.
    pub fn standing(&self, pair: &Pair, settings: &Verify) -> Standing {
        if let Some(known) = self.known(pair, settings.timing.into()) {
            return Standing::Known(known.outcome);
        }
        let stem = pair.spec.as_ref().map(|it| it.key.without_ending());
        let all = self.lock();
        let entry = stem.and_then(|stem| all.get(&stem));
        match entry.map_or(UnderWay::No, |entry| entry.under_way) {
            UnderWay::Asked => Standing::Open,
            UnderWay::Background if settings.enable => Standing::Open,
            _ => Standing::Unasked,
        }
    }

    fn lock(&self) -> MutexGuard<'_, HashMap<FileKey, Entry>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use std::str::FromStr;

    use tower_lsp::ls_types::Uri;
    use verification::verify;

    use super::*;
    use crate::lsp::document::Document;
    use crate::settings::Config;

    const LADDER: &str = "input a\noutput b\nrung: a -> b\n";
    const SPEC: &str = "Step X0\nInput a\nOutput b\nMarking X0\nSteps:\nX0: a |- b\n";

    fn pair(ladder: &str, spec: &str) -> Pair {
        let document = |name: &str, text: &str| {
            let uri = Uri::from_str(&format!("file:///p/{name}")).expect("an address");
            Some(Arc::new(Document::new(uri, "", Some(1), text)))
        };
        Pair {
            ladder: document("a.ladder", ladder),
            spec: document("a.grafcet", spec),
        }
    }

    fn stem() -> FileKey {
        FileKey::of(&Uri::from_str("file:///p/a.grafcet").expect("an address")).without_ending()
    }

    fn known(pair: &Pair, effort: u64, steps: u64) -> Known {
        let (ladder, spec) = (
            pair.ladder().expect("a ladder"),
            pair.spec().expect("a spec"),
        );
        let limits = proof::Limits {
            steps,
            ..proof::Limits::default()
        };
        let verdict = verify(ladder.program(), &spec.reading.spec, Timing::Scan, &limits);
        Known {
            question: Question::of(ladder, spec),
            timing: Timing::Scan,
            effort,
            outcome: Outcome::Found(Arc::new(verdict)),
        }
    }

    fn word(verdicts: &Verdicts, pair: &Pair) -> &'static str {
        match verdicts.standing(pair, &Config::default().verify) {
            Standing::Open => "open",
            Standing::Unasked => "unasked",
            Standing::Known(Outcome::Found(verdict)) => ide::verdict_word(&verdict),
            Standing::Known(_) => "stopped or mistaken",
        }
    }

    #[test]
    fn what_is_found_holds_as_long_as_the_same_is_asked() {
        let (verdicts, asked) = (Verdicts::default(), pair(LADDER, SPEC));
        assert_eq!(word(&verdicts, &asked), "unasked");
        let turn = verdicts.begin(&stem(), UnderWay::Background);
        assert_eq!(word(&verdicts, &asked), "open");
        assert!(verdicts.end(&turn, Some(known(&asked, 1, 1_000_000))));
        assert_eq!(word(&verdicts, &asked), "equivalent");
        verdicts.begin(&stem(), UnderWay::Background);
        let moved = pair(&format!("\n{LADDER}"), &format!("// By hand\n{SPEC}"));
        assert_eq!(word(&verdicts, &moved), "equivalent");
        let other = pair(&LADDER.replace("a -> b", "/a -> b"), SPEC);
        assert_eq!(word(&verdicts, &other), "open");
        assert!(verdicts.known(&asked, Timing::Settled).is_none());
        verdicts.forget(&stem());
        assert_eq!(word(&verdicts, &asked), "unasked");
    }

    #[test]
    fn what_has_changed_meanwhile_ends_and_is_not_kept() {
        let (verdicts, asked) = (Verdicts::default(), pair(LADDER, SPEC));
        let first = verdicts.begin(&stem(), UnderWay::Background);
        let second = verdicts.begin(&stem(), UnderWay::Asked);
        assert!(first.work.is_cancelled() && !second.work.is_cancelled());
        assert!(!verdicts.end(&first, Some(known(&asked, 1, 1_000_000))));
        assert_eq!(word(&verdicts, &asked), "open");
        assert!(verdicts.abandon(&second) && second.work.is_cancelled());
        assert!(!verdicts.abandon(&second));
        assert_eq!(word(&verdicts, &asked), "unasked");
    }

    #[test]
    fn more_work_is_done_only_where_it_could_find_more() {
        let asked = pair(LADDER, SPEC);
        let proved = known(&asked, 1, 1_000_000);
        assert!(proved.is_found(1) && proved.is_found(1_000));
        let open = known(&asked, 1, 1);
        assert!(open.is_found(1) && !open.is_found(2));
        let stopped = Known {
            outcome: Outcome::Stopped,
            ..open
        };
        assert!(!stopped.is_found(1));
    }
}
