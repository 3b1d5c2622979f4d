//! What the protocol asks for, and where it is answered.
//!
//! A handler changes the state or takes the world as it is, before its first
//! `await`: messages are begun in the order in which they arrive, but not ended
//! in it. See [`query`](super::query) for the rest.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use logic::Cancel;
use tower_lsp::jsonrpc::{Error, Result};
use tower_lsp::ls_types::*;
use tower_lsp::{Client, ClientSocket, LanguageServer, LspService};

use super::abilities::Abilities;
use super::capabilities::capabilities;
use super::checked::Checked;
use super::document::Document;
use super::in_force::{Cause, InForce};
use super::key::FileKey;
use super::log::Log;
use super::progress::{self, Shown, Work};
use super::proving::{self, Turns};
use super::query::{self, Query, about};
use super::requests::command::Command;
use super::searching;
use super::shown::Changes;
use super::teller::Tellers;
use super::transport::Output;
use super::world::State;
use super::{folders, in_force, parent, publish, requests, telling};
use crate::settings::file;

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
    /// The settings files in force.
    pub in_force: InForce,
    /// What was found in whole folders.
    pub checked: Checked,
    /// Changes of what lenses and hints of other documents depend on.
    pub changes: Changes,
    /// Whose turn it is to prove something.
    pub proofs: Turns,
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
                in_force: InForce::default(),
                checked: Checked::default(),
                changes: Changes::default(),
                proofs: Turns::default(),
            }),
            end,
        })
        .custom_method("workspace/textDocumentContent", Self::virtual_document)
        .custom_method("textDocument/inlineCompletion", Self::inline_completion)
        .custom_method("window/workDoneProgress/cancel", Self::stop)
        .finish()
    }

    /// Gives up the work that a progress is about. Whoever asks for what it was
    /// to find out begins it anew.
    async fn stop(&self, params: WorkDoneProgressCancelParams) {
        match self.shared.progress.work(&params.token) {
            Some(Work::Analysis(key)) => {
                self.shared.state.change(|world| {
                    if let Some(document) = world.open.get_mut(&key) {
                        *document = Arc::new(document.renewed());
                    }
                });
                self.shared.tellers.stop(&key);
            }
            Some(Work::Search(stopped) | Work::Proof(_, stopped) | Work::Sequences(_, stopped)) => {
                stopped.cancel()
            }
            Some(Work::Check(stopped)) => {
                self.shared.checked.give_up();
                stopped.cancel();
            }
            None => {}
        }
    }

    async fn virtual_document(
        &self,
        params: requests::content::Params,
    ) -> Result<requests::content::Content> {
        let world = self.shared.state.world();
        query::elsewhere(move |cancel| requests::content::answer(&world, &params, cancel)).await?
    }

    /// Answers a request about a position.
    async fn at<T, F>(&self, at: TextDocumentPositionParams, work: F) -> Result<Option<T>>
    where
        T: Send + 'static,
        F: FnOnce(&Query, Position) -> Option<T> + Send + 'static,
    {
        let world = self.shared.state.world();
        about(world, at.text_document.uri, move |query| {
            work(query, at.position)
        })
        .await
    }

    async fn inline_completion(
        &self,
        params: InlineCompletionParams,
    ) -> Result<Option<InlineCompletionResponse>> {
        let uri = params.text_document_position.text_document.uri.clone();
        about(self.shared.state.world(), uri, move |query| {
            requests::inline_completion::answer(query, &params)
        })
        .await
    }
}

impl LanguageServer for Server {
    async fn initialize(&self, params: InitializeParams) -> Result<InitializeResult> {
        let abilities = Abilities::of(&params);
        if let Some(id) = params.process_id {
            parent::watch(id);
        }
        let folders = folders::at_first(&params);
        let capabilities = capabilities(&abilities);
        self.shared.state.change(|world| {
            world.abilities = Arc::new(abilities);
            world.folders = folders;
        });
        if let Some(settings) = params.initialization_options {
            telling::configure(&self.shared, &settings);
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
        self.shared.state.change(|world| {
            world.is_ending = true;
            world.open.values().for_each(|it| it.outdate());
            world.verdicts.stop();
        });
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
        in_force::look(&self.shared, Cause::Perhaps);
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
        self.shared.checked.begin_anew();
        self.shared.state.change(|world| {
            world.disk.forget(&key);
            world.settings.forget(&key);
        });
        in_force::look(&self.shared, Cause::Perhaps);
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
            in_force::look(&self.shared, Cause::Perhaps);
        }
    }

