use end_to_end::lsp::{Client, Profile, selected};
use serde_json::json;
use tower_lsp::ls_types::request::{CodeActionRequest, CodeActionResolveRequest};
use tower_lsp::ls_types::{
    CodeAction, CodeActionContext, CodeActionOrCommand, CodeActionParams, DocumentChangeOperation,
    DocumentChanges, OneOf, Range, ResourceOp, TextDocumentIdentifier, TextEdit, WorkspaceEdit,
};

use crate::client_like;

const LADDER: &str = "fixtures/neutralization/neutralization.ladder";

/// What is offered at the first `what` of an open document.
pub fn offered(client: &mut Client, name: &str, what: &str) -> Vec<CodeAction> {
    let text = client.text(name).to_owned();
    let at = text.find(what).expect("the place");
    let marked = end_to_end::lsp::Marked {
        text,
        cursors: vec![at],
    };
    let position = marked.position(0, false);
    let params = CodeActionParams {
        text_document: TextDocumentIdentifier {
            uri: client.uri(name),
        },
        range: Range::new(position, position),
        context: CodeActionContext::default(),
        work_done_progress_params: Default::default(),
        partial_result_params: Default::default(),
    };
    let actions = client
        .request::<CodeActionRequest>(params)
        .unwrap_or_default();
    actions
        .into_iter()
        .map(|action| match action {
            CodeActionOrCommand::CodeAction(action) => action,
            CodeActionOrCommand::Command(command) => panic!("a command: {command:?}"),
        })
        .collect()
}

/// What the action of that title changes.
fn taken(client: &mut Client, actions: &[CodeAction], title: &str) -> WorkspaceEdit {
    let titles: Vec<&str> = actions.iter().map(|it| &*it.title).collect();
    let action = actions.iter().find(|it| it.title.starts_with(title));
    let action = action
        .unwrap_or_else(|| panic!("no {title} in {titles:#?}"))
        .clone();
    let edit = action.edit.clone();
    edit.unwrap_or_else(|| {
        let resolved = client.request::<CodeActionResolveRequest>(action);
        resolved.edit.expect("an edit")
    })
}

/// All text edits of an edit, and whether it makes a file.
fn text_edits(edit: &WorkspaceEdit) -> (bool, Vec<TextEdit>) {
    let plain = |edits: &[OneOf<TextEdit, tower_lsp::ls_types::AnnotatedTextEdit>]| {
        let edits = edits.iter().map(|it| match it {
            OneOf::Left(edit) => edit.clone(),
            OneOf::Right(annotated) => annotated.text_edit.clone(),
        });
        edits.collect::<Vec<_>>()
    };
    match &edit.document_changes {
        Some(DocumentChanges::Edits(edits)) => (
            false,
            edits.iter().flat_map(|it| plain(&it.edits)).collect(),
        ),
        Some(DocumentChanges::Operations(operations)) => {
            let mut creates = false;
            let mut all = Vec::new();
            for operation in operations {
                match operation {
                    DocumentChangeOperation::Op(ResourceOp::Create(_)) => creates = true,
                    DocumentChangeOperation::Edit(edit) => all.extend(plain(&edit.edits)),
                    other => panic!("nobody wanted {other:?}"),
                }
            }
            (creates, all)
        }
        None => {
            let changes = edit.changes.clone().unwrap_or_default();
            (false, changes.into_values().flatten().collect())
        }
    }
}

/// `text` after `edits`.
fn edited(text: &str, edits: &[TextEdit]) -> String {
    let mut edits = edits.to_vec();
    edits.sort_by_key(|edit| (edit.range.start, edit.range.end));
    let mut out = text.to_owned();
    for edit in edits.iter().rev() {
        let old = selected(text, edit.range);
        let start = old.as_ptr() as usize - text.as_ptr() as usize;
        out.replace_range(start..start + old.len(), &edit.new_text);
    }
    out
}

const TOGETHER: &str = "Accept v1 -> v2, h and m together (AND, handover";

#[test]
fn accepting_makes_the_spec_beside_the_ladder() {
    for profile in Profile::ALL {
        let mut client = client_like(profile);
        client.open_fixture(LADDER, "tank.ladder");
        let actions = offered(&mut client, "tank.ladder", "v1) * /ls2");
        assert_eq!(actions[0].is_preferred, Some(true), "{profile:?}");
        let edit = taken(&mut client, &actions, TOGETHER);
        let (creates, edits) = text_edits(&edit);
        assert_eq!(
            creates,
            matches!(profile, Profile::VsCode | Profile::Helix),
            "{profile:?}"
        );
        let spec = edited("", &edits);
        assert!(
            spec.contains("//! accept v1 -> v2 & h & m"),
            "{profile:?}: {spec}"
        );
    }
}

