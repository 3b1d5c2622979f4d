use end_to_end::lsp::{Client, Profile};
use serde_json::{Value, json};

use super::{LADDER, SCENARIO, SPEC, tank};
use crate::commands::ask;
use crate::lenses::{hints, lenses};

fn run(client: &mut Client, command: &str, argument: Value) -> Option<Value> {
    ask(client, command, argument).expect("no refusal")
}

/// The hints of a document: its text with each between `«` and `»`.
fn hinted(client: &mut Client, name: &str) -> String {
    let mut text = client.text(name).to_owned();
    let found = hints(client, name);
    for (position, hint) in found.iter().rev() {
        let mut lines = text.split_inclusive('\n');
        let before: usize = lines
            .by_ref()
            .take(position.line as usize)
            .map(str::len)
            .sum();
        text.insert_str(before + position.character as usize, &format!("«{hint}»"));
    }
    text
}

#[test]
fn a_scenario_says_above_its_title_how_it_went() {
    let (mut client, _) = tank(SCENARIO);
    let passes = (0, "passes on ladder and spec · 5 scans".to_owned());
    assert_eq!(lenses(&mut client, "fill.scenario"), [passes]);
    client.replace("tank.ladder", "/ls2", "/s");
    assert_eq!(
        lenses(&mut client, "fill.scenario"),
        [
            (
                0,
                "2 expectations not met on the ladder · passes on the spec · 5 scans · ladder \
                 and spec differ"
                    .to_owned()
            ),
            (3, "show scan 1 in ladder and spec".to_owned()),
            (4, "show scan 4 in ladder and spec".to_owned()),
        ]
    );
}

#[test]
fn the_client_is_asked_to_ask_again_when_the_ladder_changes() {
    let (mut client, _) = tank(SCENARIO);
    assert_eq!(lenses(&mut client, "fill.scenario").len(), 1);
    for typed in 1..20 {
        client.replace("tank.ladder", "/ls2", &format!("/ls2*/a{typed}"));
    }
    client.replace("tank.ladder", "(s + v1)", "s");
    client.refreshed("workspace/codeLens/refresh");
    client.refreshed("workspace/inlayHint/refresh");
    assert_eq!(lenses(&mut client, "fill.scenario").len(), 2);
}

#[test]
fn a_ladder_and_its_spec_name_the_scenarios_that_run_on_them() {
    let (mut client, _) = tank(SCENARIO);
    client.write("empty.scenario", "for tank.grafcet\noff s\n");
    for (name, place) in [("tank.ladder", 0), ("tank.grafcet", 0)] {
        let shown = lenses(&mut client, name);
        let shown: Vec<_> = shown
            .iter()
            .filter(|(_, it)| it.starts_with("run "))
            .collect();
        let wanted = [
            (place, "run empty.scenario".to_owned()),
            (place, "run fill.scenario".to_owned()),
        ];
        assert!(shown.into_iter().eq(&wanted), "{name}");
    }
}

#[test]
fn the_table_is_what_the_command_line_prints() {
    let (mut client, _) = tank(SCENARIO);
    let argument = json!({ "uri": client.uri("fill.scenario") });
    let answer = run(&mut client, "gradus.simulate", argument).expect("an answer");
    let table = "\
scan  time  done           ladder  active steps  spec  differ
1     10ms  on s           v1      Xv1           v1
2     20ms  off s, scan 3  v1      Xv1           v1
4     40ms                 v1      Xv1           v1
5     50ms  on ls2         -       X0            -

5 scans; all is as expected; ladder and spec agree
";
    assert_eq!(answer["text"], table);
    assert_eq!(answer["passed"], true);
    assert_eq!(
        answer["summary"],
        "5 scans; all is as expected; ladder and spec agree"
    );
    let uri = answer["uri"].clone();
    let again = client.ask_raw("workspace/textDocumentContent", json!({ "uri": uri }));
    assert_eq!(again["text"], table);
    client.replace("tank.ladder", "/ls2", "ls2");
    let again = client.ask_raw("workspace/textDocumentContent", json!({ "uri": uri }));
    let text = again["text"].as_str().expect("a text");
    assert!(
        text.contains("line 4: v1 should be on, but the ladder has it off\n"),
        "{text}"
    );
    assert!(
        text.ends_with("2 expectations not met; ladder and spec differ in 3 lines\n"),
        "{text}"
    );
}

#[test]
fn why_a_scenario_is_not_run_is_shown_instead_of_a_table() {
    let (mut client, _) = tank("for tank.ladder\non t => on v1\n");
    let argument = json!({ "uri": client.uri("fill.scenario") });
    let answer = run(&mut client, "gradus.simulate", argument).expect("an answer");
    let text = answer["text"].as_str().expect("a text");
    assert!(
        text.contains("error[G5002]: the ladder does not know t"),
        "{text}"
    );
    assert!(
        text.ends_with("the scenario has mistakes and was not run\n"),
        "{text}"
    );
    assert_eq!(answer["passed"], false);
}

