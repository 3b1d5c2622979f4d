//! Documents as the client has them: edited in pieces, unsaved, beside each
//! other, and changed on disk behind its back.

use std::cell::RefCell;
use std::fs;
use std::ops::Range;

use end_to_end::lsp::{Client, Profile};
use proptest::prelude::*;
use proptest::sample::{Index, select};
use proptest::test_runner::{Config, TestCaseError, TestRunner};
use serde_json::{Value, json};
use tower_lsp::ls_types::notification::DidChangeWatchedFiles;
use tower_lsp::ls_types::request::Request;
use tower_lsp::ls_types::{
    Diagnostic, DidChangeWatchedFilesParams, FileChangeType, FileEvent, Position,
    TextDocumentContentChangeEvent,
};

use crate::raw::{Raw, hover, large};
use crate::{client, client_like, hover_at};

const TANK: &str = "\
program Tank
input  s   // Start
input  ls2 // Level \u{1f6d1}
output v1  // Fill
rung \"\u{e4}\u{1f6d1} fill\": (s + v1) * /ls2 -> v1
rung: (ls2 + \"v\u{2028}2\") * s -> \"v\u{2028}2\"
";

/// A spec that wants a state `v1` of its ladder.
const SPEC: &str = "\
Grafcet Tank
Step Xv1 for v1
Marking Xv1
";

/// `workspace/textDocumentContent`.
enum Content {}

impl Request for Content {
    type Params = Value;
    type Result = Value;
    const METHOD: &'static str = "workspace/textDocumentContent";
}

/// The conditions of a ladder, as the client would show them.
fn conditions(client: &mut Client, name: &str) -> String {
    let uri = client.uri(name);
    // Everything but letters and digits, so that any server can take it apart.
    let of: String = uri
        .as_str()
        .bytes()
        .map(|byte| format!("%{byte:02X}"))
        .collect();
    let address = format!("gradus-conditions:/{name}.txt?{of}");
    let answer = client.request::<Content>(json!({ "uri": address }));
    answer["text"].as_str().expect("a text").to_owned()
}

/// What is shown at a place: the text but for the document's address, and where
/// the thing begins and ends.
fn shown(client: &mut Client, name: &str, at: Position) -> Option<(String, Value)> {
    let (markup, range) = hover_at(client, name, at)?;
    let text = markup.value.replace(client.uri(name).as_str(), "");
    Some((text, json!(range)))
}

/// Everything that the server says about a document, but for its address.
fn everything(client: &mut Client, name: &str) -> (Value, String, Vec<Option<(String, Value)>>) {
    let findings = json!(client.diagnostics(name)).to_string();
    let uri = client.uri(name);
    let findings = findings.replace(uri.as_str(), "");
    let lines = client.text(name).split(['\n', '\r']).count();
    let mut hovers = Vec::new();
    for line in 0..u32::try_from(lines).expect("few lines") {
        for column in [0, 6, 9, 14, 30] {
            hovers.push(shown(client, name, Position::new(line, column)));
        }
    }
    (json!(findings), conditions(client, name), hovers)
}

/// One edit: where it begins, how long it is, and what is there afterwards.
type Edit = (Index, Index, &'static str);

const PIECES: [&str; 22] = [
    "",
    "\r\n",
    "\r",
    "\n",
    "\n\r",
    "\u{2028}",
    "\u{85}",
    "\u{feff}",
    "\u{1f6d1}",
    "\u{e4}",
    "e\u{301}",
    "\"",
    "/",
    "(",
    ")",
    " * ",
    " -> ",
    "//",
    "v1",
    "rung: a -> b\n",
    "rung \"x\":\r\n  s * (a\r\n  + b) -> \"\u{1f6d1}\"\r\n",
    "$1",
];

fn edits() -> impl Strategy<Value = Vec<Edit>> {
    let edit = (any::<Index>(), any::<Index>(), select(&PIECES[..]));
    proptest::collection::vec(edit, 1..8)
}

fn texts() -> impl Strategy<Value = String> {
    let dos = TANK.replace('\n', "\r\n");
    let mac = TANK.replace('\n', "\r");
    let marked = format!("\u{feff}{dos}");
    let all = [
        String::new(),
        TANK.to_owned(),
        dos,
        mac,
        marked,
        "\u{1f6d1}".to_owned(),
    ];
    select(all.to_vec())
}

/// The bytes of `text` between two places where a caret can stand, not far from
/// each other, or soon nothing would be left to edit.
fn bytes(text: &str, from: &Index, length: &Index) -> Range<usize> {
    let between = |at: usize| text[..at].ends_with('\r') && text[at..].starts_with('\n');
    let carets = (0..=text.len()).filter(|&at| text.is_char_boundary(at) && !between(at));
    let carets: Vec<usize> = carets.collect();
    let from = from.index(carets.len());
    let to = (from + length.index(12)).min(carets.len() - 1);
    carets[from]..carets[to]
}

/// Any sequence of edits leaves what opening the final text leaves.
fn edits_are_as_opening(profile: Profile) {
    let client = RefCell::new(client_like(profile));
    let mut runner = TestRunner::new(Config {
        cases: 48,
        failure_persistence: None,
        ..Config::default()
    });
    let checked = runner.run(&(texts(), edits()), |(text, edits)| {
        let client = &mut *client.borrow_mut();
        client.open_plain("edited.ladder", &text);
        let count = edits.len();
        for (at, (from, length, piece)) in edits.into_iter().enumerate() {
            let bytes = bytes(client.text("edited.ladder"), &from, &length);
            client.edit("edited.ladder", bytes, piece);
            // What is known in between must not change what is said in the end.
            if at + 1 < count && (piece.is_empty() || piece == "v1") {
                everything(client, "edited.ladder");
            }
        }
        let last = client.text("edited.ladder").to_owned();
        client.open_plain("opened.ladder", &last);
        let edited = everything(client, "edited.ladder");
        let opened = everything(client, "opened.ladder");
        client.close("edited.ladder");
        client.close("opened.ladder");
        match edited == opened {
            true => Ok(()),
            false => Err(TestCaseError::fail(format!(
                "{last:?}\n{edited:?}\n{opened:?}"
            ))),
        }
    });
    if let Err(failure) = checked {
        panic!("{profile:?}: {failure}");
    }
}

#[test]
fn any_edits_leave_what_opening_the_final_text_leaves_in_bytes() {
    edits_are_as_opening(Profile::Helix);
}

#[test]
fn any_edits_leave_what_opening_the_final_text_leaves_in_utf_16() {
    edits_are_as_opening(Profile::VsCode);
}

#[test]
fn any_edits_leave_what_opening_the_final_text_leaves_when_findings_are_pushed() {
    edits_are_as_opening(Profile::Eglot);
}

/// The codes of what is found.
fn codes(found: &[Diagnostic]) -> Vec<String> {
    let code = |it: &Diagnostic| serde_json::to_value(&it.code).expect("a code");
    let text = |code: Value| code.as_str().expect("a text").to_owned();
    found.iter().map(|it| text(code(it))).collect()
}

fn whole(text: &str) -> TextDocumentContentChangeEvent {
    TextDocumentContentChangeEvent {
        range: None,
        range_length: None,
        text: text.to_owned(),
    }
}

#[test]
fn a_text_made_from_a_document_that_changes_meanwhile_is_none() {
    let mut raw = Raw::initialized(Profile::VsCode);
    raw.open("untitled:a.ladder", &large(16_000));
    let address = "gradus-conditions:/a.txt?untitled%3Aa%2Eladder";
    let asked = raw.begin(Content::METHOD, json!({ "uri": address }));
    raw.change("untitled:a.ladder", 2, ONCE);
    assert_eq!(raw.end(&asked)["error"]["code"], -32801);
    let answer = raw.ask(Content::METHOD, json!({ "uri": address }));
    let text = answer["result"]["text"].as_str().expect("a text");
    assert!(text.contains('b') && !text.contains("c0"), "{text}");
    raw.finish();
}

const TWICE: &str = "input a\nrung: a -> b\nrung: a -> b\n";
const ONCE: &str = "input a\nrung: a -> b\n";

#[test]
fn versions_are_the_clients_own_whatever_they_count() {
    let mut raw = Raw::initialized(Profile::Plain);
    let uri = "untitled:a.ladder";
    raw.open(uri, ONCE);
    for (version, text) in [(7, TWICE), (7, ONCE), (3, TWICE), (-5, ONCE), (0, TWICE)] {
        raw.change(uri, version, text);
        let found = raw.wait_for(|it| {
            let wanted = it["params"]["diagnostics"]
                .as_array()
                .map(|it| !it.is_empty());
            it["params"]["version"] == version && wanted == Some(text == TWICE)
        });
        assert_eq!(found["params"]["uri"], uri);
    }
    raw.finish();
}

#[test]
fn changes_of_a_document_that_is_not_open_are_passed_over() {
    let mut client = client();
    client.write("a.ladder", ONCE);
    client.change("a.ladder", 2, vec![whole(TWICE)]);
    // As it lies on disk.
    let before = conditions(&mut client, "a.ladder");
    client.open("a.ladder", ONCE);
    assert_eq!(conditions(&mut client, "a.ladder"), before);
    assert_eq!(client.diagnostics("a.ladder"), []);
    client.close("a.ladder");
    client.change("a.ladder", 3, vec![whole(TWICE)]);
    assert_eq!(conditions(&mut client, "a.ladder"), before);
}

#[test]
fn of_a_document_that_is_opened_twice_the_second_text_counts() {
    let mut client = client();
    client.open("a.ladder", ONCE);
    client.open("a.ladder", TWICE);
    assert_eq!(codes(&client.diagnostics("a.ladder")), ["G2002"]);
    client.close("a.ladder");
    client.close("a.ladder");
    client.open("a.ladder", ONCE);
    assert_eq!(client.diagnostics("a.ladder"), []);
}

#[test]
fn a_closed_document_is_what_lies_on_disk() {
    let mut client = client();
    client.write("a.ladder", "input x\nrung: x -> y\n");
    client.open("a.ladder", ONCE);
    assert!(conditions(&mut client, "a.ladder").contains('b'));
    client.close("a.ladder");
    assert!(conditions(&mut client, "a.ladder").contains('y'));
    fs::remove_file(client.path("a.ladder")).expect("a file removed");
    assert_eq!(shown(&mut client, "a.ladder", Position::new(1, 6)), None);
    client.open("a.ladder", TWICE);
    assert_eq!(codes(&client.diagnostics("a.ladder")), ["G2002"]);
}

#[test]
fn the_findings_of_a_closed_document_are_taken_back() {
    let mut raw = Raw::initialized(Profile::Plain);
    let uri = "untitled:a.ladder";
    raw.open(uri, TWICE);
    assert_ne!(raw.pushed(uri, 1)["params"]["diagnostics"], json!([]));
    raw.notify(
        "textDocument/didClose",
        json!({ "textDocument": { "uri": uri } }),
    );
    let last = raw.told("textDocument/publishDiagnostics");
    assert_eq!(last["params"]["diagnostics"], json!([]));
    raw.open(uri, TWICE);
    assert_ne!(raw.pushed(uri, 1)["params"]["diagnostics"], json!([]));
    raw.finish();
}

#[test]
fn a_document_without_a_file_is_like_any_other() {
    let mut raw = Raw::initialized(Profile::Plain);
    for uri in [
        "untitled:Untitled-1",
        "inmemory://model/1",
        "vscode-vfs://github/a/b.ladder",
    ] {
        raw.open(uri, TWICE);
        let found = raw.pushed(uri, 1)["params"]["diagnostics"].clone();
        assert_eq!(found[0]["code"], "G2002", "{uri}: {found}");
        let answer = raw.ask("textDocument/hover", hover(uri, 1, 6));
        assert!(answer["result"].is_object(), "{uri}: {answer}");
    }
    raw.finish();
}

/// One spelling of a file opens, another changes and closes it.
#[test]
fn a_file_is_the_same_however_its_address_is_spelled() {
    let mut raw = Raw::initialized(Profile::Plain);
    raw.open("file:///tmp/gradus%20x/a.ladder", ONCE);
    raw.change("file:///tmp/gradus%20x/./y/../%61.ladder", 2, TWICE);
    let found = raw.pushed("file:///tmp/gradus%20x/a.ladder", 2);
    assert_eq!(found["params"]["diagnostics"][0]["code"], "G2002");
    raw.finish();
}

const WITH_STATE: &str = "input s\ninput e\nrung: (s + v1) * /e -> v1\n";

fn changed_on_disk(client: &mut Client, name: &str, kind: FileChangeType) {
    let uri = client.uri(name);
    client.notify::<DidChangeWatchedFiles>(DidChangeWatchedFilesParams {
        changes: vec![FileEvent { uri, typ: kind }],
    });
}

/// The codes of a spec's findings that tell of its ladder.
fn about_ladder(client: &mut Client) -> Vec<String> {
    let found = client.diagnostics("tank.grafcet");
    let all = codes(&found).into_iter();
    all.filter(|code| code == "G3102").collect()
}

#[test]
fn a_spec_is_checked_against_the_unsaved_ladder() {
    for profile in Profile::ALL {
        let mut client = client_like(profile);
        client.write("tank.ladder", WITH_STATE);
        client.open("tank.grafcet", SPEC);
        assert_eq!(about_ladder(&mut client), [""; 0], "{profile:?}");
        client.open("tank.ladder", WITH_STATE);
        client.replace_all("tank.ladder", ONCE);
        wait_until(&mut client, &["G3102"]);
        client.replace_all("tank.ladder", WITH_STATE);
        wait_until(&mut client, &[]);
        client.replace_all("tank.ladder", ONCE);
        wait_until(&mut client, &["G3102"]);
        // What was not saved is gone.
        client.close("tank.ladder");
        wait_until(&mut client, &[]);
    }
}

/// Waits until the findings of the spec are these: pushed ones may come for
/// each change, pulled ones are those of now.
#[track_caller]
fn wait_until(client: &mut Client, wanted: &[&str]) {
    let pulls = client.server.capabilities.diagnostic_provider.is_some();
    loop {
        let found = about_ladder(client);
        if found == wanted {
            return;
        }
        assert!(!pulls, "{found:?} instead of {wanted:?}");
    }
}

#[test]
fn a_spec_is_checked_against_the_ladder_that_changed_behind_the_editors_back() {
    for profile in Profile::ALL {
        let mut client = client_like(profile);
        client.open("tank.grafcet", SPEC);
        assert_eq!(about_ladder(&mut client), [""; 0], "{profile:?}");
        client.write("tank.ladder", ONCE);
        changed_on_disk(&mut client, "tank.ladder", FileChangeType::CREATED);
        wait_until(&mut client, &["G3102"]);
        client.write("tank.ladder", WITH_STATE);
        changed_on_disk(&mut client, "tank.ladder", FileChangeType::CHANGED);
        wait_until(&mut client, &[]);
        client.write("tank.ladder", ONCE);
        changed_on_disk(&mut client, "tank.ladder", FileChangeType::CHANGED);
        wait_until(&mut client, &["G3102"]);
        fs::remove_file(client.path("tank.ladder")).expect("a file removed");
        changed_on_disk(&mut client, "tank.ladder", FileChangeType::DELETED);
        wait_until(&mut client, &[]);
    }
}

#[test]
fn who_pulls_findings_is_told_that_a_file_beside_has_changed() {
    let folder = tempfile::tempdir().expect("a folder");
    let uri = |name: &str| format!("file://{}/{name}", folder.path().display());
    let mut raw = Raw::initialized(Profile::VsCode);
    raw.open(&uri("tank.grafcet"), SPEC);
    raw.still_answers();
    fs::write(folder.path().join("tank.ladder"), ONCE).expect("a file written");
    let change = json!({ "uri": uri("tank.ladder"), "type": 1 });
    raw.notify(
        "workspace/didChangeWatchedFiles",
        json!({ "changes": [change] }),
    );
    for method in ["codeLens", "inlayHint", "semanticTokens", "diagnostic"] {
        let asked = raw.told(&format!("workspace/{method}/refresh"));
        raw.wire
            .send(&json!({ "jsonrpc": "2.0", "id": asked["id"], "result": null }));
    }
    raw.finish();
}

#[test]
fn while_a_ladder_is_open_its_file_does_not_count() {
    let mut client = client_like(Profile::Eglot);
    client.write("tank.ladder", WITH_STATE);
    client.open("tank.ladder", ONCE);
    client.open("tank.grafcet", SPEC);
    wait_until(&mut client, &["G3102"]);
    client.write("tank.ladder", &format!("{WITH_STATE}\n"));
    changed_on_disk(&mut client, "tank.ladder", FileChangeType::CHANGED);
    wait_until(&mut client, &["G3102"]);
}

#[test]
fn a_file_that_is_none_of_ours_changes_nothing() {
    let mut client = client();
    client.write("tank.png", "\u{89}PNG");
    fs::write(client.path("tank.L5X"), [0xff, 0xfe, 0, 0xd8]).expect("a file written");
    fs::create_dir(client.path("tank.xml")).expect("a folder");
    client.open("tank.grafcet", SPEC);
    assert_eq!(about_ladder(&mut client), [""; 0]);
    changed_on_disk(&mut client, "tank.png", FileChangeType::CHANGED);
    changed_on_disk(&mut client, "tank.xml", FileChangeType::DELETED);
    assert_eq!(about_ladder(&mut client), [""; 0]);
}
