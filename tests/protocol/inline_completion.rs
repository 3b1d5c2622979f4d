use end_to_end::lsp::Profile;
use tower_lsp::ls_types::request::InlineCompletionRequest;
use tower_lsp::ls_types::{
    InlineCompletionContext, InlineCompletionItem, InlineCompletionParams,
    InlineCompletionResponse, InlineCompletionTriggerKind, OneOf,
};

use crate::completion::{LACKING, TANK};
use crate::{client, client_like};

/// The ghost text at the cursor of the spec beside the tank's ladder.
fn ghosts(spec: &str) -> Vec<InlineCompletionItem> {
    let mut client = client();
    client.open("tank.ladder", TANK);
    let marked = client.open("tank.grafcet", spec);
    let params = InlineCompletionParams {
        work_done_progress_params: Default::default(),
        text_document_position: client.at("tank.grafcet", marked.position(0, false)),
        context: InlineCompletionContext {
            trigger_kind: InlineCompletionTriggerKind::AUTOMATIC,
            selected_completion_info: None,
        },
    };
    match client.request::<InlineCompletionRequest>(params) {
        Some(InlineCompletionResponse::Array(items)) => items,
        None => Vec::new(),
        other => panic!("no list of lines: {other:?}"),
    }
}

#[test]
fn the_next_decision_is_shown_at_the_end_of_a_spec() {
    let items = ghosts("Step a // \u{e4}\r\n$0");
    let [item] = items.as_slice() else {
        panic!("not one line: {items:?}");
    };
    assert_eq!(item.insert_text, "//! accept v1 -> v2");
    let range = item.range.expect("a range");
    assert_eq!(
        (range.start.line, range.start.character, range.end.character),
        (1, 0, 0)
    );
}

#[test]
fn what_is_typed_is_gone_on_with() {
    let items = ghosts("//! accept v1$0\nStep a\n");
    assert_eq!(items.len(), 1);
    assert_eq!(items[0].range.expect("a range").end.character, 13);
    assert_eq!(ghosts("//! accept v2$0\n"), []);
}

#[test]
fn a_rule_that_is_missing_is_shown_where_it_belongs() {
    let items = ghosts(LACKING);
    let lines: Vec<&str> = items.iter().map(|it| &*it.insert_text).collect();
    assert_eq!(lines, ["v1_to_Dv1: Xv1*ls2 |- @Dv1"]);
}

#[test]
fn only_clients_that_show_ghost_text_are_offered_it() {
    let offered = |profile| {
        client_like(profile)
            .server
            .capabilities
            .inline_completion_provider
            .clone()
    };
    assert_eq!(offered(Profile::VsCode), Some(OneOf::Left(true)));
    assert_eq!(offered(Profile::Eglot), None);
}
