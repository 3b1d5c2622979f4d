//! Findings in all files of the client's folders.

use std::fs;
use std::path::Path;
use std::time::Duration;

use end_to_end::lsp::Profile;
use serde_json::{Value, json};

use crate::raw::{Raw, large, uri};

const QUIET: &str = "input a\nrung: a -> b\n";
const TWICE: &str = "input a\nrung: a -> b\nrung: a -> b\n";
/// A spec of a state that the ladders above do not have.
const SPEC: &str = "Grafcet Tank\nStep Xv1 for v1\nMarking Xv1\n";

const METHOD: &str = "workspace/diagnostic";

/// A folder with these files, and a client that works on it.
struct Session {
    folder: tempfile::TempDir,
    raw: Raw,
    /// The numbers that the client has been given, by address.
    known: Vec<(String, String)>,
}

impl Session {
    fn new(profile: Profile, files: &[(&str, &str)]) -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        for (name, text) in files {
            fs::write(folder.path().join(name), text).expect("a file");
        }
        let raw = Raw::in_folders(profile, &[folder.path()]);
        Self {
            folder,
            raw,
            known: Vec::new(),
        }
    }

    fn path(&self, name: &str) -> std::path::PathBuf {
        self.folder.path().join(name)
    }

    fn uri(&self, name: &str) -> String {
        uri(&self.path(name))
    }

    fn params(&self) -> Value {
        let known = self.known.iter();
        let known = known.map(|(uri, id)| json!({ "uri": uri, "value": id }));
        json!({ "previousResultIds": known.collect::<Vec<_>>() })
    }

    /// The same for a client that takes parts.
    fn params_with(&self, token: &str) -> Value {
        let mut params = self.params();
        params["partialResultToken"] = json!(token);
        params
    }

    /// Everything that is answered at once.
    fn ask(&mut self) -> Vec<String> {
        let params = self.params();
        let answer = self.raw.ask(METHOD, params);
        self.take(&answer["result"])
    }

    /// Takes over what is told, and says it: `NAME codes`, `NAME as before`.
    fn take(&mut self, report: &Value) -> Vec<String> {
        let items = report["items"].as_array().expect("items").iter();
        let items = items.map(|item| {
            let uri = item["uri"].as_str().expect("an address");
            self.known.retain(|(known, _)| known != uri);
            if let Some(id) = item["resultId"].as_str() {
                self.known.push((uri.to_owned(), id.to_owned()));
            }
            let name = uri.rsplit('/').next().expect("a name");
            if item["kind"] == "unchanged" {
                return format!("{name} as before");
            }
            let found = item["items"].as_array().expect("findings").iter();
            let codes = found.map(|it| it["code"].as_str().expect("a code"));
            let version = item["version"].as_i64().map(|it| format!(" {it}"));
            let version = version.unwrap_or_default();
            format!("{name}{version} [{}]", codes.collect::<Vec<_>>().join(" "))
        });
        items.collect()
    }

    fn changed_on_disk(&mut self, name: &str, text: Option<&str>) {
        let path = self.path(name);
        match text {
            Some(text) => fs::write(path, text).expect("a file"),
            None => fs::remove_file(path).expect("a file removed"),
        }
        let change = json!({ "uri": self.uri(name), "type": 2 });
        self.raw.notify(
            "workspace/didChangeWatchedFiles",
            json!({ "changes": [change] }),
        );
    }
}

#[test]
fn all_files_are_told_of_open_or_not() {
    let mut session = Session::new(
        Profile::VsCode,
        &[
            ("quiet.ladder", QUIET),
            ("twice.ladder", TWICE),
            ("twice.grafcet", SPEC),
            ("page.xml", "<html/>"),
            ("notes.txt", "nothing of ours"),
        ],
    );
    let twice = session.uri("twice.ladder");
    let all = [
        "quiet.ladder []",
        "twice.grafcet [G3102]",
        "twice.ladder [G2002]",
    ];
    assert_eq!(session.ask(), all);
    assert_eq!(
        session.ask(),
        [
            "quiet.ladder as before",
            "twice.grafcet as before",
            "twice.ladder as before"
        ]
    );
    // As it is in the editor, saved or not; so is what depends on it.
    session.raw.open(&twice, TWICE);
    session
        .raw
        .change(&twice, 2, "input s\ninput e\nrung: (s + v1) * /e -> v1\n");
    session.raw.open("untitled:new.ladder", TWICE);
    let found = session.ask();
    assert_eq!(
        found,
        [
            "quiet.ladder as before",
            "twice.grafcet []",
            "twice.ladder 2 []",
            "untitled:new.ladder 1 [G2002]",
        ]
    );
    session.raw.finish();
}

