use end_to_end::lsp::Profile;
use serde_json::{Value, json};

use super::code;
use crate::raw::{Raw, hover, large};

const LARGE: &str = "untitled:large.ladder";

/// A server that is busy with a large ladder as soon as it is asked about it.
fn busy(rungs: usize) -> Raw {
    let mut raw = Raw::initialized(Profile::VsCode);
    raw.open(LARGE, &large(rungs));
    raw
}

fn cancel(raw: &mut Raw, id: &Value) {
    raw.notify("$/cancelRequest", json!({ "id": id }));
}

#[test]
fn what_is_under_way_is_cancelled_whatever_its_number_looks_like() {
    for id in [json!(41), json!("forty-one"), json!("41"), json!("")] {
        let mut raw = busy(20_000);
        raw.begin_as(&id, "textDocument/hover", hover(LARGE, 2, 8));
        cancel(&mut raw, &id);
        assert_eq!(
            raw.end(&id)["error"]["code"],
            code::REQUEST_CANCELLED,
            "{id}"
        );
        raw.still_answers();
        raw.finish();
    }
}

#[test]
fn of_many_that_wait_each_is_cancelled_by_its_own_number() {
    let mut raw = busy(2000);
    let ids: Vec<Value> = (0..60)
        .map(|_| raw.begin("textDocument/hover", hover(LARGE, 2, 8)))
        .collect();
    let (kept, dropped) = ids.split_first().expect("requests");
    for id in dropped {
        cancel(&mut raw, id);
    }
    for id in dropped {
        assert_eq!(raw.end(id)["error"]["code"], code::REQUEST_CANCELLED);
    }
    assert!(raw.end(kept)["result"].is_object());
    raw.finish();
}

#[test]
fn a_cancel_before_its_request_does_no_harm() {
    let mut raw = Raw::initialized(Profile::Plain);
    raw.open("untitled:a.ladder", "rung: a -> b\n");
    let early = json!("early");
    cancel(&mut raw, &early);
    raw.begin_as(
        &early,
        "textDocument/hover",
        hover("untitled:a.ladder", 0, 6),
    );
    // Both may have been read before either was begun.
    let answer = raw.end(&early);
    let cancelled = answer["error"]["code"] == code::REQUEST_CANCELLED;
    assert!(cancelled || answer["result"].is_object(), "{answer}");
    raw.still_answers();
    raw.finish();
}

#[test]
fn a_cancel_after_the_answer_means_nothing() {
    let mut raw = Raw::initialized(Profile::Plain);
    let uri = "untitled:a.ladder";
    raw.open(uri, "rung: a -> b\n");
    let id = raw.begin("textDocument/hover", hover(uri, 0, 6));
    assert!(raw.end(&id)["result"].is_object());
    cancel(&mut raw, &id);
    cancel(&mut raw, &id);
    raw.still_answers();
    assert_eq!(raw.kept().filter(|it| it["id"] == id).count(), 0);
    raw.finish();
}

#[test]
fn a_cancel_of_what_never_was_means_nothing() {
    let mut raw = Raw::initialized(Profile::Plain);
    for id in [
        json!(12345),
        json!("nobody"),
        json!(-1),
        Value::Null,
        json!([1]),
        json!(1.5),
    ] {
        cancel(&mut raw, &id);
    }
    raw.still_answers();
    assert_eq!(raw.kept().filter(|it| it["error"].is_object()).count(), 0);
    raw.finish();
}

#[test]
fn shutdown_does_not_wait_for_what_is_under_way() {
    let mut raw = busy(20_000);
    let under_way = raw.begin("textDocument/hover", hover(LARGE, 2, 8));
    let shutdown = raw.begin("shutdown", Value::Null);
    let answer = raw.end(&shutdown);
    assert_eq!(answer.get("result"), Some(&Value::Null), "{answer}");
    raw.notify("exit", Value::Null);
    assert!(raw.wire.wait().success());
    assert_eq!(
        raw.kept()
            .filter(|it| it["id"] == under_way && it["result"].is_object())
            .count(),
        0
    );
}
