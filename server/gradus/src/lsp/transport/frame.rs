//! A message as it crosses a stream: headers, an empty line, a body in JSON.

use std::io::{BufRead, ErrorKind, Read};

use serde::Deserialize;
use serde_json::{Value, json};
use tower_lsp::jsonrpc::{Request, Response};

/// A header that speaks of more bytes than this is wrong: the largest export
/// ever met has 60 MB.
const LARGEST: usize = 512 << 20;

/// A header line of more bytes than this is none.
const LONGEST_HEADER: u64 = 4096;

/// What stands next on a stream.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Frame {
    /// One message, which the protocol library can read.
    Message(Vec<u8>),
    /// Something else, and the answer to it.
    Refused(Value),
    /// Nothing any more.
    End,
}

/// Reads up to and including the next frame. Bytes that are no frame are passed
/// over up to the next header; the first of them are answered.
pub(super) fn next(stream: &mut impl BufRead) -> Frame {
    let length = match header(stream) {
        // Waiting for so many bytes would swallow all that follows.
        Header::Length(length) if length > LARGEST => {
            return refusal(INVALID_REQUEST, "a message of more than 512 MiB");
        }
        Header::Length(length) => length,
        Header::Broken => return refusal(PARSE_ERROR, "a header without a Content-Length"),
        Header::End => return Frame::End,
    };
    let mut body = Vec::new();
    match stream.by_ref().take(length as u64).read_to_end(&mut body) {
        Ok(read) if read == length => judged(body),
        _ => Frame::End,
    }
}

const PARSE_ERROR: i32 = -32700;
const INVALID_REQUEST: i32 = -32600;

/// What the protocol library takes for a message, read in the same way. It
/// stops for good at anything else.
#[derive(Deserialize)]
#[serde(untagged)]
enum Message {
    #[expect(dead_code, reason = "only whether there is one matters")]
    Response(Response),
    Request(Request),
}

/// `body`, if it is one message.
fn judged(body: Vec<u8>) -> Frame {
    let Ok(text) = std::str::from_utf8(&body) else {
        return refusal(PARSE_ERROR, "a message that is not UTF-8");
    };
    match serde_json::from_str(text) {
        Ok(Message::Response(_)) => Frame::Message(body),
        Ok(Message::Request(request)) if is_sound(&request) => Frame::Message(body),
        _ => refused(text),
    }
}

/// Whether a request names a method, and has params of a shape that params may
/// have.
fn is_sound(request: &Request) -> bool {
    let scalar = matches!(
        request.params(),
        Some(Value::Bool(_) | Value::Number(_) | Value::String(_))
    );
    !request.method().is_empty() && !scalar
}

/// The answer to `text`, which is no message.
fn refused(text: &str) -> Frame {
    let found: Value = match serde_json::from_str(text) {
        Ok(found) => found,
        Err(_) => return refusal(PARSE_ERROR, "a message that is not JSON"),
    };
    if found.is_array() {
        let what = "messages in batches are no part of the protocol";
        return refusal(INVALID_REQUEST, what);
    }
    // Who asks something can be told which question it was. An answer with a
    // fault has the number of a question of the server's.
    let asks = found["method"].is_string();
    let id = found.get("id").filter(|id| id.is_i64() || id.is_string());
    let id = id.filter(|_| asks).cloned();
    answer(id, INVALID_REQUEST, "this is no message of JSON-RPC 2.0")
}

fn refusal(code: i32, message: &str) -> Frame {
    answer(None, code, message)
}

fn answer(id: Option<Value>, code: i32, message: &str) -> Frame {
    Frame::Refused(json!({
        "jsonrpc": "2.0",
        "id": id.unwrap_or(Value::Null),
        "error": { "code": code, "message": message },
    }))
}

enum Header {
    Length(usize),
    Broken,
    End,
}

/// The length that the next header gives. Lines that are no header are passed
/// over: after a frame of a wrong length the next begins in the middle of a
/// line, so a header may also end one.
fn header(stream: &mut impl BufRead) -> Header {
    let mut length = None;
    let mut has_lines = false;
    loop {
        let mut line = Vec::new();
        let mut limited = stream.by_ref().take(LONGEST_HEADER);
        match limited.read_until(b'\n', &mut line) {
            Ok(0) => return Header::End,
            Ok(_) => {}
            Err(error) if error.kind() == ErrorKind::Interrupted => continue,
            Err(_) => return Header::End,
        }
        let line = String::from_utf8_lossy(&line);
        let line = line.trim_end();
        match (line.is_empty(), length) {
            (true, Some(length)) => return Header::Length(length),
            (true, None) if has_lines => return Header::Broken,
            (true, None) => {}
            (false, _) => {
                has_lines = true;
                length = content_length(line).or(length);
            }
        }
    }
}

