//! Proofs in the background: one at a time, none twice, and none that anybody has
//! to wait for.

use std::fmt::Write;

use end_to_end::lsp::Profile;
use serde_json::{Value, json};

use super::{SPEC, overflowing, proof, tank_like};
use crate::raw::Raw;

/// Factors so long that no engine proves anything about their product.
const LONG: usize = 20;

/// A ladder that multiplies, with its factors exchanged and not, and is on where
/// the two products differ. It never is, and nobody can prove it.
fn multiplier(bits: usize) -> String {
    let mut text = String::from("program Multiplier\noutput differ\n");
    for bit in 0..bits {
        let _ = writeln!(text, "input a{bit}\ninput b{bit}");
    }
    text += "rung: 0 -> zero\n";
    let one = product(&mut text, "x", ["a", "b"], bits);
    let other = product(&mut text, "y", ["b", "a"], bits);
    let pairs = one.iter().zip(&other);
    let differ: Vec<String> = pairs.map(|(x, y)| format!("{x}*/{y} + /{x}*{y}")).collect();
    let _ = writeln!(text, "rung: {} -> differ", differ.join(" + "));
    text
}

/// Adds the rungs of a product, row by row as on paper; the names of its bits.
fn product(text: &mut String, name: &str, [one, other]: [&str; 2], bits: usize) -> Vec<String> {
    let mut sum = vec!["zero".to_owned(); 2 * bits];
    for row in 0..bits {
        let mut carry = "zero".to_owned();
        for column in 0..bits {
            let (at, place) = (format!("{name}{row}_{column}"), sum[row + column].clone());
            let _ = write!(
                text,
                "rung: {one}{row} * {other}{column} -> {at}p\n\
                 rung: {place}*/{at}p + /{place}*{at}p -> {at}h\n\
                 rung: {at}h*/{carry} + /{at}h*{carry} -> {at}s\n\
                 rung: {place}*{at}p + {at}h*{carry} -> {at}c\n"
            );
            sum[row + column] = format!("{at}s");
            carry = format!("{at}c");
        }
        sum[row + bits] = carry;
    }
    sum
}

/// A spec in which the output of the multiplier is never on.
const NEVER: &str = "\
Grafcet Multiplier
Step X0, X1
Output differ
Marking X0
Steps:
X1: |- differ
";

/// The addresses of a pair.
fn pair(name: &str) -> [String; 2] {
    ["ladder", "grafcet"].map(|ending| format!("untitled:{name}.{ending}"))
}

/// A session in which a proof may take for ever.
fn patient(profile: Profile) -> Raw {
    let settings = json!({ "verify": { "effort": u32::MAX } });
    Raw::in_folders_with(profile, &[], settings)
}

/// Opens a pair that nobody can prove equal.
fn open_hard(raw: &mut Raw, name: &str) {
    let [ladder, spec] = pair(name);
    raw.open(&ladder, &multiplier(LONG));
    raw.open(&spec, NEVER);
}

/// Waits until the proof about a spec is shown; the token of the progress.
fn under_way(raw: &mut Raw, name: &str) -> Value {
    let title = format!("Verifying {name}.grafcet");
    loop {
        let next = raw.wait_for(|it| {
            let begins = it["params"]["value"]["title"] == *title;
            begins || it["method"] == "window/workDoneProgress/create"
        });
        if next["method"] == "$/progress" {
            assert_eq!(next["params"]["value"]["kind"], "begin");
            assert_eq!(next["params"]["value"]["cancellable"], true);
            return next["params"]["token"].clone();
        }
        let agreed = json!({ "jsonrpc": "2.0", "id": next["id"], "result": null });
        raw.wire.send(&agreed);
    }
}

/// The next message about a progress.
fn shown(raw: &mut Raw, token: &Value) -> Value {
    let of_token = |it: &Value| it["method"] == "$/progress" && it["params"]["token"] == *token;
    raw.wait_for(of_token)["params"]["value"].clone()
}

/// Waits until a finding of this code is pushed for a spec.
fn pushed(raw: &mut Raw, uri: &str, code: &str) {
    raw.wait_for(|it| {
        let found = it["params"]["diagnostics"].as_array();
        it["method"] == "textDocument/publishDiagnostics"
            && it["params"]["uri"] == uri
            && found.is_some_and(|found| found.iter().any(|it| it["code"] == code))
    });
}

#[test]
fn while_a_proof_would_take_for_ever_others_are_answered_and_an_edit_ends_it() {
    let mut raw = patient(Profile::Eglot);
    open_hard(&mut raw, "hard");
    let token = under_way(&mut raw, "hard");
    raw.still_answers();
    let [ladder, spec] = pair("hard");
    let lens = raw.ask("textDocument/hover", crate::raw::hover(&spec, 1, 6));
    assert!(lens["result"]["contents"].is_object(), "{lens}");
    // One proof is at work at most, so the next begins when this has ended.
    raw.change(&ladder, 2, "input a\noutput differ\nrung: a -> differ\n");
    assert_eq!(shown(&mut raw, &token)["kind"], "end");
    pushed(&mut raw, &spec, "G3201");
    raw.finish();
}

