use std::collections::{HashMap, VecDeque};
use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};
use tempfile::TempDir;
use tower_lsp::ls_types::notification::{self, Notification};
use tower_lsp::ls_types::request::{self, Request};
use tower_lsp::ls_types::{
    ApplyWorkspaceEditParams, Diagnostic, DidChangeTextDocumentParams, DidCloseTextDocumentParams,
    DidOpenTextDocumentParams, DocumentDiagnosticParams, DocumentDiagnosticReport,
    DocumentDiagnosticReportResult, InitializeResult, Position, PublishDiagnosticsParams,
    RegistrationParams, TextDocumentContentChangeEvent, TextDocumentIdentifier, TextDocumentItem,
    TextDocumentPositionParams, TextEdit, Uri, VersionedTextDocumentIdentifier,
    WorkDoneProgressCreateParams, WorkspaceEdit,
};

use super::{Marked, Profile, Wire};

/// A client, its server, and a folder of its own.
#[derive(Debug)]
pub struct Client {
    /// The connection, for messages that no client should send.
    pub wire: Wire,
    /// What the server said of itself.
    pub server: InitializeResult,
    /// The client's settings.
    settings: Value,
    profile: Profile,
    folder: TempDir,
    next_id: i64,
    /// Answers that came while another was waited for.
    answers: HashMap<i64, Value>,
    open: HashMap<String, (i32, String)>,
    published: HashMap<Uri, VecDeque<PublishDiagnosticsParams>>,
    applied: VecDeque<WorkspaceEdit>,
    /// What the server asked to be asked again.
    refreshed: VecDeque<String>,
    notifications: VecDeque<Value>,
}

/// Why the server gave no answer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refused {
    /// The number of the error in the protocol.
    pub code: i64,
    /// What it says.
    pub message: String,
}

impl Client {
    /// Starts the server and begins a session in an empty folder.
    pub fn start(executable: &str, profile: Profile) -> Self {
        Self::start_with(executable, profile, json!({}))
    }

