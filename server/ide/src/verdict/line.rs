//! A verdict in a line, for lenses and status bars.

use ::proof::Why;
use ::verification::{Difference, Reason, Timing, Verdict as Found, Verification, What};
use logic::Name;
use logic::notation::quoted;

use super::{Verdict, first_of, steps};

/// The verdict in a word: `equivalent`, `different`, `unknown`, `refused`. A
/// violated property counts as a difference.
pub fn verdict_word(verdict: &Verdict) -> &'static str {
    let Ok(found) = verdict else {
        return "refused";
    };
    let mut all = everything(found);
    if all.clone().any(|it| matches!(it, Found::Different(_))) {
        return "different";
    }
    match all.all(|it| *it == Found::Equivalent) {
        true => "equivalent",
        false => "unknown",
    }
}

fn everything(found: &Verification) -> impl Iterator<Item = &Found> + Clone {
    let properties = found.properties.iter().map(|(_, verdict)| verdict);
    std::iter::once(&found.verdict).chain(properties)
}

/// The verdict in a line: `equivalent under 7 rules (scan timing)`, `different
/// after 5 scans: v1`.
pub fn verdict_line(verdict: &Verdict) -> String {
    let found = match verdict {
        Ok(found) => found,
        Err(refusal) => return format!("cannot be verified: {refusal}"),
    };
    let mut parts = vec![outputs(found)];
    let proved = found.properties.iter();
    let proved = proved.filter(|(_, verdict)| *verdict == Found::Equivalent);
    match proved.count() {
        0 => {}
        1 => parts.push("1 property proved".to_owned()),
        more => parts.push(format!("{more} properties proved")),
    }
    for (label, verdict) in &found.properties {
        match verdict {
            Found::Equivalent => {}
            Found::Different(difference) => parts.push(format!(
                "{} violated after {}",
                quoted(label),
                steps(difference.trace.steps.len(), found.timing)
            )),
            Found::Unknown { .. } => parts.push(format!("{} not known", quoted(label))),
        }
    }
    parts.join(" · ")
}

fn outputs(found: &Verification) -> String {
    let timing = match found.timing {
        Timing::Scan => "scan timing",
        Timing::Settled => "settled timing",
    };
    match &found.verdict {
        Found::Equivalent if found.outputs.is_empty() => "no outputs are compared".to_owned(),
        Found::Equivalent => {
            let under = match found.rules {
                0 => String::new(),
                1 => " under 1 rule".to_owned(),
                rules => format!(" under {rules} rules"),
            };
            let so_far = found.deadlock.map_or_else(String::new, |most| {
                format!(", which allow no more than {}", steps(most, found.timing))
            });
            format!("equivalent{under}{so_far} ({timing})")
        }
        Found::Different(difference) => different(difference, found.timing),
        Found::Unknown { why, .. } => format!("not known: {}", reason(why)),
    }
}

fn different(difference: &Difference, timing: Timing) -> String {
    let after = steps(difference.trace.steps.len(), timing);
    match &difference.what {
        What::Outputs(names) => format!("different after {after}: {}", names_of(names)),
        What::Unstable(_) => format!("different after {after}: the spec finds no stable situation"),
        What::Restless => format!("different after {after}: something changes in every scan"),
        What::Property => format!("different after {after}"),
    }
}

/// So many names stand in a line.
const MOST_NAMES: usize = 3;

pub(super) fn names_of(names: &[Name]) -> String {
    let names: Vec<Name> = names.iter().map(|name| quoted(name).into()).collect();
    first_of(&names, MOST_NAMES).join(", ")
}

/// Why an answer is not known, in words.
pub(super) fn reason(why: &Reason) -> String {
    match why {
        Reason::Limits(Why::Steps) => "the effort is used up".to_owned(),
        Reason::Limits(Why::Memory) => "it would take more memory than is allowed".to_owned(),
        Reason::Limits(Why::Scans) => "no longer sequences are tried".to_owned(),
        Reason::Limits(Why::Cancelled) => "it was stopped".to_owned(),
        Reason::Limits(Why::Unconfirmed) => {
            "what was found did not happen again, which is a fault of Gradus".to_owned()
        }
        Reason::Nothing => "the spec has no output that the ladder knows".to_owned(),
        Reason::Numbers(names) => {
            let verb = if names.len() == 1 { "holds" } else { "hold" };
            format!("{} {verb} numbers that are not followed", names_of(names))
        }
        Reason::Unconfirmed => {
            "a difference was found that needs what is left free to be as it was not seen to be"
                .to_owned()
        }
        Reason::Rounds => "a scan takes too many evolutions to be followed".to_owned(),
    }
}
