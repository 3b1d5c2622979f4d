//! What the user may set: what there is, what it is as usual, and what of a
//! text was understood.
//!
//! Settings come from the client of the language server and from files called
//! `gradus.toml` ([`file`]); both have the same keys. Each is a [`Layer`], and a
//! layer over another hides what that says. What no layer says is as in
//! [`Config::default`]. The comments on the fields below are what schema and
//! documents say of them.

pub mod file;
mod layer;
#[cfg(test)]
mod tests;

use std::collections::HashSet;
use std::num::NonZeroU32;

use clap::ValueEnum;
use recovery::successions::Evidence;
use serde::{Deserialize, Deserializer, Serialize, de};
use source::Code;

pub use layer::{Complaint, Layer, Wrong};

/// The settings of Gradus for the programs beside this file and below.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(rename_all = "camelCase", default, deny_unknown_fields)]
pub struct Config {
    /// Lenses above rungs and steps.
    pub code_lens: CodeLens,
    /// Hints in the text.
    pub inlay_hints: InlayHints,
    /// Successions that are suggested.
    pub suggestions: Suggestions,
    /// Findings.
    pub diagnostics: Diagnostics,
    /// Proofs that a spec does what its ladder does.
    pub verify: Verify,
    /// The largest file that is analysed, in MiB.
    pub max_file_size: MaxFileSize,
}

/// Lenses above rungs and steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(inline))]
#[serde(rename_all = "camelCase", default, deny_unknown_fields)]
pub struct CodeLens {
    /// Show above each rung how many successions are open and accepted, and what the spec says of it; above a scenario how it went.
    pub enable: bool,
}

/// Hints in the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(inline))]
#[serde(rename_all = "camelCase", default, deny_unknown_fields)]
pub struct InlayHints {
    /// Show beside a coil whether it is persistent and what holds it; behind a step of a scenario what is on after it.
    pub enable: bool,
}

/// Successions that are suggested.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(inline))]
#[serde(rename_all = "camelCase", default, deny_unknown_fields)]
pub struct Suggestions {
    /// The weakest evidence that a succession needs to be listed in lenses, hovers and the light bulb.
    pub evidence: Weakest,
}

/// The weakest evidence that is still shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(inline))]
#[serde(rename_all = "lowercase")]
pub enum Weakest {
    /// List every succession that the conditions allow.
    Possible,
    /// List only successions in which what ends one state starts the other.
    Handover,
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
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(inline))]
#[serde(rename_all = "camelCase", default, deny_unknown_fields)]
pub struct Diagnostics {
    /// Report what is wrong or odd in ladders and specs, and what a scenario expects and does not get.
    pub enable: bool,
    /// Report findings in all files of the folder, open or not, where the editor asks for them.
    pub workspace: bool,
    /// Codes of findings that are not reported, such as `G2004`. Conditions and hovers still tell about them.
    #[serde(deserialize_with = "codes")]
    #[cfg_attr(test, schemars(inner(regex(pattern = "^G[0-9]{4}$"))))]
    pub ignore: Vec<String>,
}

impl Diagnostics {
    /// The codes that are left out.
    pub fn ignored(&self) -> HashSet<Code> {
        let codes = self.ignore.iter();
        codes.filter_map(|code| Code::parse(code)).collect()
    }
}

/// Proofs that a spec does what its ladder does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(inline))]
#[serde(rename_all = "camelCase", default, deny_unknown_fields)]
pub struct Verify {
    /// Find out in the background whether a spec does what its ladder does, whenever one of the two was changed.
    pub enable: bool,
    /// When outputs of ladder and spec are compared.
    pub timing: Timing,
    /// How much work that may be in the background, in millions of small steps. A hundred are about a second.
    pub effort: Effort,
}

/// When outputs are compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, ValueEnum)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(inline))]
#[serde(rename_all = "lowercase")]
pub enum Timing {
    /// After every scan.
    Scan,
    /// When both sides have come to rest with the same inputs.
    Settled,
}

impl From<Timing> for verification::Timing {
    fn from(timing: Timing) -> Self {
        match timing {
            Timing::Scan => Self::Scan,
            Timing::Settled => Self::Settled,
        }
    }
}

/// How much work something may be, in millions of small steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(inline))]
pub struct Effort(NonZeroU32);

impl Effort {
    /// The number.
    pub fn millions(self) -> u64 {
        self.0.get().into()
    }
}

/// The largest file that is analysed, in MiB.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(inline))]
pub struct MaxFileSize(NonZeroU32);

impl MaxFileSize {
    /// The same in bytes.
    pub fn bytes(self) -> u64 {
        u64::from(self.0.get()) << 20
    }
}

impl Default for CodeLens {
    fn default() -> Self {
        Self { enable: true }
    }
}

impl Default for InlayHints {
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
            workspace: true,
            ignore: Vec::new(),
        }
    }
}

impl Default for Verify {
    fn default() -> Self {
        const USUAL: NonZeroU32 = NonZeroU32::new(50).expect("more than none");
        Self {
            enable: true,
            timing: Timing::Scan,
            effort: Effort(USUAL),
        }
    }
}

impl Default for MaxFileSize {
    fn default() -> Self {
        const USUAL: NonZeroU32 = NonZeroU32::new(64).expect("more than none");
        Self(USUAL)
    }
}

/// Codes, each of which must be one.
fn codes<'a, D: Deserializer<'a>>(from: D) -> Result<Vec<String>, D::Error> {
    let codes = Vec::<String>::deserialize(from)?;
    match codes.iter().find(|code| Code::parse(code).is_none()) {
        Some(other) => Err(de::Error::custom(format!("`{other}` is no code"))),
        None => Ok(codes),
    }
}
