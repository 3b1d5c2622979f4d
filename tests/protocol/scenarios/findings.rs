use end_to_end::lsp::{Client, Profile};
use serde_json::json;
use tower_lsp::ls_types::notification::DidChangeWatchedFiles;
use tower_lsp::ls_types::{
    DiagnosticSeverity, DidChangeWatchedFilesParams, FileChangeType, FileEvent, NumberOrString,
};

use super::{LADDER, SCENARIO, SPEC, tank};
use crate::client_like;

/// `line: code message [file line: other place]`, lines counted from 1.
fn said(client: &mut Client, name: &str) -> Vec<String> {
    let found = client.diagnostics(name).into_iter();
    let shown = found.map(|it| {
        let code = match it.code {
            Some(NumberOrString::String(code)) => code,
            other => panic!("no code: {other:?}"),
        };
        let mut line = format!("{}: {code} {}", it.range.start.line + 1, it.message);
        for related in it.related_information.unwrap_or_default() {
            let file = related.location.uri.as_str().rsplit('/').next();
            let at = related.location.range.start.line + 1;
            line += &format!(" [{} {at}: {}]", file.unwrap_or_default(), related.message);
        }
        line
    });
    shown.collect()
}

#[test]
fn an_expectation_fails_and_holds_again_while_the_unsaved_ladder_is_edited() {
    let (mut client, _) = tank(SCENARIO);
    assert_eq!(said(&mut client, "fill.scenario"), [""; 0]);
    client.replace("tank.ladder", "/ls2", "ls2");
    assert_eq!(
        said(&mut client, "fill.scenario"),
        [
            "4: G5003 v1 should be on after scan 1, but the ladder has it off \
             [tank.ladder 5: rung 0 of Tank drives v1]",
            "5: G5003 v1 should be on after scan 4, but the ladder has it off \
             [tank.ladder 5: rung 0 of Tank drives v1]",
        ]
    );
    client.replace("tank.ladder", "* ls2", "* /ls2");
    assert_eq!(said(&mut client, "fill.scenario"), [""; 0]);
}

#[test]
fn the_spec_fails_by_itself_with_its_step_beside_it() {
    let (mut client, _) = tank(SCENARIO);
    client.replace("tank.grafcet", "X0*s*/ls2", "X0*s*/s");
    assert_eq!(
        said(&mut client, "fill.scenario"),
        [
            "4: G5003 v1 should be on after scan 1, but the spec has it off \
             [tank.grafcet 11: what the spec says of v1]",
            "4: G5003 Xv1 should be on after scan 1, but the spec has it off \
             [tank.grafcet 2: what the spec says of Xv1]",
            "5: G5003 v1 should be on after scan 4, but the spec has it off \
             [tank.grafcet 11: what the spec says of v1]",
        ]
    );
    client.replace("fill.scenario", ", on Xv1", "");
    assert_eq!(said(&mut client, "fill.scenario").len(), 2);
}

#[test]
fn who_cannot_pull_is_told_when_the_ladder_changes() {
    let mut client = client_like(Profile::Helix);
    client.open("tank.ladder", LADDER);
    client.open("fill.scenario", "for tank.ladder\non s => on v1\n");
    assert_eq!(said(&mut client, "fill.scenario"), [""; 0]);
    client.replace("tank.ladder", "/ls2", "ls2");
    let told = said(&mut client, "fill.scenario");
    assert_eq!(told.len(), 1, "{told:?}");
    assert!(
        told[0].starts_with("2: G5003 v1 should be on after scan 1"),
        "{told:?}"
    );
    client.replace("tank.ladder", "* ls2", "* /ls2");
    assert_eq!(said(&mut client, "fill.scenario"), [""; 0]);
}

#[test]
fn who_shows_no_other_places_reads_of_them() {
    let mut client = client_like(Profile::Plain);
    client.open("tank.ladder", LADDER);
    client.open("fill.scenario", "for tank.ladder\non s => off v1\n");
    assert_eq!(
        said(&mut client, "fill.scenario"),
        [
            "2: G5003 v1 should be off after scan 1, but the ladder has it on\n\
          tank.ladder, line 5: rung 0 of Tank drives v1"
        ]
    );
}