    /// The same, with settings.
    pub fn start_with(executable: &str, profile: Profile, settings: Value) -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        let mut wire = Wire::start(executable);
        let uri = Uri::from_file_path(folder.path()).expect("an address");
        wire.send(&json!({
            "jsonrpc": "2.0",
            "id": 0,
            "method": "initialize",
            "params": {
                "processId": std::process::id(),
                "clientInfo": { "name": format!("{profile:?}") },
                "rootUri": uri,
                "capabilities": profile.capabilities(),
                "initializationOptions": settings,
                "workspaceFolders": [{ "uri": uri, "name": "test" }],
            },
        }));
        let answer = wire.receive();
        assert_eq!(answer["id"], 0, "{answer}");
        let server = serde_json::from_value(answer["result"].clone()).expect("an InitializeResult");
        wire.send(&json!({ "jsonrpc": "2.0", "method": "initialized", "params": {} }));
        Self {
            wire,
            server,
            settings,
            profile,
            folder,
            next_id: 1,
            answers: HashMap::new(),
            open: HashMap::new(),
            published: HashMap::new(),
            applied: VecDeque::new(),
            refreshed: VecDeque::new(),
            notifications: VecDeque::new(),
        }
    }

    /// The address of a file in the client's folder.
    pub fn uri(&self, name: &str) -> Uri {
        Uri::from_file_path(self.path(name)).expect("an address")
    }

    /// The path of a file in the client's folder.
    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// Writes a file without opening it.
    pub fn write(&self, name: &str, text: &str) {
        fs::write(self.path(name), text).expect("a file written");
    }

    /// Opens a document. Cursors `$0`, `$1` in the text are taken out.
    pub fn open(&mut self, name: &str, text: &str) -> Marked {
        let marked = Marked::of(text);
        self.open_plain(name, &marked.text);
        marked
    }

    /// Opens a document whose text has no cursors. What was told of one that was
    /// closed is forgotten: its versions begin anew.
    pub fn open_plain(&mut self, name: &str, text: &str) {
        let uri = self.uri(name);
        self.published.remove(&uri);
        let language = match Path::new(name).extension().and_then(|it| it.to_str()) {
            Some("ladder") => "gradus-ladder",
            Some("grafcet") => "grafcet",
            Some("scenario") => "gradus-scenario",
            Some("txt") => "plaintext",
            _ => "xml",
        };
        self.notify::<notification::DidOpenTextDocument>(DidOpenTextDocumentParams {
            text_document: TextDocumentItem {
                uri: self.uri(name),
                language_id: language.into(),
                version: 1,
                text: text.to_owned(),
            },
        });
        self.open.insert(name.to_owned(), (1, text.to_owned()));
    }

    /// Opens a file of the repository, copied into the client's folder.
    pub fn open_fixture(&mut self, path: &str, name: &str) -> String {
        let text = fs::read_to_string(crate::path(path)).expect("a fixture");
        self.open_plain(name, &text);
        text
    }

    /// Replaces the first occurrence of `old` in an open document by `new`.
    pub fn replace(&mut self, name: &str, old: &str, new: &str) {
        let at = self.text(name).find(old).expect("the old text");
        self.edit(name, at..at + old.len(), new);
    }

    /// Replaces some bytes of an open document by `new`.
    pub fn edit(&mut self, name: &str, bytes: Range<usize>, new: &str) {
        let (version, text) = self.open.get_mut(name).expect("an open document");
        let marked = Marked {
            text: text.clone(),
            cursors: vec![bytes.start, bytes.end],
        };
        let counts_bytes = self.profile.counts_bytes();
        let [start, end] = [0, 1].map(|cursor| marked.position(cursor, counts_bytes));
        let range = tower_lsp::ls_types::Range::new(start, end);
        text.replace_range(bytes, new);
        *version += 1;
        let version = *version;
        let change = TextDocumentContentChangeEvent {
            range: Some(range),
            range_length: None,
            text: new.to_owned(),
        };
        self.change(name, version, vec![change]);
    }

    /// Replaces the whole text of an open document.
    pub fn replace_all(&mut self, name: &str, new: &str) {
        let (version, text) = self.open.get_mut(name).expect("an open document");
        *version += 1;
        new.clone_into(text);
        let version = *version;
        let change = TextDocumentContentChangeEvent {
            range: None,
            range_length: None,
            text: new.to_owned(),
        };
        self.change(name, version, vec![change]);
    }

    /// Sends changes as they are.
    pub fn change(
        &mut self,
        name: &str,
        version: i32,
        content_changes: Vec<TextDocumentContentChangeEvent>,
    ) {
        let uri = self.uri(name);
        self.notify::<notification::DidChangeTextDocument>(DidChangeTextDocumentParams {
            text_document: VersionedTextDocumentIdentifier { uri, version },
            content_changes,
        });
    }

    /// Closes a document.
    pub fn close(&mut self, name: &str) {
        let uri = self.uri(name);
        self.open.remove(name);
        self.notify::<notification::DidCloseTextDocument>(DidCloseTextDocumentParams {
            text_document: TextDocumentIdentifier { uri },
        });
    }

    /// The text of an open document.
    pub fn text(&self, name: &str) -> &str {
        &self.open[name].1
    }

    /// The text of an open document after edits, as a client makes them.
    pub fn edited(&self, name: &str, edits: &[TextEdit]) -> String {
        super::cursor::edited(self.text(name), edits, self.profile.counts_bytes())
    }

    /// A place in a document, as many requests want it.
    pub fn at(&self, name: &str, position: Position) -> TextDocumentPositionParams {
        TextDocumentPositionParams {
            text_document: TextDocumentIdentifier {
                uri: self.uri(name),
            },
            position,
        }
    }

    /// Sends a notification.
    pub fn notify<N: Notification>(&mut self, params: N::Params) {
        let params = serde_json::to_value(params).expect("params in JSON");
        let message = json!({ "jsonrpc": "2.0", "method": N::METHOD, "params": params });
        self.wire.send(&message);
    }

    /// The answer to a request. Fails the test if there is none.
    #[track_caller]
    pub fn request<R: Request>(&mut self, params: R::Params) -> R::Result {
        match self.ask::<R>(params) {
            Ok(result) => result,
            Err(refused) => panic!("{}: {refused:?}", R::METHOD),
        }
    }

    /// The answer to a request, or why there is none.
    pub fn ask<R: Request>(&mut self, params: R::Params) -> Result<R::Result, Refused> {
        let id = self.begin::<R>(params);
        self.end::<R>(id)
    }

    /// Sends a request without waiting for its answer.
    pub fn begin<R: Request>(&mut self, params: R::Params) -> i64 {
        let params = serde_json::to_value(params).expect("params in JSON");
        self.send_request(R::METHOD, params)
    }

    fn send_request(&mut self, method: &str, params: Value) -> i64 {
        let id = self.next_id;
        self.next_id += 1;
        let message = json!({ "jsonrpc": "2.0", "id": id, "method": method, "params": params });
        self.wire.send(&message);
        id
    }

    /// The answer to a request that the types of the protocol do not know.
    #[track_caller]
    pub fn ask_raw(&mut self, method: &str, params: Value) -> Value {
        let id = self.send_request(method, params);
        let answer = self.answer(id);
        assert_eq!(answer.get("error"), None, "{method}");
        answer["result"].clone()
    }

    fn answer(&mut self, id: i64) -> Value {
        loop {
            if let Some(answer) = self.answers.remove(&id) {
                return answer;
            }
            let message = self.wire.receive();
            self.take(message);
        }
    }

    /// The answer to the request of that number.
    pub fn end<R: Request>(&mut self, id: i64) -> Result<R::Result, Refused> {
        let answer = self.answer(id);
        if let Some(error) = answer.get("error") {
            return Err(Refused {
                code: error["code"].as_i64().expect("the code of an error"),
                message: error["message"].as_str().unwrap_or_default().to_owned(),
            });
        }
        let result = answer["result"].clone();
        let typed = serde_json::from_value(result.clone());
        Ok(typed.unwrap_or_else(|error| panic!("{}: {error}: {result}", R::METHOD)))
    }

    /// Everything that the server finds in an open document now.
    pub fn diagnostics(&mut self, name: &str) -> Vec<Diagnostic> {
        match &self.server.capabilities.diagnostic_provider {
            Some(_) => self.pulled(name),
            None => self.pushed(name),
        }
    }

    fn pulled(&mut self, name: &str) -> Vec<Diagnostic> {
        let params = DocumentDiagnosticParams {
            text_document: TextDocumentIdentifier {
                uri: self.uri(name),
            },
            identifier: None,
            previous_result_id: None,
            work_done_progress_params: Default::default(),
            partial_result_params: Default::default(),
        };
        let report = self.request::<request::DocumentDiagnosticRequest>(params);
        match report {
            DocumentDiagnosticReportResult::Report(DocumentDiagnosticReport::Full(full)) => {
                full.full_document_diagnostic_report.items
            }
            other => panic!("no full report: {other:?}"),
        }
    }

    /// What is pushed last for the document as it is now.
    fn pushed(&mut self, name: &str) -> Vec<Diagnostic> {
        let (uri, version) = (self.uri(name), self.open[name].0);
        loop {
            let queue = self.published.entry(uri.clone()).or_default();
            if let Some(found) = queue.pop_front() {
                if found.version == Some(version) {
                    return found.diagnostics;
                }
                continue;
            }
            let message = self.wire.receive();
            self.take(message);
        }
    }

    /// The next edit that the server asked the client to apply.
    pub fn applied(&mut self) -> WorkspaceEdit {
        while self.applied.is_empty() {
            let message = self.wire.receive();
            self.take(message);
        }
        self.applied.pop_front().expect("an edit")
    }

    /// Waits until the server asks to be asked again, by the request `method`.
    pub fn refreshed(&mut self, method: &str) {
        loop {
            let mut all = self.refreshed.iter();
            if let Some(at) = all.position(|it| it == method) {
                self.refreshed.remove(at);
                return;
            }
            let message = self.wire.receive();
            self.take(message);
        }
    }

    /// The params of the next notification called `method`.
    pub fn notification(&mut self, method: &str) -> Value {
        loop {
            let mut all = self.notifications.iter();
            if let Some(at) = all.position(|it| it["method"] == method) {
                let message = self.notifications.remove(at).expect("a notification");
                return message["params"].clone();
            }
            let message = self.wire.receive();
            self.take(message);
        }
    }

    /// Takes a message of the server, and answers it if it is a request.
    fn take(&mut self, message: Value) {
        let method = message["method"].as_str().map(str::to_owned);
        match (method.as_deref(), message.get("id")) {
            (None, Some(id)) => {
                let id = id
                    .as_i64()
                    .unwrap_or_else(|| panic!("an answer to nothing: {message}"));
                assert!(id < self.next_id, "an answer to nothing: {message}");
                self.answers.insert(id, message);
            }
            (Some(method), Some(id)) => {
                let result = self.served(method, &message["params"]);
                let answer = json!({ "jsonrpc": "2.0", "id": id, "result": result });
                self.wire.send(&answer);
            }
            (Some(method), None) => self.told(method, message),
            (None, None) => panic!("this is no message: {message}"),
        }
    }

    /// What a client answers to a request of the server.
    fn served(&mut self, method: &str, params: &Value) -> Value {
        let params = params.clone();
        match method {
            request::RegisterCapability::METHOD => {
                let _: RegistrationParams = typed(params);
                Value::Null
            }
            request::WorkspaceConfiguration::METHOD => {
                let items = params["items"].as_array().map_or(0, Vec::len);
                json!(vec![self.settings.clone(); items])
            }
            request::WorkDoneProgressCreate::METHOD => {
                let _: WorkDoneProgressCreateParams = typed(params);
                Value::Null
            }
            request::ApplyWorkspaceEdit::METHOD => {
                let params: ApplyWorkspaceEditParams = typed(params);
                self.applied.push_back(params.edit);
                json!({ "applied": true })
            }
            request::ShowDocument::METHOD => json!({ "success": true }),
            request::CodeLensRefresh::METHOD
            | request::InlayHintRefreshRequest::METHOD
            | request::SemanticTokensRefresh::METHOD
            | request::WorkspaceDiagnosticRefresh::METHOD => {
                self.refreshed.push_back(method.to_owned());
                Value::Null
            }
            _ => panic!("nobody expected {method}: {params}"),
        }
    }

    fn told(&mut self, method: &str, message: Value) {
        match method {
            notification::PublishDiagnostics::METHOD => {
                let found: PublishDiagnosticsParams = typed(message["params"].clone());
                let queue = self.published.entry(found.uri.clone()).or_default();
                queue.push_back(found);
            }
            notification::Progress::METHOD | notification::LogMessage::METHOD | "gradus/status" => {
                self.notifications.push_back(message);
            }
            _ => panic!("nobody expected {method}: {message}"),
        }
    }

    /// Ends the session. Fails the test if the server does not end well.
    fn finish(&mut self) {
        let ended = self.ask::<request::Shutdown>(());
        assert_eq!(ended, Ok(()), "shutdown");
        self.wire
            .send(&json!({ "jsonrpc": "2.0", "method": "exit" }));
        let status = self.wire.wait();
        assert!(status.success(), "the server ended with {status}");
    }
}

fn typed<T: serde::de::DeserializeOwned>(params: Value) -> T {
    let found = serde_json::from_value(params.clone());
    found.unwrap_or_else(|error| panic!("{error}: {params}"))
}

impl Drop for Client {
    fn drop(&mut self) {
        if !std::thread::panicking() {
            self.finish();
        }
    }
}
