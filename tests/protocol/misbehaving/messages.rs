use end_to_end::lsp::Profile;
use serde_json::{Value, json};

use super::code;
use crate::raw::{Raw, hover};

#[test]
fn a_request_that_nobody_knows_is_not_found() {
    let mut raw = Raw::initialized(Profile::VsCode);
    for method in ["gradus/nonsense", "textDocument/Hover", "a b", "$/unknown"] {
        let refused = raw.refused(method, json!({}));
        assert_eq!(refused, code::METHOD_NOT_FOUND, "{method}");
    }
    raw.still_answers();
    raw.finish();
}

#[test]
fn a_notification_that_nobody_knows_is_passed_over() {
    let mut raw = Raw::initialized(Profile::Plain);
    for method in ["gradus/nonsense", "$/nonsense", "workspace/nonsense", ""] {
        raw.notify(method, json!({}));
    }
    raw.still_answers();
    // The one without a name is no message.
    let errors = raw.kept().filter(|it| it["error"].is_object()).count();
    assert_eq!(errors, 1);
    raw.finish();
}

#[test]
fn wrong_params_of_a_request_are_invalid() {
    let mut raw = Raw::initialized(Profile::VsCode);
    for params in [
        Value::Null,
        json!({}),
        json!([]),
        json!({ "textDocument": { "uri": "file:///a.ladder" } }),
        json!({ "textDocument": {}, "position": { "line": 0, "character": 0 } }),
        hover("no address at all", 0, 0),
        json!({ "textDocument": { "uri": "file:///a" }, "position": { "line": -1, "character": 0 } }),
        json!({ "textDocument": { "uri": "file:///a" }, "position": { "line": "x", "character": 0 } }),
    ] {
        let refused = raw.refused("textDocument/hover", params.clone());
        assert_eq!(refused, code::INVALID_PARAMS, "{params}");
    }
    for method in ["textDocument/diagnostic", "workspace/textDocumentContent"] {
        let refused = raw.refused(method, json!({ "textDocument": 3 }));
        assert_eq!(refused, code::INVALID_PARAMS, "{method}");
    }
    raw.still_answers();
    raw.finish();
}

#[test]
fn wrong_params_of_a_notification_are_passed_over() {
    let mut raw = Raw::initialized(Profile::Plain);
    for method in [
        "textDocument/didOpen",
        "textDocument/didChange",
        "textDocument/didClose",
        "textDocument/didSave",
        "workspace/didChangeConfiguration",
        "workspace/didChangeWatchedFiles",
        "workspace/didChangeWorkspaceFolders",
        "window/workDoneProgress/cancel",
        "$/cancelRequest",
    ] {
        for params in [
            Value::Null,
            json!({}),
            json!([1]),
            json!({ "textDocument": [] }),
        ] {
            raw.notify(method, params);
        }
    }
    raw.still_answers();
    raw.finish();
}

#[test]
fn a_position_that_is_nowhere_gets_an_answer() {
    let mut raw = Raw::initialized(Profile::Plain);
    raw.open("untitled:a.ladder", "rung: a -> b\n");
    for (line, character) in [(9, 0), (0, 9999), (u32::MAX >> 1, u32::MAX >> 1)] {
        let answer = raw.ask(
            "textDocument/hover",
            hover("untitled:a.ladder", line, character),
        );
        assert!(answer.get("error").is_none(), "{answer}");
    }
    raw.finish();
}

#[test]
fn of_a_document_that_is_nowhere_nothing_is_known() {
    let mut raw = Raw::initialized(Profile::Plain);
    for uri in [
        "file:///nowhere/a.ladder",
        "untitled:b",
        "gradus-ladder:/x?y",
    ] {
        let answer = raw.ask("textDocument/hover", hover(uri, 0, 0));
        assert_eq!(answer.get("result"), Some(&Value::Null), "{answer}");
    }
    raw.finish();
}

