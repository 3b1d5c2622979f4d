//! What can be typed at a place.
//!
//! A [`Completion`] holds a text and what is known of it; the list is in order,
//! best first. Each notation has its own file; what variables a ladder has is
//! the same for all.

mod boxes;
mod decision;
mod known;
mod ladder;
mod neutral;
mod scenario;
mod spec;
mod variables;

use logic::Name;
use source::Span;

pub(crate) use boxes::BOXES;
pub use ladder::complete_in_ladder;
pub(crate) use ladder::spell;
pub(crate) use neutral::open_call;
pub use scenario::complete_in_scenario;
pub use spec::complete_in_spec;

/// What can be typed at a place, best first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Completions {
    /// The bytes that a completion replaces: what is typed of it so far.
    pub span: Span,
    /// All that fits; it may begin with something else than what is typed.
    pub items: Vec<Completion>,
}

/// Something that can be typed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Completion {
    /// What is shown.
    pub label: String,
    /// What it is.
    pub kind: CompletionKind,
    /// What else is shown beside it, in a few words.
    pub detail: String,
    /// What it means, in sentences.
    pub documentation: Option<String>,
    /// The text that is put in.
    pub insert: String,
    /// The same with places to fill in, `${1:time}`, as clients write them.
    pub snippet: Option<String>,
    /// The variable that it names: its conditions can be asked for later.
    pub variable: Option<Name>,
}

/// What a completion is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CompletionKind {
    /// A variable.
    Variable,
    /// A constant.
    Constant,
    /// A word of the notation.
    Keyword,
    /// A box or an instruction.
    Box,
    /// A type.
    Type,
    /// A routine or a part of a grafcet.
    Routine,
    /// A label, of a rung or of a rule.
    Label,
    /// A step of a grafcet.
    Step,
    /// A state of the ladder.
    State,
    /// A whole line.
    Line,
    /// A file.
    File,
}

impl Completion {
    /// One that puts in what is shown.
    fn new(label: impl Into<String>, kind: CompletionKind, detail: impl Into<String>) -> Self {
        let label = label.into();
        Self {
            insert: label.clone(),
            label,
            kind,
            detail: detail.into(),
            documentation: None,
            snippet: None,
            variable: None,
        }
    }

    /// A word of the notation.
    fn word(label: &str, detail: &str) -> Self {
        Self::new(label, CompletionKind::Keyword, detail)
    }

    /// Puts in something else than what is shown.
    fn insert(mut self, insert: impl Into<String>) -> Self {
        self.insert = insert.into();
        self
    }

    /// Has places to fill in.
    fn snippet(mut self, snippet: impl Into<String>) -> Self {
        self.snippet = Some(snippet.into());
        self
    }
}

/// A box or an instruction with its operands to fill in.
fn call(name: &str, operands: &[&str], summary: &str) -> Completion {
    let filled: Vec<String> = operands
        .iter()
        .zip(1..)
        .map(|(operand, at)| format!("${{{at}:{operand}}}"))
        .collect();
    Completion::new(name, CompletionKind::Box, summary)
        .insert(format!("{name}("))
        .snippet(format!("{name}({})", filled.join(", ")))
}

#[cfg(test)]
mod tests {
    use logic::Budget;
    use recovery::successions::Evidence;

    use super::*;
    use crate::{Ladder, Spec};

    /// The completions at `$0`, and what they replace.
    pub(super) fn in_ladder(text: &str) -> (Vec<String>, String) {
        let offset = text.find("$0").expect("a cursor");
        let text = text.replace("$0", "");
        let ladder = Ladder::read(text.as_str().into(), &Budget::default());
        let found = complete_in_ladder(&ladder, offset);
        shown(found, &text)
    }

    pub(super) fn in_spec(ladder: &str, text: &str) -> (Vec<String>, String) {
        let offset = text.find("$0").expect("a cursor");
        let text = text.replace("$0", "");
        let budget = Budget::default();
        let ladder = Ladder::read(ladder.into(), &budget);
        let spec = Spec::read(text.as_str().into());
        let found = complete_in_spec(&spec, Some(&ladder), offset, Evidence::Possible, &budget);
        shown(found, &text)
    }

    fn shown(found: Option<Completions>, text: &str) -> (Vec<String>, String) {
        let found = found.unwrap_or(Completions {
            span: Span::default(),
            items: Vec::new(),
        });
        let labels = found.items.iter().map(|it| it.insert.clone()).collect();
        (labels, text[found.span.range()].to_owned())
    }
}
