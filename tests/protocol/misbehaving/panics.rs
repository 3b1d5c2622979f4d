//! Faults of the server itself, which a build with debug assertions can be
//! asked for.

use std::process::{Command, Stdio};

use end_to_end::lsp::{Profile, Wire};
use serde_json::{Value, json};

use super::code;
use crate::raw::{Raw, hover};

/// A server that panics at `place`.
fn faulty(place: &str, profile: Profile) -> Raw {
    let mut command = Command::new(env!("CARGO_BIN_EXE_gradus"));
    command.env("GRADUS_TEST_PANIC", place);
    let wire = Wire::run(command.arg("lsp").stderr(Stdio::null()));
    let mut raw = Raw::on(wire);
    raw.initialize(profile);
    raw
}

const URI: &str = "untitled:a.ladder";

fn pull(raw: &mut Raw) -> Value {
    raw.ask(
        "textDocument/diagnostic",
        json!({ "textDocument": { "uri": URI } }),
    )
}

#[track_caller]
fn is_a_fault(answer: &Value) {
    assert_eq!(answer["error"]["code"], code::INTERNAL_ERROR, "{answer}");
    let message = answer["error"]["message"].as_str().expect("a message");
    let begins = message.starts_with("a fault in gradus, please report it: ");
    assert!(
        begins && message.ends_with("GRADUS_TEST_PANIC asked for it"),
        "{message}"
    );
}

#[test]
fn a_handler_that_panics_answers_and_the_server_goes_on() {
    let mut raw = faulty("textDocument/hover", Profile::VsCode);
    raw.open(URI, "rung: a -> b\n");
    for _ in 0..3 {
        is_a_fault(&raw.ask("textDocument/hover", hover(URI, 0, 6)));
    }
    assert_eq!(pull(&mut raw)["result"]["kind"], "full");
    raw.finish();
}

#[test]
fn work_that_panics_on_another_thread_answers_and_the_server_goes_on() {
    let mut raw = faulty("work", Profile::VsCode);
    raw.open(URI, "rung: a -> b\n");
    for _ in 0..40 {
        is_a_fault(&raw.ask("textDocument/hover", hover(URI, 0, 6)));
    }
    is_a_fault(&pull(&mut raw));
    raw.finish();
}

#[test]
fn a_panic_while_findings_are_pulled_is_an_answer() {
    let mut raw = faulty("diagnostics", Profile::VsCode);
    raw.open(URI, "rung: a -> b\n");
    is_a_fault(&pull(&mut raw));
    raw.still_answers();
    raw.finish();
}

#[test]
fn a_panic_while_findings_are_pushed_is_felt_by_nobody() {
    let mut raw = faulty("diagnostics", Profile::Plain);
    raw.open(URI, "rung: a -> b\n");
    for version in 2..30 {
        raw.change(URI, version, "rung: a -> c\n");
    }
    raw.still_answers();
    assert_eq!(raw.kept().filter(|it| it["error"].is_object()).count(), 0);
    raw.finish();
}

#[test]
fn a_notification_that_panics_costs_only_itself() {
    let mut raw = faulty("textDocument/didSave", Profile::Plain);
    raw.notify(
        "textDocument/didSave",
        json!({ "textDocument": { "uri": URI } }),
    );
    raw.still_answers();
    raw.finish();
}

#[test]
fn a_panic_during_shutdown_still_lets_the_server_end() {
    let mut raw = faulty("shutdown", Profile::Plain);
    is_a_fault(&raw.ask("shutdown", Value::Null));
    raw.notify("exit", Value::Null);
    assert_eq!(raw.wire.wait().code(), Some(1));
}
