//! What is said of a verdict: findings in the spec, a lens, the status, a text.

use end_to_end::lsp::{Client, Profile};
use serde_json::json;
use tower_lsp::ls_types::{Diagnostic, DiagnosticSeverity, NumberOrString};

use super::{LADDER, SPEC, overflowing, proof, tank_like, verify};
use crate::lenses::lenses;

const DIFFERENT: &str = "after 2 scans, in the last with ls2 on, the ladder has v1 off and the spec has it on (scan timing)";

/// What a verdict says of the spec; not that the ladder gives other rules.
fn said(client: &mut Client) -> Vec<Diagnostic> {
    let mut found = client.diagnostics("tank.grafcet");
    found.retain(|it| code(it) != "G3101");
    found
}

fn code(found: &Diagnostic) -> &str {
    match &found.code {
        Some(NumberOrString::String(code)) => code,
        other => panic!("no code: {other:?}"),
    }
}

fn codes(client: &mut Client) -> Vec<String> {
    let found = said(client);
    found.iter().map(|it| code(it).to_owned()).collect()
}

/// The first lens of the spec.
fn lens(client: &mut Client) -> String {
    let all = lenses(client, "tank.grafcet");
    let (line, title) = all.into_iter().next().expect("a lens");
    assert_eq!(line, 0);
    title
}

#[test]
fn a_difference_is_a_warning_in_the_spec_that_goes_when_it_is_mended() {
    let mut client = tank_like(Profile::VsCode, &overflowing());
    assert_eq!(
        proof(&mut client, "different"),
        "different after 2 scans: v1"
    );
    assert_eq!(lens(&mut client), "different after 2 scans: v1");
    let found = said(&mut client).remove(0);
    assert_eq!(code(&found), "G3201");
    assert_eq!(found.severity, Some(DiagnosticSeverity::WARNING));
    assert!(found.message.starts_with(DIFFERENT), "{}", found.message);
    assert_eq!(found.range.start.line, 10);
    let related = found.related_information.as_ref().expect("other places");
    assert_eq!(related.len(), 1);
    assert_eq!(related[0].location.uri, client.uri("tank.ladder"));
    assert_eq!(related[0].location.range.start.line, 4);
    assert_eq!(related[0].message, "rung 0 of Tank has v1 off in scan 2");

    client.replace("tank.grafcet", "ls2*s |-", "ls2 |-");
    // What was found of the text before is taken away at once.
    assert_eq!(said(&mut client), []);
    assert_ne!(lens(&mut client), "different after 2 scans: v1");
    assert_eq!(proof(&mut client, "equivalent"), "equivalent (scan timing)");
    assert_eq!(lens(&mut client), "equivalent (scan timing)");
    assert_eq!(said(&mut client), []);
}

#[test]
fn who_is_told_findings_is_told_of_a_verdict() {
    for profile in [Profile::Neovim, Profile::Eglot, Profile::Plain] {
        let mut client = tank_like(profile, &overflowing());
        let found = loop {
            if let Some(found) = said(&mut client).pop() {
                break found;
            }
        };
        assert_eq!(code(&found), "G3201");
        assert!(found.message.starts_with(DIFFERENT), "{}", found.message);
        // It is taken back when the ladder changes.
        client.replace("tank.ladder", "(s + v1)", "(v1 + s)");
        while !said(&mut client).is_empty() {}
    }
}

#[test]
fn a_violated_property_stands_at_its_line() {
    let spec = format!("{SPEC}Never:\nn1: v1*s\n");
    let mut client = tank_like(Profile::VsCode, &spec);
    let line = "equivalent (scan timing) · n1 violated after 1 scan";
    assert_eq!(proof(&mut client, "different"), line);
    let found = said(&mut client);
    assert_eq!(code(&found[0]), "G3202");
    assert_eq!(found[0].range.start.line, 12);
}

