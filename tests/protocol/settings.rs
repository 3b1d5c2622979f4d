//! Settings: of the client, and of the `gradus.toml` that is nearest.

use std::fs;
use std::path::Path;

use end_to_end::lsp::Profile;
use serde_json::{Value, json};

use crate::raw::{Raw, hover, uri};

/// A coil that two rungs drive.
const TWICE: &str = "input a\nrung: a -> b\nrung: a -> b\n";

const IGNORE: &str = "diagnostics.ignore = [\"G2002\"]\n";

fn write(folder: &Path, name: &str, text: &str) {
    let path = folder.join(name);
    fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
    fs::write(path, text).expect("a file");
}

/// The codes that are told of a document next. Who asks for findings asks now.
fn codes(raw: &mut Raw, pulls: bool, uri: &str) -> Vec<Value> {
    let found = match pulls {
        true => {
            let params = json!({ "textDocument": { "uri": uri } });
            raw.ask("textDocument/diagnostic", params)["result"]["items"].clone()
        }
        false => told(raw, uri),
    };
    let found = found.as_array().expect("findings").iter();
    found.map(|it| it["code"].clone()).collect()
}

/// What is pushed next for a document.
fn told(raw: &mut Raw, uri: &str) -> Value {
    let message = raw.wait_for(|it| {
        it["method"] == "textDocument/publishDiagnostics" && it["params"]["uri"] == uri
    });
    message["params"]["diagnostics"].clone()
}

fn changed_on_disk(raw: &mut Raw, uri: &str) {
    let change = json!({ "uri": uri, "type": 2 });
    raw.notify(
        "workspace/didChangeWatchedFiles",
        json!({ "changes": [change] }),
    );
}

fn pulls(profile: Profile) -> bool {
    matches!(profile, Profile::VsCode | Profile::Helix)
}

#[test]
fn a_file_above_the_program_sets_what_every_client_is_told() {
    for profile in Profile::ALL {
        let folder = tempfile::tempdir().expect("a folder");
        write(folder.path(), "gradus.toml", IGNORE);
        write(folder.path(), "line/cell/tank.ladder", TWICE);
        let mut raw = Raw::in_folders(profile, &[folder.path()]);
        let tank = uri(&folder.path().join("line/cell/tank.ladder"));
        raw.open(&tank, TWICE);
        let found = codes(&mut raw, pulls(profile), &tank);
        assert_eq!(found, [Value::Null; 0], "{profile:?}");
        raw.finish();
    }
}

#[test]
fn each_folder_has_settings_of_its_own() {
    let root = tempfile::tempdir().expect("a folder");
    let [one, two] = ["one", "two"].map(|name| root.path().join(name));
    // Above the client's folders, so it does not count.
    write(root.path(), "gradus.toml", "diagnostics.enable = false\n");
    write(&one, "gradus.toml", IGNORE);
    write(&two, "a.ladder", TWICE);
    let mut raw = Raw::in_folders(Profile::Plain, &[&one, &two]);
    for (folder, expected) in [(&one, [].as_slice()), (&two, &["G2002"])] {
        let program = uri(&folder.join("a.ladder"));
        raw.open(&program, TWICE);
        assert_eq!(codes(&mut raw, false, &program), expected, "{program}");
    }
    raw.finish();
}

#[test]
fn a_file_hides_what_the_client_sets_and_leaves_the_rest() {
    let folder = tempfile::tempdir().expect("a folder");
    write(folder.path(), "gradus.toml", "codeLens.enable = true\n");
    let settings = json!({ "codeLens": { "enable": false }, "inlayHints": { "enable": false } });
    let mut raw = Raw::in_folders_with(Profile::Plain, &[folder.path()], settings);
    let ladder = "input s\ninput e\nrung: (s + v1) * /e -> v1\n";
    for (program, has_lenses) in [
        (uri(&folder.path().join("tank.ladder")), true),
        ("untitled:tank.ladder".to_owned(), false),
    ] {
        raw.open(&program, ladder);
        let document = json!({ "uri": program });
        let lenses = raw.ask("textDocument/codeLens", json!({ "textDocument": document }));
        assert_eq!(
            lenses["result"].is_array(),
            has_lenses,
            "{program}: {lenses}"
        );
        let all = json!({
            "start": { "line": 0, "character": 0 },
            "end": { "line": 9, "character": 0 },
        });
        let hints = raw.ask(
            "textDocument/inlayHint",
            json!({ "textDocument": document, "range": all }),
        );
        assert_eq!(hints["result"], Value::Null, "{program}");
    }
    raw.finish();
}

