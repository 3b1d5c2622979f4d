use end_to_end::lsp::{Client, Profile, Refused};
use tower_lsp::ls_types::request::{PrepareRenameRequest, Rename};
use tower_lsp::ls_types::{
    DocumentChanges, OneOf, Position, PrepareRenameResponse, RenameParams, TextEdit, WorkspaceEdit,
};

use crate::{client, client_like};

const LADDER: &str =
    "input s %I0 // \u{1f6d1}\r\noutput v1\r\nrung: \"\u{1f6d1}\" * (s + v1) -> v1\r\n";
const SPEC: &str = "Step Xv1 for v1\r\nOutput v1\r\nSteps:\r\nXv1: |- v1\r\n//! initial v1\r\n";

fn rename(
    client: &mut Client,
    name: &str,
    at: Position,
    new: &str,
) -> Result<WorkspaceEdit, Refused> {
    let params = RenameParams {
        text_document_position: client.at(name, at),
        new_name: new.to_owned(),
        work_done_progress_params: Default::default(),
    };
    client
        .ask::<Rename>(params)
        .map(|edit| edit.expect("a name"))
}

/// The plain edits of one document.
fn edits(client: &Client, edit: &WorkspaceEdit, name: &str) -> Vec<TextEdit> {
    let uri = client.uri(name);
    if let Some(changes) = &edit.changes {
        return changes.get(&uri).cloned().unwrap_or_default();
    }
    let Some(DocumentChanges::Edits(documents)) = &edit.document_changes else {
        panic!("no edits of documents: {edit:?}");
    };
    let of = documents.iter().filter(|it| it.text_document.uri == uri);
    of.flat_map(|it| &it.edits)
        .map(|edit| match edit {
            OneOf::Left(edit) => edit.clone(),
            OneOf::Right(annotated) => annotated.text_edit.clone(),
        })
        .collect()
}

/// A document after an edit.
pub fn after(client: &Client, edit: &WorkspaceEdit, name: &str) -> String {
    client.edited(name, &edits(client, edit, name))
}

#[test]
fn every_client_renames_in_ladder_and_spec_together() {
    for profile in Profile::ALL {
        let mut client = client_like(profile);
        let marked = client.open("tank.ladder", &LADDER.replace("+ v1", "+ v$01"));
        client.open("tank.grafcet", SPEC);
        let at = marked.position(0, profile.counts_bytes());
        let edit = rename(&mut client, "tank.ladder", at, "fill valve").expect("renamed");
        assert_eq!(
            after(&client, &edit, "tank.ladder"),
            LADDER.replace("v1", "\"fill valve\"")
        );
        let spec = SPEC
            .replace("v1", "\"fill valve\"")
            .replace("X\"fill valve\"", "\"Xfill valve\"");
        assert_eq!(after(&client, &edit, "tank.grafcet"), spec);
        assert_eq!(
            edit.changes.is_some(),
            matches!(profile, Profile::Neovim | Profile::Plain)
        );
    }
}

#[test]
fn edits_name_versions_and_what_they_are_for() {
    let mut client = client();
    client.write("tank.grafcet", SPEC);
    let marked = client.open("tank.ladder", &LADDER.replace("+ v1", "+ v$01"));
    let edit = rename(
        &mut client,
        "tank.ladder",
        marked.position(0, false),
        "fill",
    )
    .expect("renamed");
    let annotations = edit.change_annotations.expect("annotations");
    let labels: Vec<&str> = annotations.values().map(|it| &*it.label).collect();
    assert_eq!(labels, ["Rename v1 to fill"]);
    let Some(DocumentChanges::Edits(documents)) = edit.document_changes else {
        panic!("no edits of documents");
    };
    let versions: Vec<_> = documents
        .iter()
        .map(|it| it.text_document.version)
        .collect();
    assert_eq!(versions, [Some(1), None]);
}

#[test]
fn a_state_is_renamed_from_the_spec() {
    let mut client = client_like(Profile::Plain);
    client.open("tank.ladder", LADDER);
    let marked = client.open("tank.grafcet", &SPEC.replace("initial v1", "initial v1$0"));
    let edit = rename(
        &mut client,
        "tank.grafcet",
        marked.position(0, false),
        "fill",
    )
    .expect("renamed");
    assert_eq!(
        after(&client, &edit, "tank.ladder"),
        LADDER.replace("v1", "fill")
    );
}

