use end_to_end::lsp::{Client, Marked};
use serde_json::json;
use tower_lsp::ls_types::request::CodeActionRequest;
use tower_lsp::ls_types::{
    CodeAction, CodeActionContext, CodeActionOrCommand, CodeActionParams, Range,
    TextDocumentIdentifier,
};

use super::tank;
use crate::rename::after;

const NAME: &str = "fill.scenario";

/// What can be done at the cursor.
fn actions(client: &mut Client, marked: &Marked) -> Vec<CodeAction> {
    let at = marked.position(0, false);
    let params = CodeActionParams {
        text_document: TextDocumentIdentifier {
            uri: client.uri(NAME),
        },
        range: Range::new(at, at),
        context: CodeActionContext::default(),
        work_done_progress_params: Default::default(),
        partial_result_params: Default::default(),
    };
    let found = client
        .request::<CodeActionRequest>(params)
        .unwrap_or_default();
    let actions = found.into_iter().map(|it| match it {
        CodeActionOrCommand::CodeAction(action) => action,
        CodeActionOrCommand::Command(command) => panic!("a command: {command:?}"),
    });
    actions.collect()
}

#[test]
fn what_the_ladder_does_can_be_expected_by_one_edit() {
    let (mut client, marked) =
        tank("for tank.ladder\n\non s => off$0 v1 // Fill\non ls2 => only\n");
    let found = actions(&mut client, &marked);
    let titles: Vec<&str> = found.iter().map(|it| &*it.title).collect();
    assert_eq!(
        titles,
        [
            "Expect what the ladder does",
            "Expect everywhere what the ladder does",
            "Show scan 1 in ladder and spec",
            "Explain G5003: expectation not met",
        ]
    );
    let edit = found[0].edit.as_ref().expect("an edit");
    assert_eq!(
        after(&client, edit, NAME),
        "for tank.ladder\n\non s => on v1 // Fill\non ls2 => only\n"
    );
    let edit = found[1].edit.as_ref().expect("an edit");
    let new = after(&client, edit, NAME);
    assert_eq!(
        new,
        "for tank.ladder\n\non s => on v1 // Fill\non ls2 => only off v1\n"
    );
    client.replace_all(NAME, &new);
    assert_eq!(client.diagnostics(NAME), []);
    let command = found[2].command.as_ref().expect("a command");
    assert_eq!(command.command, "gradus.showScan");
    let argument = json!({ "uri": client.uri(NAME), "line": 2 });
    assert_eq!(command.arguments.as_deref(), Some(&[argument][..]));
}

#[test]
fn a_step_that_expects_nothing_can_be_recorded_and_a_name_put_right() {
    let (mut client, marked) = tank("for tank.ladder\n\n$0on s // Fill\n");
    let found = actions(&mut client, &marked);
    assert_eq!(
        found[0].title,
        "Expect what the ladder does, and nothing else"
    );
    let kind = found[0].kind.as_ref().expect("a kind").as_str();
    assert_eq!(kind, "refactor.gradus.expect");
    let edit = found[0].edit.as_ref().expect("an edit");
    assert_eq!(
        after(&client, edit, NAME),
        "for tank.ladder\n\non s => only on v1 // Fill\n"
    );
    let (mut client, marked) = tank("for tank.ladder\n\non l$0s3\n");
    let found = actions(&mut client, &marked);
    assert_eq!(found[0].title, "Write ls2 instead");
    let edit = found[0].edit.as_ref().expect("an edit");
    assert_eq!(after(&client, edit, NAME), "for tank.ladder\n\non ls2\n");
}
