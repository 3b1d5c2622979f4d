//! A request under way.

use std::sync::Arc;

use logic::{Budget, Cancel};
use tokio::task::AbortHandle;
use tower_lsp::jsonrpc::{Error, Result};
use tower_lsp::ls_types::{Location, Position, Range, Uri};

use super::document::Document;
use super::fault;
use super::guard::{internal, reason};
use super::plant::Plant;
use super::position::Encoding;
use super::world::World;
use crate::settings::Config;
use ide::navigate::{self, Side};
use ide::{Judged, Ladder, Run, Scenario, Spec, Verdict};
use recovery::successions::Evidence;
use source::Span;

/// A request about one document, with all that was known when it came.
#[derive(Debug)]
pub struct Query {
    /// What was known.
    pub world: World,
    /// The document.
    pub document: Arc<Document>,
    /// What answering may cost; it ends when the client cancels.
    pub budget: Budget,
}

impl Query {
    /// What columns count.
    pub fn encoding(&self) -> Encoding {
        self.world.encoding()
    }

    /// What is set for the document.
    pub fn config(&self) -> Config {
        self.world.config(&self.document.key)
    }

    /// The weakest evidence that the user wants to see.
    pub fn weakest(&self) -> Evidence {
        self.config().suggestions.evidence.into()
    }

    /// The byte at a position of the document.
    pub fn offset(&self, position: Position) -> usize {
        self.document.offset(position, self.encoding())
    }

    /// The range of a span of the document.
    pub fn range(&self, span: Span) -> Range {
        self.encoding().range(&self.document.rope, span)
    }

    /// The ladder that the document holds.
    pub fn ladder(&self) -> Option<&Arc<Ladder>> {
        self.document.ladder().filter(|ladder| ladder.is_known())
    }

    /// The spec that the document holds.
    pub fn spec(&self) -> Option<&Arc<Spec>> {
        self.document.spec()
    }

    /// The scenario that the document holds.
    pub fn scenario(&self) -> Option<&Arc<Scenario>> {
        self.document.scenario()
    }

    /// What the scenario that the document holds runs on, and what comes of it.
    pub fn run(&self) -> Option<(Plant, Arc<Run>)> {
        let scenario = self.scenario()?;
        let plant = Plant::of(&self.world, &self.document)?;
        let run = self.world.runs.run(&self.document, scenario, &plant);
        Some((plant, run))
    }

    /// The step of the scenario in the document of which a scan is shown.
    pub fn chosen_step(&self, run: &Run) -> Option<usize> {
        let chosen = self.world.chosen.as_ref();
        let own = chosen.filter(|it| it.scenario == self.document.key)?;
        own.scan.in_run(run).map(|(step, _)| step)
    }

    /// What the document holds, as far as it is understood.
    pub fn text(&self) -> Option<Text<'_>> {
        if let Some(spec) = self.spec() {
            return Some(Text::Spec(spec));
        }
        match self.scenario() {
            Some(scenario) => Some(Text::Scenario(scenario)),
            None => self.ladder().map(|it| Text::Ladder(it)),
        }
    }

    /// The document and the one beside it, told apart.
    pub fn pair(&self) -> Pair {
        Pair::of(&self.world, &self.document)
    }

    /// Which of the two texts of a pair the document is.
    pub fn side(&self) -> Option<Side> {
        match (self.spec(), self.ladder()) {
            (Some(_), _) => Some(Side::Spec),
            (None, Some(_)) => Some(Side::Ladder),
            (None, None) => None,
        }
    }

    /// Where a span of `document` is.
    pub fn location(&self, document: &Document, span: Span) -> Location {
        document.location(span, self.encoding())
    }
}

