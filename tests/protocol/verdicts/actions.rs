//! What can be done about a difference.

use end_to_end::lsp::{Client, Profile};
use tower_lsp::ls_types::request::{CodeActionRequest, CodeActionResolveRequest};
use tower_lsp::ls_types::{
    CodeAction, CodeActionContext, CodeActionOrCommand, CodeActionParams, Position, Range,
    TextDocumentIdentifier, WorkspaceEdit,
};

use super::{overflowing, proof, tank_like};
use crate::rename::after;

/// What can be done about the difference in the spec.
fn actions(client: &mut Client) -> Vec<CodeAction> {
    let found = client.diagnostics("tank.grafcet");
    let found: Vec<_> = found
        .into_iter()
        .filter(|it| it.message.contains("the ladder has v1"))
        .collect();
    actions_at(client, found[0].range)
}

/// What can be done in a range of the spec.
fn actions_at(client: &mut Client, range: Range) -> Vec<CodeAction> {
    let params = CodeActionParams {
        text_document: TextDocumentIdentifier {
            uri: client.uri("tank.grafcet"),
        },
        range,
        context: CodeActionContext::default(),
        work_done_progress_params: Default::default(),
        partial_result_params: Default::default(),
    };
    let actions = client.request::<CodeActionRequest>(params);
    let actions = actions.unwrap_or_default().into_iter().map(|it| match it {
        CodeActionOrCommand::CodeAction(action) => action,
        CodeActionOrCommand::Command(command) => panic!("a command: {command:?}"),
    });
    actions.collect()
}

fn titles(actions: &[CodeAction]) -> Vec<&str> {
    let kinds = ["quickfix.gradus.trace", "quickfix.gradus.exclude"];
    let ours = actions.iter().filter(|it| {
        let kind = it.kind.as_ref().map(|it| it.as_str());
        kind.is_some_and(|kind| kinds.contains(&kind))
    });
    ours.map(|it| &*it.title).collect()
}

/// The file that an edit makes, and its text.
fn created(edit: &WorkspaceEdit) -> (String, String) {
    let edit = serde_json::to_value(edit).expect("an edit");
    let changes = edit["documentChanges"].as_array().expect("changes");
    assert_eq!(changes[0]["kind"], "create");
    assert_eq!(changes[0]["annotationId"], "gradus");
    let uri = changes[1]["textDocument"]["uri"]
        .as_str()
        .expect("an address");
    let name = uri.rsplit('/').next().expect("a name").to_owned();
    let text = changes[1]["edits"][0]["newText"].as_str().expect("a text");
    (name, text.to_owned())
}

#[test]
fn the_trace_becomes_a_scenario_under_a_free_name() {
    let mut client = tank_like(Profile::VsCode, &overflowing());
    proof(&mut client, "different");
    let all = actions(&mut client);
    assert_eq!(all[0].title, "Add this trace as a scenario");
    assert_eq!(all[0].edit, None, "it is worked out when it is taken");
    let taken = client.request::<CodeActionResolveRequest>(all[0].clone());
    let (name, text) = created(taken.edit.as_ref().expect("an edit"));
    assert_eq!(name, "tank-trace.scenario");
    assert_eq!(
        text,
        "scenario \"v1 differs after 2 scans\"\nfor tank.ladder, tank.grafcet\n\n\
         on s\noff s, on ls2 => off v1\n"
    );
    // It passes on the ladder, and fails on the spec.
    client.open("tank-trace.scenario", &text);
    let found = client.diagnostics("tank-trace.scenario");
    assert_eq!(found.len(), 1, "{found:?}");
    let message = &found[0].message;
    assert!(
        message.starts_with("v1 should be off after scan 2, but the spec has it on"),
        "{message}"
    );
    let all = actions(&mut client);
    let taken = client.request::<CodeActionResolveRequest>(all[0].clone());
    let (name, _) = created(taken.edit.as_ref().expect("an edit"));
    assert_eq!(name, "tank-trace-2.scenario");
    client.write("tank-trace-2.scenario", &text);
    let taken = client.request::<CodeActionResolveRequest>(all[0].clone());
    let (name, _) = created(taken.edit.as_ref().expect("an edit"));
    assert_eq!(name, "tank-trace-3.scenario");
    // Once the spec was edited there is no such trace.
    client.replace("tank.grafcet", "ls2*s |-", "ls2 |-");
    let refused = client.ask::<CodeActionResolveRequest>(all[0].clone());
    assert_eq!(refused.expect_err("refused").code, -32801);
}

