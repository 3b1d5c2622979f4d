//! Proofs in the background, and those that somebody asks for.
//!
//! When a ladder or a spec has changed and rests for a moment, the pair is
//! verified with a small effort, in 150 MB at the very worst. At most one such proof is at work, and one that
//! somebody asked for with a command; the others wait for their turn. A proof
//! ends at once when one of its two texts changes, when both are closed, and when
//! the user cancels its progress. Nothing is proved again that is known: see
//! [`Verdicts`](super::verdicts::Verdicts).

use std::sync::Arc;
use std::time::Duration;

use ide::Question;
use proof::{Limits, Netlist};
use source::{Diagnostic, Severity};
use tokio::sync::Semaphore;
use tower_lsp::jsonrpc::{Error, Result};
use tower_lsp::ls_types::Uri;
use verification::{Refusal, verify};

use super::key::FileKey;
use super::progress::{self, Work};
use super::query::{Pair, elsewhere};
use super::server::Shared;
use super::telling;
use super::verdicts::{Known, Outcome, Turn, UnderWay};
use super::world::World;
use crate::settings::Verify;

/// How long nothing changes before a proof is begun.
const REST: Duration = Duration::from_millis(500);

/// Millions of steps that are worth it for who asks: about a minute, as with
/// `gradus verify`.
const ASKED: u64 = 5_000;

/// Whose turn it is.
#[derive(Debug)]
pub struct Turns {
    background: Semaphore,
    asked: Semaphore,
}

impl Default for Turns {
    fn default() -> Self {
        Self {
            background: Semaphore::new(1),
            asked: Semaphore::new(1),
        }
    }
}

/// What is to be found out.
#[derive(Clone, Debug)]
struct Task {
    pair: Pair,
    question: Question,
    settings: Verify,
    /// Whether a text has errors.
    has_errors: bool,
}

impl Task {
    /// What is to be found out about the open documents of a stem.
    fn of(world: &World, stem: &FileKey) -> Option<Self> {
        let mut open = world.open.values();
        let document = open.find(|it| it.key.without_ending() == *stem && !it.may_be_scenario())?;
        Self::about(world, Pair::of(world, document))
    }

    /// What is to be found out about the ladder or spec at an address.
    fn at(world: &World, uri: &Uri) -> Option<Self> {
        let document = world.document(uri)?;
        if document.scenario().is_some() {
            return None;
        }
        Self::about(world, Pair::of(world, &document))
    }

    fn about(world: &World, pair: Pair) -> Option<Self> {
        let (ladder, spec) = (pair.ladder()?, pair.spec()?);
        let has_errors =
            |found: &[Diagnostic]| found.iter().any(|it| it.severity == Severity::Error);
        Some(Self {
            question: Question::of(ladder, spec),
            settings: world.config(&pair.spec.as_ref()?.key).verify,
            has_errors: has_errors(ladder.diagnostics()) || has_errors(&spec.reading.diagnostics),
            pair,
        })
    }

    /// What is kept of it.
    fn known(&self, world: &World) -> Option<Known> {
        let timing = self.settings.timing.into();
        world.verdicts.known(&self.pair, timing)
    }

    /// Whether the background has nothing to do: it is found out, nobody wants it to
    /// be, or it cannot be while there are errors.
    fn is_settled(&self, world: &World) -> bool {
        self.known(world).is_some_and(|known| match known.outcome {
            Outcome::Found(_) => known.is_found(self.settings.effort.millions()),
            Outcome::Stopped => true,
            Outcome::Mistaken => self.has_errors,
        })
    }
}

/// Finds out, when nothing has changed for a moment, how the pair stands that
/// the document of `key` belongs to.
pub fn changed(shared: &Arc<Shared>, key: &FileKey) {
    let world = shared.state.world();
    let open = world.open.get(key);
    if open.is_none_or(|document| document.may_be_scenario()) {
        return;
    }
    let stem = key.without_ending();
    let turn = world.verdicts.begin(&stem, UnderWay::Background);
    let shared = Arc::clone(shared);
    tokio::spawn(async move {
        tokio::time::sleep(REST).await;
        if !turn.work.is_cancelled() {
            in_background(&shared, &stem, turn).await;
        }
    });
}

/// The same when the ladder or spec of `key` was closed.
pub fn closed(shared: &Arc<Shared>, key: &FileKey) {
    let world = shared.state.world();
    let partners = world.open_partners(key);
    match partners.iter().find(|it| !it.may_be_scenario()) {
        Some(partner) => changed(shared, &partner.key),
        None => world.verdicts.forget(&key.without_ending()),
    }
}

