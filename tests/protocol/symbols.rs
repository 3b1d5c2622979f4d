//! What documents and folders hold: documentSymbol and workspace/symbol.

use end_to_end::lsp::{Client, Profile, selected};
use tower_lsp::ls_types::notification::{Cancel, DidChangeWorkspaceFolders};
use tower_lsp::ls_types::request::{DocumentSymbolRequest, WorkspaceSymbolRequest};
use tower_lsp::ls_types::{
    CancelParams, DidChangeWorkspaceFoldersParams, DocumentSymbol, DocumentSymbolParams,
    DocumentSymbolResponse, NumberOrString, SymbolInformation, SymbolKind, TextDocumentIdentifier,
    Uri, WorkspaceFolder, WorkspaceFoldersChangeEvent, WorkspaceSymbolResponse,
};

use crate::raw::Raw;
use crate::{client, client_like};
use serde_json::json;

const LADDER: &str = "\
program Tänk\r
output v1 // Öffnen 🛑\r
rung \"Füllen\": (s + v1) * /ls2 -> v1\r
rung: v1 -> lamp\r
";

fn outline(client: &mut Client, name: &str) -> Option<DocumentSymbolResponse> {
    let params = DocumentSymbolParams {
        text_document: TextDocumentIdentifier {
            uri: client.uri(name),
        },
        work_done_progress_params: Default::default(),
        partial_result_params: Default::default(),
    };
    client.request::<DocumentSymbolRequest>(params)
}

/// The tree with two blanks a level: names, details, what the client selects.
fn drawn(symbols: &[DocumentSymbol], text: &str, depth: usize) -> String {
    let mut out = String::new();
    for symbol in symbols {
        out += &"  ".repeat(depth);
        out += &symbol.name;
        if let Some(detail) = &symbol.detail {
            out += &format!(" ({detail})");
        }
        if symbol.selection_range != symbol.range {
            out += &format!(" [{}]", selected(text, symbol.selection_range));
        }
        out += "\n";
        let children = symbol.children.as_deref().unwrap_or_default();
        out += &drawn(children, text, depth + 1);
    }
    out
}

fn tree(client: &mut Client, name: &str) -> String {
    match outline(client, name) {
        Some(DocumentSymbolResponse::Nested(tree)) => drawn(&tree, client.text(name), 0),
        other => panic!("no tree: {other:?}"),
    }
}

#[test]
fn a_ladder_is_a_tree_of_rungs_and_coils() {
    let mut client = client();
    client.open("tank.ladder", LADDER);
    assert_eq!(
        tree(&mut client, "tank.ladder"),
        "\
Tänk [Tänk]
  rung 0: Füllen
    v1 (state, Öffnen 🛑)
  rung 1
    lamp
"
    );
}

/// The names of all symbols that are marked as states.
fn states(symbols: &[DocumentSymbol]) -> Vec<&str> {
    let states = symbols.iter().flat_map(|it| {
        let detail = it.detail.as_deref().unwrap_or_default();
        let own = detail.starts_with("state").then_some(it.name.as_str());
        let inner = states(it.children.as_deref().unwrap_or_default());
        own.into_iter().chain(inner)
    });
    states.collect()
}

#[test]
fn the_same_program_has_the_same_states_in_every_format() {
    for fixture in [
        "neutralization.ladder",
        "neutralization.L5X",
        "neutralization.xml",
    ] {
        let mut client = client();
        client.open_fixture(&format!("fixtures/neutralization/{fixture}"), fixture);
        let Some(DocumentSymbolResponse::Nested(tree)) = outline(&mut client, fixture) else {
            panic!("{fixture}: no tree");
        };
        assert_eq!(tree[0].name, "Neutralization", "{fixture}");
        let wanted = ["v1", "v2", "v3", "v4", "h", "m"];
        assert_eq!(states(&tree), wanted, "{fixture}");
    }
}

#[test]
fn a_spec_is_a_tree_of_steps_and_rules() {
    let mut client = client();
    let text = "\
Grafcet Tank\r
Step X0, Xö for v1\r
Transition t1\r
Input s\r
Marking X0\r
Transitions:\r
t1: X0*s |- @Xö // fülle 🛑\r
Never:\r
n1: v1*s\r
";
    client.open("tank.grafcet", text);
    assert_eq!(
        tree(&mut client, "tank.grafcet"),
        "\
Tank [Tank]
  X0 (initial)
  Xö (for v1)
  Transitions [Transitions:]
    t1 (X0*s |- @Xö) [t1]
  Never [Never:]
    n1 (v1*s) [n1]
"
    );
}

