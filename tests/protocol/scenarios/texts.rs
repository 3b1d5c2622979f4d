use end_to_end::lsp::{Client, selected};
use tower_lsp::ls_types::request::{
    DocumentSymbolRequest, FoldingRangeRequest, Formatting, OnTypeFormatting, RangeFormatting,
    SelectionRangeRequest, SemanticTokensFullRequest, WorkspaceSymbolRequest,
};
use tower_lsp::ls_types::{
    DocumentFormattingParams, DocumentOnTypeFormattingParams, DocumentRangeFormattingParams,
    DocumentSymbolParams, DocumentSymbolResponse, FoldingRangeParams, FormattingOptions, Range,
    SelectionRangeParams, SemanticTokensParams, SemanticTokensResult, SymbolKind,
    TextDocumentIdentifier, WorkspaceSymbolParams, WorkspaceSymbolResponse,
};

use super::{LADDER, SCENARIO, tank, with_cursor};
use crate::links::links;

const NAME: &str = "fill.scenario";

fn document(client: &Client) -> TextDocumentIdentifier {
    TextDocumentIdentifier {
        uri: client.uri(NAME),
    }
}

#[test]
fn a_scenario_is_laid_out_whole_in_part_and_as_it_is_typed() {
    let (mut client, marked) = tank("on s=>on v1\r\noff  s=>on v1\r\n$0?\r\n");
    let params = DocumentFormattingParams {
        text_document: document(&client),
        options: FormattingOptions::default(),
        work_done_progress_params: Default::default(),
    };
    let edits = client.request::<Formatting>(params).expect("a layout");
    assert_eq!(
        client.edited(NAME, &edits),
        "on s  => on v1\r\noff s => on v1\r\n?\r\n"
    );
    let at = marked.position(0, false);
    let second = Range::new(
        tower_lsp::ls_types::Position::new(1, 0),
        tower_lsp::ls_types::Position::new(1, 3),
    );
    let params = DocumentRangeFormattingParams {
        text_document: document(&client),
        range: second,
        options: FormattingOptions::default(),
        work_done_progress_params: Default::default(),
    };
    let edits = client.request::<RangeFormatting>(params).expect("a layout");
    let laid = "on s=>on v1\r\noff s => on v1\r\n?\r\n";
    assert_eq!(client.edited(NAME, &edits), laid);
    let params = DocumentOnTypeFormattingParams {
        text_document_position: client.at(NAME, at),
        ch: "\n".to_owned(),
        options: FormattingOptions::default(),
    };
    let edits = client
        .request::<OnTypeFormatting>(params)
        .expect("a layout");
    assert_eq!(client.edited(NAME, &edits), laid);
}

#[test]
fn its_steps_are_an_outline_and_its_title_is_found_in_folders() {
    let (mut client, _) = tank(SCENARIO);
    let params = DocumentSymbolParams {
        text_document: document(&client),
        work_done_progress_params: Default::default(),
        partial_result_params: Default::default(),
    };
    let symbols = client.request::<DocumentSymbolRequest>(params);
    let Some(DocumentSymbolResponse::Nested(tree)) = symbols else {
        panic!("no tree");
    };
    assert_eq!(
        (&*tree[0].name, tree[0].kind),
        ("Filled", SymbolKind::MODULE)
    );
    let steps = tree[0].children.iter().flatten();
    let steps: Vec<String> = steps
        .map(|it| format!("{} | {}", it.name, it.detail.as_deref().unwrap_or("-")))
        .collect();
    assert_eq!(
        steps,
        [
            "on s | on v1, on Xv1",
            "off s, scan 3 | on v1",
            "on ls2 | off %Q0"
        ]
    );
    client.write("closed.scenario", "scenario \"Filled again\"\non s\n");
    let params = WorkspaceSymbolParams {
        query: "fille".to_owned(),
        work_done_progress_params: Default::default(),
        partial_result_params: Default::default(),
    };
    let Some(WorkspaceSymbolResponse::Flat(found)) =
        client.request::<WorkspaceSymbolRequest>(params)
    else {
        panic!("no list");
    };
    let names: Vec<&str> = found.iter().map(|it| &*it.name).collect();
    assert_eq!(names, ["Filled", "Filled again"]);
}

