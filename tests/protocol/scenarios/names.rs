use end_to_end::lsp::{Client, Profile, selected};
use tower_lsp::ls_types::request::{
    Completion, DocumentHighlightRequest, GotoDeclaration, GotoDefinition, PrepareRenameRequest,
    References, Rename,
};
use tower_lsp::ls_types::{
    CompletionParams, CompletionResponse, DocumentHighlightParams, GotoDefinitionParams,
    GotoDefinitionResponse, Location, PrepareRenameResponse, ReferenceContext, ReferenceParams,
    RenameParams,
};

use super::{LADDER, SCENARIO, SPEC, tank, with_cursor};
use crate::rename::after;
use crate::{client_like, hover_at};

fn hover(context: &str) -> String {
    let (mut client, marked) = tank(&with_cursor(context));
    let (markup, _) =
        hover_at(&mut client, "fill.scenario", marked.position(0, false)).expect("a hover");
    markup.value
}

#[test]
fn a_name_is_shown_as_in_the_ladder_with_its_value_on_both_sides() {
    let shown = hover("=> on v$01, on Xv1");
    let begins = "**v1** `%Q0`  
Fill: holds a state (seal-in)

After scan 1:

```text
ladder       on
spec         on

turns on     s*/ls2
stays on     /ls2
turns off    ls2
";
    assert!(shown.starts_with(begins), "{shown}");
    assert!(
        shown.contains("Driven by [rung 0 of Tank](file:///"),
        "{shown}"
    );
    let shown = hover("off %Q$00");
    assert!(
        shown.contains("After scan 5:\n\n```text\nladder       off\n"),
        "{shown}"
    );
    let shown = hover("on Xv$01");
    let begins = "**Xv1**  \nstep for v1\n\nAfter scan 1:\n\n```text\nspec         on\n";
    assert!(shown.starts_with(begins), "{shown}");
}

#[test]
fn a_step_is_shown_with_all_that_is_on_after_it() {
    assert_eq!(
        hover("off s, scan 3   $0 =>"),
        "**off s, scan 3**\n\n```text\nscan          4, at 40ms\nladder        v1\n\
         active steps  Xv1\nspec          v1\n```"
    );
}

/// `file line: text`, lines counted from 1.
fn shown(client: &Client, locations: &[Location]) -> Vec<String> {
    let places = locations.iter().map(|it| {
        let file = it.uri.as_str().rsplit('/').next().expect("a name");
        let line = it.range.start.line + 1;
        format!("{file} {line}: {}", selected(client.text(file), it.range))
    });
    places.collect()
}

fn targets(answer: Option<GotoDefinitionResponse>) -> Vec<Location> {
    match answer {
        None => Vec::new(),
        Some(GotoDefinitionResponse::Link(links)) => links
            .into_iter()
            .map(|it| Location::new(it.target_uri, it.target_selection_range))
            .collect(),
        Some(other) => panic!("no links: {other:?}"),
    }
}

#[test]
fn names_lead_to_coils_steps_and_declarations() {
    for (context, definition, declaration) in [
        ("on v$01, on Xv1", "tank.ladder 5: v1", "tank.ladder 4: v1"),
        ("off %Q$00", "tank.ladder 5: v1", "tank.ladder 4: v1"),
        ("on l$0s2", "tank.ladder 3: ls2", "tank.ladder 3: ls2"),
        ("on X$0v1", "tank.grafcet 2: Xv1", "tank.grafcet 2: Xv1"),
    ] {
        let (mut client, marked) = tank(&with_cursor(context));
        let at = client.at("fill.scenario", marked.position(0, false));
        let params = |at| GotoDefinitionParams {
            text_document_position_params: at,
            work_done_progress_params: Default::default(),
            partial_result_params: Default::default(),
        };
        let found = targets(client.request::<GotoDefinition>(params(at.clone())));
        assert_eq!(shown(&client, &found), [definition], "{context}");
        let found = targets(client.request::<GotoDeclaration>(params(at)));
        assert_eq!(shown(&client, &found), [declaration], "{context}");
    }
}

fn references(
    client: &mut Client,
    name: &str,
    position: tower_lsp::ls_types::Position,
) -> Vec<String> {
    let params = ReferenceParams {
        text_document_position: client.at(name, position),
        context: ReferenceContext {
            include_declaration: true,
        },
        work_done_progress_params: Default::default(),
        partial_result_params: Default::default(),
    };
    let found = client.request::<References>(params).unwrap_or_default();
    shown(client, &found)
}

#[test]
fn references_are_those_in_ladder_spec_and_scenarios() {
    let wanted = [
        "tank.ladder 4: v1",
        "tank.ladder 5: v1",
        "tank.ladder 5: v1",
        "tank.grafcet 2: Xv1",
        "tank.grafcet 2: v1",
        "tank.grafcet 5: v1",
        "tank.grafcet 8: Xv1",
        "tank.grafcet 9: Xv1",
        "tank.grafcet 11: Xv1",
        "tank.grafcet 11: v1",
        "fill.scenario 4: v1",
        "fill.scenario 4: Xv1",
        "fill.scenario 5: v1",
        "fill.scenario 6: %Q0",
    ];
    let (mut client, marked) = tank(&with_cursor("on v$01, on"));
    let at = marked.position(0, false);
    assert_eq!(references(&mut client, "fill.scenario", at), wanted);
    client.close("tank.ladder");
    let marked = client.open("tank.ladder", &LADDER.replace("+ v1", "+ v$01"));
    let at = marked.position(0, false);
    assert_eq!(references(&mut client, "tank.ladder", at), wanted);
}

