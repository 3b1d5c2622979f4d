use end_to_end::lsp::{Client, Profile};
use serde_json::Value;
use tower_lsp::ls_types::request::{Completion, ResolveCompletionItem};
use tower_lsp::ls_types::{
    CompletionItem, CompletionParams, CompletionResponse, CompletionTextEdit, Documentation,
    InsertTextFormat,
};

use crate::{client, client_like};

/// A tank whose second valve follows its first.
pub const TANK: &str = "\
input s   %I0 // Start
input ls2     // Level
input ls3
output v1 %Q0 // Fill
output v2     // Dose

rung: (s + v1) * /ls2 -> v1
rung: (v2 + ls2*/v1) * /ls3 -> v2
";

/// What can be typed at the cursor of a document.
fn completed(
    client: &mut Client,
    name: &str,
    text: &str,
    counts_bytes: bool,
) -> Vec<CompletionItem> {
    let marked = client.open(name, text);
    let at = marked.position(0, counts_bytes);
    let params = CompletionParams {
        text_document_position: client.at(name, at),
        work_done_progress_params: Default::default(),
        partial_result_params: Default::default(),
        context: None,
    };
    match client.request::<Completion>(params) {
        Some(CompletionResponse::List(list)) => {
            let sorted = list.items.is_sorted_by_key(|it| it.sort_text.clone());
            assert!(sorted, "best first");
            list.items
        }
        None => Vec::new(),
        Some(CompletionResponse::Array(_)) => panic!("a list without a word on its order"),
    }
}

fn labels(items: &[CompletionItem]) -> Vec<&str> {
    items.iter().map(|it| &*it.label).collect()
}

/// The text that an item puts in, and the columns that it replaces.
fn edit(item: &CompletionItem) -> (&str, u32, u32) {
    match &item.text_edit {
        Some(CompletionTextEdit::Edit(edit)) => {
            let (from, to) = (edit.range.start.character, edit.range.end.character);
            (&edit.new_text, from, to)
        }
        other => panic!("no edit: {other:?}"),
    }
}

#[test]
fn a_contact_is_a_variable_with_what_is_known_of_it() {
    let mut client = client();
    let text = format!("{TANK}// \u{1f6d1}\r\nrung: s * l$0");
    let items = completed(&mut client, "tank.ladder", &text, false);
    assert_eq!(labels(&items)[..5], ["s", "ls2", "ls3", "v1", "v2"]);
    assert_eq!(edit(&items[1]), ("ls2", 10, 11));
    assert_eq!(items[0].detail.as_deref(), Some("input  %I0  Start"));

    let resolved = client.request::<ResolveCompletionItem>(items[3].clone());
    let Some(Documentation::MarkupContent(markup)) = resolved.documentation else {
        panic!("no documentation");
    };
    assert!(
        markup
            .value
            .starts_with("v1  %Q0\nFill: holds a state (seal-in)"),
        "{}",
        markup.value
    );
}

#[test]
fn boxes_are_snippets_where_the_client_has_them() {
    let text = format!("{TANK}rung: s -> $0");
    for (profile, expected, format) in [
        (
            Profile::VsCode,
            "TON(${1:timer}, ${2:5s})",
            Some(InsertTextFormat::SNIPPET),
        ),
        (Profile::Eglot, "TON(", None),
    ] {
        let items = completed(&mut client_like(profile), "tank.ladder", &text, false);
        let timer = items.iter().find(|it| it.label == "TON").expect("a timer");
        assert_eq!(
            (edit(timer).0, timer.insert_text_format),
            (expected, format)
        );
    }
}

#[test]
fn of_very_many_variables_those_are_sent_that_hold_what_is_typed() {
    let inputs: String = (0..1500)
        .map(|number| format!("input x{number}\n"))
        .collect();
    let mut client = client();
    let items = completed(&mut client, "a.ladder", &format!("{inputs}rung: $0"), false);
    assert_eq!(items.len(), 1000);
    let items = completed(
        &mut client,
        "b.ladder",
        &format!("{inputs}rung: X149$0"),
        false,
    );
    assert_eq!(labels(&items)[..3], ["x149", "x1490", "x1491"]);
    assert_eq!(items.len(), 11);
}

