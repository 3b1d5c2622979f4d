//! What is shown of the thing under the pointer.
//!
//! A [`Hover`] is a heading, then blocks: the same for every format, on a
//! contact in XML as on a name in rung notation. How blocks look, with Markdown
//! or without, is said here once.

mod coil;
mod ladder;
mod markdown;
mod scenario;
mod spec;

use source::Span;

use crate::Term;
use crate::condition::broken;
use markdown::{escaped, in_brackets};

pub(crate) use ladder::rung_title;
pub use ladder::{hover_in_ladder, hover_of_variable};
pub use scenario::{RunOn, hover_in_scenario};
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
    /// Words that it uses, and that have a page.
    pub terms: Vec<Term>,
}

/// What a hover may lead to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// The rung at this place in the ladder.
    Rung(Span),
    /// The page of a word.
    Page(Term),
}

/// A part of a hover.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Block {
    /// Labels with conditions, in columns, as they are. What a condition is
    /// broken into has one label.
    Fields(Vec<(&'static str, String)>),
    /// A sentence or two.
    Text(String),
    /// Rungs of the ladder, and what they do.
    Rungs(Rungs),
    /// Lines of characters as they are.
    Drawing(String),
}

/// Rungs that a hover speaks of.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rungs {
    /// What they do.
    pub label: &'static str,
    /// What each is called, and where it is in the ladder.
    pub named: Vec<(String, Span)>,
    /// How many more there are.
    pub more: usize,
}

impl Rungs {
    fn said(&self, name: impl Fn(&str, Span) -> String) -> String {
        let named = self.named.iter().map(|(title, span)| name(title, *span));
        let named: Vec<String> = named.collect();
        let more = match self.more {
            0 => String::new(),
            more => format!(" and {more} more"),
        };
        format!("{} {}{more}", self.label, named.join(", "))
    }
}

impl Hover {
    /// The hover in Markdown. `link` gives the address of what shall have one.
    pub fn markdown(&self, link: &dyn Fn(Target) -> Option<String>) -> String {
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
                Part::Rungs(rungs) => {
                    let said = rungs.said(|title, span| match link(Target::Rung(span)) {
                        Some(address) => format!("[{}]({address})", in_brackets(title)),
                        None => escaped(title),
                    });
                    format!("\n\n{said}")
                }
                Part::Lines(lines) => format!("\n\n```text\n{lines}\n```"),
            };
        }
        let pages = self.terms.iter().filter_map(|term| {
            let address = link(Target::Page(*term))?;
            Some(format!("[{}]({address})", term.words()))
        });
        let pages: Vec<String> = pages.collect();
        if !pages.is_empty() {
            out += &format!("\n\nMore on {}", pages.join(", "));
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
                Part::Rungs(rungs) => {
                    let said = rungs.said(|title, _| title.to_owned());
                    format!("\n\n{said}")
                }
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
    /// The same of rungs.
    Rungs(&'b Rungs),
    /// Lines as they are.
    Lines(String),
}

/// The parts of a hover. What stands in lines is one part, with the same columns
/// and blank lines between, up to the next words.
fn parts(blocks: &[Block]) -> Vec<Part<'_>> {
    let is_words = |block: &Block| matches!(block, Block::Text(_) | Block::Rungs(_));
    let runs = blocks.chunk_by(|a, b| !is_words(a) && !is_words(b));
    let shown = runs.map(|run| match run {
        [Block::Text(words)] => Part::Words(words),
        [Block::Rungs(rungs)] => Part::Rungs(rungs),
        run => {
            let labels = run.iter().flat_map(|block| match block {
                Block::Fields(fields) => fields.as_slice(),
                _ => &[],
            });
            let start = labels.map(|(label, _)| label.len()).max().unwrap_or(0) + 2;
            let lines = run.iter().filter_map(|block| match block {
                Block::Fields(fields) => Some(columns(fields, start)),
                Block::Drawing(lines) => Some(lines.clone()),
                Block::Text(_) | Block::Rungs(_) => None,
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
