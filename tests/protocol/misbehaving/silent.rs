//! Clients that leave something undone: they do not answer, or do not read.

use std::io::{BufRead, BufReader};
use std::process::{Command, Stdio};
use std::time::Duration;

use end_to_end::lsp::{Profile, Wire};
use serde_json::{Value, json};

use crate::raw::{Raw, hover, large};

const URI: &str = "untitled:a.ladder";

/// After so long without a message a test takes it that there is no more; if
/// one comes all the same, the test has only seen less.
const QUIET: Duration = Duration::from_secs(3);

fn server() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_gradus"));
    command.arg("lsp").stderr(Stdio::null());
    command
}

#[test]
fn four_hundred_edits_pass_while_the_client_owes_its_answers() {
    for profile in Profile::ALL {
        let mut raw = Raw::initialized(profile);
        raw.open(URI, "rung: a -> b\n");
        let mut asked = Vec::new();
        for number in 0..400 {
            raw.change(URI, number + 2, &format!("rung: a{number} -> b\n"));
            asked.push(raw.begin("textDocument/hover", hover(URI, 0, 6)));
            // Each makes the server ask for the settings once more.
            raw.notify(
                "workspace/didChangeConfiguration",
                json!({ "settings": null }),
            );
        }
        for id in asked {
            let answer = raw.end(&id);
            let code = &answer["error"]["code"];
            // An edit may come before the answer.
            assert!(
                answer.get("result").is_some() || *code == -32801,
                "{answer}"
            );
        }
        let answer = raw.ask("textDocument/hover", hover(URI, 0, 6));
        let text = answer["result"]["contents"]["value"]
            .as_str()
            .expect("a hover");
        assert!(text.contains("a399"), "{text}");
        raw.finish();
    }
}

#[test]
fn a_client_that_owes_an_answer_is_asked_the_next_question_all_the_same() {
    let mut raw = Raw::initialized(Profile::VsCode);
    let settings = raw.told("workspace/configuration");
    let answer = json!({ "jsonrpc": "2.0", "id": settings["id"],
        "result": [{ "codeLens": { "enable": false } }] });
    raw.wire.send(&answer);
    // Nobody answers the first, so the second comes when patience is at its end.
    raw.told("workspace/codeLens/refresh");
    raw.told("workspace/inlayHint/refresh");
    raw.finish();
}

#[test]
fn answers_that_are_errors_or_nonsense_are_taken_as_none() {
    let mut raw = Raw::initialized(Profile::VsCode);
    let settings = raw.told("workspace/configuration");
    let watch = raw.told("client/registerCapability");
    let error = json!({ "code": -32601, "message": "no" });
    raw.wire
        .send(&json!({ "jsonrpc": "2.0", "id": watch["id"], "error": error }));
    raw.wire
        .send(&json!({ "jsonrpc": "2.0", "id": settings["id"], "result": "nonsense" }));
    for result in [
        json!([]),
        json!(null),
        json!([7]),
        json!([{ "maxFileSize": "much" }]),
    ] {
        raw.notify(
            "workspace/didChangeConfiguration",
            json!({ "settings": null }),
        );
        let asked = raw.told("workspace/configuration");
        raw.wire
            .send(&json!({ "jsonrpc": "2.0", "id": asked["id"], "result": result }));
    }
    raw.still_answers();
    raw.finish();
}

#[test]
fn a_client_that_reads_late_gets_everything() {
    let mut raw = Raw::initialized(Profile::Plain);
    let ids: Vec<Value> = (0..3000)
        .map(|number| raw.begin(&format!("gradus/unknown{number}"), json!({})))
        .collect();
    for id in ids {
        assert!(raw.end(&id)["error"].is_object());
    }
    raw.finish();
}

#[test]
fn a_client_that_never_reads_does_not_keep_the_server() {
    let mut raw = Raw::initialized(Profile::Plain);
    for number in 0..3000 {
        raw.begin(&format!("gradus/unknown{number}"), json!({}));
    }
    raw.notify("exit", Value::Null);
    assert_eq!(raw.wire.wait().code(), Some(1));
}

#[test]
fn findings_that_nobody_reads_do_not_pile_up() {
    let mut raw = Raw::on(Wire::run(server().stderr(Stdio::piped())));
    let errors = BufReader::new(raw.wire.errors());
    raw.initialize(Profile::Plain);
    let faulty = "rung: a ->\n".repeat(1000);
    raw.open(URI, &faulty);
    // Each makes all findings be told anew.
    for _ in 0..300 {
        raw.notify(
            "workspace/didChangeConfiguration",
            json!({ "settings": {} }),
        );
    }
    // A line of the log tells that all are taken in, without a message read.
    raw.change("untitled:unknown.ladder", 1, "");
    let told = |line: String| line.contains("unknown.ladder");
    assert!(errors.lines().map_while(Result::ok).any(told));
    let first = raw.pushed(URI, 1).to_string();
    assert!(first.len() > 100_000, "{} bytes", first.len());
    let more = std::iter::from_fn(|| raw.wire.receive_within(QUIET));
    let more = more
        .filter(|it| it["method"] == "textDocument/publishDiagnostics")
        .count();
    // 1 MiB may wait, and the pipe holds something.
    assert!(more < 20, "{more} more were told");
    raw.change(URI, 2, "");
    raw.pushed(URI, 2);
    raw.finish();
}

#[test]
fn a_client_that_does_not_read_standard_error_holds_up_nobody() {
    let mut raw = Raw::on(Wire::run(server().stderr(Stdio::piped())));
    let _unread = raw.wire.errors();
    raw.initialize(Profile::Plain);
    // Each is a line on standard error, and a pipe holds some 64 KiB.
    let name = "x".repeat(1000);
    for version in 0..1000 {
        raw.change(&format!("untitled:{name}.ladder"), version, "");
    }
    raw.still_answers();
    raw.finish();
}

#[test]
fn a_client_that_closes_standard_error_loses_nothing_else() {
    let mut raw = Raw::on(Wire::run(server().stderr(Stdio::piped())));
    drop(raw.wire.errors());
    raw.initialize(Profile::Plain);
    raw.change("untitled:unknown.ladder", 1, "");
    raw.still_answers();
    raw.finish();
}

#[test]
fn a_large_document_does_not_hold_up_a_small_one() {
    const LARGE: &str = "untitled:large.ladder";
    let mut raw = Raw::initialized(Profile::Plain);
    raw.open(LARGE, &large(20_000));
    let asked: Vec<Value> = (0..100)
        .map(|_| raw.begin("textDocument/hover", hover(LARGE, 2, 8)))
        .collect();
    raw.still_answers();
    let of_large = raw
        .kept()
        .filter(|it| it["params"]["uri"] == LARGE || asked.contains(&it["id"]));
    assert_eq!(of_large.count(), 0, "the small one waited");
    raw.finish();
}
