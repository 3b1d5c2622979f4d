//! What the protocol asks for, and where it is answered.
//!
//! A handler changes the state or takes the world as it is, before its first
//! `await`: messages are begun in the order in which they arrive, but not ended
//! in it. See [`query`](super::query) for the rest.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use tower_lsp::jsonrpc::Result;
use tower_lsp::ls_types::notification::Notification;
use tower_lsp::ls_types::*;
use tower_lsp::{Client, ClientSocket, LanguageServer, LspService};

use super::abilities::Abilities;
use super::capabilities::capabilities;
use super::config::Config;
use super::document::Document;
use super::key::FileKey;
use super::log::Log;
use super::progress::{self, Shown};
use super::query::{self, about};
use super::teller::Tellers;
use super::transport::Output;
use super::world::State;
use super::{parent, publish, requests, telling};

/// How the server ended.
#[derive(Clone, Debug, Default)]
pub struct End(Arc<AtomicBool>);

impl End {
    /// The exit status of the process (LSP, `exit`).
    pub fn status(&self) -> i32 {
        i32::from(!self.0.load(Ordering::SeqCst))
    }
}

/// The language server.
#[derive(Debug)]
pub struct Server {
    /// All that handlers share with the tasks that they begin.
    shared: Arc<Shared>,
    end: End,
}

/// What handlers share with the tasks that they begin.
#[derive(Debug)]
pub struct Shared {
    /// The client.
    pub client: Client,
    /// All that changes.
    pub state: State,
    /// What was done.
    pub log: Log,
    /// What is said to the client.
    pub output: Output,
    /// Who tells findings.
    pub tellers: Tellers,
    /// What the client shows of work that takes long.
    pub progress: Shown,
}

impl Server {
    /// The server as a service, and the socket to its client.
    pub fn service(end: End, log: Log, output: Output) -> (LspService<Self>, ClientSocket) {
        LspService::build(|client| Self {
            shared: Arc::new(Shared {
                client,
                state: State::default(),
                log,
                output,
                tellers: Tellers::default(),
                progress: Shown::default(),
            }),
            end,
        })
        .custom_method("workspace/textDocumentContent", Self::virtual_document)
        .custom_method("window/workDoneProgress/cancel", Self::stop)
        .finish()
    }

    /// Gives up the work that a progress is about. Whoever asks for what it was
    /// to find out begins it anew.
    async fn stop(&self, params: WorkDoneProgressCancelParams) {
        if let Some(key) = self.shared.progress.document(&params.token) {
            self.shared.state.change(|world| {
                if let Some(document) = world.open.get_mut(&key) {
                    *document = Arc::new(document.renewed());
                }
            });
            self.shared.tellers.stop(&key);
        }
    }

    async fn virtual_document(
        &self,
        params: requests::content::Params,
    ) -> Result<requests::content::Content> {
        let world = self.shared.state.world();
        query::elsewhere(move |cancel| requests::content::answer(&world, &params, cancel)).await?
    }

    /// Takes over what the user set, and tells all findings anew.
    fn configure(&self, settings: &LSPAny) {
        let (config, complaints) = Config::read(settings);
        for complaint in complaints {
            self.shared.log.line(complaint);
        }
        self.shared
            .state
            .change(|world| world.config = Arc::new(config));
    }
}

impl LanguageServer for Server {
    async fn initialize(&self, params: InitializeParams) -> Result<InitializeResult> {
        let abilities = Abilities::of(&params);
        if let Some(id) = params.process_id {
            parent::watch(id);
        }
        let folders = params.workspace_folders.unwrap_or_default();
        let capabilities = capabilities(&abilities);
        self.shared.state.change(|world| {
            world.abilities = Arc::new(abilities);
            world.folders = folders.iter().map(|it| FileKey::of(&it.uri)).collect();
        });
        if let Some(settings) = params.initialization_options {
            self.configure(&settings);
        }
        Ok(InitializeResult {
            capabilities,
            server_info: Some(ServerInfo {
                name: "gradus".to_owned(),
                version: Some(env!("CARGO_PKG_VERSION").to_owned()),
            }),
            offset_encoding: None,
        })
    }

    async fn initialized(&self, _: InitializedParams) {
        telling::register(&self.shared);
        telling::ask_for_settings(&self.shared);
    }

