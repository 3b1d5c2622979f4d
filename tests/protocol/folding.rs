//! What folds.

use end_to_end::lsp::Client;
use tower_lsp::ls_types::request::FoldingRangeRequest;
use tower_lsp::ls_types::{FoldingRangeKind, FoldingRangeParams, TextDocumentIdentifier};

use crate::client;

/// `first..last` line, counted from 1, `//` behind comments.
fn folds(client: &mut Client, name: &str) -> Option<Vec<String>> {
    let params = FoldingRangeParams {
        text_document: TextDocumentIdentifier {
            uri: client.uri(name),
        },
        work_done_progress_params: Default::default(),
        partial_result_params: Default::default(),
    };
    let found = client.request::<FoldingRangeRequest>(params)?;
    let shown = found.iter().map(|it| {
        let mark = match it.kind {
            Some(FoldingRangeKind::Comment) => " //",
            _ => "",
        };
        format!("{}..{}{mark}", it.start_line + 1, it.end_line + 1)
    });
    Some(shown.collect())
}

#[test]
fn a_ladder_folds_by_routines_rungs_and_comments() {
    let mut client = client();
    let text = "\
// Ein Tänk\r
// 🛑\r
program Tank\r
rung: (s + v1)\r
    * /ls2 -> v1\r
\r
routine Doors\r
rung: a -> b\r
";
    client.open("tank.ladder", text);
    let wanted = ["1..2 //", "3..5", "4..5", "7..8"];
    assert_eq!(folds(&mut client, "tank.ladder").expect("folds"), wanted);
}

#[test]
fn a_spec_folds_by_sections() {
    let mut client = client();
    let text = "Step X0\nTransitions:\nt1: X0 |- @X0\nNever:\nn1: X0\n//! accept a -> b\n//! accept b -> c\n";
    client.open("tank.grafcet", text);
    assert_eq!(
        folds(&mut client, "tank.grafcet").expect("folds"),
        ["2..3", "4..5", "6..7"]
    );
}

#[test]
fn rungs_in_xml_fold_and_foreign_xml_does_not() {
    for fixture in ["neutralization.L5X", "neutralization.xml"] {
        let mut client = client();
        let text = client.open_fixture(&format!("fixtures/neutralization/{fixture}"), fixture);
        let found = folds(&mut client, fixture).expect("folds");
        let routine = found.first().expect("a routine");
        let start: usize = routine
            .split_once("..")
            .and_then(|(start, _)| start.parse().ok())
            .expect("a line");
        let line = text.lines().nth(start - 1).expect("in the text");
        assert!(
            line.contains("<Routine ") || line.contains("<LD"),
            "{fixture}: {line}"
        );
        assert!(found.len() > 8, "{fixture}: {found:?}");
    }
    let mut client = client();
    client.open("note.xml", "<note>\nv1\n</note>");
    assert_eq!(folds(&mut client, "note.xml"), None);
}