#[test]
fn before_initialize_every_request_is_refused() {
    let mut raw = Raw::start();
    for method in [
        "textDocument/hover",
        "shutdown",
        "workspace/textDocumentContent",
    ] {
        let refused = raw.refused(method, hover("untitled:a.ladder", 0, 0));
        assert_eq!(refused, code::SERVER_NOT_INITIALIZED, "{method}");
    }
    raw.initialize(Profile::Plain);
    raw.still_answers();
    raw.finish();
}

#[test]
fn before_initialize_every_notification_is_passed_over() {
    let mut raw = Raw::start();
    raw.open("untitled:a.ladder", "rung: a -> b\n");
    raw.notify("initialized", json!({}));
    raw.initialize(Profile::Plain);
    let answer = raw.ask("textDocument/hover", hover("untitled:a.ladder", 0, 6));
    assert_eq!(answer["result"], Value::Null);
    raw.finish();
}

#[test]
fn initialize_is_answered_once() {
    let mut raw = Raw::initialized(Profile::Neovim);
    let again = json!({ "processId": null, "rootUri": null, "capabilities": {} });
    assert_eq!(raw.refused("initialize", again), code::INVALID_REQUEST);
    // What the first said still counts: columns are bytes.
    raw.open(
        "untitled:a.ladder",
        "rung \"\u{1f6d1}\u{1f6d1}\": abc -> b\n",
    );
    let answer = raw.ask("textDocument/hover", hover("untitled:a.ladder", 0, 18));
    assert_eq!(
        answer["result"]["range"]["start"]["character"], 17,
        "{answer}"
    );
    raw.finish();
}

#[test]
fn initialize_with_wrong_params_may_be_tried_again() {
    let mut raw = Raw::start();
    for params in [
        Value::Null,
        json!({ "capabilities": 7 }),
        json!({ "processId": -1 }),
    ] {
        let refused = raw.refused("initialize", params);
        assert_eq!(refused, code::INVALID_PARAMS);
    }
    raw.initialize(Profile::Plain);
    raw.still_answers();
    raw.finish();
}

#[test]
fn after_shutdown_every_request_is_refused() {
    let mut raw = Raw::initialized(Profile::VsCode);
    raw.ask("shutdown", Value::Null);
    for method in ["textDocument/hover", "shutdown", "initialize"] {
        let refused = raw.refused(method, hover("untitled:a.ladder", 0, 0));
        assert_eq!(refused, code::INVALID_REQUEST, "{method}");
    }
    raw.open("untitled:a.ladder", "rung: a -> b\n");
    raw.notify("exit", Value::Null);
    assert!(raw.wire.wait().success());
}

#[test]
fn an_answer_that_nobody_waits_for_is_passed_over() {
    let mut raw = Raw::initialized(Profile::Plain);
    for answer in [
        json!({ "jsonrpc": "2.0", "id": 77, "result": null }),
        json!({ "jsonrpc": "2.0", "id": "x", "result": [1, 2] }),
        json!({ "jsonrpc": "2.0", "id": null, "error": { "code": -32700, "message": "no" } }),
    ] {
        raw.wire.send(&answer);
    }
    raw.still_answers();
    assert_eq!(raw.kept().filter(|it| it["error"].is_object()).count(), 0);
    raw.finish();
}

#[test]
fn a_number_of_a_request_that_is_under_way_is_no_number_of_another() {
    let mut raw = Raw::initialized(Profile::Plain);
    let (id, uri) = (json!("twice"), "untitled:large.ladder");
    raw.open(uri, &crate::raw::large(3000));
    raw.begin_as(&id, "textDocument/hover", hover(uri, 2, 8));
    raw.begin_as(&id, "textDocument/hover", hover(uri, 2, 8));
    // Each is answered, whichever comes first.
    let answers = [raw.end(&id), raw.end(&id)];
    let refused = answers.iter().filter(|it| it["error"].is_object());
    assert!(refused.count() <= 1, "{answers:?}");
    raw.still_answers();
    raw.finish();
}
