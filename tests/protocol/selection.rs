//! How a selection grows.

use end_to_end::lsp::{Client, Profile, selected};
use tower_lsp::ls_types::request::SelectionRangeRequest;
use tower_lsp::ls_types::{Position, SelectionRange, SelectionRangeParams, TextDocumentIdentifier};

use crate::{client, client_like};

fn grown(client: &mut Client, name: &str, positions: &[Position]) -> Option<Vec<SelectionRange>> {
    let params = SelectionRangeParams {
        text_document: TextDocumentIdentifier {
            uri: client.uri(name),
        },
        positions: positions.to_vec(),
        work_done_progress_params: Default::default(),
        partial_result_params: Default::default(),
    };
    client.request::<SelectionRangeRequest>(params)
}

/// What is selected, from inside out.
fn texts<'t>(text: &'t str, selection: &SelectionRange) -> Vec<&'t str> {
    let chain = std::iter::successors(Some(selection), |it| it.parent.as_deref());
    chain.map(|it| selected(text, it.range)).collect()
}

#[test]
fn from_a_contact_over_its_branch_to_the_rung() {
    let mut client = client();
    let text = "program Tänk\r\nrung: (s + \"🛑\"*v$01) * /ls2 -> v1\r\nrung: a -> b\r\n";
    let marked = client.open("tank.ladder", text);
    let at = marked.position(0, false);
    let found = grown(&mut client, "tank.ladder", &[at, Position::new(0, 0)]).expect("selections");
    assert_eq!(found.len(), 2);
    let rung = "rung: (s + \"🛑\"*v1) * /ls2 -> v1";
    assert_eq!(
        texts(&marked.text, &found[0])[..5],
        [
            "v1",
            "\"🛑\"*v1",
            "(s + \"🛑\"*v1)",
            "(s + \"🛑\"*v1) * /ls2",
            rung
        ]
    );
    assert_eq!(texts(&marked.text, &found[1]), [&*marked.text]);
}

#[test]
fn in_xml_from_an_operand_to_its_rung_and_routine() {
    let mut client = client();
    let text = std::fs::read_to_string(end_to_end::path(
        "fixtures/neutralization/neutralization.L5X",
    ))
    .expect("a fixture");
    let text = text.replacen("XIC(v1)", "XIC(v$01)", 1);
    let marked = client.open("n.L5X", &text);
    let at = marked.position(0, false);
    let found = grown(&mut client, "n.L5X", &[at]).expect("selections");
    let texts = texts(&marked.text, &found[0]);
    assert_eq!(texts[..3], ["v1", "XIC(v1)", "[XIC(s) ,XIC(v1) ]"]);
    let begins = |start: &str| texts.iter().any(|it| it.starts_with(start));
    assert!(begins("<Rung ") && begins("<Routine "), "{texts:?}");
}

#[test]
fn in_plcopen_from_an_operand_over_its_branches_to_the_rung() {
    let mut client = client();
    let path = end_to_end::path("fixtures/neutralization/neutralization.xml");
    let text = std::fs::read_to_string(path).expect("a fixture");
    let text = text.replacen("<variable>v1</variable>", "<variable>v$01</variable>", 1);
    let marked = client.open("n.xml", &text);
    let at = marked.position(0, false);
    let found = grown(&mut client, "n.xml", &[at]).expect("selections");
    let texts = texts(&marked.text, &found[0]);
    // The contacts that each selection holds.
    let held = texts.iter().map(|text| {
        let parts = text.split("<variable>").skip(1);
        let names = parts.filter_map(|it| it.split_once("</variable>"));
        names.map(|(name, _)| name).collect::<Vec<_>>().join(" ")
    });
    let held: Vec<String> = held.take(5).collect();
    assert_eq!(held[..4], ["", "v1", "s v1", "s v1 ls2"], "{texts:#?}");
    assert!(held[4].starts_with("s v1 ls2 v1"), "{held:?}");
}

#[test]
fn in_a_spec_from_a_name_to_its_section() {
    let mut client = client_like(Profile::Neovim);
    let text = "Step Xö\nTransitions:\nt1: Xö*(a + $0b) |- @Xö\n";
    let marked = client.open("tank.grafcet", text);
    let at = marked.position(0, true);
    let found = grown(&mut client, "tank.grafcet", &[at]).expect("selections");
    let chain = std::iter::successors(Some(&found[0]), |it| it.parent.as_deref());
    let ranges: Vec<_> = chain
        .map(|it| {
            (
                it.range.start.line,
                it.range.start.character,
                it.range.end.character,
            )
        })
        .collect();
    // Columns in bytes: `ö` has two.
    assert_eq!(
        ranges,
        [
            (2, 13, 14),
            (2, 8, 15),
            (2, 4, 15),
            (2, 0, 23),
            (1, 0, 23),
            (0, 0, 0)
        ]
    );
}

#[test]
fn xml_that_is_no_ladder_is_selected_by_others() {
    let mut client = client();
    client.open("note.xml", "<note>v1</note>");
    assert_eq!(grown(&mut client, "note.xml", &[Position::new(0, 7)]), None);
}