#[test]
fn a_client_without_trees_gets_a_list() {
    let mut client = client_like(Profile::Helix);
    client.open("tank.ladder", LADDER);
    let Some(DocumentSymbolResponse::Flat(list)) = outline(&mut client, "tank.ladder") else {
        panic!("no list");
    };
    let names: Vec<(&str, Option<&str>)> = list
        .iter()
        .map(|it| (it.name.as_str(), it.container_name.as_deref()))
        .collect();
    assert_eq!(
        names,
        [
            ("Tänk", None),
            ("rung 0: Füllen", Some("Tänk")),
            ("v1", Some("rung 0: Füllen")),
            ("rung 1", Some("Tänk")),
            ("lamp", Some("rung 1")),
        ]
    );
}

#[test]
fn neutral_text_has_rungs_and_foreign_xml_has_nothing() {
    let mut client = client();
    client.open("rungs.txt", "XIC(a)OTE(b);\n");
    assert_eq!(tree(&mut client, "rungs.txt").matches("rung 0").count(), 1);
    client.open("note.xml", "<note>v1</note>");
    assert_eq!(outline(&mut client, "note.xml"), None);
}

fn found(client: &mut Client, typed: &str) -> Vec<SymbolInformation> {
    let params = tower_lsp::ls_types::WorkspaceSymbolParams {
        query: typed.to_owned(),
        partial_result_params: Default::default(),
        work_done_progress_params: Default::default(),
    };
    match client.request::<WorkspaceSymbolRequest>(params) {
        Some(WorkspaceSymbolResponse::Flat(found)) => found,
        other => panic!("no list: {other:?}"),
    }
}

/// `file:line name`.
fn named(client: &mut Client, typed: &str) -> Vec<String> {
    let shown = |it: &SymbolInformation| {
        let file = it.location.uri.as_str().rsplit('/').next().expect("a name");
        format!("{file}:{} {}", it.location.range.start.line + 1, it.name)
    };
    found(client, typed).iter().map(shown).collect()
}

fn workspace() -> Client {
    let client = client();
    std::fs::create_dir_all(client.path("line 2/.hidden")).expect("folders");
    client.write("tank.ladder", LADDER);
    client.write("line 2/press.grafcet", "Step Xpress for press\n");
    client.write("line 2/note.xml", "<note>press</note>");
    client.write("line 2/.hidden/old.ladder", "rung: a -> press");
    client.write("line 2/readme.md", "rung: a -> press");
    client
}

#[test]
fn whole_folders_are_searched() {
    let mut client = workspace();
    assert_eq!(named(&mut client, "press"), ["press.grafcet:1 Xpress"]);
    assert_eq!(named(&mut client, "V1"), ["tank.ladder:3 v1"]);
    assert_eq!(named(&mut client, "füll"), ["tank.ladder:3 rung 0: Füllen"]);
    assert_eq!(named(&mut client, "lmp"), ["tank.ladder:4 lamp"]);
    assert_eq!(named(&mut client, "nothing like it"), [""; 0]);
    // Nothing is analysed for a search, so that nothing tells it from other coils.
    let coil = &found(&mut client, "v1")[0];
    assert_eq!(coil.kind, SymbolKind::VARIABLE);
    assert_eq!(coil.container_name.as_deref(), Some("rung 0: Füllen"));
}

#[test]
fn what_is_open_counts_as_it_is_and_what_changed_on_disk_is_read_again() {
    let mut client = workspace();
    assert_eq!(named(&mut client, "lamp"), ["tank.ladder:4 lamp"]);
    client.open("tank.ladder", "\r\nrung: a -> lamp");
    assert_eq!(named(&mut client, "lamp"), ["tank.ladder:2 lamp"]);
    client.replace("tank.ladder", "lamp", "horn");
    assert_eq!(named(&mut client, "lamp"), [""; 0]);
    assert_eq!(named(&mut client, "horn"), ["tank.ladder:2 horn"]);
    client.close("tank.ladder");
    assert_eq!(named(&mut client, "lamp"), ["tank.ladder:4 lamp"]);
    client.write("tank.ladder", "rung: a -> another_lamp\n");
    assert_eq!(named(&mut client, "lamp"), ["tank.ladder:1 another_lamp"]);
    std::fs::remove_file(client.path("tank.ladder")).expect("removed");
    assert_eq!(named(&mut client, "lamp"), [""; 0]);
}