async fn in_background(shared: &Arc<Shared>, stem: &FileKey, turn: Turn) {
    let world = shared.state.world();
    let (at, own) = (stem.clone(), world.clone());
    let task = elsewhere(move |_| {
        let task = Task::of(&own, &at).filter(|task| task.settings.enable)?;
        (!task.is_settled(&own)).then_some(task)
    });
    let task = task.await.ok().flatten();
    let Some(task) = task.filter(|_| !world.is_ending) else {
        world.verdicts.end(&turn, None);
        return;
    };
    let effort = task.settings.effort.millions();
    if task.has_errors {
        end(shared, stem, &turn, known(&task, effort, Outcome::Mistaken));
        return;
    }
    if let Ok(_turn) = shared.proofs.background.acquire().await {
        let limits = Limits {
            gates: 1_000_000,
            clauses: 1_000_000,
            nodes: 250_000,
            ..Limits::default()
        };
        prove(shared, stem, &task, &turn, effort, limits).await;
    }
}

/// What is known of the pair that the ladder or spec at an address belongs to,
/// once as much work has been done as is worth it for who asks. `None` if there
/// is no such pair.
pub async fn asked(shared: &Arc<Shared>, uri: Uri) -> Result<Option<(Pair, Known)>> {
    let world = shared.state.world();
    let stem = FileKey::of(&uri).without_ending();
    let asked = Asked {
        turn: world.verdicts.begin(&stem, UnderWay::Asked),
        shared: Arc::clone(shared),
        stem,
    };
    let own = world.clone();
    let task = elsewhere(move |_| {
        let task = Task::at(&own, &uri)?;
        let effort = ASKED.max(task.settings.effort.millions());
        let known = task.known(&own).filter(|known| known.is_found(effort));
        Some((task, effort, known))
    });
    let Some((task, effort, known)) = task.await? else {
        return Ok(None);
    };
    if let Some(known) = known {
        return Ok(Some((task.pair, known)));
    }
    let Ok(_turn) = shared.proofs.asked.acquire().await else {
        return Ok(None);
    };
    let limits = Limits::default();
    match prove(shared, &asked.stem, &task, &asked.turn, effort, limits).await {
        Some(known) => Ok(Some((task.pair, known))),
        None => Err(Error::content_modified()),
    }
}

/// A question that somebody waits to be answered; dropped, nobody does.
struct Asked {
    shared: Arc<Shared>,
    stem: FileKey,
    turn: Turn,
}

impl Drop for Asked {
    fn drop(&mut self) {
        let world = self.shared.state.world();
        if world.verdicts.abandon(&self.turn) && !world.is_ending {
            telling::judged(&self.shared, &self.stem);
        }
    }
}

/// Proves with so many millions of steps, and keeps what comes of it. `None` if
/// something has changed meanwhile.
async fn prove(
    shared: &Arc<Shared>,
    stem: &FileKey,
    task: &Task,
    turn: &Turn,
    effort: u64,
    limits: Limits,
) -> Option<Known> {
    let name = task.pair.spec.as_ref().map(|it| it.key.name());
    let work = Work::Proof(name.unwrap_or_default(), turn.work.clone());
    let under_way = progress::under_way(shared, work);
    let limits = Limits {
        steps: effort.saturating_mul(1_000_000),
        cancel: turn.work.clone(),
        ..limits
    };
    let (pair, timing) = (task.pair.clone(), task.settings.timing.into());
    let found = elsewhere(move |_| {
        let (ladder, spec) = (pair.ladder()?, pair.spec()?);
        let mut verdict = verify(ladder.program(), &spec.reading.spec, timing, &limits);
        if let Ok(found) = &mut verdict {
            // Nobody exports it from here, and it may be large.
            found.question = Netlist::default();
        }
        Some(verdict)
    });
    let found = found.await;
    drop(under_way);
    let outcome = match found {
        Ok(Some(Err(Refusal::Cancelled))) => Outcome::Stopped,
        Ok(Some(Ok(found))) if found.is_cancelled() => Outcome::Stopped,
        Ok(Some(verdict)) => Outcome::Found(Arc::new(verdict)),
        Ok(None) => return None,
        Err(error) => {
            shared.log.line(error.message.into_owned());
            Outcome::Stopped
        }
    };
    let known = known(task, effort, outcome);
    end(shared, stem, turn, known.clone()).then_some(known)
}

fn known(task: &Task, effort: u64, outcome: Outcome) -> Known {
    Known {
        question: task.question.clone(),
        timing: task.settings.timing.into(),
        effort,
        outcome,
    }
}

/// Keeps what is known and tells it, unless something has changed meanwhile.
fn end(shared: &Arc<Shared>, stem: &FileKey, turn: &Turn, known: Known) -> bool {
    let world = shared.state.world();
    let is_current = world.verdicts.end(turn, Some(known));
    if is_current && !world.is_ending {
        telling::judged(shared, stem);
    }
    is_current
}
