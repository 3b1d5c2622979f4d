//! A client without manners: it says what a test wants, in any order, and
//! answers nothing by itself.

use std::collections::VecDeque;
use std::path::Path;

use end_to_end::lsp::{Profile, Wire};
use serde_json::{Value, json};
use tower_lsp::ls_types::Uri;

/// A session, message by message.
pub struct Raw {
    pub wire: Wire,
    next_id: i64,
    /// What came while something else was waited for.
    kept: VecDeque<Value>,
}

impl Raw {
    /// A server that has been told nothing yet.
    pub fn start() -> Self {
        Self::on(Wire::start(env!("CARGO_BIN_EXE_gradus")))
    }

    /// A session on this connection.
    pub fn on(wire: Wire) -> Self {
        Self {
            wire,
            next_id: 1,
            kept: VecDeque::new(),
        }
    }

    /// A server that knows its client, which is of this kind.
    pub fn initialized(profile: Profile) -> Self {
        let mut raw = Self::start();
        raw.initialize(profile);
        raw
    }

    /// Begins the session. Returns what the server offers.
    pub fn initialize(&mut self, profile: Profile) -> Value {
        let answer = self.ask(
            "initialize",
            json!({ "processId": null, "rootUri": null, "capabilities": profile.capabilities() }),
        );
        self.notify("initialized", json!({}));
        answer["result"].clone()
    }

    /// A session of a client of this kind that works on these folders.
    pub fn in_folders(profile: Profile, folders: &[&Path]) -> Self {
        Self::in_folders_with(profile, folders, Value::Null)
    }

    /// The same, with settings.
    pub fn in_folders_with(profile: Profile, folders: &[&Path], settings: Value) -> Self {
        let mut raw = Self::start();
        let folders = folders
            .iter()
            .map(|it| json!({ "uri": uri(it), "name": "folder" }));
        let hello = json!({
            "processId": null,
            "capabilities": profile.capabilities(),
            "initializationOptions": settings,
            "workspaceFolders": folders.collect::<Vec<_>>(),
        });
        raw.ask("initialize", hello);
        raw.notify("initialized", json!({}));
        raw
    }

    pub fn notify(&mut self, method: &str, params: Value) {
        let message = json!({ "jsonrpc": "2.0", "method": method, "params": params });
        self.wire.send(&message);
    }

    /// Sends a request with a number of its own, and returns that.
    pub fn begin(&mut self, method: &str, params: Value) -> Value {
        let id = json!(self.next_id);
        self.next_id += 1;
        self.begin_as(&id, method, params);
        id
    }

    /// Sends a request with this number.
    pub fn begin_as(&mut self, id: &Value, method: &str, params: Value) {
        let message = json!({ "jsonrpc": "2.0", "id": id, "method": method, "params": params });
        self.wire.send(&message);
    }

    /// The answer to a request.
    pub fn ask(&mut self, method: &str, params: Value) -> Value {
        let id = self.begin(method, params);
        self.end(&id)
    }

    /// The answer to the request with this number.
    pub fn end(&mut self, id: &Value) -> Value {
        self.wait_for(|message| message.get("method").is_none() && message["id"] == *id)
    }

    /// The code of an answer that says why there is none.
    pub fn refused(&mut self, method: &str, params: Value) -> Value {
        self.ask(method, params)["error"]["code"].clone()
    }

    /// The next message of the server that is called `method`.
    pub fn told(&mut self, method: &str) -> Value {
        self.wait_for(|message| message["method"] == method)
    }

    /// The first message that is wanted, among those that came and those that
    /// come. The others are kept.
    pub fn wait_for(&mut self, wanted: impl Fn(&Value) -> bool) -> Value {
        if let Some(at) = self.kept.iter().position(&wanted) {
            return self.kept.remove(at).expect("a message");
        }
        loop {
            let message = self.wire.receive();
            if wanted(&message) {
                return message;
            }
            self.kept.push_back(message);
        }
    }

    /// Everything that came and that nobody waited for.
    pub fn kept(&self) -> impl Iterator<Item = &Value> {
        self.kept.iter()
    }

    /// Opens a ladder that only the client has.
    pub fn open(&mut self, uri: &str, text: &str) {
        let language = match uri.ends_with(".grafcet") {
            true => "grafcet",
            false => "gradus-ladder",
        };
        self.notify(
            "textDocument/didOpen",
            json!({ "textDocument": {
                "uri": uri, "languageId": language, "version": 1, "text": text,
            }}),
        );
    }

    /// Replaces the whole text of a document.
    pub fn change(&mut self, uri: &str, version: i32, text: &str) {
        self.notify(
            "textDocument/didChange",
            json!({
                "textDocument": { "uri": uri, "version": version },
                "contentChanges": [{ "text": text }],
            }),
        );
    }

    /// What is pushed for this version of a document.
    pub fn pushed(&mut self, uri: &str, version: i32) -> Value {
        self.wait_for(|message| {
            let params = &message["params"];
            message["method"] == "textDocument/publishDiagnostics"
                && params["uri"] == uri
                && params["version"] == version
        })
    }

    /// Whether the server still shows what it knows of a contact.
    #[track_caller]
    pub fn still_answers(&mut self) {
        const URI: &str = "untitled:alive.ladder";
        self.open(URI, "rung: a -> b\n");
        let answer = self.ask("textDocument/hover", hover(URI, 0, 6));
        let text = answer["result"]["contents"]["value"].as_str();
        assert!(text.is_some_and(|text| text.contains('a')), "{answer}");
        self.notify(
            "textDocument/didClose",
            json!({ "textDocument": { "uri": URI } }),
        );
    }

    /// Ends the session as it should end.
    #[track_caller]
    pub fn finish(mut self) {
        let answer = self.ask("shutdown", Value::Null);
        assert_eq!(answer["result"], Value::Null, "{answer}");
        self.notify("exit", Value::Null);
        let status = self.wire.wait();
        assert!(status.success(), "the server ended with {status}");
    }
}

/// The address of a file.
pub fn uri(path: &Path) -> String {
    let uri = Uri::from_file_path(path).expect("an address");
    uri.as_str().to_owned()
}

/// The params of a hover.
pub fn hover(uri: &str, line: u32, character: u32) -> Value {
    json!({
        "textDocument": { "uri": uri },
        "position": { "line": line, "character": character },
    })
}

/// A ladder that keeps the server busy for a while.
pub fn large(rungs: usize) -> String {
    let mut text = String::from("program Large\n\n");
    for number in 0..rungs {
        let before = number.saturating_sub(1);
        text += &format!("rung: (a{number} * c{before} + c{number}) * /b{number} -> c{number}\n");
    }
    text
}