#[test]
fn a_root_counts_as_the_one_folder() {
    let [one, two] = ["v1", "v2"].map(|coil| {
        let folder = tempfile::tempdir().expect("a folder");
        let text = format!("rung: a -> {coil}");
        std::fs::write(folder.path().join("tank.ladder"), text).expect("a file");
        folder
    });
    let address = |folder: &tempfile::TempDir| Uri::from_file_path(folder.path());
    let [one, two] = [&one, &two].map(|it| (it.path(), address(it).expect("an address")));
    let named = json!([{ "uri": two.1, "name": "two" }]);
    for (roots, coils) in [
        (json!({ "rootUri": one.1 }), ["v1"].as_slice()),
        (json!({ "rootUri": null, "rootPath": one.0 }), &["v1"]),
        (json!({ "rootUri": two.1, "rootPath": one.0 }), &["v2"]),
        (
            json!({ "rootUri": two.1, "workspaceFolders": null }),
            &["v2"],
        ),
        // Folders say more than a root.
        (
            json!({ "rootUri": one.1, "workspaceFolders": named }),
            &["v2"],
        ),
        (json!({ "rootUri": one.1, "workspaceFolders": [] }), &[]),
        (json!({ "rootUri": null, "rootPath": "" }), &[]),
        (json!({}), &[]),
    ] {
        let mut raw = Raw::start();
        let mut hello = json!({ "processId": null, "capabilities": {} });
        let own = hello.as_object_mut().expect("an object");
        own.extend(roots.as_object().expect("an object").clone());
        raw.ask("initialize", hello);
        raw.notify("initialized", json!({}));
        let answer = raw.ask("workspace/symbol", json!({ "query": "v" }));
        let found = answer["result"].as_array().expect("a list").iter();
        let found: Vec<&str> = found.filter_map(|it| it["name"].as_str()).collect();
        assert_eq!(found, coils, "{roots}");
        raw.finish();
    }
}

#[test]
fn folders_that_are_added_are_searched_and_removed_ones_are_not() {
    let mut client = workspace();
    let other = tempfile::tempdir().expect("a folder");
    std::fs::write(other.path().join("mill.ladder"), "rung: a -> spindle").expect("a file");
    let folder = WorkspaceFolder {
        uri: Uri::from_file_path(other.path()).expect("an address"),
        name: "mill".to_owned(),
    };
    let change =
        |added: &[WorkspaceFolder], removed: &[WorkspaceFolder]| DidChangeWorkspaceFoldersParams {
            event: WorkspaceFoldersChangeEvent {
                added: added.to_vec(),
                removed: removed.to_vec(),
            },
        };
    let one = std::slice::from_ref(&folder);
    assert_eq!(named(&mut client, "spindle"), [""; 0]);
    client.notify::<DidChangeWorkspaceFolders>(change(one, &[]));
    assert_eq!(named(&mut client, "spindle"), ["mill.ladder:1 spindle"]);
    client.notify::<DidChangeWorkspaceFolders>(change(&[], one));
    assert_eq!(named(&mut client, "spindle"), [""; 0]);
}

#[test]
fn a_search_that_nobody_waits_for_stops_and_the_next_one_answers() {
    let mut client = workspace();
    let params = || tower_lsp::ls_types::WorkspaceSymbolParams {
        query: "v1".to_owned(),
        partial_result_params: Default::default(),
        work_done_progress_params: Default::default(),
    };
    for _ in 0..20 {
        let id = client.begin::<WorkspaceSymbolRequest>(params());
        client.notify::<Cancel>(CancelParams {
            id: NumberOrString::Number(id.try_into().expect("a small number")),
        });
        // It may have been answered before it was cancelled.
        if let Err(refused) = client.end::<WorkspaceSymbolRequest>(id) {
            assert_eq!(refused.code, -32800, "{}", refused.message);
        }
    }
    assert_eq!(named(&mut client, "v1"), ["tank.ladder:3 v1"]);
}

#[test]
fn an_answer_is_never_longer_than_a_client_can_show() {
    let mut client = client();
    let rungs: String = (0..700)
        .map(|at| format!("rung: a -> coil{at}\n"))
        .collect();
    client.write("many.ladder", &rungs);
    assert_eq!(found(&mut client, "coil").len(), 500);
    assert_eq!(named(&mut client, "coil699"), ["many.ladder:700 coil699"]);
}
