//! Whether a spec does what its ladder does, as somebody who edits the two is
//! shown it.
//!
//! What was found is a [`Verdict`], worked out by `verification` for a
//! [`Question`]; here it is said: in [a line](verdict_line), as
//! [findings](verdict_findings) in the spec with the rungs that decide, as
//! [a scenario](trace_scenario) that shows the difference again, and as
//! [rules](exclusions) about the plant under which it cannot happen.

mod exclusion;
mod findings;
mod line;
mod observed;
mod question;
mod rule;
#[cfg(test)]
mod tests_of_verdicts;
mod trace;

use std::collections::BTreeSet;

use ::verification::{Difference, Refusal, Verdict as Found, Verification};
use grafcet::{Role, RulePlace};
use logic::Name;

use crate::{Ladder, Spec};

pub use exclusion::{Exclusion, exclusions};
pub use findings::{VerdictFinding, verdict_findings};
pub use line::{verdict_line, verdict_word};
pub use observed::Observed;
pub use question::Question;
pub use trace::{trace_name, trace_scenario};

/// What was found about a ladder and its spec, or why the two cannot be
/// compared.
pub type Verdict = Result<Verification, Refusal>;

/// A ladder and its spec with what was found about them.
#[derive(Clone, Copy, Debug)]
pub struct Judged<'a> {
    /// The ladder.
    pub ladder: &'a Ladder,
    /// The spec.
    pub spec: &'a Spec,
    /// What was found.
    pub verdict: &'a Verdict,
}

/// What a sequence of inputs shows.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum About {
    /// That ladder and spec differ.
    Outputs,
    /// That a property of the spec is violated: its label.
    Property(Name),
}

impl<'a> Judged<'a> {
    /// The sequence that shows something, if there is one.
    pub fn difference(&self, about: &About) -> Option<&'a Difference> {
        let found = self.verdict.as_ref().ok()?;
        let verdict = match about {
            About::Outputs => &found.verdict,
            About::Property(label) => {
                let mut all = found.properties.iter();
                &all.find(|(name, _)| name == label)?.1
            }
        };
        match verdict {
            Found::Different(difference) => Some(difference),
            Found::Equivalent | Found::Unknown { .. } => None,
        }
    }

    /// The variables that the property of a label speaks of.
    fn names_of_property(&self, label: &Name) -> Vec<Name> {
        let Some(rule) = rule_of(self.spec, label) else {
            return Vec::new();
        };
        let mentions = self.spec.reading.places.mentions.iter();
        let within = mentions.filter(|it| rule.span.cover(it.span) == rule.span);
        let names = within.filter(|it| it.role == Role::Variable);
        let names: BTreeSet<Name> = names.map(|it| it.name.clone()).collect();
        names.into_iter().collect()
    }
}

/// The environment rule or property of a label, where it stands.
fn rule_of<'s>(spec: &'s Spec, label: &Name) -> Option<&'s RulePlace> {
    let mut rules = spec.reading.places.rules.iter();
    rules.find(|it| it.role == Role::Rule && it.name == *label)
}

/// The first of these names, and how many more there are: a real program has
/// dozens of outputs, and nobody reads a line of them.
fn first_of(names: &[Name], most: usize) -> Vec<Name> {
    let left = names.len().saturating_sub(most);
    let more = (left > 0).then(|| format!("{left} more").into());
    names.iter().take(most).cloned().chain(more).collect()
}

/// `1 scan`, `5 scans`; `2 settled steps` where a step is as many as settle.
fn steps(number: usize, timing: ::verification::Timing) -> String {
    let word = match timing {
        ::verification::Timing::Scan => "scan",
        ::verification::Timing::Settled => "settled step",
    };
    let plural = if number == 1 { "" } else { "s" };
    format!("{number} {word}{plural}")
}
