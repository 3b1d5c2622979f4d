//! Findings about files, in the three forms that they are asked for: text for
//! people, JSON for scripts, SARIF for code-review tools.
//!
//! Core crates speak of bytes; here bytes become the lines and columns that
//! people count. A report is a value, not a side effect: commands decide where
//! it goes.

mod excerpt;
mod json;
mod printable;
mod sarif;
mod text;
mod uri;
mod values;

use std::path::PathBuf;

use source::{Diagnostic, LineColumn, LineIndex, Severity, Span};

pub use json::json;
pub use printable::printable;
pub use sarif::sarif;
pub use text::{text, unreadable};
pub use values::{on, value};

/// What was found in one file.
pub struct Findings {
    /// Its path, or `-`.
    pub path: PathBuf,
    /// Its bytes.
    pub text: Vec<u8>,
    /// The findings, in the order of their places.
    pub diagnostics: Vec<Diagnostic>,
    lines: LineIndex,
}

impl Findings {
    /// The findings about the file at `path` that holds `text`.
    pub fn new(path: PathBuf, text: Vec<u8>, diagnostics: Vec<Diagnostic>) -> Self {
        Self {
            lines: LineIndex::new(&text),
            path,
            text,
            diagnostics,
        }
    }

    /// How many findings have `severity`.
    pub fn count(&self, severity: Severity) -> usize {
        self.diagnostics
            .iter()
            .filter(|diagnostic| diagnostic.severity == severity)
            .count()
    }

    /// Where `span` begins, as people count.
    pub fn start(&self, span: Span) -> LineColumn {
        self.lines.locate(&self.text, span.start as usize)
    }

    /// Where `span` ends: just after its last character.
    pub fn end(&self, span: Span) -> LineColumn {
        self.lines.locate(&self.text, span.end as usize)
    }
}