#[test]
fn stretches_of_steps_fold_and_a_selection_grows_over_them() {
    let (mut client, marked) = tank(&with_cursor("on v$01, on Xv1"));
    let params = FoldingRangeParams {
        text_document: document(&client),
        work_done_progress_params: Default::default(),
        partial_result_params: Default::default(),
    };
    let folds = client.request::<FoldingRangeRequest>(params);
    let folds: Vec<_> = folds
        .expect("folds")
        .iter()
        .map(|it| (it.start_line, it.end_line))
        .collect();
    assert_eq!(folds, [(0, 1), (3, 5)]);
    let params = SelectionRangeParams {
        text_document: document(&client),
        positions: vec![marked.position(0, false)],
        work_done_progress_params: Default::default(),
        partial_result_params: Default::default(),
    };
    let grown = client.request::<SelectionRangeRequest>(params);
    let mut grown = grown.expect("selections").into_iter().next().map(Box::new);
    let mut all = Vec::new();
    while let Some(selection) = grown {
        all.push(selected(client.text(NAME), selection.range).to_owned());
        grown = selection.parent;
    }
    assert_eq!(
        all[..4],
        [
            "v1",
            "on v1",
            "on v1, on Xv1",
            "on s             => on v1, on Xv1"
        ]
    );
    assert_eq!(all.last().map(String::as_str), Some(SCENARIO));
}

#[test]
fn names_are_coloured_as_in_the_ladder() {
    let (mut client, _) = tank("for tank.ladder\non s => on v1, off what\n");
    let legend = match client.server.capabilities.semantic_tokens_provider.clone() {
        Some(provider) => serde_json::to_value(provider).expect("a legend")["legend"].clone(),
        None => panic!("no tokens"),
    };
    let params = SemanticTokensParams {
        text_document: document(&client),
        work_done_progress_params: Default::default(),
        partial_result_params: Default::default(),
    };
    let Some(SemanticTokensResult::Tokens(tokens)) =
        client.request::<SemanticTokensFullRequest>(params)
    else {
        panic!("no tokens");
    };
    let told = tokens.data.iter().map(|it| {
        let kind = legend["tokenTypes"][it.token_type as usize].as_str();
        (it.delta_line, it.delta_start, kind.unwrap_or_default())
    });
    assert_eq!(
        told.collect::<Vec<_>>(),
        [(1, 3, "variable"), (0, 8, "coil")]
    );
}

#[test]
fn a_scenario_and_what_it_runs_on_lead_to_each_other() {
    let (mut client, _) = tank(SCENARIO);
    assert_eq!(
        links(&mut client, NAME).expect("links"),
        [
            "tank.ladder -> tank.ladder (Open the ladder tank.ladder)",
            "tank.grafcet -> tank.grafcet (Open the spec tank.grafcet)",
        ]
    );
    client.replace(NAME, "for tank.ladder, tank.grafcet\n", "");
    client.close("tank.ladder");
    client.open("tank.ladder", &format!("// see tank.scenario\n{LADDER}"));
    client.open("tank.scenario", "scenario \"Filled\"\non s\n");
    assert_eq!(
        links(&mut client, "tank.scenario").expect("links"),
        ["\"Filled\" -> tank.ladder (Open the ladder tank.ladder)"]
    );
    assert_eq!(
        links(&mut client, "tank.ladder").expect("links"),
        [
            "Tank -> tank.grafcet (Open the spec tank.grafcet)",
            "tank.scenario -> tank.scenario (Open the scenario tank.scenario)",
        ]
    );
}
