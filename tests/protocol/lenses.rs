use serde_json::json;
use tower_lsp::ls_types::request::{CodeLensRequest, InlayHintRequest};
use tower_lsp::ls_types::{
    CodeLensParams, InlayHintLabel, InlayHintParams, Position, Range, TextDocumentIdentifier,
};

use end_to_end::lsp::{Client, Profile};

use crate::client;

const TANK: &str = "\
rung: (s + v1) * /ls2 -> v1
rung: (ls2 + v2) * s -> v2
";

/// The lenses of a document, with their lines.
pub fn lenses(client: &mut Client, name: &str) -> Vec<(u32, String)> {
    let params = CodeLensParams {
        text_document: TextDocumentIdentifier {
            uri: client.uri(name),
        },
        work_done_progress_params: Default::default(),
        partial_result_params: Default::default(),
    };
    let found = client
        .request::<CodeLensRequest>(params)
        .unwrap_or_default();
    let said = found.into_iter().map(|lens| {
        let command = lens.command.expect("a command");
        (lens.range.start.line, command.title)
    });
    said.collect()
}

/// The hints of a document, with their places.
pub fn hints(client: &mut Client, name: &str) -> Vec<(Position, String)> {
    let params = InlayHintParams {
        text_document: TextDocumentIdentifier {
            uri: client.uri(name),
        },
        range: Range::new(Position::new(0, 0), Position::new(99, 0)),
        work_done_progress_params: Default::default(),
    };
    let found = client
        .request::<InlayHintRequest>(params)
        .unwrap_or_default();
    let said = found.into_iter().map(|hint| match hint.label {
        InlayHintLabel::String(text) => (hint.position, text),
        InlayHintLabel::LabelParts(parts) => panic!("parts: {parts:?}"),
    });
    said.collect()
}

#[test]
fn lenses_follow_the_decisions_of_the_unsaved_spec() {
    let mut client = client();
    client.open("tank.ladder", TANK);
    let open = [
        (0, "1 may follow".to_owned()),
        (1, "1 may follow".to_owned()),
    ];
    assert_eq!(lenses(&mut client, "tank.ladder"), open);
    client.open("tank.grafcet", "Step Xv1 for v1\n//! accept v1 -> v2\n");
    let decided = [(0, "1 accepted".to_owned()), (1, "1 may follow".to_owned())];
    assert_eq!(lenses(&mut client, "tank.ladder"), decided);
    // Above the spec its verdict comes first.
    assert_eq!(lenses(&mut client, "tank.grafcet")[1..], decided[..1]);
}

#[test]
fn hints_stand_behind_coils() {
    let mut client = client();
    client.open("tank.ladder", TANK);
    assert_eq!(
        hints(&mut client, "tank.ladder"),
        [
            (Position::new(0, 27), "holds while /ls2".to_owned()),
            (Position::new(1, 26), "holds while s".to_owned()),
        ]
    );
}

#[test]
fn both_can_be_switched_off() {
    let settings = json!({ "codeLens": { "enable": false }, "inlayHints": { "enable": false } });
    let mut client = Client::start_with(env!("CARGO_BIN_EXE_gradus"), Profile::Neovim, settings);
    client.open("tank.ladder", TANK);
    assert_eq!(lenses(&mut client, "tank.ladder"), []);
    assert_eq!(hints(&mut client, "tank.ladder"), []);
}

#[test]
fn the_status_says_how_ladder_and_spec_stand() {
    let mut client = client();
    client.open("tank.ladder", TANK);
    let status = client.notification("gradus/status");
    assert_eq!(status["verdict"], "no-spec");
    assert_eq!(status["message"], "2 states, 2 suggestions, no spec yet");
    client.open("tank.grafcet", "Step Xv9 for v9\nMarking Xv9\n");
    let status = client.notification("gradus/status");
    assert_eq!(status["verdict"], "behind");
}