fn content_length(line: &str) -> Option<usize> {
    const NAME: &str = "content-length:";
    let lower = line.to_ascii_lowercase();
    let at = lower.rfind(NAME)?;
    line[at + NAME.len()..].trim().parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All frames of `stream`: messages as they are, refusals by their code.
    fn frames(stream: &str) -> Vec<String> {
        let mut stream = stream.as_bytes();
        let mut found = Vec::new();
        loop {
            match next(&mut stream) {
                Frame::Message(body) => found.push(String::from_utf8(body).expect("text")),
                Frame::Refused(answer) => found.push(answer["error"]["code"].to_string()),
                Frame::End => return found,
            }
        }
    }

    const EXIT: &str = r#"{"jsonrpc":"2.0","method":"exit"}"#;

    fn framed(body: &str) -> String {
        format!("Content-Length: {}\r\n\r\n{body}", body.len())
    }

    #[test]
    fn messages_are_handed_over_as_they_are() {
        let both = framed(EXIT) + &framed(EXIT);
        assert_eq!(frames(&both), [EXIT, EXIT]);
        let typed = format!(
            "content-length:{}\r\nContent-Type: application/vscode-jsonrpc; charset=utf-8\r\n\r\n{EXIT}",
            EXIT.len()
        );
        assert_eq!(frames(&typed), [EXIT]);
    }

    #[test]
    fn what_is_no_message_is_answered_and_the_next_one_read() {
        let bad = [
            ("{", "-32700"),
            ("\u{e4}", "-32700"),
            ("[]", "-32600"),
            ("7", "-32600"),
            ("{}", "-32600"),
            (r#"{"jsonrpc":"1.0","method":"exit"}"#, "-32600"),
            (r#"{"jsonrpc":"2.0"}"#, "-32600"),
            (r#"{"jsonrpc":"2.0","id":{},"method":"m"}"#, "-32600"),
            (
                r#"{"jsonrpc":"2.0","id":1,"method":"m","params":3}"#,
                "-32600",
            ),
            (r#"{"jsonrpc":"2.0","id":1,"error":{}}"#, "-32600"),
            (r#"{"jsonrpc":"2.0","id":1}"#, "-32600"),
            (r#"{"jsonrpc":"2.0","method":"m","method":"n"}"#, "-32600"),
            (r#"{"jsonrpc":"2.0","method":"m","x":1e999}"#, "-32700"),
        ];
        for (body, code) in bad {
            let stream = framed(body) + &framed(EXIT);
            assert_eq!(frames(&stream), [code, EXIT], "{body}");
        }
    }

    #[test]
    fn what_nests_too_deeply_is_refused_wherever_it_stands() {
        let deep = "[".repeat(500) + &"]".repeat(500);
        for place in ["params", "result", "x"] {
            let body = format!(r#"{{"jsonrpc":"2.0","id":1,"method":"m","{place}":{deep}}}"#);
            let stream = framed(&body) + &framed(EXIT);
            assert_eq!(frames(&stream), ["-32700", EXIT], "{place}");
        }
    }

    #[test]
    fn a_broken_header_costs_its_own_frame() {
        let stream = format!("Content-Length: many\r\n\r\n{}", framed(EXIT));
        assert_eq!(frames(&stream), ["-32700", EXIT]);
        let typed = format!("Content-Type: x\r\n\r\n{EXIT}\r\n{}", framed(EXIT));
        assert_eq!(frames(&typed), ["-32700", EXIT]);
        for much in ["99999999999", "99999999999999999999999", "-1"] {
            let huge = format!("Content-Length: {much}\r\n\r\n{EXIT}{}", framed(EXIT));
            assert_eq!(frames(&huge).last().map(String::as_str), Some(EXIT));
        }
        // The length was one too small: the last brace begins the next header.
        let short = format!("Content-Length: {}\r\n\r\n{EXIT}", EXIT.len() - 1);
        assert_eq!(frames(&(short + &framed(EXIT))), ["-32700", EXIT]);
    }

    #[test]
    fn a_stream_that_breaks_off_ends() {
        let whole = framed(EXIT);
        for end in 1..whole.len() {
            assert_eq!(frames(&whole[..end]), [""; 0], "{end}");
        }
    }
}