    async fn did_change_configuration(&self, params: DidChangeConfigurationParams) {
        self.shared.checked.begin_anew();
        if self.shared.state.world().abilities.configuration {
            telling::ask_for_settings(&self.shared);
        } else {
            telling::configure(&self.shared, &params.settings);
            telling::everything(&self.shared);
        }
    }

    async fn did_change_workspace_folders(&self, params: DidChangeWorkspaceFoldersParams) {
        self.shared.checked.begin_anew();
        self.shared
            .state
            .change(|world| folders::changed(&mut world.folders, &params.event));
        in_force::look(&self.shared, Cause::Perhaps);
    }

    async fn did_change_watched_files(&self, params: DidChangeWatchedFilesParams) {
        self.shared.checked.begin_anew();
        let (mut matters, mut is_set) = (false, false);
        for change in params.changes {
            let key = FileKey::of(&change.uri);
            let (partners, runs) = self.shared.state.change(|world| {
                world.disk.forget(&key);
                world.settings.forget(&key);
                let runs = world.open.values().any(|it| it.may_be_scenario());
                (world.open_partners(&key), runs)
            });
            is_set |= key.name() == file::NAME;
            matters |= runs || !partners.is_empty();
            telling::scenarios(&self.shared, &key);
            for partner in partners {
                telling::changed(&self.shared, &partner.key);
            }
        }
        if matters {
            telling::refresh(&self.shared);
        }
        if is_set {
            in_force::look(&self.shared, Cause::Said);
        }
    }

