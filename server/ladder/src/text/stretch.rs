//! What a stretch of statements says, read by itself.

use std::collections::HashMap;
use std::ops::Range;

use source::Diagnostic;

use super::names::{Names, Spellings};
use super::read::{
    Meaning, Written, comments_at_end, move_to_file, pins, understand, without_output,
};
use super::statement::{Item, Keyword, Statement, cut};
use crate::reading::Source;
use crate::{Declarations, Rung};

/// The first word of a statement.
#[derive(Clone, Copy, Debug)]
pub(super) struct Head {
    /// Its first byte in the text.
    pub(super) start: u32,
    pub(super) keyword: Keyword,
}

impl Head {
    pub(super) fn start(self) -> usize {
        self.start as usize
    }

    /// Up to where `text` must stay the same for the head to do so: what
    /// follows a word tells where it ends.
    pub(super) fn reach(self, text: &str) -> usize {
        let end = self.start() + self.keyword.len();
        let next = text.get(end..).and_then(|rest| rest.chars().next());
        end + next.map_or(1, char::len_utf8)
    }
}

/// The head of a statement of a stretch that begins at `base`.
pub(super) fn head(statement: &Statement, base: usize) -> Option<Head> {
    let start = base + statement.span().range().start;
    Some(Head {
        start: u32::try_from(start).unwrap_or(u32::MAX),
        keyword: statement.keyword?,
    })
}

/// What the statements of a stretch say: their rungs, and what concerns
/// others.
pub(super) struct Said<'t> {
    pub(super) rungs: Vec<Rung>,
    pub(super) findings: Vec<Diagnostic>,
    pub(super) heads: Vec<Head>,
    pub(super) statements: usize,
    pub(super) pins: HashMap<String, usize>,
    pub(super) undeclared: Vec<String>,
    /// The comment lines at its end.
    pub(super) comments: Vec<&'t str>,
}

impl<'t> Said<'t> {
    /// Reads a stretch of the text; `None` if it declares something or begins
    /// a program or routine. Statements that begin before the byte `from` stand
    /// there for the comments between them and the next.
    pub(super) fn in_stretch(
        source: Source<'t>,
        stretch: Range<usize>,
        from: usize,
        declared: &Declarations,
        spellings: &Spellings,
    ) -> Option<Self> {
        let text = source.text.get(stretch.clone())?;
        let base = source.base + stretch.start;
        let source = Source { text, base };
        let items = cut(text);
        let is_read = |it: &&Statement| it.span().range().start + stretch.start >= from;
        let statements = || items.iter().filter_map(Item::statement).filter(is_read);
        let mut findings = Vec::new();
        let mut written = Vec::new();
        for (at, item) in items.iter().enumerate() {
            let Some(statement) = item.statement().filter(is_read) else {
                continue;
            };
            let (meaning, problems) = understand(text, statement);
            match meaning {
                Some(Meaning::Rung(rung)) => {
                    if problems.is_empty() {
                        findings.extend(without_output(&rung, statement.span()));
                    }
                    let before = items.get(..at).unwrap_or_default();
                    written.push(Written {
                        rung,
                        statement,
                        before,
                    });
                }
                None if statement.keyword.is_none() => {}
                _ => return None,
            }
            findings.extend(problems);
        }
        let mut names = Names::new(declared, spellings.clone());
        let drawn = written.iter();
        let rungs = drawn.map(|rung| rung.drawn(0, source, &mut names, &mut findings));
        let rungs = rungs.collect();
        for finding in &mut findings {
            move_to_file(finding, source);
        }
        Some(Self {
            rungs,
            findings,
            heads: statements()
                .filter_map(|it| head(it, stretch.start))
                .collect(),
            statements: statements().count(),
            pins: pins(text, statements()),
            undeclared: names.undeclared,
            comments: comments_at_end(text, &items),
        })
    }
}