/// The text of the spec once the action of this title is taken.
fn taken(client: &mut Client, title: &str) -> String {
    let all = actions(client);
    let action = all.iter().find(|it| it.title == title);
    let action = action.unwrap_or_else(|| panic!("{:#?}", titles(&all)));
    after(
        client,
        action.edit.as_ref().expect("an edit"),
        "tank.grafcet",
    )
}

#[test]
fn a_rule_excludes_the_trace_by_a_fact_that_the_title_states() {
    let mut client = tank_like(Profile::VsCode, &overflowing());
    proof(&mut client, "different");
    assert_eq!(
        titles(&actions(&mut client)),
        [
            "Add this trace as a scenario",
            "Exclude it by an environment rule: s is on whenever ls2 is (ls2 |- s)",
            "Exclude it by an environment rule: s stays on while v1 is on (s*v1 |- @s)",
            "Exclude it by an environment rule: ls2 stays off while v1 is on (/ls2*v1 |- /@ls2)",
        ]
    );
    // The button was seen to be let go while the tank was filled.
    client.open("seen.scenario", "for tank.ladder\non s => on v1\noff s\n");
    assert_eq!(
        titles(&actions(&mut client)),
        [
            "Add this trace as a scenario",
            "Exclude it by an environment rule: ls2 stays off while v1 is on (/ls2*v1 |- /@ls2)",
            "Exclude it by an environment rule: ls2 is off in the scan after one with v1 on (v1 |- /@ls2)",
            "Exclude it by an environment rule: s is on whenever ls2 is (ls2 |- s)",
        ]
    );
    let title = "Exclude it by an environment rule: s is on whenever ls2 is (ls2 |- s)";
    let new = taken(&mut client, title);
    let added = "Environment:\ne1: ls2 |- s  // s is on whenever ls2 is\n";
    assert!(new.ends_with(added), "{new}");
    client.replace_all("tank.grafcet", &new);
    assert_eq!(
        proof(&mut client, "equivalent"),
        "equivalent under 1 rule (scan timing)"
    );
}

#[test]
fn who_cannot_wait_for_an_edit_has_it_at_once() {
    let mut client = tank_like(Profile::Eglot, &overflowing());
    let is_known = |client: &mut Client| {
        let found = client.diagnostics("tank.grafcet");
        found
            .iter()
            .any(|it| it.message.contains("the ladder has v1"))
    };
    while !is_known(&mut client) {}
    // What was pushed is not pushed again, so that the place is known here.
    let found = client
        .text("tank.grafcet")
        .lines()
        .position(|it| it == "Xv1: |- v1");
    let line = u32::try_from(found.expect("the action")).expect("a line");
    let all = actions_at(
        &mut client,
        Range::new(Position::new(line, 8), Position::new(line, 10)),
    );
    let first = all[0].edit.as_ref().expect("an edit");
    let edit = serde_json::to_value(first).expect("an edit");
    let uri = client.uri("tank-trace.scenario");
    let text = &edit["documentChanges"][0]["edits"][0]["newText"];
    assert_eq!(
        edit["documentChanges"][0]["textDocument"]["uri"],
        uri.as_str(),
        "{edit}"
    );
    assert!(
        text.as_str()
            .is_some_and(|it| it.contains("off s, on ls2 => off v1")),
        "{edit}"
    );
}