#[test]
fn in_neutral_text_instructions_and_tags_can_be_typed() {
    let mut client = client();
    let items = completed(
        &mut client,
        "rungs.txt",
        "XIC(start)OTE(run);\nXIC($0)OTE(run);\n",
        false,
    );
    assert_eq!(labels(&items), ["run", "start"]);
    let items = completed(&mut client, "more.txt", "XIC(start)OTE(run);\nX$0", false);
    let contact = items
        .iter()
        .find(|it| it.label == "XIC")
        .expect("a contact");
    assert_eq!(edit(contact), ("XIC(${1:Data Bit})", 0, 1));
}

#[test]
fn in_xml_nothing_can_be_typed() {
    let mut client = client();
    for path in ["neutralization.L5X", "neutralization.xml"] {
        let text =
            std::fs::read_to_string(end_to_end::path(&format!("fixtures/neutralization/{path}")));
        let text = text.expect("a fixture").replacen("v1", "v$01", 1);
        assert_eq!(completed(&mut client, path, &text, false), []);
    }
    assert_eq!(
        completed(&mut client, "note.xml", "<note>v$01</note>", false),
        []
    );
}

#[test]
fn a_spec_goes_on_with_decisions_best_first() {
    let mut client = client();
    client.open("tank.ladder", TANK);
    let items = completed(&mut client, "tank.grafcet", "// \u{e4}\n//! acc$0", false);
    let first = &items[0];
    assert_eq!(edit(first), ("//! accept v1 -> v2", 0, 7));
    assert_eq!(first.filter_text.as_deref(), Some("//! accept v1 -> v2"));
    assert_eq!(first.detail.as_deref(), Some("possible"));
    let Some(Documentation::String(reason)) = &first.documentation else {
        panic!("no documentation");
    };
    assert_eq!(
        reason,
        "What ends v1 and what starts v2 share a variable and can hold together. \
         Condition: /v1*ls2*/ls3 + v2*ls2*/ls3"
    );
}

/// What the ladder gives once `v1 -> v2` is accepted, but for one rule.
pub const LACKING: &str = "\
Step v1_waits  // nothing runs yet
Step Xv1 for v1
Step Dv1  // v1 has ended; waits for what follows
Step Xv2 for v2
Transition v1_waits_to_v1, v1_to_Dv1, Dv1_to_v2, v2_to_v1_waits
Input s, ls2, ls3
Output v1, v2
Marking v1_waits

Transitions:
v1_waits_to_v1: v1_waits*s*/ls2 |- @Xv1
$0
Dv1_to_v2: Dv1*ls2*/ls3 |- @Xv2
v2_to_v1_waits: Xv2*ls3 |- @v1_waits

Steps:
Xv1: |- v1
Xv2: |- v2

//! accept v1 -> v2
";

#[test]
fn a_rule_that_the_ladder_gives_and_the_spec_lacks_comes_first() {
    let mut client = client();
    client.open("tank.ladder", TANK);
    let items = completed(&mut client, "tank.grafcet", LACKING, false);
    assert_eq!(edit(&items[0]), ("v1_to_Dv1: Xv1*ls2 |- @Dv1", 0, 0));
    assert_eq!(items[0].detail.as_deref(), Some("the ladder gives it"));
    let reason = "The ladder goes from Xv1 to Dv1 on ls2; the spec has no such rule.";
    assert_eq!(
        items[0].documentation,
        Some(Documentation::String(reason.to_owned()))
    );
}

#[test]
fn weaker_evidence_than_the_user_wants_is_left_out() {
    let settings: Value = serde_json::json!({ "suggestions": { "evidence": "handover" } });
    let mut client = Client::start_with(env!("CARGO_BIN_EXE_gradus"), Profile::Plain, settings);
    client.open("tank.ladder", TANK);
    let items = completed(&mut client, "tank.grafcet", "//! $0", false);
    assert_eq!(labels(&items)[0], "accept");
}

#[test]
fn a_spec_knows_its_steps_and_the_ladders_variables() {
    let mut client = client_like(Profile::Neovim);
    client.open("tank.ladder", TANK);
    let spec = "Step \"X ä\" for v1, X2 for v2\r\nTransition t1\r\nTransitions:\r\nt1: \"X ä\"*$0 |- @X2\r\n";
    let items = completed(&mut client, "tank.grafcet", spec, true);
    assert_eq!(
        labels(&items),
        ["s", "ls2", "ls3", "v1", "v2", "X \u{e4}", "X2"]
    );
    assert_eq!(edit(&items[5]), ("\"X \u{e4}\"", 11, 11));
}