#[test]
fn a_scenario_runs_on_files_that_are_not_open_and_hears_when_they_change() {
    let mut client = crate::client();
    client.write("tank.ladder", LADDER);
    client.write("tank.grafcet", SPEC);
    client.open("tank.scenario", "on s => on v1, off Xv1\n");
    let spec = "1: G5003 Xv1 should be off after scan 1, but the spec has it on \
                [tank.grafcet 2: what the spec says of Xv1]";
    assert_eq!(said(&mut client, "tank.scenario"), [spec]);
    client.write(
        "tank.ladder",
        "input s\ninput ls2\noutput v1\nrung: 0 -> v1\n",
    );
    let changed = FileEvent::new(client.uri("tank.ladder"), FileChangeType::CHANGED);
    client.notify::<DidChangeWatchedFiles>(DidChangeWatchedFilesParams {
        changes: vec![changed],
    });
    let ladder = "1: G5003 v1 should be on after scan 1, but the ladder has it off \
                  [tank.ladder 4: rung 0 of main drives v1]";
    assert_eq!(said(&mut client, "tank.scenario"), [ladder, spec]);
}

#[test]
fn mistakes_are_told_and_a_scenario_that_has_one_is_not_run() {
    let (mut client, _) = tank("for tank.ladder\n\non S => off v1\nof ls2\n");
    assert_eq!(
        said(&mut client, "fill.scenario"),
        [
            "3: G5002 the ladder does not know S\ndid you mean s?",
            "4: G5001 line not understood: expected `=` and a value, found `ls2`\n\
             a step is written `on a, off b, wait 5s => on q`",
        ]
    );
}

#[test]
fn a_run_that_takes_long_is_ended_with_a_remark() {
    let (mut client, _) = tank("for tank.ladder\nscan 60000 => off v1\nscan 60000 => on v1\n");
    let found = client.diagnostics("fill.scenario");
    assert_eq!(found[0].severity, Some(DiagnosticSeverity::INFORMATION));
    assert_eq!(
        said(&mut client, "fill.scenario"),
        ["3: G5004 the run was ended after 100000 scans\n`gradus simulate` runs it to its end"]
    );
}

#[test]
fn files_that_cannot_be_run_on_are_told_at_their_names() {
    let (mut client, _) = tank("for tank.ladder, gone.ladder, fill.scenario\n\non s => off v1\n");
    client.write("other.ladder", LADDER);
    assert_eq!(
        said(&mut client, "fill.scenario"),
        [
            "1: G4001 gone.ladder: there is no such file\n\
             the path is seen from the folder of the scenario",
            "1: G4001 fill.scenario: this holds neither a ladder nor a spec\n\
             the path is seen from the folder of the scenario",
        ]
    );
    client.replace(
        "fill.scenario",
        "gone.ladder, fill.scenario",
        "other.ladder",
    );
    let second = said(&mut client, "fill.scenario");
    let wanted = "1: G4001 other.ladder: this is a second ladder, and a scenario runs on one";
    assert!(
        second.len() == 1 && second[0].starts_with(wanted),
        "{second:?}"
    );
}

#[test]
fn the_only_ladder_in_the_folder_is_run_with_its_unsaved_spec() {
    let mut client = crate::client();
    client.write("tank.ladder", LADDER);
    client.write("tank.xml", "<note/>");
    client.open("tank.grafcet", SPEC);
    client.open("start.scenario", "on s => on v1, off Xv1\n");
    let spec = "1: G5003 Xv1 should be off after scan 1, but the spec has it on \
                [tank.grafcet 2: what the spec says of Xv1]";
    assert_eq!(said(&mut client, "start.scenario"), [spec]);
    client.write("motor.ladder", "rung: a -> b\n");
    assert_eq!(said(&mut client, "start.scenario"), [""; 0]);
}

#[test]
fn a_scenario_beside_nothing_has_only_its_text() {
    let mut client = crate::client();
    client.open("alone.scenario", "on s => on v1\n?\n");
    let told = said(&mut client, "alone.scenario");
    assert!(
        told.len() == 1 && told[0].starts_with("2: G5001"),
        "{told:?}"
    );
}

#[test]
fn the_published_tables_hold_and_can_be_left_out() {
    for table in ["table-2.scenario", "table-3.scenario", "table-4.scenario"] {
        let mut client = crate::client();
        client.open_fixture(
            "fixtures/neutralization/neutralization.ladder",
            "neutralization.ladder",
        );
        client.open_fixture(&format!("fixtures/neutralization/{table}"), table);
        assert_eq!(said(&mut client, table), [""; 0]);
    }
    let settings = json!({ "diagnostics": { "ignore": ["G5003"] } });
    let mut client = Client::start_with(env!("CARGO_BIN_EXE_gradus"), Profile::VsCode, settings);
    client.open("tank.ladder", LADDER);
    client.open("tank.scenario", "on s => off v1\n");
    assert_eq!(said(&mut client, "tank.scenario"), [""; 0]);
}
