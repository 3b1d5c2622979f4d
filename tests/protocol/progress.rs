//! Progress of work that takes long.

use std::path::Path;

use end_to_end::lsp::Profile;
use serde_json::{Value, json};

use crate::raw::{Raw, large};

const URI: &str = "untitled:large.ladder";

/// Rungs of a ladder that may be done soon, where its end is waited for.
const SHORT: usize = 500;

/// Rungs of a ladder that is under way for a while.
const LONG: usize = 16_000;

/// Opens ladders, the first of so many rungs, the next twice as large, until one takes so long that
/// the server wants to show it. Returns the token that it wants to use, and the
/// question to answer.
fn slow(raw: &mut Raw, pulls: bool, mut rungs: usize) -> (Value, Value) {
    loop {
        raw.open(URI, &large(rungs));
        if pulls {
            raw.begin(
                "textDocument/diagnostic",
                json!({ "textDocument": { "uri": URI } }),
            );
        }
        let next = raw.wait_for(|it| is_create(it) || are_findings(it));
        if is_create(&next) {
            return (next["params"]["token"].clone(), next["id"].clone());
        }
        assert!(rungs < 2_000_000, "even {rungs} rungs take no time");
        rungs *= 2;
    }
}

fn is_create(message: &Value) -> bool {
    message["method"] == "window/workDoneProgress/create"
}

fn are_findings(message: &Value) -> bool {
    message["method"] == "textDocument/publishDiagnostics"
        || message["result"]["kind"] == "full"
        || message["error"].is_object()
}

/// Answers the server's question.
fn agree(raw: &mut Raw, id: &Value) {
    raw.wire
        .send(&json!({ "jsonrpc": "2.0", "id": id, "result": null }));
}

/// The next message about a progress.
fn shown(raw: &mut Raw, token: &Value) -> Value {
    let message =
        raw.wait_for(|it| it["method"] == "$/progress" && it["params"]["token"] == *token);
    message["params"]["value"].clone()
}

/// Makes the document a small one, and waits until that is known.
fn make_small(raw: &mut Raw, pulls: bool) {
    raw.change(URI, 2, "rung: a -> b\n");
    if pulls {
        raw.ask(
            "textDocument/diagnostic",
            json!({ "textDocument": { "uri": URI } }),
        );
    } else {
        raw.pushed(URI, 2);
    }
}

#[test]
fn long_work_is_shown_from_its_begin_to_its_end() {
    for (profile, pulls) in [(Profile::Eglot, false), (Profile::VsCode, true)] {
        let mut raw = Raw::initialized(profile);
        let (token, id) = slow(&mut raw, pulls, SHORT);
        agree(&mut raw, &id);
        // What ends at once, when the client has agreed late, is not shown.
        let next = raw.wait_for(|it| it["method"] == "$/progress" || are_findings(it));
        if next["method"] == "$/progress" {
            let begin = &next["params"]["value"];
            assert_eq!(begin["kind"], "begin");
            assert_eq!(begin["title"], "Analysing large.ladder");
            assert_eq!(begin["cancellable"], true);
            assert_eq!(shown(&mut raw, &token)["kind"], "end");
        }
        make_small(&mut raw, pulls);
        raw.finish();
    }
}

#[test]
fn long_work_ends_when_the_user_cancels_it() {
    for (profile, pulls) in [(Profile::Eglot, false), (Profile::VsCode, true)] {
        let mut raw = Raw::initialized(profile);
        let (token, id) = slow(&mut raw, pulls, LONG);
        agree(&mut raw, &id);
        raw.notify("window/workDoneProgress/cancel", json!({ "token": token }));
        let next = raw.wait_for(|it| it["method"] == "$/progress" || are_findings(it));
        if next["method"] == "$/progress" {
            assert_eq!(next["params"]["value"]["kind"], "begin");
            raw.notify("window/workDoneProgress/cancel", json!({ "token": token }));
            assert_eq!(shown(&mut raw, &token)["kind"], "end");
        }
        raw.notify("window/workDoneProgress/cancel", json!({ "token": token }));
        make_small(&mut raw, pulls);
        raw.still_answers();
        raw.finish();
    }
}