    async fn diagnostic(
        &self,
        params: DocumentDiagnosticParams,
    ) -> Result<DocumentDiagnosticReportResult> {
        let world = self.shared.state.world();
        let open = world.open.get(&FileKey::of(&params.text_document.uri));
        let work = open.map(|document| Work::Analysis(document.key.clone()));
        let _under_way = work.map(|work| progress::under_way(&self.shared, work));
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

    async fn workspace_diagnostic(
        &self,
        params: WorkspaceDiagnosticParams,
    ) -> Result<WorkspaceDiagnosticReportResult> {
        let report = requests::workspace_diagnostic::answer(&self.shared, params);
        Ok(report.await?.into())
    }

    async fn code_action(&self, params: CodeActionParams) -> Result<Option<CodeActionResponse>> {
        let uri = params.text_document.uri;
        about(self.shared.state.world(), uri, move |query| {
            requests::code_action::answer(query, params.range, &params.context)
        })
        .await
    }

    async fn code_action_resolve(&self, params: CodeAction) -> Result<CodeAction> {
        let world = self.shared.state.world();
        let data = params.data.clone().unwrap_or_default();
        let Ok(pending) = serde_json::from_value::<requests::code_action::Pending>(data) else {
            return Ok(params);
        };
        let resolved = about(world, pending.uri.clone(), move |query| {
            requests::code_action::resolve(query, &pending, params)
        });
        resolved.await?.ok_or_else(Error::content_modified)
    }

    async fn code_lens(&self, params: CodeLensParams) -> Result<Option<Vec<CodeLens>>> {
        let uri = params.text_document.uri;
        about(self.shared.state.world(), uri, requests::code_lens::answer).await
    }

    async fn execute_command(&self, params: ExecuteCommandParams) -> Result<Option<LSPAny>> {
        let world = self.shared.state.world();
        match requests::command::read(params)? {
            Command::Explain(code) => Ok(Some(requests::command::page(code))),
            Command::Report => Ok(Some(requests::command::report(&world, &self.shared.log))),
            Command::Simulate(uri) => {
                let what = format!("{} holds no scenario", uri.as_str());
                let shown = about(world, uri, requests::simulate::table);
                shown
                    .await?
                    .map(Some)
                    .ok_or_else(|| Error::invalid_params(what))
            }
            Command::ShowScan(uri, wanted) => {
                let found = about(world, uri, move |query| {
                    requests::simulate::scan(query, wanted)
                });
                let found = found.await?;
                let what = "the scenario has no such scan, or was not run so far";
                let (chosen, answer) = found.ok_or_else(|| Error::invalid_params(what))?;
                telling::choose(&self.shared, Some(chosen));
                Ok(Some(answer))
            }
            Command::HideScan => {
                telling::choose(&self.shared, None);
                Ok(None)
            }
            Command::Search(uri) => searching::asked(&self.shared, uri).await.map(Some),
            Command::Verify(uri) => {
                let what = format!("{} belongs to no ladder with a spec", uri.as_str());
                let found = proving::asked(&self.shared, uri).await?;
                let (pair, known) = found.ok_or_else(|| Error::invalid_params(what))?;
                query::elsewhere(move |_| requests::verify::answer(&pair, &known)).await
            }
            Command::Ladder(uri, command) => {
                if command.needs_sights() {
                    searching::once(&self.shared, uri.clone()).await?;
                }
                let world = self.shared.state.world();
                let done = about(world, uri.clone(), move |query| {
                    requests::command::answer(query, &command)
                });
                let Some(done) = done.await? else {
                    let what = format!("{} holds no ladder that gradus knows", uri.as_str());
                    return Err(Error::invalid_params(what));
                };
                telling::carry_out(&self.shared, done).await.map(Some)
            }
        }
    }

    async fn inlay_hint(&self, params: InlayHintParams) -> Result<Option<Vec<InlayHint>>> {
        let uri = params.text_document.uri;
        about(self.shared.state.world(), uri, move |query| {
            requests::inlay_hint::answer(query, params.range)
        })
        .await
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

    async fn goto_definition(
        &self,
        params: GotoDefinitionParams,
    ) -> Result<Option<GotoDefinitionResponse>> {
        self.at(
            params.text_document_position_params,
            requests::definition::definition,
        )
        .await
    }

    async fn goto_declaration(
        &self,
        params: request::GotoDeclarationParams,
    ) -> Result<Option<request::GotoDeclarationResponse>> {
        self.at(
            params.text_document_position_params,
            requests::definition::declaration,
        )
        .await
    }

    async fn references(&self, params: ReferenceParams) -> Result<Option<Vec<Location>>> {
        let declarations = params.context.include_declaration;
        self.at(params.text_document_position, move |query, at| {
            requests::references::answer(query, at, declarations)
        })
        .await
    }

    async fn document_highlight(
        &self,
        params: DocumentHighlightParams,
    ) -> Result<Option<Vec<DocumentHighlight>>> {
        self.at(
            params.text_document_position_params,
            requests::highlight::answer,
        )
        .await
    }

    async fn document_symbol(
        &self,
        params: DocumentSymbolParams,
    ) -> Result<Option<DocumentSymbolResponse>> {
        about(
            self.shared.state.world(),
            params.text_document.uri,
            requests::symbols::of_document,
        )
        .await
    }

    async fn symbol(
        &self,
        params: WorkspaceSymbolParams,
    ) -> Result<Option<WorkspaceSymbolResponse>> {
        let world = self.shared.state.world();
        let stopped = Cancel::default();
        let _under_way = progress::under_way(&self.shared, Work::Search(stopped.clone()));
        query::elsewhere(move |cancel| {
            let wanted = || !cancel.is_cancelled() && !stopped.is_cancelled();
            requests::symbols::in_folders(&world, &params.query, &wanted)
        })
        .await
    }

    async fn folding_range(&self, params: FoldingRangeParams) -> Result<Option<Vec<FoldingRange>>> {
        about(
            self.shared.state.world(),
            params.text_document.uri,
            requests::folding::answer,
        )
        .await
    }

    async fn selection_range(
        &self,
        params: SelectionRangeParams,
    ) -> Result<Option<Vec<SelectionRange>>> {
        let world = self.shared.state.world();
        about(world, params.text_document.uri, move |query| {
            requests::selection::answer(query, &params.positions)
        })
        .await
    }

    async fn document_link(&self, params: DocumentLinkParams) -> Result<Option<Vec<DocumentLink>>> {
        about(
            self.shared.state.world(),
            params.text_document.uri,
            requests::link::answer,
        )
        .await
    }

    async fn prepare_call_hierarchy(
        &self,
        params: CallHierarchyPrepareParams,
    ) -> Result<Option<Vec<CallHierarchyItem>>> {
        self.at(
            params.text_document_position_params,
            requests::hierarchy::prepare,
        )
        .await
    }

    async fn incoming_calls(
        &self,
        params: CallHierarchyIncomingCallsParams,
    ) -> Result<Option<Vec<CallHierarchyIncomingCall>>> {
        let world = self.shared.state.world();
        about(world, params.item.uri.clone(), move |query| {
            requests::hierarchy::incoming(query, &params.item)
        })
        .await
    }

    async fn outgoing_calls(
        &self,
        params: CallHierarchyOutgoingCallsParams,
    ) -> Result<Option<Vec<CallHierarchyOutgoingCall>>> {
        let world = self.shared.state.world();
        about(world, params.item.uri.clone(), move |query| {
            requests::hierarchy::outgoing(query, &params.item)
        })
        .await
    }

    async fn semantic_tokens_full(
        &self,
        params: SemanticTokensParams,
    ) -> Result<Option<SemanticTokensResult>> {
        let world = self.shared.state.world();
        about(world, params.text_document.uri, |query| {
            requests::tokens::full(query).map(Into::into)
        })
        .await
    }

    async fn semantic_tokens_range(
        &self,
        params: SemanticTokensRangeParams,
    ) -> Result<Option<SemanticTokensRangeResult>> {
        let world = self.shared.state.world();
        about(world, params.text_document.uri, move |query| {
            requests::tokens::range(query, params.range).map(Into::into)
        })
        .await
    }

    async fn completion(&self, params: CompletionParams) -> Result<Option<CompletionResponse>> {
        let at = params.text_document_position;
        self.at(at, requests::completion::answer).await
    }

    async fn completion_resolve(&self, mut item: CompletionItem) -> Result<CompletionItem> {
        let data = item.data.clone().unwrap_or_default();
        let Ok(remembered) = serde_json::from_value::<requests::completion::Remembered>(data)
        else {
            return Ok(item);
        };
        let uri = remembered.uri.clone();
        item.documentation = about(self.shared.state.world(), uri, move |query| {
            requests::completion::documentation(query, &remembered)
        })
        .await?;
        Ok(item)
    }

    async fn signature_help(&self, params: SignatureHelpParams) -> Result<Option<SignatureHelp>> {
        let at = params.text_document_position_params;
        self.at(at, requests::signature_help::answer).await
    }

    async fn formatting(&self, params: DocumentFormattingParams) -> Result<Option<Vec<TextEdit>>> {
        let uri = params.text_document.uri;
        about(
            self.shared.state.world(),
            uri,
            requests::formatting::document,
        )
        .await
    }

    async fn range_formatting(
        &self,
        params: DocumentRangeFormattingParams,
    ) -> Result<Option<Vec<TextEdit>>> {
        let uri = params.text_document.uri;
        about(self.shared.state.world(), uri, move |query| {
            requests::formatting::range(query, params.range)
        })
        .await
    }

    async fn on_type_formatting(
        &self,
        params: DocumentOnTypeFormattingParams,
    ) -> Result<Option<Vec<TextEdit>>> {
        let at = params.text_document_position;
        self.at(at, requests::formatting::on_type).await
    }

    async fn prepare_rename(
        &self,
        params: TextDocumentPositionParams,
    ) -> Result<Option<PrepareRenameResponse>> {
        let found = self.at(params, requests::rename::prepare).await?;
        found.transpose()
    }

    async fn rename(&self, params: RenameParams) -> Result<Option<WorkspaceEdit>> {
        let at = params.text_document_position;
        let found = about(
            self.shared.state.world(),
            at.text_document.uri,
            move |query| requests::rename::answer(query, at.position, &params.new_name),
        );
        found.await?.transpose()
    }
}
