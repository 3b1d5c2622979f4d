//! Links between a ladder and the spec beside it.

use end_to_end::lsp::{Client, selected};
use tower_lsp::ls_types::request::DocumentLinkRequest;
use tower_lsp::ls_types::{DocumentLinkParams, TextDocumentIdentifier};

use crate::client;

/// `text -> file (tooltip)`.
pub fn links(client: &mut Client, name: &str) -> Option<Vec<String>> {
    let params = DocumentLinkParams {
        text_document: TextDocumentIdentifier {
            uri: client.uri(name),
        },
        work_done_progress_params: Default::default(),
        partial_result_params: Default::default(),
    };
    let found = client.request::<DocumentLinkRequest>(params)?;
    let shown = found.iter().map(|it| {
        let target = it.target.as_ref().expect("a target").as_str();
        let file = target.rsplit('/').next().expect("a name");
        let text = selected(client.text(name), it.range);
        let tooltip = it.tooltip.as_deref().unwrap_or_default();
        format!("{text} -> {file} ({tooltip})")
    });
    Some(shown.collect())
}

#[test]
fn a_ladder_and_its_spec_lead_to_each_other() {
    let mut client = client();
    client.open("tank.ladder", "program \"Tänk 🛑\"\r\nrung: a -> b\r\n");
    assert_eq!(links(&mut client, "tank.ladder"), Some(Vec::new()));
    client.open(
        "tank.grafcet",
        "// of the tank\r\nGrafcet Tänk\r\nStep X0\r\n",
    );
    assert_eq!(
        links(&mut client, "tank.ladder").expect("links"),
        ["Tänk 🛑 -> tank.grafcet (Open the spec tank.grafcet)"]
    );
    assert_eq!(
        links(&mut client, "tank.grafcet").expect("links"),
        ["Tänk -> tank.ladder (Open the ladder tank.ladder)"]
    );
}

#[test]
fn an_export_leads_to_a_spec_that_lies_beside_it() {
    for (name, fixture) in [
        ("tank.L5X", "neutralization.L5X"),
        ("tank.xml", "neutralization.xml"),
    ] {
        let mut client = client();
        client.write("tank.grafcet", "Step X0\n");
        client.open_fixture(&format!("fixtures/neutralization/{fixture}"), name);
        assert_eq!(
            links(&mut client, name).expect("links"),
            ["Neutralization -> tank.grafcet (Open the spec tank.grafcet)"]
        );
    }
}

#[test]
fn xml_that_is_no_ladder_has_no_links() {
    let mut client = client();
    client.write("note.grafcet", "Step X0\n");
    client.open("note.xml", "<note>v1</note>");
    assert_eq!(links(&mut client, "note.xml"), None);
}
