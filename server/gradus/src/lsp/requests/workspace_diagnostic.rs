//! `workspace/diagnostic`: the findings in all files of the client's folders.
//!
//! A client that takes an answer in parts gets them as they are found, and
//! while there is nothing that it does not know, its question is kept until
//! there is: so neither of the two does anything while nothing happens. That
//! needs a client that says when files change; any other is answered at once.

use std::sync::Arc;
use std::time::{Duration, Instant};

use logic::Cancel;
use serde_json::{Value, json};
use tokio::sync::mpsc::{self, Sender};
use tower_lsp::jsonrpc::Result;
use tower_lsp::ls_types::{
    FullDocumentDiagnosticReport, PreviousResultId, ProgressToken,
    UnchangedDocumentDiagnosticReport, WorkspaceDiagnosticParams, WorkspaceDiagnosticReport,
    WorkspaceDocumentDiagnosticReport as Item, WorkspaceFullDocumentDiagnosticReport,
    WorkspaceUnchangedDocumentDiagnosticReport,
};

use crate::lsp::checked::{Report, Told};
use crate::lsp::key::FileKey;
use crate::lsp::progress::{self, Work};
use crate::lsp::query::elsewhere;
use crate::lsp::server::Shared;

/// How long changes are gathered before files are looked at again.
const GATHER: Duration = Duration::from_secs(1);

/// How long parts of an answer are gathered, and how many.
const PART: (Duration, usize) = (Duration::from_millis(250), 64);

/// Answers, as soon as there is anything that the client does not know.
pub async fn answer(
    shared: &Arc<Shared>,
    params: WorkspaceDiagnosticParams,
) -> Result<WorkspaceDiagnosticReport> {
    let token = params.partial_result_params.partial_result_token;
    let told = told(params.previous_result_ids);
    let mut changes = shared.state.changes();
    loop {
        changes.mark_unchanged();
        let found = round(shared, &told, token.as_ref()).await?;
        let world = shared.state.world();
        let waits = token.is_some() && world.abilities.watches_files && !world.is_ending;
        if found.is_news || !waits {
            let items = found.items;
            return Ok(WorkspaceDiagnosticReport { items });
        }
        // The sender is part of the state, which outlives all requests.
        let _ = changes.changed().await;
        if !shared.state.world().is_ending {
            tokio::time::sleep(GATHER).await;
        }
    }
}

/// What a look at all files comes to.
#[derive(Debug, Default)]
struct Found {
    /// There is something that the client does not know.
    is_news: bool,
    /// What it was not told in parts.
    items: Vec<Item>,
}

/// Looks at all files once, and tells what is found to who takes it in parts.
async fn round(shared: &Arc<Shared>, told: &Told, token: Option<&ProgressToken>) -> Result<Found> {
    let stopped = RaisedAtTheEnd::default();
    let _under_way = progress::under_way(shared, Work::Check(stopped.0.clone()));
    let (parts, mut come) = mpsc::channel(1);
    let (flag, told) = (stopped.0.clone(), told.clone());
    let (on, world) = (Arc::clone(shared), shared.state.world());
    let work = elsewhere(move |_| {
        let mut part = Part::into(parts);
        on.checked
            .check(&world, told, &flag, &mut |reports| part.add(reports));
        part.send();
    });
    let telling = async {
        let (mut found, mut unsaid) = (Found::default(), Vec::new());
        while let Some(reports) = come.recv().await {
            let is_news = reports.iter().any(|it: &Report| it.found.is_some());
            let items = reports.into_iter().map(item);
            match token {
                None => found.items.extend(items),
                Some(_) if !is_news && !found.is_news => unsaid.extend(items),
                Some(token) => {
                    let items = unsaid.drain(..).chain(items).collect();
                    shared.output.room().await;
                    shared.output.message(&partial(token, items));
                }
            }
            found.is_news |= is_news;
        }
        // Whoever waits for parts has nothing to learn from these.
        if !found.is_news {
            found.items.append(&mut unsaid);
        }
        found
    };
    let (done, found) = tokio::join!(work, telling);
    done.map(|()| found)
}

/// A part of an answer, as a message. Were it left to the library, the answer
/// itself could overtake it, and the client would not listen any more.
fn partial(token: &ProgressToken, items: Vec<Item>) -> Value {
    let value = WorkspaceDiagnosticReport { items };
    let params = json!({ "token": token, "value": value });
    json!({ "jsonrpc": "2.0", "method": "$/progress", "params": params })
}

/// Raises its flag when it is dropped, as it is with a request that is
/// cancelled.
#[derive(Debug, Default)]
struct RaisedAtTheEnd(Cancel);

impl Drop for RaisedAtTheEnd {
    fn drop(&mut self) {
        self.0.cancel();
    }
}

/// Reports that are told together.
#[derive(Debug)]
struct Part {
    reports: Vec<Report>,
    since: Instant,
    to: Sender<Vec<Report>>,
}

impl Part {
    fn into(to: Sender<Vec<Report>>) -> Self {
        Self {
            reports: Vec::new(),
            since: Instant::now(),
            to,
        }
    }

    /// Whether anybody wants to hear more.
    fn add(&mut self, reports: Vec<Report>) -> bool {
        self.reports.extend(reports);
        let (time, number) = PART;
        match self.since.elapsed() >= time || self.reports.len() >= number {
            true => self.send(),
            false => !self.to.is_closed(),
        }
    }

    fn send(&mut self) -> bool {
        self.since = Instant::now();
        let reports = std::mem::take(&mut self.reports);
        self.to.blocking_send(reports).is_ok()
    }
}

/// What the client says that it knows.
fn told(previous: Vec<PreviousResultId>) -> Told {
    let by_file = previous.into_iter();
    by_file
        .map(|it| (FileKey::of(&it.uri), (it.uri, it.value)))
        .collect()
}

/// A report in the protocol's types.
fn item(report: Report) -> Item {
    let Report { uri, id, .. } = report;
    let version = report.version.map(i64::from);
    match (report.found, id) {
        (None, Some(result_id)) => Item::Unchanged(WorkspaceUnchangedDocumentDiagnosticReport {
            uri,
            version,
            unchanged_document_diagnostic_report: UnchangedDocumentDiagnosticReport { result_id },
        }),
        (found, result_id) => Item::Full(WorkspaceFullDocumentDiagnosticReport {
            uri,
            version,
            full_document_diagnostic_report: FullDocumentDiagnosticReport {
                result_id,
                items: found.unwrap_or_default(),
            },
        }),
    }
}
