//! The search for sequences of inputs that show which state follows which.

use end_to_end::lsp::{Client, Profile};
use serde_json::{Value, json};
use tower_lsp::ls_types::Position;

use crate::commands::ask;
use crate::{client, hover_at};

const TANK: &str = "\
program Tank
input s
input ls2
input empty
output v1
output v2
rung: (s + v1) * /ls2 * /v2 -> v1
rung: (ls2 + v2) * /empty -> v2
";

/// A plant in which nothing is empty at ls2.
const LEVELS: &str = "\
Grafcet Tank
Environment:
e1: ls2 |- /empty
e2: s |- /ls2
";

fn search(client: &mut Client, name: &str) -> Value {
    let argument = json!({ "uri": client.uri(name) });
    let answer = ask(client, "gradus.search", argument);
    answer.expect("no refusal").expect("an answer")
}

/// What the hover on a coil says of its neighbours.
fn neighbours(client: &mut Client, line: u32) -> Vec<String> {
    let at = Position::new(line, 11);
    let (markup, _) = hover_at(client, "tank.ladder", at).expect("a hover");
    let lines = markup.value.lines();
    let lines = lines.skip_while(|line| !line.starts_with("follows"));
    lines
        .take_while(|line| !line.is_empty())
        .map(str::to_owned)
        .collect()
}

#[test]
fn hovers_tell_what_was_seen_until_the_ladder_is_edited() {
    let mut client = client();
    client.open("tank.ladder", TANK);
    let before = neighbours(&mut client, 6);
    let answer = search(&mut client, "tank.ladder");
    assert_eq!(answer["summary"], "2 successions seen");
    assert_eq!(
        (&answer["witnessed"], &answer["delayed"]),
        (&json!(0), &json!(1))
    );
    assert_eq!(
        neighbours(&mut client, 6),
        [
            "follows      v2 (delayed, seen after: on ls2; on empty; off ls2; on s)",
            "followed by  v2 (handover on ls2*/empty, seen after: on s; on ls2)",
        ]
    );
    client.replace("tank.ladder", "program Tank", "program Tank // Edited");
    assert_eq!(neighbours(&mut client, 6), before);
}

#[test]
fn the_rules_of_the_spec_count_typed_or_saved() {
    let mut client = client();
    client.open("tank.ladder", TANK);
    client.open("tank.grafcet", LEVELS);
    let answer = search(&mut client, "tank.grafcet");
    assert_eq!(
        answer["summary"],
        "2 successions seen in plants that obey 2 environment rules"
    );
}

#[test]
fn what_was_seen_can_be_accepted() {
    let mut client = client();
    client.open("tank.ladder", TANK);
    search(&mut client, "tank.ladder");
    let actions = crate::code_action::offered(&mut client, "tank.ladder", "-> v1");
    let titles = actions.iter().map(|it| it.title.as_str());
    let accepts = titles.filter(|title| title.starts_with("Accept"));
    assert_eq!(
        accepts.collect::<Vec<&str>>(),
        [
            "Accept v1 -> v2 (handover on ls2*/empty)",
            "Accept v2 -> v1 (delayed on s*/ls2)",
        ]
    );
}

#[test]
fn all_that_is_seen_can_be_accepted_at_once() {
    let mut client = client();
    client.open("tank.ladder", TANK);
    let argument = json!({ "uri": client.uri("tank.ladder"), "accept": "witnessed" });
    let converted = ask(&mut client, "gradus.convert", argument);
    assert_eq!(
        converted.expect("no refusal").expect("an answer")["changed"],
        true
    );
    // The search that it took is kept.
    let seen = neighbours(&mut client, 6);
    assert!(
        seen.iter().any(|line| line.contains("seen after")),
        "{seen:?}"
    );
    let spec = format!("{:?}", client.applied());
    assert!(spec.contains("@Xv2"), "{spec}");
}

#[test]
fn a_ladder_that_is_not_open_is_refused() {
    let mut client = crate::client_like(Profile::Helix);
    client.open("tank.grafcet", LEVELS);
    let argument = json!({ "uri": client.uri("tank.grafcet") });
    let refused = ask(&mut client, "gradus.search", argument).expect_err("a refusal");
    assert_eq!(refused.code, -32602);
}
