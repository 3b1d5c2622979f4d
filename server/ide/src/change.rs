//! What a decision changes: the spec beside the ladder, and nothing else.

use std::fmt;

use grafcet::{Decision, Verdict};
use logic::{Budget, Name};
use recovery::conversion::update;

use crate::{Ladder, Spec, decide, merged_spec};

/// One thing that somebody decides.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Change {
    /// A decision is made; those that it contradicts go.
    Make(Verdict),
    /// A decision is taken back.
    Withdraw(Verdict),
}

impl Change {
    /// Changes a list of decisions.
    pub fn apply(&self, ladder: &Ladder, decisions: &mut Vec<Decision>) {
        match self {
            Self::Make(Verdict::Accept { from, to }) => decide::accept(decisions, from, to),
            Self::Make(Verdict::Reject { from, to }) => decide::reject(decisions, from, to),
            Self::Make(Verdict::Initial(state)) => {
                let states = std::slice::from_ref(state);
                decide::start_in(states, &ladder.analysis, decisions);
            }
            Self::Make(verdict) => {
                if !decisions.iter().any(|it| it.verdict == *verdict) {
                    decisions.push(verdict.clone().into());
                }
            }
            Self::Withdraw(verdict) => decisions.retain(|it| it.verdict != *verdict),
        }
    }

    /// The change that `text` spells, as [`Change`]'s `Display` does.
    pub fn parse(text: &str) -> Option<Self> {
        let (withdrawn, line) = match text.strip_prefix(WITHDRAW) {
            Some(line) => (true, line),
            None => (false, text),
        };
        let decision = grafcet::read(line).spec.decisions.pop()?;
        Some(match withdrawn {
            true => Self::Withdraw(decision.verdict),
            false => Self::Make(decision.verdict),
        })
    }
}

const WITHDRAW: &str = "withdraw ";

impl fmt::Display for Change {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (prefix, verdict) = match self {
            Self::Make(verdict) => ("", verdict),
            Self::Withdraw(verdict) => (WITHDRAW, verdict),
        };
        let line = grafcet::decision_text(&verdict.clone().into());
        write!(f, "{prefix}{line}")
    }
}

/// What rules that depart from the ladder become.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Departing {
    /// They stay as they are.
    Stay,
    /// What the ladder gives takes their place.
    Renewed,
}

/// The text of the spec beside `ladder` after `changes`: the old text in which
/// only what follows from them is new.
pub fn changed_spec(
    ladder: &Ladder,
    spec: Option<&Spec>,
    changes: &[Change],
    departing: Departing,
    budget: &Budget,
) -> String {
    let existing = spec.map(|it| it.reading.spec.clone()).unwrap_or_default();
    let mut decisions = existing.decisions.clone();
    for change in changes {
        change.apply(ladder, &mut decisions);
    }
    let updated = update(&ladder.analysis, &existing, &decisions, budget);
    let mut new = updated.spec;
    if departing == Departing::Renewed {
        for departure in &updated.departures {
            departure.renew(&mut new);
        }
    }
    let text = spec.map_or("", |it| &*it.text);
    merged_spec(&ladder.analysis, text, &existing, &new, budget)
}

/// `v2`, or `v2, h and m`.
pub(crate) fn listed(names: &[Name]) -> String {
    match names {
        [] => String::new(),
        [one] => one.to_string(),
        [rest @ .., last] => format!("{} and {last}", rest.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_change_reads_back_as_it_was_spelled() {
        for text in [
            "//! accept v1 -> v2 & h",
            "//! reject \"a b\" -> c",
            "withdraw //! initial Seq=10",
        ] {
            let change = Change::parse(text).expect("a change");
            assert_eq!(change.to_string(), text);
        }
        assert_eq!(Change::parse("v1 -> v2"), None);
    }

    const TANK: &str = "rung: (s + v1) * /ls2 -> v1\nrung: ls2 + v2*/ls3 -> v2\n";

    #[test]
    fn accepting_adds_the_rule_and_keeps_what_people_wrote() {
        let budget = Budget::default();
        let ladder = Ladder::read(TANK.into(), &budget);
        let text = |spec: Option<&Spec>, changes: &[&str]| {
            let changes: Vec<Change> = changes.iter().filter_map(|it| Change::parse(it)).collect();
            changed_spec(&ladder, spec, &changes, Departing::Stay, &budget)
        };
        let first = text(None, &["//! accept v1 -> v2"]);
        assert!(first.contains("Xv1*ls2 |- @Xv2"), "{first}");
        let noted = first.replace(
            "//! accept v1 -> v2",
            "//! accept v1 -> v2  // seen at the tank",
        );
        let spec = Spec::read(noted.clone().into());
        assert_eq!(text(Some(&spec), &[]), noted);
        let back = text(Some(&spec), &["withdraw //! accept v1 -> v2"]);
        assert!(!back.contains("accept"), "{back}");
    }
}