#[test]
fn the_same_thing_lights_up_under_all_its_names() {
    let (mut client, marked) = tank(&with_cursor("on v$01, on"));
    let params = DocumentHighlightParams {
        text_document_position_params: client.at("fill.scenario", marked.position(0, false)),
        work_done_progress_params: Default::default(),
        partial_result_params: Default::default(),
    };
    let found = client.request::<DocumentHighlightRequest>(params);
    let text = client.text("fill.scenario");
    let found = found.expect("highlights");
    let lit: Vec<&str> = found.iter().map(|it| selected(text, it.range)).collect();
    assert_eq!(lit, ["v1", "Xv1", "v1", "%Q0"]);
}

#[test]
fn every_client_renames_in_ladder_spec_and_scenarios_together() {
    for profile in Profile::ALL {
        let mut client = client_like(profile);
        let marked = client.open("tank.ladder", &LADDER.replace("+ v1", "+ v$01"));
        client.open("tank.grafcet", SPEC);
        client.open("fill.scenario", SCENARIO);
        client.open("other.scenario", "on s => on q\n");
        let params = RenameParams {
            text_document_position: client.at("tank.ladder", marked.position(0, true)),
            new_name: "fill valve".to_owned(),
            work_done_progress_params: Default::default(),
        };
        let edit = client.request::<Rename>(params).expect("renamed");
        let ladder = LADDER.replace("v1", "\"fill valve\"");
        assert_eq!(after(&client, &edit, "tank.ladder"), ladder);
        let scenario = SCENARIO
            .replace("Xv1", "\"Xfill valve\"")
            .replace("v1", "\"fill valve\"");
        assert_eq!(after(&client, &edit, "fill.scenario"), scenario);
        assert_eq!(after(&client, &edit, "other.scenario"), "on s => on q\n");
    }
}

#[test]
fn a_scenario_that_is_not_open_is_renamed_too_and_a_name_is_renamed_from_it() {
    let mut client = client_like(Profile::Plain);
    client.open("tank.ladder", LADDER);
    client.write("refill.scenario", "for tank.ladder\non s => on v1\n");
    client.write("tank.scenario", "off s => only off v1\n");
    let marked = client.open("fill.scenario", "for tank.ladder\non s => on v$01\n");
    let params = client.at("fill.scenario", marked.position(0, false));
    let prepared = client.request::<PrepareRenameRequest>(params.clone());
    assert!(matches!(
        prepared,
        Some(PrepareRenameResponse::RangeWithPlaceholder { placeholder, .. }) if placeholder == "v1"
    ));
    let params = RenameParams {
        text_document_position: params,
        new_name: "fill".to_owned(),
        work_done_progress_params: Default::default(),
    };
    let edit = client.request::<Rename>(params).expect("renamed");
    let changes = edit.changes.as_ref().expect("plain changes");
    let mut files: Vec<&str> = changes
        .keys()
        .map(|uri| uri.as_str().rsplit('/').next().expect("a name"))
        .collect();
    files.sort_unstable();
    assert_eq!(
        files,
        [
            "fill.scenario",
            "refill.scenario",
            "tank.ladder",
            "tank.scenario"
        ]
    );
    for name in ["refill.scenario", "tank.scenario"] {
        let text = std::fs::read_to_string(client.path(name)).expect("a file");
        client.open_plain(name, &text);
        let new = text.replace("v1", "fill");
        assert_eq!(after(&client, &edit, name), new);
    }
}

#[test]
fn a_name_that_a_scenario_has_already_is_refused() {
    let (mut client, _) = tank("for tank.ladder\non s => on v1, off fill\n");
    client.close("tank.ladder");
    let marked = client.open("tank.ladder", &LADDER.replace("+ v1", "+ v$01"));
    let params = RenameParams {
        text_document_position: client.at("tank.ladder", marked.position(0, false)),
        new_name: "fill".to_owned(),
        work_done_progress_params: Default::default(),
    };
    let refused = client.ask::<Rename>(params).expect_err("a refusal");
    assert_eq!(
        (refused.code, &*refused.message),
        (
            -32803,
            "fill.scenario: a scenario speaks of a `fill` already"
        )
    );
}

#[test]
fn names_and_words_can_be_completed() {
    for (scenario, first, has) in [
        ("for tank.ladder\non $0\n", "s", "ls2"),
        ("for tank.ladder\non s => on $0\n", "v1", "Xv1"),
        ("for tank.ladder\non s => $0\n", "only", "v1"),
        ("for $0\n", "fill.ladder", "tank.ladder"),
        ("$0", "on", "scenario"),
    ] {
        let (mut client, _) = tank("");
        client.write("fill.ladder", LADDER);
        client.close("fill.scenario");
        let marked = client.open("tank.scenario", scenario);
        let params = CompletionParams {
            text_document_position: client.at("tank.scenario", marked.position(0, false)),
            work_done_progress_params: Default::default(),
            partial_result_params: Default::default(),
            context: None,
        };
        let answer = client.request::<Completion>(params).expect("completions");
        let CompletionResponse::List(list) = answer else {
            panic!("no list");
        };
        let labels: Vec<&str> = list.items.iter().map(|it| &*it.label).collect();
        assert_eq!(labels.first(), Some(&first), "{scenario}: {labels:?}");
        let is_there = labels.contains(&has) || has == "Xv1";
        assert!(is_there, "{scenario}: {labels:?}");
    }
}