#[test]
fn what_cannot_be_compared_and_what_has_errors_is_said_so() {
    let spec = format!("{SPEC}Environment:\ne1: s |- /v1\n");
    let mut client = tank_like(Profile::VsCode, &spec);
    proof(&mut client, "refused");
    let found = said(&mut client);
    assert_eq!(code(&found[0]), "G3204");
    assert_eq!(found[0].severity, Some(DiagnosticSeverity::INFORMATION));
    assert_eq!(found[0].range.start.line, 12);

    client.replace("tank.grafcet", "e1: s |- /v1", "e1: s |- (");
    let line = "not verified: the ladder or the spec has errors";
    assert_eq!(proof(&mut client, "mistaken"), line);
    assert_eq!(lens(&mut client), line);
    assert_eq!(codes(&mut client), ["G3001"]);
    // What is read without the line is what was read of it.
    client.replace("tank.grafcet", "e1: s |- (\n", "");
    assert_eq!(proof(&mut client, "equivalent"), "equivalent (scan timing)");
}

#[test]
fn a_spec_that_says_nothing_of_outputs_so_far_is_left_alone() {
    let mut client = tank_like(Profile::VsCode, "Grafcet Tank\nStep X0\nMarking X0\n");
    let line = "not known: the spec has no output that the ladder knows";
    assert_eq!(proof(&mut client, "unknown"), line);
    assert_eq!(client.diagnostics("tank.grafcet"), []);
}

#[test]
fn the_command_shows_what_the_command_line_prints() {
    let mut client = tank_like(Profile::VsCode, &overflowing());
    let answer = verify(&mut client);
    let text = answer["text"].as_str().expect("a text");
    assert_eq!(answer["title"], "tank.grafcet.txt");
    assert_eq!(answer["verdict"], "different");
    assert_eq!(answer["summary"], "different after 2 scans: v1");
    for (name, text) in [("tank.ladder", LADDER), ("tank.grafcet", &overflowing())] {
        client.write(name, text);
    }
    let printed = std::process::Command::new(env!("CARGO_BIN_EXE_gradus"))
        .args(["verify", "tank.ladder", "tank.grafcet"])
        .current_dir(client.path("tank.ladder").parent().expect("a folder"))
        .output()
        .expect("an answer");
    assert_eq!(text, String::from_utf8_lossy(&printed.stdout));
    // The document is about what is known now.
    let document = json!({ "uri": answer["uri"] });
    let shown = client.ask_raw("workspace/textDocumentContent", document.clone());
    assert_eq!(shown["text"], answer["text"]);
    client.replace("tank.grafcet", "ls2*s |-", "ls2 |-");
    let shown = client.ask_raw("workspace/textDocumentContent", document);
    assert_ne!(shown["text"], answer["text"]);
}

#[test]
fn without_the_background_only_the_command_verifies() {
    let settings = json!({ "verify": { "enable": false } });
    let mut client = Client::start_with(env!("CARGO_BIN_EXE_gradus"), Profile::VsCode, settings);
    client.open("tank.ladder", LADDER);
    client.open("tank.grafcet", &overflowing());
    assert_eq!(lens(&mut client), "not verified");
    assert_eq!(codes(&mut client), [""; 0]);
    verify(&mut client);
    assert_eq!(lens(&mut client), "different after 2 scans: v1");
    assert_eq!(codes(&mut client), ["G3201"]);
}

#[test]
fn the_timing_is_a_setting() {
    // The lamp follows a scan late.
    let ladder = "input go\noutput lamp\nrung: m -> lamp\nrung: go -> m\n";
    let spec = "Step X0\nInput go\nOutput lamp\nMarking X0\nSteps:\nX0: go |- lamp\n";
    for (timing, line) in [
        ("scan", "different after 1 scan: lamp"),
        ("settled", "equivalent (settled timing)"),
    ] {
        let settings = json!({ "verify": { "timing": timing } });
        let mut client =
            Client::start_with(env!("CARGO_BIN_EXE_gradus"), Profile::VsCode, settings);
        client.open("tank.ladder", ladder);
        client.open("tank.grafcet", spec);
        assert_eq!(verify(&mut client)["summary"], line);
        assert_eq!(lens(&mut client), line);
    }
}

#[test]
fn a_file_that_belongs_to_no_pair_is_refused() {
    let mut client = crate::client();
    client.open("tank.ladder", LADDER);
    let argument = json!({ "uri": client.uri("tank.ladder") });
    let refused = crate::commands::ask(&mut client, "gradus.verify", argument);
    let refused = refused.expect_err("refused");
    assert!(
        refused
            .message
            .ends_with("belongs to no ladder with a spec")
    );
}