#[test]
fn behind_each_step_stands_what_is_on_after_it() {
    let (mut client, _) = tank("for tank.ladder, tank.grafcet\non s\noff s, scan 3 // holds\n");
    assert_eq!(
        hinted(&mut client, "fill.scenario"),
        "for tank.ladder, tank.grafcet\non s«v1 · Xv1»\noff s, scan 3«v1 · Xv1» // holds\n"
    );
}

#[test]
fn a_scan_is_shown_in_ladder_and_spec_until_it_is_taken_back() {
    let (mut client, _) = tank(SCENARIO);
    let usual = hinted(&mut client, "tank.ladder");
    let scan = json!({ "uri": client.uri("fill.scenario"), "line": 4 });
    let answer = run(&mut client, "gradus.showScan", scan.clone()).expect("an answer");
    assert_eq!(
        answer,
        json!({ "scan": 4, "step": 1, "done": "off s, scan 3" })
    );
    let rung = "rung: (s + v1«●») * /ls2«●» -> v1«●»";
    let shown = hinted(&mut client, "tank.ladder");
    assert_eq!(shown, LADDER.replace("rung: (s + v1) * /ls2 -> v1", rung));
    let shown = hinted(&mut client, "tank.grafcet");
    assert_eq!(
        shown,
        SPEC.replace("Step X0, Xv1", "Step X0, Xv1«● active»")
    );
    let lens = (4, "scan 4 is shown: hide it".to_owned());
    assert!(lenses(&mut client, "fill.scenario").contains(&lens));

    // What is shown follows what is typed.
    client.replace("tank.ladder", "(s + v1)", "s");
    let shown = hinted(&mut client, "tank.ladder");
    assert!(shown.ends_with("rung: s * /ls2 -> v1\n"), "{shown}");
    client.replace("tank.ladder", "s *", "(s + v1) *");

    assert_eq!(run(&mut client, "gradus.hideScan", json!({})), None);
    assert_eq!(hinted(&mut client, "tank.ladder"), usual);
}

#[test]
fn any_scan_can_be_shown_by_its_number() {
    let (mut client, _) = tank("for tank.ladder\non s, wait 5s\non ls2, wait 5s\n");
    for (scan, step, rung) in [
        (1, 0, "rung: (s«●» + v1) * /ls2«●» -> v1«●»"),
        (2, 0, "rung: (s«●» + v1«●») * /ls2«●» -> v1«●»"),
        (501, 1, "rung: (s«●» + v1«●») * /ls2 -> v1"),
        (1000, 1, "rung: (s«●» + v1) * /ls2 -> v1"),
    ] {
        let argument = json!({ "uri": client.uri("fill.scenario"), "scan": scan });
        let answer = run(&mut client, "gradus.showScan", argument).expect("an answer");
        assert_eq!(
            (&answer["scan"], &answer["step"]),
            (&json!(scan), &json!(step))
        );
        let shown = hinted(&mut client, "tank.ladder");
        assert_eq!(shown.lines().last(), Some(rung), "scan {scan}");
    }
}

#[test]
fn what_makes_no_sense_is_refused_with_a_reason() {
    let (mut client, _) = tank(SCENARIO);
    let uri = client.uri("fill.scenario");
    let ladder = client.uri("tank.ladder");
    let no_scenario = format!("{} holds no scenario", ladder.as_str());
    for (command, argument, reason) in [
        ("gradus.simulate", json!({ "uri": ladder }), &*no_scenario),
        (
            "gradus.showScan",
            json!({ "uri": uri, "line": 0 }),
            "the scenario has no such scan, or was not run so far",
        ),
        (
            "gradus.showScan",
            json!({ "uri": uri }),
            "gradus.showScan: missing field `line` or `scan`",
        ),
        (
            "gradus.showScan",
            json!({ "uri": uri, "scan": 6 }),
            "the scenario has no such scan, or was not run so far",
        ),
    ] {
        let refused = ask(&mut client, command, argument).expect_err("refused");
        assert_eq!((refused.code, &*refused.message), (-32602, reason));
    }
}

#[test]
fn all_of_it_can_be_switched_off() {
    let settings = json!({
        "codeLens": { "enable": false },
        "inlayHints": { "enable": false },
        "diagnostics": { "enable": false },
    });
    let mut client = Client::start_with(env!("CARGO_BIN_EXE_gradus"), Profile::VsCode, settings);
    client.open("tank.ladder", LADDER);
    client.open("tank.scenario", "on s => off v1\n");
    assert_eq!(lenses(&mut client, "tank.scenario"), []);
    assert_eq!(hints(&mut client, "tank.scenario"), []);
    assert_eq!(client.diagnostics("tank.scenario"), []);
    let scan = json!({ "uri": client.uri("tank.scenario"), "line": 0 });
    run(&mut client, "gradus.showScan", scan);
    assert_eq!(hints(&mut client, "tank.ladder"), []);
}
