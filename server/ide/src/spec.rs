use std::sync::Arc;

use logic::Budget;
use recovery::conversion::spec_findings;
use source::Diagnostic;

use crate::Ladder;

/// A spec that somebody looks at.
#[derive(Debug)]
pub struct Spec {
    /// The text, as the file or the editor has it.
    pub text: Arc<str>,
    /// What was read from it.
    pub reading: grafcet::Reading,
}

impl Spec {
    /// Reads `text`, whatever it holds.
    pub fn read(text: Arc<str>) -> Self {
        Self {
            reading: grafcet::read(&text),
            text,
        }
    }

    /// Everything there is to say about the spec, in the order of the places:
    /// about its text and, with its ladder, about what the ladder does not
    /// support.
    pub fn findings(&self, ladder: Option<&Ladder>, budget: &Budget) -> Vec<Diagnostic> {
        let mut found = match ladder {
            Some(ladder) => spec_findings(&ladder.analysis, &self.reading, &self.text, budget),
            None => Vec::new(),
        };
        found.extend(self.reading.diagnostics.iter().cloned());
        found.sort_by_key(|finding| (finding.span, finding.code));
        found
    }
}
