//! What the user may set.
//!
//! The client sends the section `gradus` when the server starts and whenever
//! it changes. Anything that is missing, or of a wrong type, is as in
//! [`Config::default`]; a wrong one is said in the log.

use recovery::successions::Evidence;
use serde::Deserialize;
use serde_json::Value;

/// The settings that the server reads.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub struct Config {
    /// Lenses above rungs and steps.
    pub code_lens: Switch,
    /// Hints behind coils and steps.
    pub inlay_hints: Switch,
    /// What suggestions are shown.
    pub suggestions: Suggestions,
    /// Findings.
    pub diagnostics: Diagnostics,
    /// Larger files are not read, in MiB.
    pub max_file_size: u64,
}

/// Something that can be on or off.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(default)]
pub struct Switch {
    /// Whether it is on.
    pub enable: bool,
}

/// What suggestions are shown.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(default)]
pub struct Suggestions {
    /// The weakest evidence that is still shown.
    pub evidence: Weakest,
}

/// The weakest evidence that is still shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Weakest {
    /// Only states that hand over to each other.
    Handover,
    /// Also those of which the one may follow the other.
    Possible,
}

impl From<Weakest> for Evidence {
    fn from(weakest: Weakest) -> Self {
        match weakest {
            Weakest::Handover => Self::Handover,
            Weakest::Possible => Self::Possible,
        }
    }
}

/// What findings are shown.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(default)]
pub struct Diagnostics {
    /// Whether there are any.
    pub enable: bool,
    /// Codes that are left out.
    pub ignore: Vec<String>,
}

impl Default for Config {
    fn default() -> Self {
        Self {
            code_lens: Switch::default(),
            inlay_hints: Switch::default(),
            suggestions: Suggestions::default(),
            diagnostics: Diagnostics::default(),
            max_file_size: 64,
        }
    }
}

impl Default for Switch {
    fn default() -> Self {
        Self { enable: true }
    }
}

impl Default for Suggestions {
    fn default() -> Self {
        Self {
            evidence: Weakest::Possible,
        }
    }
}

impl Default for Diagnostics {
    fn default() -> Self {
        Self {
            enable: true,
            ignore: Vec::new(),
        }
    }
}

impl Config {
    /// The settings in `value`, and what of it was not understood.
    pub fn read(value: &Value) -> (Self, Vec<String>) {
        // Some clients send the section, some the object that it is in.
        let section = value.get("gradus").unwrap_or(value);
        let Some(settings) = section.as_object() else {
            return (Self::default(), Vec::new());
        };
        let mut understood = serde_json::Map::new();
        let mut complaints = Vec::new();
        for (key, value) in settings {
            let mut tried = understood.clone();
            tried.insert(key.clone(), value.clone());
            match serde_json::from_value::<Self>(Value::Object(tried.clone())) {
                Ok(_) => understood = tried,
                Err(error) => complaints.push(format!("setting gradus.{key}: {error}")),
            }
        }
        let config = serde_json::from_value(Value::Object(understood)).unwrap_or_default();
        (config, complaints)
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn what_is_missing_is_as_usual() {
        let (config, complaints) = Config::read(&json!({ "codeLens": { "enable": false } }));
        assert!(!config.code_lens.enable && config.inlay_hints.enable);
        assert_eq!(complaints, [""; 0]);
        assert_eq!(Config::read(&Value::Null).0, Config::default());
    }

    #[test]
    fn one_wrong_setting_costs_only_itself() {
        let settings = json!({ "gradus": {
            "maxFileSize": "much",
            "suggestions": { "evidence": "handover" },
            "trace": { "server": "off" },
        }});
        let (config, complaints) = Config::read(&settings);
        assert_eq!(config.max_file_size, 64);
        assert_eq!(config.suggestions.evidence, Weakest::Handover);
        assert_eq!(
            complaints,
            ["setting gradus.maxFileSize: invalid type: string \"much\", expected u64"]
        );
    }
}