#[test]
fn what_is_wrong_in_a_file_is_told_at_its_place_until_it_is_mended() {
    for profile in Profile::ALL {
        let folder = tempfile::tempdir().expect("a folder");
        let text =
            "# \u{1f6d1}\ndiagnostics = { ignore = [\"G2002\", \"\u{1f6d1}\", 7] }\ncolour = 3\n";
        write(folder.path(), "gradus.toml", text);
        let mut raw = Raw::in_folders(profile, &[folder.path()]);
        let [tank, settings] =
            ["tank.ladder", "gradus.toml"].map(|it| uri(&folder.path().join(it)));
        raw.open(&tank, TWICE);
        // All that is right counts.
        assert_eq!(codes(&mut raw, pulls(profile), &tank), [Value::Null; 0]);
        let found = told(&mut raw, &settings);
        let places = found.as_array().expect("findings").iter().map(|it| {
            let (from, to) = (&it["range"]["start"], &it["range"]["end"]);
            assert_eq!(from["line"], to["line"]);
            let columns = [&from["character"], &to["character"]];
            let columns = columns.map(|it| it.as_u64().expect("a column"));
            (
                it["code"].as_str().expect("a code"),
                from["line"].as_u64(),
                columns,
            )
        });
        // The sign that stops is four bytes, or two units of UTF-16.
        let (end, next) = match profile.counts_bytes() {
            true => (41, 43),
            false => (39, 41),
        };
        assert_eq!(
            places.collect::<Vec<_>>(),
            [
                ("G4103", Some(1), [35, end]),
                ("G4103", Some(1), [next, next + 1]),
                ("G4102", Some(2), [0, 6]),
            ],
            "{profile:?}"
        );
        write(folder.path(), "gradus.toml", IGNORE);
        changed_on_disk(&mut raw, &settings);
        assert_eq!(told(&mut raw, &settings), json!([]), "{profile:?}");
        raw.finish();
    }
}

#[test]
fn what_a_changed_file_sets_is_told_to_those_who_are_pushed() {
    for profile in [Profile::Neovim, Profile::Eglot, Profile::Plain] {
        let folder = tempfile::tempdir().expect("a folder");
        let mut raw = Raw::in_folders(profile, &[folder.path()]);
        let [tank, settings] =
            ["tank.ladder", "gradus.toml"].map(|it| uri(&folder.path().join(it)));
        raw.open(&tank, TWICE);
        assert_eq!(codes(&mut raw, false, &tank), ["G2002"], "{profile:?}");
        write(folder.path(), "gradus.toml", IGNORE);
        changed_on_disk(&mut raw, &settings);
        assert_eq!(
            codes(&mut raw, false, &tank),
            [Value::Null; 0],
            "{profile:?}"
        );
        fs::remove_file(folder.path().join("gradus.toml")).expect("a file removed");
        // Who watches no files says so when something is saved.
        raw.notify(
            "textDocument/didSave",
            json!({ "textDocument": { "uri": tank } }),
        );
        assert_eq!(codes(&mut raw, false, &tank), ["G2002"], "{profile:?}");
        raw.finish();
    }
}

#[test]
fn who_asks_for_findings_is_told_to_ask_again_when_a_file_has_changed() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut raw = Raw::in_folders(Profile::Helix, &[folder.path()]);
    let [tank, settings] = ["tank.ladder", "gradus.toml"].map(|it| uri(&folder.path().join(it)));
    raw.open(&tank, TWICE);
    assert_eq!(codes(&mut raw, true, &tank), ["G2002"]);
    write(folder.path(), "gradus.toml", IGNORE);
    changed_on_disk(&mut raw, &settings);
    let asked = raw.told("workspace/diagnostic/refresh");
    raw.wire
        .send(&json!({ "jsonrpc": "2.0", "id": asked["id"], "result": null }));
    assert_eq!(codes(&mut raw, true, &tank), [Value::Null; 0]);
    raw.finish();
}

#[test]
fn clients_that_watch_files_watch_settings_too() {
    let mut raw = Raw::initialized(Profile::VsCode);
    let asked = raw.told("client/registerCapability");
    let watchers = &asked["params"]["registrations"][0]["registerOptions"]["watchers"];
    let watchers = watchers.as_array().expect("a list");
    assert!(
        watchers
            .iter()
            .any(|it| it["globPattern"] == "**/gradus.toml"),
        "{asked}"
    );
    raw.finish();
}

#[test]
fn a_report_tells_of_all_settings_in_force() {
    let folder = tempfile::tempdir().expect("a folder");
    write(folder.path(), "gradus.toml", "maxFileSize = 7\n");
    let mut raw = Raw::in_folders(Profile::Plain, &[folder.path()]);
    let tank = uri(&folder.path().join("tank.ladder"));
    raw.open(&tank, TWICE);
    raw.ask("textDocument/hover", hover(&tank, 1, 6));
    let report = raw.ask(
        "workspace/executeCommand",
        json!({ "command": "gradus.report" }),
    );
    let text = report["result"]["text"].as_str().expect("a text");
    assert_eq!(text.matches("max_file_size").count(), 2, "{text}");
    assert!(text.contains("7,") && text.contains("64,"), "{text}");
    raw.finish();
}
