//! Call hierarchy: which step follows which.

use end_to_end::lsp::{Client, selected};
use tower_lsp::ls_types::request::{
    CallHierarchyIncomingCalls, CallHierarchyOutgoingCalls, CallHierarchyPrepare,
};
use tower_lsp::ls_types::{
    CallHierarchyIncomingCallsParams, CallHierarchyItem, CallHierarchyOutgoingCallsParams,
    CallHierarchyPrepareParams, Position, Range,
};

use crate::client;

fn prepared(client: &mut Client, name: &str, at: Position) -> Option<CallHierarchyItem> {
    let params = CallHierarchyPrepareParams {
        text_document_position_params: client.at(name, at),
        work_done_progress_params: Default::default(),
    };
    let mut items = client.request::<CallHierarchyPrepare>(params)?;
    assert_eq!(items.len(), 1);
    items.pop()
}

fn said(client: &Client, item: &CallHierarchyItem, from: &[Range], text: &str) -> String {
    let file = item.uri.as_str().rsplit('/').next().expect("a name");
    let named = selected(client.text(file), item.selection_range);
    assert_eq!(named, item.name);
    let detail = item.detail.as_deref().expect("a detail");
    let from: Vec<&str> = from.iter().map(|it| selected(text, *it)).collect();
    format!("{} ({detail}) by {}", item.name, from.join(", "))
}

fn after(client: &mut Client, item: &CallHierarchyItem, text: &str) -> Vec<String> {
    let params = CallHierarchyOutgoingCallsParams {
        item: item.clone(),
        work_done_progress_params: Default::default(),
        partial_result_params: Default::default(),
    };
    let calls = client.request::<CallHierarchyOutgoingCalls>(params);
    let calls = calls.expect("an answer");
    let said = calls
        .iter()
        .map(|it| said(client, &it.to, &it.from_ranges, text));
    said.collect()
}

fn before(client: &mut Client, item: &CallHierarchyItem, text: &str) -> Vec<String> {
    let params = CallHierarchyIncomingCallsParams {
        item: item.clone(),
        work_done_progress_params: Default::default(),
        partial_result_params: Default::default(),
    };
    let calls = client.request::<CallHierarchyIncomingCalls>(params);
    let calls = calls.expect("an answer");
    let said = calls
        .iter()
        .map(|it| said(client, &it.from, &it.from_ranges, text));
    said.collect()
}

const LADDER: &str = "\
// Ä 🛑\r
rung: (s + v$01) * /ls2 -> v1\r
rung: (v1*ls2 + v2) * /ls3 -> v2\r
rung: (v2*ls3 + v3) * /s -> v3\r
";

#[test]
fn states_are_followed_by_what_is_suggested_until_something_is_accepted() {
    let mut client = client();
    let marked = client.open("tank.ladder", LADDER);
    let at = marked.position(0, false);
    let v1 = prepared(&mut client, "tank.ladder", at).expect("a state");
    assert_eq!(v1.name, "v1");
    let text = marked.text;
    assert_eq!(
        after(&mut client, &v1, &text),
        ["v2 (handover, on ls2*/ls3) by v1"]
    );
    client.open(
        "tank.grafcet",
        "//! accept v1 -> v3\r\n//! accept v2 -> v1\r\n",
    );
    assert_eq!(after(&mut client, &v1, &text)[..], ["v3 (accepted) by v1"]);
    assert_eq!(before(&mut client, &v1, &text)[..], ["v2 (accepted) by v2"]);
    client.replace("tank.grafcet", "accept v1 -> v3", "reject v1 -> v2");
    assert_eq!(after(&mut client, &v1, &text), [""; 0]);
}

#[test]
fn steps_of_a_spec_are_followed_by_its_transitions() {
    let mut client = client();
    let marked = client.open(
        "tank.grafcet",
        "Step X0, X$0ö\r\nTransitions:\r\nt1: X0*s |- @Xö\r\nt2: Xö*a |- @X0\r\n",
    );
    let at = marked.position(0, false);
    let step = prepared(&mut client, "tank.grafcet", at).expect("a step");
    let text = marked.text;
    assert_eq!(
        after(&mut client, &step, &text),
        ["X0 (t2, on a) by t2: Xö*a |- @X0"]
    );
    assert_eq!(
        before(&mut client, &step, &text),
        ["X0 (t1, on s) by t1: X0*s |- @Xö"]
    );
}

#[test]
fn the_same_states_follow_in_xml() {
    for (fixture, contact) in [
        ("neutralization.L5X", "XIC(v1)"),
        ("neutralization.xml", "<variable>v1</variable>"),
    ] {
        let mut client = client();
        let path = end_to_end::path(&format!("fixtures/neutralization/{fixture}"));
        let text = std::fs::read_to_string(path).expect("a fixture");
        let marked = contact.replace("v1", "$0v1");
        let marked = client.open(fixture, &text.replacen(contact, &marked, 1));
        let at = marked.position(0, false);
        let v1 = prepared(&mut client, fixture, at).expect("a state");
        let params = CallHierarchyOutgoingCallsParams {
            item: v1,
            work_done_progress_params: Default::default(),
            partial_result_params: Default::default(),
        };
        let calls = client.request::<CallHierarchyOutgoingCalls>(params);
        let calls = calls.expect("an answer");
        let names: Vec<&str> = calls.iter().map(|it| it.to.name.as_str()).collect();
        assert_eq!(names, ["v2", "v4", "h", "m"], "{fixture}");
    }
}

#[test]
fn what_is_no_state_has_no_neighbours() {
    let mut client = client();
    let marked = client.open("tank.ladder", "rung: $0a -> b");
    let at = marked.position(0, false);
    assert_eq!(prepared(&mut client, "tank.ladder", at), None);
    client.open("note.xml", "<note>v1</note>");
    assert_eq!(prepared(&mut client, "note.xml", Position::new(0, 7)), None);
}