#[test]
fn the_end_of_the_session_ends_a_proof() {
    let mut raw = patient(Profile::Eglot);
    open_hard(&mut raw, "hard");
    let token = under_way(&mut raw, "hard");
    raw.ask("shutdown", Value::Null);
    assert_eq!(shown(&mut raw, &token)["kind"], "end");
    raw.notify("exit", Value::Null);
    assert!(raw.wire.wait().success());
}

#[test]
fn a_proof_that_the_user_stops_is_not_begun_again_until_it_is_about_something_else() {
    let mut raw = patient(Profile::VsCode);
    open_hard(&mut raw, "hard");
    let token = under_way(&mut raw, "hard");
    raw.notify("window/workDoneProgress/cancel", json!({ "token": token }));
    assert_eq!(shown(&mut raw, &token)["kind"], "end");
    let [_, spec] = pair("hard");
    let lens = |raw: &mut Raw| {
        let params = json!({ "textDocument": { "uri": spec } });
        let answer = raw.ask("textDocument/codeLens", params);
        answer["result"][0]["command"]["title"].clone()
    };
    let stopped = |it: &Value| it["params"]["proof"]["verdict"] == "stopped";
    raw.wait_for(stopped);
    assert_eq!(lens(&mut raw), "proof stopped");
    raw.change(&spec, 2, &format!("// Never on\n{NEVER}"));
    assert_eq!(lens(&mut raw), "proof stopped");
    // But it is when somebody asks for it.
    let asked = json!({ "command": "gradus.verify", "arguments": [{ "uri": spec }] });
    let id = raw.begin("workspace/executeCommand", asked);
    under_way(&mut raw, "hard");
    raw.notify("$/cancelRequest", json!({ "id": id }));
    raw.end(&id);
    raw.change(&spec, 3, &NEVER.replace("Marking X0", "Marking X1"));
    assert_eq!(lens(&mut raw), "proving …");
    raw.finish();
}

#[test]
fn one_proof_is_at_work_and_the_next_has_its_turn_when_that_is_closed() {
    let mut raw = patient(Profile::Eglot);
    open_hard(&mut raw, "one");
    let token = under_way(&mut raw, "one");
    open_hard(&mut raw, "two");
    let [ladder, spec] = pair("one");
    for uri in [ladder, spec] {
        let document = json!({ "textDocument": { "uri": uri } });
        raw.notify("textDocument/didClose", document);
    }
    assert_eq!(shown(&mut raw, &token)["kind"], "end");
    under_way(&mut raw, "two");
    raw.finish();
}

#[test]
fn who_asks_need_not_wait_for_the_background_and_can_take_it_back() {
    let mut raw = patient(Profile::Eglot);
    open_hard(&mut raw, "one");
    under_way(&mut raw, "one");
    let uris = ["untitled:other.ladder", "untitled:other.grafcet"];
    raw.open(uris[0], super::LADDER);
    raw.open(uris[1], SPEC);
    let command = |uri: &str| json!({ "command": "gradus.verify", "arguments": [{ "uri": uri }] });
    let answer = raw.ask("workspace/executeCommand", command(uris[1]));
    assert_eq!(answer["result"]["verdict"], "equivalent", "{answer}");
    // Asked for, a proof of the pair takes the place of the one in the background.
    let [ladder, _] = pair("one");
    let id = raw.begin("workspace/executeCommand", command(&ladder));
    let token = under_way(&mut raw, "one");
    raw.notify("$/cancelRequest", json!({ "id": id }));
    assert_eq!(raw.end(&id)["error"]["code"], -32800);
    assert_eq!(shown(&mut raw, &token)["kind"], "end");
    raw.finish();
}

#[test]
fn nothing_is_proved_again_that_is_known() {
    let mut client = tank_like(Profile::VsCode, &overflowing());
    let line = proof(&mut client, "different");
    let next = |client: &mut end_to_end::lsp::Client| {
        client.notification("gradus/status")["proof"]["message"].clone()
    };
    client.replace("tank.ladder", "// Fill", "// Open the valve");
    assert_eq!(next(&mut client), line);
    client.replace("tank.grafcet", "Grafcet Tank", "// By hand\nGrafcet Tank");
    assert_eq!(next(&mut client), line);
    client.replace("tank.ladder", "(s + v1)", "(v1 + s)");
    assert_eq!(proof(&mut client, "different"), line);
}