/// Renames `v1` of the neutralization to `fill` in a format; the answer is how
/// often the new name stands in the text, and the old.
fn in_fixture(path: &str, name: &str, contact: &str) -> (usize, usize) {
    let mut client = client();
    let text = std::fs::read_to_string(end_to_end::path(path)).expect("a fixture");
    let at = text.find(contact).expect("a contact") + contact.find("v1").expect("a name");
    let marked = client.open(name, &format!("{}$0{}", &text[..at], &text[at..]));
    let edit = rename(&mut client, name, marked.position(0, false), "fill").expect("renamed");
    let new = after(&client, &edit, name);
    let count = |text: &str, name: &str| {
        let words = text.split(|c: char| !c.is_alphanumeric() && c != '_');
        words.filter(|word| *word == name).count()
    };
    assert_eq!(
        count(&new, "fill") + count(&new, "v1"),
        count(&text, "v1") + count(&text, "fill")
    );
    (
        count(&new, "fill") - count(&text, "fill"),
        count(&new, "v1"),
    )
}

#[test]
fn the_same_program_is_renamed_in_every_format() {
    // What is left are descriptions: people's own words.
    let ladder = in_fixture(
        "fixtures/neutralization/neutralization.ladder",
        "t.ladder",
        "+ v1)",
    );
    assert_eq!(ladder, (3, 1));
    let l5x = in_fixture(
        "fixtures/neutralization/neutralization.L5X",
        "t.L5X",
        "XIC(v1)",
    );
    assert_eq!(l5x, (3, 1));
    let plcopen = in_fixture(
        "fixtures/neutralization/neutralization.xml",
        "t.xml",
        "<variable>v1</variable>",
    );
    assert_eq!(plcopen, (3, 0));
}

#[test]
fn neutral_text_takes_only_what_a_controller_takes() {
    let mut client = client();
    let marked = client.open(
        "rungs.txt",
        "XIC(Start$0)\r\nTON(T1,?,?);\r\nXIC(T1.DN)XIO(start)OTE(run);\r\n",
    );
    let at = marked.position(0, false);
    let edit = rename(&mut client, "rungs.txt", at, "go").expect("renamed");
    let new = "XIC(go)\r\nTON(T1,?,?);\r\nXIC(T1.DN)XIO(go)OTE(run);\r\n";
    assert_eq!(after(&client, &edit, "rungs.txt"), new);
    let refused = rename(&mut client, "rungs.txt", at, "fill valve").expect_err("a refusal");
    assert_eq!(
        refused.message,
        "`fill valve` cannot be a name: in this format names are letters, digits and single \
         underscores, and begin with no digit"
    );
}

#[test]
fn what_can_be_renamed_is_told_before() {
    let mut client = client();
    let marked = client.open(
        "tank.ladder",
        "rung: s -> \"fill$0 valve\"\ninput s %I0$1\nr$2ung: 5 -> %I0$3\n",
    );
    let mut prepare = |cursor: usize| {
        let params = client.at("tank.ladder", marked.position(cursor, false));
        client.ask::<PrepareRenameRequest>(params)
    };
    let Ok(Some(PrepareRenameResponse::RangeWithPlaceholder { range, placeholder })) = prepare(0)
    else {
        panic!("no range");
    };
    assert_eq!(placeholder, "fill valve");
    assert_eq!((range.start.character, range.end.character), (12, 22));
    assert_eq!(prepare(1), Ok(None));
    assert_eq!(prepare(2), Ok(None));
    let refused = prepare(3).expect_err("a refusal");
    assert_eq!(
        (refused.code, &*refused.message),
        (
            -32803,
            "`%I0` is another spelling of `s`; rename it where that name stands"
        )
    );
}

#[test]
fn a_name_that_is_taken_is_refused_with_a_sentence() {
    let mut client = client();
    let marked = client.open("tank.ladder", &LADDER.replace("+ v1", "+ v$01"));
    let at = marked.position(0, false);
    let refused = rename(&mut client, "tank.ladder", at, "s").expect_err("a refusal");
    assert_eq!(
        (refused.code, &*refused.message),
        (-32803, "the ladder has a `s` already")
    );
    let refused = rename(&mut client, "tank.ladder", at, "5s").expect_err("a refusal");
    assert_eq!(
        refused.message,
        "`5s` cannot be a name: it reads as a number or a time"
    );
}

#[test]
fn xml_that_is_no_ladder_has_nothing_to_rename() {
    let mut client = client();
    let marked = client.open("note.xml", "<note>v$01</note>");
    let params = client.at("note.xml", marked.position(0, false));
    assert_eq!(client.request::<PrepareRenameRequest>(params), None);
}