#[test]
fn a_client_that_asks_for_findings_may_ask_for_all() {
    for profile in Profile::ALL {
        let mut raw = Raw::start();
        let server = raw.initialize(profile);
        let provider = &server["capabilities"]["diagnosticProvider"];
        let asks = matches!(profile, Profile::VsCode | Profile::Helix);
        let offered = match asks {
            true => json!({
                "identifier": "gradus",
                "interFileDependencies": true,
                "workspaceDiagnostics": true,
            }),
            false => Value::Null,
        };
        assert_eq!(*provider, offered, "{profile:?}");
        raw.finish();
    }
}

#[test]
fn what_changes_on_disk_is_told_with_what_depends_on_it() {
    let mut session = Session::new(
        Profile::Helix,
        &[
            ("a.ladder", TWICE),
            ("b.ladder", TWICE),
            ("b.grafcet", SPEC),
        ],
    );
    session.ask();
    session.changed_on_disk("b.ladder", None);
    assert_eq!(
        session.ask(),
        ["a.ladder as before", "b.grafcet []", "b.ladder []"]
    );
    session.changed_on_disk("a.ladder", Some(QUIET));
    assert_eq!(session.ask(), ["a.ladder []", "b.grafcet as before"]);
    session.raw.finish();
}

#[test]
fn settings_say_what_is_told_of_which_folder() {
    let mut session = Session::new(Profile::VsCode, &[("a.ladder", TWICE)]);
    assert_eq!(session.ask(), ["a.ladder [G2002]"]);
    session.changed_on_disk("gradus.toml", Some("diagnostics.workspace = false\n"));
    assert_eq!(session.ask(), ["a.ladder []"]);
    assert_eq!(session.ask(), ["a.ladder as before"]);
    // A document that is open is told of all the same.
    let address = session.uri("a.ladder");
    session.raw.open(&address, TWICE);
    assert_eq!(session.ask(), ["a.ladder 1 [G2002]"]);
    session.raw.finish();
}

/// What is told in parts, up to the answer, whose number is `asked`.
fn parts(session: &mut Session, asked: &Value, token: &str) -> Vec<String> {
    let mut all = Vec::new();
    loop {
        let next = session.raw.wait_for(|it| {
            it["params"]["token"] == *token || (it["id"] == *asked && it.get("method").is_none())
        });
        if next["id"] == *asked {
            assert_eq!(next["result"]["items"], json!([]), "{next}");
            return all;
        }
        all.extend(session.take(&next["params"]["value"]));
    }
}

#[test]
fn who_takes_parts_is_told_in_parts_and_then_only_of_changes() {
    let names: Vec<String> = (0..150).map(|at| format!("{at:03}.ladder")).collect();
    let files: Vec<(&str, &str)> = names.iter().map(|it| (it.as_str(), QUIET)).collect();
    let mut session = Session::new(Profile::VsCode, &files);
    let params = session.params_with("first");
    let asked = session.raw.begin(METHOD, params);
    let all = parts(&mut session, &asked, "first");
    assert_eq!(all.len(), 150);
    assert!(all.iter().all(|it| it.ends_with(" []")), "{all:?}");
    // There is nothing new, so the question is kept. Other questions are not.
    let params = session.params_with("second");
    let asked = session.raw.begin(METHOD, params);
    session.raw.still_answers();
    session.changed_on_disk("077.ladder", Some(TWICE));
    let news = parts(&mut session, &asked, "second");
    assert!(news.contains(&"077.ladder [G2002]".to_owned()), "{news:?}");
    let others = news.iter().filter(|it| !it.ends_with("as before"));
    assert_eq!(others.count(), 1, "{news:?}");
    session.raw.finish();
}

#[test]
fn a_question_that_is_kept_is_answered_when_a_verdict_is_known() {
    let spec = "Step X0\nInput a\nOutput b\nMarking X0\nSteps:\nX0: 0 |- b\n";
    let ladder = "input a\noutput b\nrung: a -> b\n";
    let mut session = Session::new(
        Profile::VsCode,
        &[("tank.ladder", ladder), ("tank.grafcet", spec)],
    );
    let address = session.uri("tank.grafcet");
    session.raw.open(&address, spec);
    let mut told = session.ask();
    let wanted = |told: &[String]| told.iter().any(|it| it == "tank.grafcet 1 [G3101 G3201]");
    while !wanted(&told) {
        let params = session.params_with("parts");
        let asked = session.raw.begin(METHOD, params);
        told = parts(&mut session, &asked, "parts");
    }
    // Whoever knows it is told nothing anew, until nobody looks at the spec.
    let params = session.params_with("kept");
    let asked = session.raw.begin(METHOD, params);
    let document = json!({ "textDocument": { "uri": address } });
    session.raw.notify("textDocument/didClose", document);
    assert_eq!(
        parts(&mut session, &asked, "kept"),
        ["tank.grafcet [G3101]", "tank.ladder as before"]
    );
    session.raw.finish();
}