    async fn shutdown(&self) -> Result<()> {
        self.end.0.store(true, Ordering::SeqCst);
        self.shared
            .state
            .change(|world| world.open.values().for_each(|it| it.outdate()));
        Ok(())
    }

    async fn did_open(&self, params: DidOpenTextDocumentParams) {
        let item = params.text_document;
        let document = Document::new(item.uri, &item.language_id, Some(item.version), &item.text);
        let key = document.key.clone();
        self.shared.state.change(|world| {
            if let Some(old) = world.open.insert(key.clone(), Arc::new(document)) {
                old.outdate();
            }
        });
        telling::changed(&self.shared, &key);
    }

    async fn did_change(&self, params: DidChangeTextDocumentParams) {
        let key = FileKey::of(&params.text_document.uri);
        let known = self.shared.state.change(|world| {
            let encoding = world.encoding();
            let Some(document) = world.open.get_mut(&key) else {
                return false;
            };
            let version = params.text_document.version;
            *document = Arc::new(document.edited(version, params.content_changes, encoding));
            true
        });
        match known {
            true => telling::changed(&self.shared, &key),
            false => self
                .shared
                .log
                .line(format!("a change of {key:?}, which is not open")),
        }
    }

    async fn did_save(&self, params: DidSaveTextDocumentParams) {
        let key = FileKey::of(&params.text_document.uri);
        self.shared.state.change(|world| world.disk.forget(&key));
    }

    async fn did_close(&self, params: DidCloseTextDocumentParams) {
        let key = FileKey::of(&params.text_document.uri);
        let closed = self.shared.state.change(|world| {
            world.disk.forget(&key);
            world.open.remove(&key)
        });
        if let Some(document) = closed {
            document.outdate();
            telling::closed(&self.shared, &document);
        }
    }

    async fn did_change_configuration(&self, params: DidChangeConfigurationParams) {
        if self.shared.state.world().abilities.configuration {
            telling::ask_for_settings(&self.shared);
        } else {
            self.configure(&params.settings);
            telling::everything(&self.shared);
        }
    }

    async fn did_change_workspace_folders(&self, params: DidChangeWorkspaceFoldersParams) {
        let removed: Vec<_> = params
            .event
            .removed
            .iter()
            .map(|it| FileKey::of(&it.uri))
            .collect();
        let added = params.event.added.iter().map(|it| FileKey::of(&it.uri));
        self.shared.state.change(|world| {
            world.folders.retain(|it| !removed.contains(it));
            world.folders.extend(added);
        });
    }

    async fn did_change_watched_files(&self, params: DidChangeWatchedFilesParams) {
        let mut matters = false;
        for change in params.changes {
            let key = FileKey::of(&change.uri);
            let partners = self.shared.state.change(|world| {
                world.disk.forget(&key);
                world.open_partners(&key)
            });
            matters |= !partners.is_empty();
            for partner in partners {
                telling::changed(&self.shared, &partner.key);
            }
        }
        if matters {
            telling::refresh(&self.shared);
        }
    }

    async fn diagnostic(
        &self,
        params: DocumentDiagnosticParams,
    ) -> Result<DocumentDiagnosticReportResult> {
        let world = self.shared.state.world();
        let open = world.open.get(&FileKey::of(&params.text_document.uri));
        let _under_way = open.map(|document| progress::under_way(&self.shared, document));
        let found = about(world, params.text_document.uri, |query| {
            let (world, document) = (&query.world, &query.document);
            Some(publish::diagnostics(world, document, &query.budget))
        });
        let report = FullDocumentDiagnosticReport {
            result_id: None,
            items: found.await?.unwrap_or_default(),
        };
        Ok(
            DocumentDiagnosticReport::Full(RelatedFullDocumentDiagnosticReport {
                related_documents: None,
                full_document_diagnostic_report: report,
            })
            .into(),
        )
    }

    async fn hover(&self, params: HoverParams) -> Result<Option<Hover>> {
        let at = params.text_document_position_params;
        about(
            self.shared.state.world(),
            at.text_document.uri,
            move |query| requests::hover::answer(query, at.position),
        )
        .await
    }
}

/// A notification of the server's own: what is known of a ladder.
#[derive(Debug)]
pub enum StatusNotification {}

impl Notification for StatusNotification {
    type Params = LSPAny;
    const METHOD: &'static str = "gradus/status";
}
