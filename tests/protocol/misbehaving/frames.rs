use end_to_end::lsp::Profile;
use serde_json::Value;

use super::code;
use crate::raw::Raw;

/// Sends `bytes` and then asks something. The codes of the errors that came
/// before the answer.
#[track_caller]
fn errors(bytes: &[u8]) -> Vec<i64> {
    let mut raw = Raw::initialized(Profile::Plain);
    raw.wire.send_bytes(bytes);
    raw.still_answers();
    let errors = raw
        .kept()
        .filter(|message| message["error"].is_object() && message["id"] == Value::Null)
        .filter_map(|message| message["error"]["code"].as_i64())
        .collect();
    raw.finish();
    errors
}

fn framed(body: impl AsRef<[u8]>) -> Vec<u8> {
    let body = body.as_ref();
    let header = format!("Content-Length: {}\r\n\r\n", body.len());
    [header.as_bytes(), body].concat()
}

/// A notification that says nothing.
const MESSAGE: &str = r#"{"jsonrpc":"2.0","method":"$/setTrace","params":{"value":"off"}}"#;

#[test]
fn a_header_that_is_none_is_answered_with_a_parse_error() {
    for header in [
        "Content-Length: many\r\n\r\n",
        "Content-Length: -5\r\n\r\n",
        "Content-Length: 99999999999999999999999999\r\n\r\n",
        "nonsense\r\n\r\n",
        "\u{0}\u{1}\r\n\r\n",
        ": 5\r\n\r\n",
    ] {
        assert_eq!(errors(header.as_bytes()), [code::PARSE_ERROR], "{header:?}");
    }
}

#[test]
fn a_message_without_its_length_is_answered_with_a_parse_error() {
    let bytes = format!("Content-Type: application/json\r\n\r\n{MESSAGE}\r\n");
    assert_eq!(errors(bytes.as_bytes()), [code::PARSE_ERROR]);
}

#[test]
fn empty_lines_between_messages_mean_nothing() {
    let message = framed(MESSAGE);
    let bytes = [b"\r\n\r\n".as_slice(), &message, b"\n\n", &message].concat();
    assert_eq!(errors(&bytes), [0; 0]);
}

#[test]
fn a_length_that_is_too_small_costs_its_own_message() {
    let bytes = format!("Content-Length: {}\r\n\r\n{MESSAGE}", MESSAGE.len() - 3);
    assert_eq!(errors(bytes.as_bytes()), [code::PARSE_ERROR]);
}

#[test]
fn a_length_that_is_too_large_costs_its_own_message_and_the_next() {
    let long = format!("Content-Length: {}\r\n\r\n{MESSAGE}", MESSAGE.len() + 3);
    let bytes = [long.as_bytes(), &framed(MESSAGE), &framed(MESSAGE)].concat();
    let errors = errors(&bytes);
    assert!(errors.iter().all(|it| *it == code::PARSE_ERROR) && !errors.is_empty());
}

#[test]
fn a_huge_length_is_refused_and_what_follows_is_read() {
    let huge = format!("Content-Length: 99999999999\r\n\r\n{MESSAGE}");
    assert_eq!(errors(huge.as_bytes()), [code::INVALID_REQUEST]);
}

#[test]
fn what_is_not_json_is_answered_with_a_parse_error() {
    for body in ["", "{", "hello", "{\"jsonrpc\":\"2.0\",}", "\u{feff}{}"] {
        assert_eq!(errors(&framed(body)), [code::PARSE_ERROR], "{body:?}");
    }
}

#[test]
fn what_is_not_utf_8_is_answered_with_a_parse_error() {
    let bad = b"{\"jsonrpc\":\"2.0\",\"method\":\"m\",\"x\":\"\xff\xfe\"}";
    assert_eq!(errors(&framed(bad)), [code::PARSE_ERROR]);
}

#[test]
fn json_that_is_no_message_is_an_invalid_request() {
    for body in [
        "7",
        "null",
        "\"hello\"",
        "{}",
        r#"{"jsonrpc":"1.0","method":"m"}"#,
        r#"{"method":"m"}"#,
        r#"{"jsonrpc":"2.0"}"#,
        r#"{"jsonrpc":"2.0","id":5}"#,
        r#"{"jsonrpc":"2.0","method":7}"#,
        r#"{"jsonrpc":"2.0","id":[1],"method":"m"}"#,
        r#"{"jsonrpc":"2.0","id":1.5,"method":"m"}"#,
        r#"{"jsonrpc":"2.0","id":99999999999999999999,"method":"m"}"#,
        r#"{"jsonrpc":"2.0","method":"m","params":"text"}"#,
        r#"{"jsonrpc":"2.0","id":5,"error":"no object"}"#,
    ] {
        assert_eq!(errors(&framed(body)), [code::INVALID_REQUEST], "{body}");
    }
}

#[test]
fn batches_are_refused_whole() {
    let batch = format!("[{MESSAGE},{MESSAGE}]");
    for body in ["[]", batch.as_str()] {
        assert_eq!(errors(&framed(body)), [code::INVALID_REQUEST], "{body}");
    }
}

#[test]
fn what_nests_without_end_is_refused_wherever_it_stands() {
    let deep = "[".repeat(100_000) + &"]".repeat(100_000);
    for name in ["params", "result", "unknown"] {
        let body = format!(r#"{{"jsonrpc":"2.0","method":"m","{name}":{deep}}}"#);
        assert_eq!(errors(&framed(body)), [code::PARSE_ERROR], "{name}");
    }
}

#[test]
fn a_message_may_come_in_any_pieces() {
    let mut raw = Raw::initialized(Profile::Plain);
    for byte in framed(MESSAGE) {
        raw.wire.send_bytes(&[byte]);
    }
    raw.still_answers();
    assert_eq!(raw.kept().filter(|it| it["error"].is_object()).count(), 0);
    raw.finish();
}

#[test]
fn many_bad_frames_leave_the_server_as_it_was() {
    let bad = [
        framed("{"),
        framed("[]"),
        b"Content-Length: x\r\n\r\n".to_vec(),
    ]
    .concat();
    assert_eq!(errors(&bad.repeat(300)).len(), 900);
}