#[test]
fn accepting_changes_only_what_follows_and_can_be_taken_back() {
    let mut client = client_like(Profile::VsCode);
    client.open_fixture(LADDER, "tank.ladder");
    let actions = offered(&mut client, "tank.ladder", "v1) * /ls2");
    let first = text_edits(&taken(&mut client, &actions, "Accept v1 -> v2 (handover")).1;
    let spec = edited("", &first).replace("Input s", "Input  s");
    client.open("tank.grafcet", &spec);
    let actions = offered(&mut client, "tank.ladder", "ls1 * (v3");
    let second = text_edits(&taken(&mut client, &actions, "Accept h -> v3")).1;
    let after = edited(&spec, &second);
    assert!(
        after.contains("Input  s") && after.contains("//! accept h -> v3"),
        "{after}"
    );
    client.replace_all("tank.grafcet", &after);
    let actions = offered(&mut client, "tank.grafcet", "//! accept h");
    let back = text_edits(&taken(&mut client, &actions, "Take back: h -> v3")).1;
    let back = edited(&after, &back);
    assert_eq!(back, spec);
}

#[test]
fn every_decision_is_an_edit_of_the_spec_and_can_be_taken_back() {
    for (title, decision) in [
        ("Accept v1 -> v4", "//! accept v1 -> v4"),
        ("Reject v1 -> v2", "//! reject v1 -> v2"),
        ("Start the sequence in v1", "//! initial v1"),
    ] {
        let mut client = client_like(Profile::VsCode);
        client.open_fixture(LADDER, "tank.ladder");
        let actions = offered(&mut client, "tank.ladder", "v1) * /ls2");
        let create = text_edits(&taken(&mut client, &actions, "Create the spec")).1;
        let before = edited("", &create);
        client.open("tank.grafcet", &before);
        let edits = text_edits(&taken(&mut client, &actions, title)).1;
        let after = edited(&before, &edits);
        assert!(after.lines().any(|line| line == decision), "{after}");
        client.replace_all("tank.grafcet", &after);
        let actions = offered(&mut client, "tank.ladder", "v1) * /ls2");
        let back = text_edits(&taken(&mut client, &actions, "Take back")).1;
        assert_eq!(edited(&after, &back), before, "{title}");
    }
}

#[test]
fn selected_states_may_follow_each_other_though_nobody_suggests_it() {
    let mut client = client_like(Profile::VsCode);
    let ladder = "rung: (m + $0v3) * ls1 -> v3\nrung: (s + v1$1) * /ls2 -> v1\n";
    let marked = client.open("tank.ladder", ladder);
    let params = CodeActionParams {
        text_document: TextDocumentIdentifier {
            uri: client.uri("tank.ladder"),
        },
        range: Range::new(marked.position(0, false), marked.position(1, false)),
        context: CodeActionContext::default(),
        work_done_progress_params: Default::default(),
        partial_result_params: Default::default(),
    };
    let actions = client.request::<CodeActionRequest>(params);
    let Some(CodeActionOrCommand::CodeAction(own)) = actions.into_iter().flatten().next() else {
        panic!("nothing is offered");
    };
    assert_eq!(own.title, "Accept v3 -> v1 (not suggested)");
    let edits = text_edits(&taken(&mut client, &[own], "Accept v3")).1;
    assert!(
        edited("", &edits).contains("//! accept v3 -> v1\n"),
        "{edits:?}"
    );
}

#[test]
fn a_rule_that_the_ladder_no_longer_gives_is_mended() {
    let mut client = client_like(Profile::VsCode);
    client.open_fixture(LADDER, "tank.ladder");
    let actions = offered(&mut client, "tank.ladder", "v1) * /ls2");
    let first = text_edits(&taken(&mut client, &actions, TOGETHER)).1;
    let spec = edited("", &first);
    client.open("tank.grafcet", &spec);
    assert_eq!(client.diagnostics("tank.grafcet"), []);
    client.replace("tank.ladder", "(s + v1) * /ls2", "(s + v1) * /ls2 * /as");
    let found = client.diagnostics("tank.grafcet");
    assert!(!found.is_empty());
    let stale = selected(&spec, found[0].range).to_owned();
    let actions = offered(&mut client, "tank.grafcet", &stale);
    let mended = text_edits(&taken(
        &mut client,
        &actions,
        "Take over all that the ladder gives",
    ))
    .1;
    client.replace_all("tank.grafcet", &edited(&spec, &mended));
    assert_eq!(client.diagnostics("tank.grafcet"), []);
}

