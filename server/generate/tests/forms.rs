//! Other forms of the texts under `fixtures/grafcet`: `NAME.json` and
//! `NAME.dot` beside each.

use std::fs;
use std::path::PathBuf;

use generate::{to_dot, to_json};
use grafcet::read;
use serde_json::Value;

fn fixture(name: &str) -> String {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/grafcet");
    let path = folder.join(name);
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

#[test]
fn json_has_what_is_promised() {
    for name in ["figure3", "everything"] {
        let spec = read(&fixture(&format!("{name}.grafcet"))).spec;
        let expected: Value =
            serde_json::from_str(&fixture(&format!("{name}.json"))).expect("JSON");
        assert_eq!(to_json(&spec.grafcet), expected, "{name}");
    }
}

#[test]
fn json_keys_come_in_the_documented_order() {
    let spec = read(&fixture("figure3.grafcet")).spec;
    let json = to_json(&spec.grafcet);
    let keys = |value: &Value| -> Vec<String> {
        let object = value.as_object().expect("an object");
        object.keys().cloned().collect()
    };
    assert_eq!(
        keys(&json),
        [
            "name",
            "steps",
            "transitions",
            "actions",
            "inputs",
            "outputs"
        ]
    );
    assert_eq!(
        keys(&json["steps"][0]),
        ["name", "initial", "state", "macro"]
    );
    assert_eq!(
        keys(&json["transitions"][0]),
        ["name", "from", "to", "receptivity"]
    );
    assert_eq!(
        keys(&json["actions"][0]),
        ["step", "kind", "output", "condition"]
    );
}

#[test]
fn a_picture_is_the_same_every_time() {
    for name in ["figure3", "everything"] {
        let spec = read(&fixture(&format!("{name}.grafcet"))).spec;
        assert_eq!(to_dot(&spec.grafcet), fixture(&format!("{name}.dot")));
    }
}

#[test]
fn names_in_a_picture_may_hold_anything() {
    let rules =
        "Step \"a\\b\"\nMarking \"a\\b\"\nTransition t1\nTransitions:\nt1: \"a\\b\"*\"x y\" |-\n";
    let picture = to_dot(&read(rules).spec.grafcet);
    assert!(
        picture.contains(r#"peripheries=2, label="a\\b""#),
        "{picture}"
    );
    assert!(picture.contains(r#"xlabel="\"x y\"""#), "{picture}");
}