/// What a document holds.
#[derive(Clone, Copy, Debug)]
pub enum Text<'q> {
    /// A ladder.
    Ladder(&'q Ladder),
    /// A spec.
    Spec(&'q Spec),
    /// A scenario.
    Scenario(&'q Scenario),
}

/// A ladder and the spec beside it.
#[derive(Clone, Debug, Default)]
pub struct Pair {
    /// The document that holds the ladder.
    pub ladder: Option<Arc<Document>>,
    /// The document that holds the spec.
    pub spec: Option<Arc<Document>>,
}

impl Pair {
    /// A document and the one beside it; of a scenario the two that it belongs
    /// to.
    pub fn of(world: &World, document: &Arc<Document>) -> Self {
        if let Some(plant) = Plant::of(world, document) {
            return plant.belongs_to(world);
        }
        if document.spec().is_some() {
            return Self {
                ladder: world.ladder_of(document),
                spec: Some(Arc::clone(document)),
            };
        }
        let is_ladder = document.ladder().is_some_and(|it| it.is_known());
        Self {
            spec: world.spec_of(document),
            ladder: is_ladder.then(|| Arc::clone(document)),
        }
    }

    /// The ladder.
    pub fn ladder(&self) -> Option<&Arc<Ladder>> {
        self.ladder.as_ref()?.ladder()
    }

    /// The spec.
    pub fn spec(&self) -> Option<&Arc<Spec>> {
        self.spec.as_ref()?.spec()
    }

    /// The document of one of the two.
    pub fn document(&self, side: Side) -> Option<&Arc<Document>> {
        match side {
            Side::Ladder => self.ladder.as_ref(),
            Side::Spec => self.spec.as_ref(),
        }
    }

    /// The two with what was found about them.
    pub fn judged<'p>(&'p self, verdict: &'p Verdict) -> Option<Judged<'p>> {
        Some(Judged {
            ladder: self.ladder()?,
            spec: self.spec()?,
            verdict,
        })
    }

    /// The two as they are looked at.
    pub fn looked_at(&self) -> navigate::Pair<'_> {
        navigate::Pair {
            ladder: self.ladder().map(|it| &**it),
            spec: self.spec().map(|it| &**it),
        }
    }
}

/// Cancels when it is dropped, as the future of a cancelled request is: work
/// under way by its flag, and work that has not begun for good.
#[derive(Debug)]
struct CancelOnDrop(Cancel, AbortHandle);

impl Drop for CancelOnDrop {
    fn drop(&mut self) {
        self.0.cancel();
        self.1.abort();
    }
}

/// Answers a request about the document at `uri` on another thread. Of a
/// document that is not there, nothing is known; of one that changes
/// meanwhile, the answer is dropped.
pub async fn about<T, F>(world: World, uri: Uri, work: F) -> Result<Option<T>>
where
    T: Send + 'static,
    F: FnOnce(&Query) -> Option<T> + Send + 'static,
{
    elsewhere(move |cancel| {
        let Some(document) = world.document(&uri) else {
            return Ok(None);
        };
        let query = Query {
            world,
            document,
            budget: Budget {
                cancel,
                ..Budget::default()
            },
        };
        let answer = work(&query);
        let used = query.world.used_by(&query.document);
        match used.iter().any(|document| document.is_outdated()) {
            true => Err(Error::content_modified()),
            false => Ok(answer),
        }
    })
    .await?
}

/// Does `work` on another thread; its flag is raised when nobody waits for the
/// answer any more.
pub async fn elsewhere<T, F>(work: F) -> Result<T>
where
    T: Send + 'static,
    F: FnOnce(Cancel) -> T + Send + 'static,
{
    let cancel = Cancel::default();
    let flag = cancel.clone();
    let job = tokio::task::spawn_blocking(move || {
        fault::forced(fault::WORK);
        work(flag)
    });
    let _guard = CancelOnDrop(cancel, job.abort_handle());
    job.await.map_err(|error| match error.try_into_panic() {
        Ok(panic) => internal(reason(&*panic)),
        Err(_) => Error::request_cancelled(),
    })
}