#[test]
fn in_xml_the_same_is_offered() {
    for form in ["L5X", "xml"] {
        let mut client = client_like(Profile::VsCode);
        let name = format!("tank.{form}");
        client.open_fixture(
            &format!("fixtures/neutralization/neutralization.{form}"),
            &name,
        );
        let at = match form {
            "L5X" => "v1)",
            _ => "v1</variable>",
        };
        let actions = offered(&mut client, &name, at);
        taken(&mut client, &actions, TOGETHER);
    }
}

/// `kind: title` of what is offered, cut behind the first words.
fn kinds(actions: &[CodeAction]) -> Vec<String> {
    let shown = actions.iter().map(|it| {
        let kind = it.kind.as_ref().expect("a kind").as_str();
        let words: Vec<&str> = it.title.split(' ').take(4).collect();
        format!("{kind}: {}", words.join(" "))
    });
    shown.collect()
}

/// Two coils drive the same output.
const DOUBLE: &str = "rung: (a + y) * /b -> y\nrung: c -> y // again\n";

#[test]
fn the_light_bulb_of_a_rung_has_the_page_of_its_finding_and_the_way_to_a_spec() {
    let mut client = client_like(Profile::VsCode);
    client.open_plain("tank.ladder", DOUBLE);
    let actions = offered(&mut client, "tank.ladder", "y // again");
    assert_eq!(
        kinds(&actions),
        ["quickfix.gradus.explain: Explain G2002: coil driven"]
    );
    assert_eq!(actions[0].is_preferred, None);
    client.open_fixture(LADDER, "case.ladder");
    let actions = offered(&mut client, "case.ladder", "v1) * /ls2");
    assert_eq!(
        kinds(&actions).last().map(String::as_str),
        Some("refactor.gradus.convert: Create the spec beside")
    );
    let spec = text_edits(&taken(&mut client, &actions, "Create the spec")).1;
    assert!(edited("", &spec).contains("Step "), "{spec:?}");
}

#[test]
fn pages_are_offered_to_clients_that_show_them_and_of_findings_that_are_shown() {
    let explains = |client: &mut Client| {
        client.open_plain("tank.ladder", DOUBLE);
        let actions = offered(client, "tank.ladder", "y // again");
        actions.iter().any(|it| it.title.starts_with("Explain"))
    };
    assert!(explains(&mut client_like(Profile::VsCode)));
    for profile in [Profile::Helix, Profile::Eglot, Profile::Plain] {
        assert!(!explains(&mut client_like(profile)), "{profile:?}");
    }
    let settings = json!({ "diagnostics": { "ignore": ["G2002"] } });
    let executable = env!("CARGO_BIN_EXE_gradus");
    let mut client = Client::start_with(executable, Profile::VsCode, settings);
    assert!(!explains(&mut client));
}

#[test]
fn what_mends_a_rule_comes_before_what_explains_it() {
    let mut client = client_like(Profile::VsCode);
    client.open_fixture(LADDER, "tank.ladder");
    let actions = offered(&mut client, "tank.ladder", "v1) * /ls2");
    let spec = edited(
        "",
        &text_edits(&taken(&mut client, &actions, "Create the spec")).1,
    );
    client.open("tank.grafcet", &spec.replacen("/ls2 |-", "/ls3 |-", 1));
    let actions = offered(&mut client, "tank.grafcet", "/ls3 |-");
    let kinds = kinds(&actions);
    assert_eq!(
        kinds[..3],
        [
            "quickfix: Take over what the",
            "quickfix: Keep v1_starts as it",
            "quickfix: Take over all that",
        ]
    );
    let last = kinds.last().map(String::as_str);
    let explains = "quickfix.gradus.explain: Explain G3101: rule that";
    assert_eq!(last, Some(explains));
}

#[test]
fn only_the_kinds_that_are_asked_for_are_offered() {
    let mut client = client_like(Profile::VsCode);
    client.open_fixture(LADDER, "tank.ladder");
    let params = CodeActionParams {
        text_document: TextDocumentIdentifier {
            uri: client.uri("tank.ladder"),
        },
        range: Range::default(),
        context: CodeActionContext {
            only: Some(vec!["quickfix".into()]),
            ..CodeActionContext::default()
        },
        work_done_progress_params: Default::default(),
        partial_result_params: Default::default(),
    };
    assert_eq!(
        client.request::<CodeActionRequest>(params),
        Some(Vec::new())
    );
}
