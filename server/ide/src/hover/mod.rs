//! What is shown of the thing under the pointer.
//!
//! A [`Hover`] is a heading, then blocks: the same for every format, on a
//! contact in XML as on a name in rung notation. How blocks look, with Markdown
//! or without, is said here once.

mod coil;
mod ladder;
mod spec;

use source::Span;

pub use ladder::{hover_in_ladder, hover_of_variable};
pub use spec::hover_in_spec;

/// What is shown of the thing under the pointer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hover {
    /// The bytes it is about.
    pub span: Span,
    /// What it is called.
    pub name: String,
    /// What stands behind the name: an address.
    pub address: Option<String>,
    /// What it is, in a line.
    pub summary: String,
    /// All else, from above downwards.
    pub blocks: Vec<Block>,
}

/// A part of a hover.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Block {
    /// Labels with conditions, one a line, in columns.
    Fields(Vec<(&'static str, String)>),
    /// A sentence or two.
    Text(String),
    /// Lines of characters as they are.
    Drawing(String),
}

impl Hover {
    /// The hover in Markdown.
    pub fn markdown(&self) -> String {
        let mut out = format!("**{}**", escaped(&self.name));
        if let Some(address) = &self.address {
            out += &format!(" `{address}`");
        }
        if !self.summary.is_empty() {
            out += &format!("  \n{}", escaped(&self.summary));
        }
        for block in &self.blocks {
            out += "\n\n";
            match block {
                Block::Fields(fields) => out += &format!("```text\n{}\n```", columns(fields)),
                Block::Text(text) => out += &escaped(text),
                Block::Drawing(lines) => out += &format!("```text\n{lines}\n```"),
            }
        }
        out
    }

    /// The hover as plain text.
    pub fn plain(&self) -> String {
        let mut out = self.name.clone();
        if let Some(address) = &self.address {
            out += &format!("  {address}");
        }
        if !self.summary.is_empty() {
            out += &format!("\n{}", self.summary);
        }
        for block in &self.blocks {
            out += "\n\n";
            match block {
                Block::Fields(fields) => out += &columns(fields),
                Block::Text(text) | Block::Drawing(text) => out += text,
            }
        }
        out
    }
}

fn columns(fields: &[(&'static str, String)]) -> String {
    let width = fields
        .iter()
        .map(|(label, _)| label.len())
        .max()
        .unwrap_or(0);
    let lines = fields
        .iter()
        .map(|(label, text)| format!("{label:width$}  {text}"));
    lines.collect::<Vec<_>>().join("\n")
}

/// `text` as Markdown shows it. Comments in programs are people's own words and
/// may hold anything.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        if matches!(
            c,
            '\\' | '`' | '*' | '_' | '[' | ']' | '<' | '>' | '#' | '|' | '~' | '&'
        ) {
            out.push('\\');
        }
        out.push(c);
    }
    out
}
