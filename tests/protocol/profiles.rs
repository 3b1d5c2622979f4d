//! What each kind of client is told, and asked: nothing that it has not said it
//! understands.

use end_to_end::lsp::{Profile, Wire};
use serde_json::{Value, json};

use crate::raw::{Raw, hover};

const URI: &str = "untitled:tank.ladder";

/// A coil that two rungs drive, one of which is never reached: findings with
/// other places and tags.
const TANK: &str = "\
program Tank
rung: a -> v1
rung: b -> v1
rung: 1 -> jump end
rung: c -> v2
rung label end:
";

/// Whether a client says this of itself.
fn says(profile: Profile, path: &str) -> bool {
    let capabilities = profile.capabilities();
    let found = capabilities.pointer(path);
    found.is_some_and(|it| !matches!(it, Value::Null | Value::Bool(false)))
}

/// Whether a client may be asked `method`.
fn may_be_asked(profile: Profile, method: &str) -> bool {
    let announced = match method {
        "client/registerCapability" => "/workspace/didChangeWatchedFiles/dynamicRegistration",
        "workspace/configuration" => "/workspace/configuration",
        "workspace/applyEdit" => "/workspace/applyEdit",
        "window/workDoneProgress/create" => "/window/workDoneProgress",
        "window/showDocument" => "/window/showDocument/support",
        "workspace/codeLens/refresh" => "/workspace/codeLens/refreshSupport",
        "workspace/inlayHint/refresh" => "/workspace/inlayHint/refreshSupport",
        "workspace/semanticTokens/refresh" => "/workspace/semanticTokens/refreshSupport",
        "workspace/diagnostic/refresh" => "/workspace/diagnostics/refreshSupport",
        _ => panic!("nobody expected {method}"),
    };
    says(profile, announced)
}

/// What a client answers that agrees to everything and has one setting.
fn agreed(method: &str, is_on: bool) -> Value {
    match method {
        "workspace/configuration" => json!([{ "codeLens": { "enable": is_on } }]),
        _ => Value::Null,
    }
}

#[test]
fn only_what_a_client_understands_is_asked_of_it() {
    for profile in Profile::ALL {
        let mut raw = Raw::initialized(profile);
        raw.open(URI, TANK);
        let mut asked = Vec::new();
        for round in 0..4 {
            raw.notify(
                "workspace/didChangeConfiguration",
                json!({ "settings": {} }),
            );
            let end = raw.begin("textDocument/hover", hover(URI, 1, 6));
            loop {
                let message = raw.wait_for(|_| true);
                let Some(method) = message["method"].as_str() else {
                    assert_eq!(message["id"], end);
                    break;
                };
                if let Some(id) = message.get("id") {
                    assert!(may_be_asked(profile, method), "{profile:?}: {method}");
                    let result = agreed(method, round % 2 == 0);
                    raw.wire
                        .send(&json!({ "jsonrpc": "2.0", "id": id, "result": result }));
                    asked.push(method.to_owned());
                }
            }
        }
        let is_asked = asked.iter().any(|it| it == "workspace/configuration");
        assert_eq!(
            is_asked,
            says(profile, "/workspace/configuration"),
            "{profile:?}"
        );
        let watches = asked.iter().any(|it| it == "client/registerCapability");
        let wanted = says(
            profile,
            "/workspace/didChangeWatchedFiles/dynamicRegistration",
        );
        assert_eq!(watches, wanted, "{profile:?}");
        raw.finish();
    }
}

#[test]
fn columns_are_counted_as_the_client_counts() {
    for profile in Profile::ALL {
        let mut raw = Raw::on(Wire::start(env!("CARGO_BIN_EXE_gradus")));
        let server = raw.initialize(profile);
        let (encoding, start) = match profile.counts_bytes() {
            true => ("utf-8", 17),
            false => ("utf-16", 13),
        };
        assert_eq!(server["capabilities"]["positionEncoding"], encoding);
        raw.open(URI, "rung \"\u{1f6d1}\u{1f6d1}\": abc -> b\n");
        let answer = raw.ask("textDocument/hover", hover(URI, 0, start + 1));
        let range = json!({
            "start": { "line": 0, "character": start },
            "end": { "line": 0, "character": start + 3 },
        });
        assert_eq!(answer["result"]["range"], range, "{profile:?}");
        raw.finish();
    }
}

#[test]
fn findings_are_pulled_by_those_who_are_told_when_and_pushed_to_all_others() {
    for profile in Profile::ALL {
        let mut raw = Raw::start();
        let server = raw.initialize(profile);
        let pulls = says(profile, "/textDocument/diagnostic")
            && says(profile, "/workspace/diagnostics/refreshSupport");
        let provider = &server["capabilities"]["diagnosticProvider"];
        assert_eq!(provider.is_object(), pulls, "{profile:?}");
        let findings = findings(&mut raw, pulls);
        assert!(!findings.is_empty(), "{profile:?}");
        let pushed = raw.kept().filter(|it| it["method"] == PUBLISH);
        assert_eq!(pushed.count(), 0, "{profile:?}");
        raw.finish();
    }
}

const PUBLISH: &str = "textDocument/publishDiagnostics";

/// What the server finds in the tank.
fn findings(raw: &mut Raw, pulls: bool) -> Vec<Value> {
    raw.open(URI, TANK);
    let found = match pulls {
        true => {
            let params = json!({ "textDocument": { "uri": URI } });
            raw.ask("textDocument/diagnostic", params)["result"]["items"].clone()
        }
        false => raw.told(PUBLISH)["params"]["diagnostics"].clone(),
    };
    found.as_array().expect("findings").clone()
}

#[test]
fn findings_have_only_parts_that_the_client_shows() {
    for profile in Profile::ALL {
        let mut raw = Raw::start();
        let server = raw.initialize(profile);
        let pulls = server["capabilities"]["diagnosticProvider"].is_object();
        let found = findings(&mut raw, pulls);
        for (part, announced) in [
            (
                "relatedInformation",
                "/textDocument/publishDiagnostics/relatedInformation",
            ),
            (
                "codeDescription",
                "/textDocument/publishDiagnostics/codeDescriptionSupport",
            ),
            ("tags", "/textDocument/publishDiagnostics/tagSupport"),
        ] {
            let has = found.iter().any(|it| it.get(part).is_some());
            assert_eq!(
                has,
                says(profile, announced),
                "{profile:?}: {part}: {found:?}"
            );
        }
        let double = found
            .iter()
            .find(|it| it["code"] == "G2002")
            .expect("a double coil");
        let message = double["message"].as_str().expect("a message");
        let tells = message.contains("line 2: also driven by rung 0 of Tank");
        let shows = says(
            profile,
            "/textDocument/publishDiagnostics/relatedInformation",
        );
        assert_eq!(tells, !shows, "{profile:?}: {message}");
        raw.finish();
    }
}

#[test]
fn hovers_are_of_a_kind_that_the_client_shows() {
    for profile in Profile::ALL {
        let mut raw = Raw::initialized(profile);
        raw.open(URI, TANK);
        let answer = raw.ask("textDocument/hover", hover(URI, 1, 6));
        let capabilities = profile.capabilities();
        let kinds = capabilities.pointer("/textDocument/hover/contentFormat");
        let kind = &answer["result"]["contents"]["kind"];
        let shown = kinds
            .and_then(Value::as_array)
            .is_some_and(|kinds| kinds.contains(kind));
        assert!(shown || kind == "plaintext", "{profile:?}: {kind}");
        raw.finish();
    }
}
