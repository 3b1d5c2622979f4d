//! Clients that leave something undone: they do not answer, or do not read.

use std::process::{Command, Stdio};

use end_to_end::lsp::{Profile, Wire};
use serde_json::{Value, json};

use crate::raw::{Raw, hover, large};

const URI: &str = "untitled:a.ladder";

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
    let mut raw = Raw::on(Wire::unread(&mut server()));
    let hello = json!({ "processId": null, "rootUri": null, "capabilities": {} });
    let first = raw.begin("initialize", hello.clone());
    // Only who has been answered may go on.
    raw.wire.listen();
    raw.end(&first);
    raw.finish();

    let mut raw = Raw::on(Wire::unread(&mut server()));
    let first = raw.begin("initialize", hello);
    raw.notify("initialized", json!({}));
    let ids: Vec<Value> = (0..3000)
        .map(|number| raw.begin(&format!("gradus/unknown{number}"), json!({})))
        .collect();
    raw.wire.listen();
    assert!(raw.end(&first)["result"].is_object());
    for id in ids {
        assert!(raw.end(&id)["error"].is_object());
    }
    raw.finish();
}

#[test]
fn a_client_that_never_reads_does_not_keep_the_server() {
    let mut wire = Wire::unread(&mut server());
    let hello = json!({ "processId": null, "rootUri": null, "capabilities": {} });
    wire.send(&json!({ "jsonrpc": "2.0", "id": 0, "method": "initialize", "params": hello }));
    for id in 1..3000 {
        wire.send(&json!({ "jsonrpc": "2.0", "id": id, "method": "gradus/unknown" }));
    }
    wire.send(&json!({ "jsonrpc": "2.0", "method": "exit" }));
    assert_eq!(wire.wait().code(), Some(1));
}

#[test]
fn findings_that_nobody_read_are_told_once_as_they_are_now() {
    let faulty = |count: usize| "rung: a -> a\nrung: a ->\n".repeat(count);
    let mut raw = Raw::on(Wire::unread(&mut server()));
    let hello = json!({ "processId": null, "rootUri": null, "capabilities": {} });
    let first = raw.begin("initialize", hello);
    // The server has answered when it reads no message of before; whether it has
    // cannot be seen without reading, so it is told again until it is.
    raw.wire.listen();
    raw.end(&first);
    raw.notify("initialized", json!({}));
    raw.open(URI, &faulty(1));
    for version in 2..=300 {
        raw.change(
            URI,
            version,
            &faulty(usize::try_from(version % 7).expect("small") + 1),
        );
    }
    let last = raw.pushed(URI, 300);
    let again = raw
        .kept()
        .filter(|it| it["params"]["version"] == 300)
        .count();
    assert_eq!(again, 0);
    let found = last["params"]["diagnostics"].as_array().expect("findings");
    assert!(!found.is_empty());
    let newer = raw.kept().filter_map(|it| it["params"]["version"].as_i64());
    let newer: Vec<i64> = newer.collect();
    assert!(newer.is_sorted(), "{newer:?}");
    raw.finish();
}

#[test]
fn a_client_that_does_not_read_standard_error_holds_up_nobody() {
    let mut raw = Raw::on(Wire::unread(server().stderr(Stdio::piped())));
    raw.wire.listen();
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
fn a_large_document_does_not_hold_up_a_small_one() {
    let mut raw = Raw::initialized(Profile::Plain);
    raw.open("untitled:large.ladder", &large(20_000));
    raw.still_answers();
    let pushed = raw
        .kept()
        .filter(|it| it["params"]["uri"] == "untitled:large.ladder");
    assert_eq!(pushed.count(), 0, "the small one waited");
    raw.finish();
}
