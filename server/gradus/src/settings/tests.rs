//! What a settings file says and what is wrong in it; and that schema,
//! documents and the extension for VS Code tell of the same settings.

use std::fmt::Write;

use serde_json::{Map, Value, json};

use super::{Config, Weakest, file};

/// What is said of a settings file: `CODE at "text": message (help)`.
fn said(text: &str) -> Vec<String> {
    let file = file::read(text.as_bytes().to_vec());
    let found = file.findings.iter().map(|it| {
        let place = &text[it.span.range()];
        let help = it.help.iter().map(|help| format!(" ({help})"));
        format!(
            "{} at {place:?}: {}{}",
            it.code,
            it.message,
            help.collect::<String>()
        )
    });
    found.collect()
}

fn config(text: &str) -> Config {
    file::read(text.as_bytes().to_vec()).layer.config()
}

#[test]
fn a_file_sets_what_it_names() {
    let text = "\u{feff}\
# The tank farm.
maxFileSize = 0x10

[diagnostics]
ignore = ['G2004', \"g2005\"] # many

[suggestions]\r
evidence = \"handover\"
";
    assert_eq!(said(text), [""; 0]);
    let config = config(text);
    assert_eq!(config.max_file_size.bytes(), 16 << 20);
    assert_eq!(config.suggestions.evidence, Weakest::Handover);
    assert!(config.code_lens.enable && config.diagnostics.enable);
    let ignored = config.diagnostics.ignored();
    let codes = ["G2004", "G2005"].map(|code| source::Code::parse(code).expect("a code"));
    assert_eq!(ignored, codes.into());
}

#[test]
fn nothing_sets_nothing() {
    assert_eq!(config(""), Config::default());
    assert_eq!(said(""), [""; 0]);
}

#[test]
fn a_mistake_costs_only_itself() {
    let text = "\
codelens.enable = false
inlayHints = { enable = 'no', color = 3 }
maxFileSize = -1
suggestions.evidence = \"certain\"
diagnostics.enable = false
diagnostics.ignore = [\"G2004\", \"G9999\", 2005]
";
    assert_eq!(
        said(text),
        [
            "G4102 at \"codelens\": there is no setting `codelens` \
             (known here: `codeLens`, `inlayHints`, `suggestions`, `diagnostics`, `verify`, `maxFileSize`)",
            "G4103 at \"'no'\": `inlayHints.enable` is \"no\"; expected true or false",
            "G4102 at \"color\": there is no setting `inlayHints.color` (known here: `enable`)",
            "G4103 at \"-1\": `maxFileSize` is -1; expected a whole number, 1 or more",
            "G4103 at \"\\\"certain\\\"\": `suggestions.evidence` is \"certain\"; expected \"possible\" or \"handover\"",
            "G4103 at \"\\\"G9999\\\"\": `diagnostics.ignore` holds \"G9999\"; \
             expected the code of a finding, such as \"G2004\"",
            "G4103 at \"2005\": `diagnostics.ignore` holds 2005; expected the code of a finding, such as \"G2004\"",
        ]
    );
    let config = config(text);
    assert!(!config.diagnostics.enable);
    assert_eq!(config.diagnostics.ignore, ["G2004"]);
    assert_eq!(config.suggestions, Config::default().suggestions);
}

#[test]
fn what_is_no_table_or_no_list_is_said_to_be_none() {
    assert_eq!(
        said("diagnostics = 3\n"),
        ["G4103 at \"3\": `diagnostics` is 3; expected a table of `enable`, `workspace`, `ignore`"]
    );
    assert_eq!(
        said("diagnostics.ignore = 'G2004'\n"),
        [
            "G4103 at \"'G2004'\": `diagnostics.ignore` is \"G2004\"; expected a list of codes, such as [\"G2004\"]"
        ]
    );
    assert_eq!(
        said("[codeLens.enable]\non = 1979-05-27\n"),
        [
            "G4103 at \"[codeLens.enable]\": `codeLens.enable` is {\"on\":\"1979-05-27\"}; expected true or false"
        ]
    );
    assert_eq!(
        said("[[codeLens]]\nenable = true\n"),
        [
            "G4103 at \"[[codeLens]]\": `codeLens` is [{\"enable\":true}]; expected a table of `enable`"
        ]
    );
}

#[test]
fn what_stands_around_a_broken_line_counts() {
    let text = "maxFileSize = 3\ncodeLens.enable = \ninlayHints.enable = false\n";
    let found = said(text);
    assert!(found.iter().all(|it| it.starts_with("G4101")), "{found:?}");
    assert_eq!(found.len(), 1);
    let config = config(text);
    assert_eq!(config.max_file_size.bytes(), 3 << 20);
    assert!(!config.inlay_hints.enable && config.code_lens.enable);
}

#[test]
fn what_is_no_text_or_too_long_sets_nothing() {
    let of = |bytes: Vec<u8>| {
        let file = file::read(bytes);
        assert_eq!(file.layer.config(), Config::default());
        file.findings[0].message.clone()
    };
    assert_eq!(
        of(b"# \xff".to_vec()),
        "gradus.toml must be UTF-8; byte 2 is not"
    );
    assert_eq!(
        of(vec![b'\n'; (1 << 20) + 1]),
        "gradus.toml is larger than 1 MiB"
    );
}

/// A setting, as the schema tells of it.
struct Setting {
    key: String,
    about: String,
    usual: Value,
    schema: Value,
}

impl Setting {
    /// The values that it can have, and what they mean.
    fn choices(&self) -> Option<Vec<(String, String)>> {
        let choices = self.schema.get("oneOf")?.as_array()?.iter();
        let text = |value: &Value| value.as_str().expect("a text").to_owned();
        let choices = choices.map(|it| (text(&it["const"]), text(&it["description"])));
        Some(choices.collect())
    }
}

/// The schema of a settings file.
fn schema() -> Value {
    let mut schema = serde_json::to_value(schemars::schema_for!(Config)).expect("a schema");
    schema["title"] = json!("gradus.toml");
    schema
}

/// All settings, in the order of the schema.
fn settings() -> Vec<Setting> {
    let schema = schema();
    let mut all = Vec::new();
    let usual = serde_json::to_value(Config::default()).expect("settings");
    add(&schema, &usual, "", &mut all);
    all
}

fn add(schema: &Value, usual: &Value, prefix: &str, all: &mut Vec<Setting>) {
    for (name, schema) in schema["properties"].as_object().expect("a table") {
        let (key, usual) = (format!("{prefix}{name}"), usual[name].clone());
        match schema.get("properties") {
            Some(_) => add(schema, &usual, &format!("{key}."), all),
            None => {
                let about = schema["description"].as_str().expect("a description");
                all.push(Setting {
                    about: about.to_owned(),
                    schema: schema.clone(),
                    key,
                    usual,
                });
            }
        }
    }
}

fn repository(path: &str) -> std::path::PathBuf {
    std::path::Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../..")
        .join(path)
}

/// Compares what a document holds, or a part of it, with what it should hold.
#[track_caller]
fn assert_document(path: &str, expected: impl Fn(&str) -> String) {
    let place = repository(path);
    let written = std::fs::read_to_string(&place).unwrap_or_default();
    let expected = expected(&written);
    if std::env::var_os("UPDATE").is_some() {
        std::fs::write(&place, &expected).expect("a document");
    } else {
        assert!(
            written == expected,
            "{path} is out of date; `UPDATE=1 cargo test -p gradus --bin gradus settings` rewrites it"
        );
    }
}

#[test]
fn the_schema_is_the_one_of_what_is_read() {
    assert_document("docs/gradus.schema.json", |_| format!("{:#}\n", schema()));
}

const BEGIN: &str = "<!-- made from the program -->\n";
const END: &str = "<!-- up to here -->";

#[test]
fn the_page_lists_every_setting() {
    let mut table = String::from("| key | values | usual | what it does |\n|---|---|---|---|\n");
    for setting in settings() {
        let values = match (&setting.usual, setting.choices()) {
            (_, Some(choices)) => {
                let choices = choices.iter().map(|(word, _)| format!("`\"{word}\"`"));
                choices.collect::<Vec<_>>().join(", ")
            }
            (Value::Bool(_), _) => "`true`, `false`".to_owned(),
            (Value::Array(_), _) => "a list of codes".to_owned(),
            _ => "1 or more".to_owned(),
        };
        let (key, usual, about) = (&setting.key, &setting.usual, &setting.about);
        let meanings = setting.choices().unwrap_or_default().into_iter();
        let meanings: String = meanings
            .map(|(word, about)| format!(" `{word}`: {about}"))
            .collect();
        // Writing into a string cannot fail.
        let _ = writeln!(
            table,
            "| `{key}` | {values} | `{usual}` | {about}{meanings} |"
        );
    }
    assert_document("docs/settings.md", |page| {
        let (before, rest) = page.split_once(BEGIN).expect("where it begins");
        let (_, after) = rest.split_once(END).expect("where it ends");
        format!("{before}{BEGIN}{table}{END}{after}")
    });
}

/// What the extension for VS Code has for itself.
fn is_the_extensions_own(key: &str) -> bool {
    key.starts_with("gradus.server.") || key.starts_with("gradus.trace.")
}

#[test]
fn the_extension_for_vs_code_has_the_same_settings() {
    let manifest = std::fs::read_to_string(repository("editors/vscode/package.json"));
    let manifest: Value = serde_json::from_str(&manifest.expect("a manifest")).expect("JSON");
    let properties = &manifest["contributes"]["configuration"]["properties"];
    let properties = properties.as_object().expect("a table").iter();
    let theirs: Map<String, Value> = properties
        .filter(|(key, _)| !is_the_extensions_own(key))
        .map(|(key, about)| {
            let told = json!({
                "usual": about["default"],
                "about": about["markdownDescription"],
                "least": about["minimum"],
                "element": about["items"]["pattern"],
                "choices": about["enum"],
                "meanings": about["enumDescriptions"],
            });
            (key.clone(), told)
        })
        .collect();
    let ours: Map<String, Value> = settings()
        .iter()
        .map(|setting| {
            let (words, meanings): (Vec<_>, Vec<_>) =
                setting.choices().unwrap_or_default().into_iter().unzip();
            let list = |list: Vec<String>| (!list.is_empty()).then_some(list);
            let told = json!({
                "usual": setting.usual,
                "about": setting.about,
                "least": setting.schema.get("minimum"),
                "element": setting.schema.pointer("/items/pattern"),
                "choices": list(words),
                "meanings": list(meanings),
            });
            (format!("gradus.{}", setting.key), told)
        })
        .collect();
    assert_eq!(theirs, ours);
}
