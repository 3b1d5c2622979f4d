//! How the server ends, and with what status.

use std::process::{Command, Stdio};

use end_to_end::lsp::{Profile, Wire};
use serde_json::{Value, json};

use crate::raw::{Raw, hover, large};

const LARGE: &str = "untitled:large.ladder";

#[test]
fn exit_after_shutdown_is_0() {
    Raw::initialized(Profile::Plain).finish();
}

#[test]
fn exit_without_shutdown_is_1() {
    let mut raw = Raw::initialized(Profile::Plain);
    raw.notify("exit", Value::Null);
    assert_eq!(raw.wire.wait().code(), Some(1));
}

#[test]
fn exit_before_initialize_is_1() {
    let mut raw = Raw::start();
    raw.notify("exit", Value::Null);
    assert_eq!(raw.wire.wait().code(), Some(1));
}

#[test]
fn exit_does_not_wait_for_work() {
    let mut raw = Raw::initialized(Profile::Plain);
    raw.open(LARGE, &large(20_000));
    for _ in 0..100 {
        raw.begin("textDocument/hover", hover(LARGE, 2, 8));
    }
    raw.notify("exit", Value::Null);
    assert_eq!(raw.wire.wait().code(), Some(1));
}

#[test]
fn the_end_of_its_input_is_1() {
    let mut raw = Raw::initialized(Profile::VsCode);
    raw.wire.close();
    assert_eq!(raw.wire.wait().code(), Some(1));
    let mut raw = Raw::start();
    raw.wire.close();
    assert_eq!(raw.wire.wait().code(), Some(1));
}

#[test]
fn the_end_of_its_input_after_shutdown_is_0() {
    let mut raw = Raw::initialized(Profile::VsCode);
    raw.ask("shutdown", Value::Null);
    raw.wire.close();
    assert_eq!(raw.wire.wait().code(), Some(0));
}

#[test]
fn the_end_of_its_input_in_the_middle_of_a_message_is_1() {
    let mut raw = Raw::initialized(Profile::VsCode);
    raw.wire
        .send_bytes(b"Content-Length: 500\r\n\r\n{\"jsonrpc\":");
    raw.wire.close();
    assert_eq!(raw.wire.wait().code(), Some(1));
}

#[test]
fn the_end_of_its_input_does_not_wait_for_work() {
    let mut raw = Raw::initialized(Profile::VsCode);
    raw.open(LARGE, &large(20_000));
    raw.begin("textDocument/hover", hover(LARGE, 2, 8));
    raw.wire.close();
    assert_eq!(raw.wire.wait().code(), Some(1));
}

#[test]
fn a_client_that_closes_everything_at_once_leaves_no_server() {
    let mut command = Command::new(env!("CARGO_BIN_EXE_gradus"));
    let mut server = command
        .arg("lsp")
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the server starts");
    drop(server.stdout.take());
    drop(server.stderr.take());
    drop(server.stdin.take());
    assert_eq!(server.wait().expect("its status").code(), Some(1));
}

#[cfg(unix)]
#[test]
fn the_server_ends_when_its_client_is_killed() {
    // A process that stands for the client; the streams stay open, as they do
    // where another process holds them.
    let mut client = Command::new("sleep").arg("1000").spawn().expect("`sleep`");
    let mut raw = Raw::start();
    let hello = json!({ "processId": client.id(), "rootUri": null, "capabilities": {} });
    raw.ask("initialize", hello);
    raw.notify("initialized", json!({}));
    raw.still_answers();
    client.kill().expect("a process to kill");
    client.wait().expect("its status");
    assert_eq!(raw.wire.wait().code(), Some(1));
}

#[cfg(unix)]
mod signals {
    use std::os::unix::process::ExitStatusExt;

    use super::*;

    fn send(signal: &str, wire: &Wire) {
        let sent = Command::new("kill")
            .args([signal, &wire.id().to_string()])
            .status();
        assert!(sent.expect("`kill`").success());
    }

    #[test]
    fn sigterm_ends_the_server_even_at_work() {
        let mut raw = Raw::initialized(Profile::VsCode);
        raw.open(LARGE, &large(20_000));
        raw.begin("textDocument/hover", hover(LARGE, 2, 8));
        send("-TERM", &raw.wire);
        assert_eq!(raw.wire.wait().signal(), Some(15));
    }

    #[test]
    fn sigint_ends_the_server_even_at_work_with_130() {
        let mut raw = Raw::initialized(Profile::VsCode);
        raw.open(LARGE, &large(20_000));
        raw.begin("textDocument/hover", hover(LARGE, 2, 8));
        send("-INT", &raw.wire);
        assert_eq!(raw.wire.wait().code(), Some(130));
    }
}
