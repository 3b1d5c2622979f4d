//! Whether the spec that was written does what the ladder does, as far as a
//! small effort finds out.

use ladder::Program;
use logic::Cancel;
use logic::notation::quoted;
use proof::Limits;
use verification::{Timing, Verdict, Verification, What, verify};

use crate::input::numbered;
use crate::report::printable;

/// So many steps are worth it without being asked: about half a second.
pub const EFFORT: u64 = 50_000_000;

/// So many are worth it for a spec that no person has looked at.
pub const THOROUGH: u64 = 1_000_000_000;

/// What was found: the word for scripts, and a sentence for people.
pub struct Found {
    /// `equivalent`, `different`, `unknown`, or null where nothing is compared.
    pub word: Option<&'static str>,
    /// `equivalent` where it is so only when both sides rest.
    pub settled: Option<&'static str>,
    /// How it stands.
    pub sentence: String,
}

/// Verifies the spec that `text` holds, with so many steps.
pub fn of(program: &Program, text: &str, effort: u64, cancel: &Cancel) -> Found {
    let limits = Limits {
        steps: effort,
        cancel: cancel.clone(),
        ..Limits::default()
    };
    let spec = grafcet::read(text).spec;
    match verify(program, &spec, Timing::Scan, &limits) {
        Ok(found) => {
            // A ladder with transition bits of its own moves a scan late.
            let settles = matches!(found.verdict, Verdict::Different(_))
                && verify(program, &spec, Timing::Settled, &limits)
                    .is_ok_and(|it| it.verdict == Verdict::Equivalent);
            told(&found, settles)
        }
        Err(refusal) => Found {
            word: Some("unknown"),
            settled: None,
            sentence: format!("cannot be verified: {}", printable(&refusal.to_string())),
        },
    }
}

/// What is told; `settles` where it is equivalent when both sides rest.
fn told(found: &Verification, settles: bool) -> Found {
    if found.outputs.is_empty() {
        return Found {
            word: None,
            settled: None,
            sentence: "nothing to verify: the spec has no outputs".to_owned(),
        };
    }
    let (word, sentence) = match &found.verdict {
        Verdict::Equivalent if found.rules == 0 => (
            "equivalent",
            "does what the ladder does, whatever the inputs".to_owned(),
        ),
        Verdict::Equivalent => (
            "equivalent",
            format!(
                "does what the ladder does, whatever the inputs that {} allow",
                numbered(found.rules, "environment rule")
            ),
        ),
        Verdict::Different(difference) => {
            let after = numbered(difference.trace.steps.len(), "scan");
            let what = match &difference.what {
                What::Outputs(names) => {
                    let names: Vec<String> =
                        names.iter().map(|it| printable(&quoted(it))).collect();
                    format!("in {} after {after}", names.join(", "))
                }
                What::Unstable(_) => format!("has no stable situation after {after}"),
                What::Restless | What::Property => format!("after {after}"),
            };
            let but = match settles {
                true => ", but not when both rest (settled)",
                false => "",
            };
            (
                "different",
                format!("differs from the ladder {what}{but}; `gradus verify` shows it"),
            )
        }
        Verdict::Unknown { .. } => (
            "unknown",
            "not verified with a small effort; `gradus verify` tries harder".to_owned(),
        ),
    };
    Found {
        word: Some(word),
        settled: settles.then_some("equivalent"),
        sentence,
    }
}
