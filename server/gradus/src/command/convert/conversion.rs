//! A conversion under way: the ladder, the spec as it is, the decisions as they
//! will be.

use std::collections::BTreeSet;

use grafcet::{Decision, Spec, Verdict};
use logic::{Budget, Name};
use recovery::Analysis;
use recovery::conversion::{Unsaid, spec_findings, unsaid, update};
use recovery::successions::{Evidence, Succession};
use source::Diagnostic;

use super::spec_file::SpecFile;
use ide::{legible, merged_spec};

/// A conversion under way.
pub struct Conversion<'a> {
    /// What is known of the ladder.
    pub analysis: &'a Analysis,
    /// The spec as it was last read or written.
    pub file: SpecFile,
    /// The decisions that the file holds.
    pub made: Vec<Decision>,
    /// The decisions that it shall hold.
    pub decisions: Vec<Decision>,
    existing: Spec,
    budget: &'a Budget,
    renewing: Renewing,
}

/// What becomes of rules that depart from what the ladder gives.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Renewing {
    No,
    Yes,
}

impl<'a> Conversion<'a> {
    /// With the decisions that `file` holds.
    pub fn begin(analysis: &'a Analysis, file: SpecFile, budget: &'a Budget) -> Self {
        let existing = grafcet::read(&file.text).spec;
        Self {
            analysis,
            made: existing.decisions.clone(),
            decisions: existing.decisions.clone(),
            existing,
            file,
            budget,
            renewing: Renewing::No,
        }
    }

    /// From now on rules that depart from the ladder are replaced.
    pub fn renew(&mut self) {
        self.renewing = Renewing::Yes;
    }

    /// The variables that the spec does not say exactly, and why.
    pub fn unsaid(&self) -> Vec<(Name, Unsaid)> {
        unsaid(self.analysis, &self.decisions, self.budget)
    }

    /// The text that the file shall hold.
    pub fn text(&self) -> String {
        let updated = update(self.analysis, &self.existing, &self.decisions, self.budget);
        let mut spec = updated.spec;
        if self.renewing == Renewing::Yes {
            for departure in &updated.departures {
                departure.renew(&mut spec);
            }
        }
        let text = &self.file.text;
        merged_spec(self.analysis, text, &self.existing, &spec, self.budget)
    }

    /// Writes the file. The error says why it was left as it is.
    pub fn save(&mut self) -> Result<(), String> {
        let text = self.text();
        self.file.save(&text)?;
        self.existing = grafcet::read(&text).spec;
        Ok(())
    }

    /// What there is to say about a spec that holds `text`.
    pub fn findings(&self, text: &str) -> Vec<Diagnostic> {
        let reading = grafcet::read(text);
        // A spec that was just made agrees with its ladder.
        let mut found = match self.existing == Spec::default() {
            true => Vec::new(),
            false => spec_findings(self.analysis, &reading, text, self.budget),
        };
        found.extend(reading.diagnostics);
        found.sort_by_key(|diagnostic| (diagnostic.span, diagnostic.code));
        found
    }

    /// Suggestions about which nothing is decided, best first.
    pub fn open(&self) -> Vec<&'a Succession> {
        let decided: BTreeSet<(&Name, &Name)> = self
            .decisions
            .iter()
            .flat_map(|decision| match &decision.verdict {
                Verdict::Accept { from, to } => to.iter().map(|to| (from, to)).collect(),
                Verdict::Reject { from, to } => vec![(from, to)],
                _ => Vec::new(),
            })
            .collect();
        let all = self.analysis.successions().iter();
        all.filter(|it| it.evidence != Evidence::Written)
            .filter(|it| !decided.contains(&(&it.from, &it.to)))
            .collect()
    }

    /// The condition of a suggestion, in the notation; `None` if it is too long.
    pub fn condition(&self, succession: &Succession) -> Option<String> {
        let condition = succession.condition.as_ref()?;
        legible(condition, &self.analysis.conditions, self.budget)
    }

    /// What ends a state; `None` if it is too long.
    pub fn ends_on(&self, state: &Name) -> Option<String> {
        let state = self.analysis.states().find(state)?;
        legible(&state.deactivation, &self.analysis.conditions, self.budget)
    }
}