/// Writes ladders into a folder, the next twice as large as the one before,
/// until looking for names in it takes so long that the server wants to show
/// it. Returns the number of the search, the token and the question to answer.
fn slow_search(raw: &mut Raw, folder: &Path, mut rungs: usize) -> (Value, Value, Value) {
    loop {
        let file = folder.join(format!("{rungs}.ladder"));
        std::fs::write(file, large(rungs)).expect("a file");
        let id = raw.begin("workspace/symbol", json!({ "query": "c77" }));
        let next = raw.wait_for(|it| is_create(it) || it["id"] == id);
        if is_create(&next) {
            return (id, next["params"]["token"].clone(), next["id"].clone());
        }
        assert!(rungs < 2_000_000, "even {rungs} rungs take no time");
        rungs *= 2;
    }
}

#[test]
fn a_long_search_is_shown_from_its_begin_to_its_end() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut raw = Raw::in_folders(Profile::VsCode, &[folder.path()]);
    let (search, token, id) = slow_search(&mut raw, folder.path(), LONG);
    agree(&mut raw, &id);
    // What ends at once, when the client has agreed late, is not shown.
    let next = raw.wait_for(|it| it["method"] == "$/progress" || it["id"] == search);
    let answer = if next["method"] == "$/progress" {
        let begin = &next["params"]["value"];
        assert_eq!(begin["kind"], "begin");
        assert_eq!(begin["title"], "Reading the names in all files");
        assert_eq!(begin["cancellable"], true);
        assert_eq!(shown(&mut raw, &token)["kind"], "end");
        raw.end(&search)
    } else {
        next
    };
    let first = &answer["result"][0];
    assert_eq!(first["name"], "c77", "{answer}");
    raw.finish();
}

#[test]
fn a_long_search_ends_when_the_user_cancels_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut raw = Raw::in_folders(Profile::VsCode, &[folder.path()]);
    let (search, token, id) = slow_search(&mut raw, folder.path(), LONG);
    agree(&mut raw, &id);
    let next = raw.wait_for(|it| it["method"] == "$/progress" || it["id"] == search);
    if next["method"] == "$/progress" {
        raw.notify("window/workDoneProgress/cancel", json!({ "token": token }));
        assert_eq!(shown(&mut raw, &token)["kind"], "end");
        // Nothing, unless all had been read by then.
        let answer = raw.end(&search);
        let first = &answer["result"][0]["name"];
        assert!(answer["result"].is_null() || first == "c77", "{answer}");
    }
    let answer = raw.ask("workspace/symbol", json!({ "query": "c77" }));
    assert_eq!(
        answer["result"][0]["name"], "c77",
        "the next search answers"
    );
    raw.finish();
}

#[test]
fn an_edit_ends_the_progress_of_what_was_before() {
    let mut raw = Raw::initialized(Profile::Eglot);
    let (token, id) = slow(&mut raw, false, LONG);
    agree(&mut raw, &id);
    make_small(&mut raw, false);
    let of_token = |it: &Value| it["params"]["token"] == token;
    let has_begun = raw
        .kept()
        .any(|it| it["method"] == "$/progress" && of_token(it));
    if has_begun {
        assert_eq!(shown(&mut raw, &token)["kind"], "begin");
        assert_eq!(shown(&mut raw, &token)["kind"], "end");
    }
    raw.finish();
}

#[test]
fn a_client_that_refuses_or_does_not_answer_is_shown_nothing() {
    for refuses in [true, false] {
        let mut raw = Raw::initialized(Profile::Eglot);
        let (_, id) = slow(&mut raw, false, SHORT);
        if refuses {
            let error = json!({ "code": -32603, "message": "no" });
            raw.wire
                .send(&json!({ "jsonrpc": "2.0", "id": id, "error": error }));
        }
        raw.told("textDocument/publishDiagnostics");
        assert_eq!(
            raw.kept().filter(|it| it["method"] == "$/progress").count(),
            0
        );
        raw.finish();
    }
}

#[test]
fn a_client_without_progress_is_asked_nothing() {
    let mut raw = Raw::initialized(Profile::Plain);
    raw.open(URI, &large(5000));
    raw.told("textDocument/publishDiagnostics");
    assert_eq!(raw.kept().filter(|it| is_create(it)).count(), 0);
    raw.finish();
}

#[test]
fn a_cancel_of_no_progress_means_nothing() {
    let mut raw = Raw::initialized(Profile::VsCode);
    for token in [json!("gradus/0"), json!(7), json!("x")] {
        raw.notify("window/workDoneProgress/cancel", json!({ "token": token }));
    }
    raw.still_answers();
    raw.finish();
}
