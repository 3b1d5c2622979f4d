//! What a document holds, as a tree: for outlines, and for finding a thing by
//! its name in a whole folder.

mod ladder;
mod matching;
mod scenario;
mod spec;

use source::Span;

pub use ladder::{names_of_program, symbols_of_ladder};
pub use matching::rank;
pub use scenario::symbols_of_scenario;
pub use spec::symbols_of_spec;

/// A thing with a name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Symbol {
    /// What it is called.
    pub name: String,
    /// What else there is to say, in a line.
    pub detail: Option<String>,
    /// What it is.
    pub kind: SymbolKind,
    /// All of it.
    pub whole: Span,
    /// What names it, inside of the whole.
    pub span: Span,
    /// What stands in it, in the order of the text.
    pub children: Vec<Symbol>,
}

/// What a symbol is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SymbolKind {
    /// A program, a POU.
    Program,
    /// A routine.
    Routine,
    /// A rung.
    Rung,
    /// A coil that holds a state, or a value written to a step register.
    State,
    /// Any other coil.
    Coil,
    /// A constant that is written to a number, of which nobody asked whether it
    /// counts steps.
    Value,
    /// A box: a timer, a counter, a call.
    Box,
    /// A label of jumps.
    Label,
    /// A grafcet.
    Grafcet,
    /// A part of a grafcet.
    Part,
    /// A section of rules.
    Section,
    /// A step.
    Step,
    /// A transition.
    Transition,
    /// An action of a step.
    Action,
    /// An environment rule or a property.
    Rule,
    /// A scenario.
    Scenario,
    /// A step of a scenario.
    ScenarioStep,
}

impl SymbolKind {
    /// Whether people look for it by its name in a whole folder.
    pub fn is_looked_for(self) -> bool {
        !matches!(
            self,
            Self::Section | Self::Action | Self::Box | Self::ScenarioStep
        )
    }
}

impl Symbol {
    fn new(kind: SymbolKind, name: impl Into<String>, whole: Span, span: Span) -> Self {
        Self {
            name: name.into(),
            detail: None,
            kind,
            // Clients refuse a name outside of the whole.
            whole: whole.cover(span),
            span,
            children: Vec::new(),
        }
    }

    fn detailed(mut self, detail: impl Into<String>) -> Self {
        let detail = detail.into();
        self.detail = (!detail.is_empty()).then_some(detail);
        self
    }
}

/// The longest name that is shown of a comment, in characters.
const LONGEST: usize = 80;

/// The first line of `text` that says something, cut where it gets too long.
fn title(text: &str) -> String {
    let lines = text.lines().map(str::trim);
    let line = lines.into_iter().find(|it| !it.is_empty());
    let line = line.unwrap_or_default();
    match line.char_indices().nth(LONGEST) {
        Some((at, _)) => format!("{}…", line[..at].trim_end()),
        None => line.to_owned(),
    }
}

#[cfg(test)]
pub(crate) fn drawn(symbols: &[Symbol], text: &str, depth: usize) -> String {
    let mut out = String::new();
    for symbol in symbols {
        let named = &text[symbol.span.range()];
        let detail = symbol.detail.as_deref().unwrap_or("-");
        out += &format!(
            "{}{:?} {} | {detail} | {named}\n",
            "  ".repeat(depth),
            symbol.kind,
            symbol.name
        );
        out += &drawn(&symbol.children, text, depth + 1);
    }
    out
}
