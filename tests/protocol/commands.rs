use end_to_end::lsp::{Client, Profile, Refused};
use serde_json::{Value, json};
use tower_lsp::ls_types::ExecuteCommandParams;
use tower_lsp::ls_types::request::ExecuteCommand;

use crate::{client, client_like};

const LADDER: &str = "fixtures/neutralization/neutralization.ladder";

/// What a command answers, or why it is refused.
pub fn ask(client: &mut Client, command: &str, argument: Value) -> Result<Option<Value>, Refused> {
    client.ask::<ExecuteCommand>(ExecuteCommandParams {
        command: command.to_owned(),
        arguments: vec![argument],
        work_done_progress_params: Default::default(),
    })
}

fn run(client: &mut Client, command: &str, argument: Value) -> Value {
    let answer = ask(client, command, argument).expect("no refusal");
    answer.expect("an answer")
}

#[test]
fn converting_asks_the_editor_to_make_the_spec() {
    let mut client = client();
    client.open_fixture(LADDER, "tank.ladder");
    let argument = json!({ "uri": client.uri("tank.ladder") });
    let answer = run(&mut client, "gradus.acceptHandovers", argument);
    assert_eq!(answer["uri"], json!(client.uri("tank.grafcet")));
    assert_eq!(answer["changed"], true);
    assert_eq!(
        answer["summary"],
        "20 steps, 21 transitions, 9 actions; 7 suggestions open"
    );
    assert!(client.applied().document_changes.is_some());
}

#[test]
fn a_ladder_in_xml_is_shown_as_text() {
    let mut client = client();
    client.open_fixture("fixtures/neutralization/neutralization.L5X", "tank.L5X");
    let argument = json!({ "uri": client.uri("tank.L5X") });
    let answer = run(&mut client, "gradus.ladderText", argument.clone());
    assert_eq!(answer["title"], "tank.L5X.ladder");
    let text = answer["text"].as_str().expect("a text");
    assert!(text.contains("(s + v1) * /ls2"), "{text}");
    let again = client.ask_raw(
        "workspace/textDocumentContent",
        json!({ "uri": answer["uri"] }),
    );
    assert_eq!(again["text"], answer["text"]);
    let conditions = run(&mut client, "gradus.conditions", argument);
    let text = conditions["text"].as_str().expect("a text");
    assert!(text.contains("turns on    s*/ls2"), "{text}");
}

#[test]
fn the_spec_is_found_or_said_to_be_missing() {
    let mut client = client();
    client.open_fixture(LADDER, "tank.ladder");
    let argument = json!({ "uri": client.uri("tank.ladder") });
    let missing = run(&mut client, "gradus.openSpec", argument.clone());
    assert_eq!(
        missing,
        json!({ "uri": client.uri("tank.grafcet"), "exists": false })
    );
    client.write("tank.grafcet", "Step X0\n");
    assert_eq!(
        run(&mut client, "gradus.openSpec", argument)["exists"],
        true
    );
}

#[test]
fn a_code_is_explained_and_a_report_made() {
    let mut client = client_like(Profile::Eglot);
    let page = run(&mut client, "gradus.explain", json!("G2002"));
    assert!(
        page["text"]
            .as_str()
            .expect("a text")
            .starts_with("# G2002")
    );
    let report = run(&mut client, "gradus.report", Value::Null);
    assert!(
        report["text"]
            .as_str()
            .expect("a text")
            .starts_with("# gradus ")
    );
}

#[test]
fn what_makes_no_sense_is_refused_with_a_reason() {
    let mut client = client();
    for (command, argument, reason) in [
        (
            "gradus.dance",
            json!(1),
            "gradus.dance: gradus has no such command",
        ),
        (
            "gradus.explain",
            json!("G9"),
            "gradus.explain: `G9` is no code",
        ),
        (
            "gradus.convert",
            json!({}),
            "gradus.convert: missing field `uri`",
        ),
    ] {
        let refused = ask(&mut client, command, argument).expect_err("refused");
        assert_eq!((refused.code, &*refused.message), (-32602, reason));
    }
}
