use end_to_end::lsp::{Client, Marked, Profile};
use tower_lsp::ls_types::request::{Formatting, OnTypeFormatting, RangeFormatting};
use tower_lsp::ls_types::{
    DocumentFormattingParams, DocumentOnTypeFormattingParams, DocumentRangeFormattingParams,
    FormattingOptions, Range, TextDocumentIdentifier, TextEdit,
};

use crate::{client, client_like};

fn document(client: &Client, name: &str) -> TextDocumentIdentifier {
    TextDocumentIdentifier {
        uri: client.uri(name),
    }
}

/// The whole document laid out; `None` where it has no layout.
fn whole(client: &mut Client, name: &str) -> Option<Vec<TextEdit>> {
    let params = DocumentFormattingParams {
        text_document: document(client, name),
        options: FormattingOptions::default(),
        work_done_progress_params: Default::default(),
    };
    client.request::<Formatting>(params)
}

const ODD: &str =
    "input   a // \u{1f6d1}\r\n\r\n\r\n/*\r\nrung \"\u{1f6d1}\":a*b->c\r\nrung:(a+\r\n";

#[test]
fn a_ladder_is_laid_out_by_small_edits() {
    for profile in Profile::ALL {
        let mut client = client_like(profile);
        client.open("odd.ladder", ODD);
        let edits = whole(&mut client, "odd.ladder").expect("a layout");
        let laid =
            "input a  // \u{1f6d1}\r\n\r\n/*\r\nrung \"\u{1f6d1}\": a * b -> c\r\nrung:(a+\r\n";
        assert_eq!(client.edited("odd.ladder", &edits), laid);
        assert!(
            edits.iter().all(|edit| edit.new_text.len() <= 2),
            "{edits:?}"
        );
    }
}

#[test]
fn a_spec_is_laid_out_and_what_is_laid_out_stays() {
    let mut client = client();
    client.open(
        "tank.grafcet",
        "step  a,b\nTransitions:\nt1:a*m|-@b\n? odd\n",
    );
    let edits = whole(&mut client, "tank.grafcet").expect("a layout");
    let laid = "Step a, b\n\nTransitions:\nt1: a*m |- @b\n? odd\n";
    assert_eq!(client.edited("tank.grafcet", &edits), laid);
    client.replace_all("tank.grafcet", laid);
    assert_eq!(whole(&mut client, "tank.grafcet"), Some(Vec::new()));
}

#[test]
fn other_texts_have_no_layout() {
    let mut client = client();
    client.open_fixture("fixtures/neutralization/neutralization.L5X", "tank.L5X");
    client.open_fixture("fixtures/neutralization/neutralization.xml", "tank.xml");
    client.open("rungs.txt", "XIC(a)  OTE(b);");
    client.open("note.xml", "<note>  </note>");
    for name in ["tank.L5X", "tank.xml", "rungs.txt", "note.xml"] {
        assert_eq!(whole(&mut client, name), None);
    }
}

#[test]
fn only_statements_in_the_range_are_laid_out() {
    let mut client = client();
    let marked: Marked = client.open("a.ladder", "rung:a->b\nrung:c$0\n  ->d\nrung:e->f\n");
    let at = marked.position(0, false);
    let params = DocumentRangeFormattingParams {
        text_document: document(&client, "a.ladder"),
        range: Range::new(at, at),
        options: FormattingOptions::default(),
        work_done_progress_params: Default::default(),
    };
    let edits = client.request::<RangeFormatting>(params).expect("a layout");
    assert_eq!(
        client.edited("a.ladder", &edits),
        "rung:a->b\nrung: c -> d\nrung:e->f\n"
    );
}

#[test]
fn a_new_line_lays_out_the_line_above() {
    let mut client = client_like(Profile::Helix);
    for (name, before, after) in [
        (
            "a.ladder",
            "rung:a->b\nrung \"\u{e4}\":c->d\n$0\n",
            "rung:a->b\nrung \"\u{e4}\": c -> d\n\n",
        ),
        (
            "a.grafcet",
            "Transitions:\nt1:a|-@b\n$0",
            "Transitions:\nt1: a |- @b\n",
        ),
        ("b.ladder", "rung:(a +\n    $0", "rung:(a +\n    "),
    ] {
        let marked = client.open(name, before);
        let params = DocumentOnTypeFormattingParams {
            text_document_position: client.at(name, marked.position(0, true)),
            ch: "\n".to_owned(),
            options: FormattingOptions::default(),
        };
        let edits = client
            .request::<OnTypeFormatting>(params)
            .expect("a layout");
        assert_eq!(client.edited(name, &edits), after);
    }
}
