//! What is shown of the thing under the pointer.
//!
//! A [`Hover`] is a heading, then blocks: the same for every format, on a
//! contact in XML as on a name in rung notation. How blocks look, with Markdown
//! or without, is said here once.

mod coil;
mod ladder;
mod markdown;
mod spec;

use source::Span;

use crate::condition::broken;
use markdown::escaped;

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
    /// Labels with conditions, in columns, as they are. What a condition is
    /// broken into has one label.
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
        for part in parts(&self.blocks) {
            out += &match part {
                Part::Words(words) => format!("\n\n{}", escaped(words)),
                Part::Lines(lines) => format!("\n\n```text\n{lines}\n```"),
            };
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
        for part in parts(&self.blocks) {
            out += &match part {
                Part::Words(words) => format!("\n\n{words}"),
                Part::Lines(lines) => format!("\n\n{lines}"),
            };
        }
        out
    }
}

/// What is shown in one piece.
enum Part<'b> {
    /// Words, to be broken where they are shown.
    Words(&'b str),
    /// Lines as they are.
    Lines(String),
}

/// The parts of a hover. What stands in lines is one part, with the same columns
/// and blank lines between, up to the next words.
fn parts(blocks: &[Block]) -> Vec<Part<'_>> {
    let is_words = |block: &Block| matches!(block, Block::Text(_));
    let runs = blocks.chunk_by(|a, b| !is_words(a) && !is_words(b));
    let shown = runs.map(|run| match run {
        [Block::Text(words)] => Part::Words(words),
        run => {
            let labels = run.iter().flat_map(|block| match block {
                Block::Fields(fields) => fields.as_slice(),
                _ => &[],
            });
            let start = labels.map(|(label, _)| label.len()).max().unwrap_or(0) + 2;
            let lines = run.iter().map(|block| match block {
                Block::Fields(fields) => columns(fields, start),
                Block::Text(lines) | Block::Drawing(lines) => lines.clone(),
            });
            Part::Lines(lines.collect::<Vec<_>>().join("\n\n"))
        }
    });
    shown.collect()
}

/// How wide a hover may be: in columns, as many as editors show without breaking
/// lines.
const WIDTH: usize = 76;

/// Labels, and what belongs to them from the column `start` on.
fn columns(fields: &[(&'static str, String)], start: usize) -> String {
    let lines = fields.iter().map(|(label, text)| {
        let line = format!("{label:start$}{}", broken(text, start, WIDTH));
        line.trim_end().to_owned()
    });
    lines.collect::<Vec<_>>().join("\n")
}