#[test]
fn a_question_that_is_kept_can_be_cancelled_and_ends_with_the_session() {
    let mut session = Session::new(Profile::VsCode, &[("a.ladder", QUIET)]);
    session.ask();
    let params = session.params_with("one");
    let one = session.raw.begin(METHOD, params.clone());
    let two = session.raw.begin(METHOD, params);
    assert_eq!(
        session
            .raw
            .wire
            .receive_within(Duration::from_millis(50))
            .filter(|it| it["id"] == one),
        None
    );
    session.raw.notify("$/cancelRequest", json!({ "id": one }));
    assert_eq!(session.raw.end(&one)["error"]["code"], -32800);
    let ended = session.raw.begin("shutdown", Value::Null);
    let kept = session.raw.end(&two);
    assert_eq!(kept["result"]["items"][0]["kind"], "unchanged", "{kept}");
    session.raw.end(&ended);
    session.raw.notify("exit", Value::Null);
    assert!(session.raw.wire.wait().success());
}

#[test]
fn who_does_not_say_when_files_change_is_answered_at_once() {
    let mut session = Session::new(Profile::Plain, &[("a.ladder", QUIET)]);
    session.ask();
    let params = session.params_with("now");
    let answer = session.raw.ask(METHOD, params);
    assert_eq!(session.take(&answer["result"]), ["a.ladder as before"]);
    session.raw.finish();
}

/// Writes ladders into a folder, the next twice as large as the one before,
/// until checking them takes so long that the server wants to show it.
fn slow(session: &mut Session) -> (Value, Value, Value) {
    let mut rungs = 4_000;
    loop {
        let name = format!("{rungs}.ladder");
        fs::write(session.path(&name), large(rungs)).expect("a file");
        let params = session.params();
        let asked = session.raw.begin(METHOD, params);
        let next = session
            .raw
            .wait_for(|it| it["method"] == "window/workDoneProgress/create" || it["id"] == asked);
        if next["method"].is_string() {
            return (asked, next["params"]["token"].clone(), next["id"].clone());
        }
        assert!(rungs < 2_000_000, "even {rungs} rungs take no time");
        rungs *= 2;
    }
}

#[test]
fn a_long_check_is_shown_and_given_up_when_the_user_cancels_it() {
    let mut session = Session::new(Profile::VsCode, &[]);
    let (asked, token, id) = slow(&mut session);
    session
        .raw
        .wire
        .send(&json!({ "jsonrpc": "2.0", "id": id, "result": null }));
    let cancel = json!({ "token": token });
    session
        .raw
        .notify("window/workDoneProgress/cancel", cancel.clone());
    let next = session
        .raw
        .wait_for(|it| it["method"] == "$/progress" || it["id"] == asked);
    if next["method"].is_string() {
        assert_eq!(next["params"]["value"]["title"], "Checking all files");
        session.raw.notify("window/workDoneProgress/cancel", cancel);
        session.raw.end(&asked);
    }
    session.raw.still_answers();
    session.raw.finish();
}

#[test]
fn folders_that_are_added_are_told_of_and_removed_ones_are_taken_back() {
    let mut session = Session::new(Profile::VsCode, &[("a.ladder", TWICE)]);
    let other = tempfile::tempdir().expect("a folder");
    fs::write(other.path().join("b.ladder"), TWICE).expect("a file");
    fs::write(
        other.path().join("gradus.toml"),
        "diagnostics.ignore = ['G2002']",
    )
    .expect("a file");
    let folder = |path: &Path| json!({ "uri": uri(path), "name": "folder" });
    let change = |session: &mut Session, added: &[Value], removed: &[Value]| {
        let event = json!({ "added": added, "removed": removed });
        session.raw.notify(
            "workspace/didChangeWorkspaceFolders",
            json!({ "event": event }),
        );
        let mut said = session.ask();
        said.sort();
        said
    };
    let (one, two) = (folder(session.folder.path()), folder(other.path()));
    let two = std::slice::from_ref(&two);
    assert_eq!(change(&mut session, &[], &[]), ["a.ladder [G2002]"]);
    let both = ["a.ladder as before", "b.ladder []"];
    assert_eq!(change(&mut session, two, &[]), both);
    let second = ["a.ladder []", "b.ladder as before"];
    assert_eq!(change(&mut session, &[], &[one]), second);
    assert_eq!(change(&mut session, &[], two), ["b.ladder []"]);
    assert_eq!(change(&mut session, &[], &[]), [""; 0]);
    session.raw.finish();
}
