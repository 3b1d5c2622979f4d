//! A message as it crosses a stream: headers, an empty line, a body in JSON.

use std::io::{BufRead, ErrorKind, Read};

use serde::Deserialize;
use serde::de::IgnoredAny;
use serde_json::{Value, json};

/// A body of more bytes than this is read past, not kept: the largest export
/// ever met has 60 MB.
const LARGEST: usize = 512 << 20;

/// A header line of more bytes than this is none.
const LONGEST_HEADER: u64 = 4096;

/// What stands next on a stream.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Frame {
    /// One message, well formed as far as its envelope goes.
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
        Header::Length(length) => length,
        Header::Broken => return refusal(PARSE_ERROR, "a header without a Content-Length"),
        Header::End => return Frame::End,
    };
    if length > LARGEST {
        let mut rest = stream.by_ref().take(length as u64);
        return match std::io::copy(&mut rest, &mut std::io::sink()) {
            Ok(_) => refusal(INVALID_REQUEST, "a message of more than 512 MiB"),
            Err(_) => Frame::End,
        };
    }
    let mut body = Vec::new();
    match stream.by_ref().take(length as u64).read_to_end(&mut body) {
        Ok(read) if read == length => judged(body),
        _ => Frame::End,
    }
}

const PARSE_ERROR: i32 = -32700;
const INVALID_REQUEST: i32 = -32600;

/// What every message has, and what a request and a response have apart.
#[derive(Deserialize)]
struct Envelope {
    jsonrpc: String,
    id: Option<Value>,
    method: Option<String>,
    params: Option<Value>,
    result: Option<IgnoredAny>,
    error: Option<IgnoredAny>,
}

/// `body`, if it is one message.
fn judged(body: Vec<u8>) -> Frame {
    let value: Result<Envelope, _> = serde_json::from_slice(&body);
    let envelope = match value {
        Ok(envelope) => envelope,
        Err(error) if error.is_data() => {
            let what = match body.iter().find(|byte| !byte.is_ascii_whitespace()) {
                Some(b'[') => "messages in batches are no part of the protocol",
                _ => "this is no message of JSON-RPC 2.0",
            };
            return refusal(INVALID_REQUEST, what);
        }
        Err(_) => return refusal(PARSE_ERROR, "a message that is not JSON"),
    };
    let id_is_one = match &envelope.id {
        None | Some(Value::Null | Value::String(_)) => true,
        Some(Value::Number(number)) => number.is_i64(),
        Some(_) => false,
    };
    let params_are_some = !matches!(
        envelope.params,
        Some(Value::Bool(_) | Value::Number(_) | Value::String(_))
    );
    let is_response =
        envelope.result.is_some() || envelope.error.is_some() || envelope.id.is_some();
    let is_known = envelope.method.is_some() || is_response;
    if envelope.jsonrpc != "2.0" || !id_is_one || !params_are_some || !is_known {
        let id = envelope.id.filter(|_| id_is_one);
        return answer(id, INVALID_REQUEST, "this is no message of JSON-RPC 2.0");
    }
    Frame::Message(body)
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
    let mut is_broken = false;
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
            (true, None) if is_broken => return Header::Broken,
            (true, None) => {}
            (false, _) => match content_length(line) {
                Some(found) => length = Some(found),
                None => is_broken |= !line.contains(':') || line.contains("Content-Length"),
            },
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
        ];
        for (body, code) in bad {
            let stream = framed(body) + &framed(EXIT);
            assert_eq!(frames(&stream), [code, EXIT], "{body}");
        }
    }

    #[test]
    fn a_broken_header_costs_its_own_frame() {
        let stream = format!("Content-Length: many\r\n\r\n{}", framed(EXIT));
        assert_eq!(frames(&stream), ["-32700", EXIT]);
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
