//! Where new lines go: at the end of the section they belong to.
//!
//! A new section, and a new part, begins only where a section ends, so that
//! no rule ever finds itself under another head than the one it was written
//! under.

use logic::Name;
use source::{Edit, Span};

use super::edits::whole_lines;
use crate::rules::syntax::{Document, Kind, Statement};
use crate::rules::words::{Section, Word};
use crate::rules::write::{WIDTH, is_bare};

/// Where new lines that declare with `word` go.
pub(super) fn for_declaration(document: &Document<'_>, part: Option<&Name>, word: Word) -> usize {
    let rank_of = |statement: &Statement| match &statement.kind {
        Kind::List(other, _) if word.is_global() && other.is_global() => Some(Some(*other)),
        Kind::List(other, _) if statement.part.as_ref() == part => Some(Some(*other)),
        Kind::Grafcet(_) if part.is_none() && statement.part.is_none() => Some(None),
        Kind::Part(name, _) if Some(name) == part => Some(None),
        _ => None,
    };
    // After the last list of the nearest word before it.
    let ranked = document.statements.iter().filter_map(|statement| {
        let rank = rank_of(statement)?;
        (rank <= Some(word)).then_some((rank, statement))
    });
    if let Some((_, statement)) = ranked.max_by_key(|(rank, _)| *rank) {
        return statement.next();
    }
    // Else before whatever begins first.
    let mut all = document.statements.iter();
    let first = all.find(|statement| {
        statement.part.as_ref() == part && is_significant(statement)
            || matches!(statement.kind, Kind::Part(..))
    });
    first.map_or(document.text.len(), Statement::start)
}

/// Whether a statement is more than a blank line, a comment or a decision.
fn is_significant(statement: &Statement) -> bool {
    !statement.tokens.is_empty()
}

/// Where new names can be declared with one word in one part.
pub(crate) struct Room {
    /// The last list there, if it holds bare names alone.
    pub(super) list: Option<OpenList>,
    /// Where new lines go.
    pub(super) line: usize,
}

/// A list that may take more bare names at its end.
pub(super) struct OpenList {
    /// The place of its statement.
    pub(super) at: usize,
    /// Where its last name ends.
    pub(super) end: usize,
    /// How many characters its last line has.
    width: usize,
}

impl OpenList {
    /// Whether `names` still fit on its last line, a comma before them.
    pub(super) fn fits(&self, names: &str) -> bool {
        self.width + 2 + names.chars().count() <= WIDTH
    }
}

/// Where new names can be declared.
pub(crate) fn room(document: &Document<'_>, part: Option<&Name>, word: Word) -> Room {
    Room {
        list: open_list(document, part, word),
        line: for_declaration(document, part, word),
    }
}

impl Room {
    /// The edit that declares one more name, spelled as in the text.
    pub(crate) fn declare(&self, document: &Document<'_>, word: Word, name: &str) -> Edit {
        if let Some(list) = self.list.as_ref().filter(|list| list.fits(name)) {
            return Edit {
                span: Span::at(list.end),
                text: format!(", {name}"),
            };
        }
        let line = format!("{} {name}", word.text());
        Edit {
            span: Span::at(self.line),
            text: whole_lines(document.text, self.line, &[line], document.line_end()),
        }
    }
}

fn open_list(document: &Document<'_>, part: Option<&Name>, word: Word) -> Option<OpenList> {
    let of_word = |statement: &Statement| match &statement.kind {
        Kind::List(other, _) => {
            *other == word && (word.is_global() || statement.part.as_ref() == part)
        }
        _ => false,
    };
    let at = document.statements.iter().rposition(of_word)?;
    let statement = document.statements.get(at)?;
    let Kind::List(_, entries) = &statement.kind else {
        return None;
    };
    let quiet = statement.lines.iter().all(|line| line.comment.is_none());
    let bare = entries.iter().all(|entry| is_bare(&entry.item));
    let line = statement.lines.last()?;
    let text = document.text.get(line.start..line.end)?;
    let list = OpenList {
        at,
        end: entries.last()?.span.range().end,
        width: text.trim_end().chars().count(),
    };
    (quiet && bare && statement.problem.is_none()).then_some(list)
}

/// Where new rules of a section go, if the section is there.
pub(super) fn for_rule(
    document: &Document<'_>,
    part: Option<&Name>,
    section: Section,
) -> Option<usize> {
    let belongs = |statement: &&Statement| {
        let here = section.is_global() || statement.part.as_ref() == part;
        let fits = match &statement.kind {
            Kind::Section(_)
            | Kind::Transition(_)
            | Kind::Action(_)
            | Kind::Environment(_)
            | Kind::Never(_)
            | Kind::Broken(_) => is_significant(statement),
            _ => false,
        };
        here && fits && statement.section == Some(section)
    };
    document
        .statements
        .iter()
        .rfind(belongs)
        .map(Statement::next)
}

/// Where a new section of a chart goes.
pub(super) fn for_section(document: &Document<'_>, part: Option<&Name>, section: Section) -> usize {
    let fits = |block: &&Block<'_>| {
        block.part == part && !block.is_global() && block.section <= Some(section)
    };
    let blocks = blocks(document);
    let last = blocks.iter().filter(fits).max_by_key(|block| block.section);
    last.map_or(document.text.len(), |block| block.end)
}

/// Where a new part goes: after all charts.
pub(super) fn for_part(document: &Document<'_>) -> usize {
    let blocks = blocks(document);
    let last = blocks
        .iter()
        .rfind(|block| !block.is_global() || block.declares);
    last.map_or(document.text.len(), |block| block.end)
}

/// Where a new section of the whole spec goes: at the end, properties last.
pub(super) fn for_global_section(document: &Document<'_>, section: Section) -> usize {
    let blocks = blocks(document);
    let never = blocks
        .iter()
        .position(|block| block.section == Some(Section::Never));
    let before = match (section, never) {
        (Section::Environment, Some(at)) => at.checked_sub(1).and_then(|at| blocks.get(at)),
        _ => blocks.last(),
    };
    before.map_or(document.text.len(), |block| block.end)
}

/// Where the lines before the first head end.
pub(super) fn end_of_first_block(document: &Document<'_>) -> usize {
    let blocks = blocks(document);
    blocks
        .first()
        .map_or(document.text.len(), |block| block.end)
}

/// Where new decisions go, and whether any are there.
pub(super) fn for_decision(document: &Document<'_>) -> (usize, bool) {
    let is_decision = |statement: &&Statement| matches!(statement.kind, Kind::Decision(_));
    match document.statements.iter().rfind(is_decision) {
        Some(last) => (last.next(), true),
        None => (document.text.len(), false),
    }
}

/// What stands between two heads.
struct Block<'d> {
    part: Option<&'d Name>,
    section: Option<Section>,
    /// Where the line after its last statement starts.
    end: usize,
    /// Whether declarations stand in it, after which more may come.
    declares: bool,
}

impl Block<'_> {
    fn is_global(&self) -> bool {
        self.section.is_some_and(Section::is_global)
    }
}

fn blocks<'d>(document: &'d Document<'_>) -> Vec<Block<'d>> {
    let mut statements = document.statements.iter();
    let begins = statements.find(|statement| is_significant(statement));
    let mut blocks = vec![Block {
        part: None,
        section: None,
        end: begins.map_or(document.text.len(), Statement::start),
        declares: false,
    }];
    for statement in &document.statements {
        if !is_significant(statement) {
            continue;
        }
        if matches!(statement.kind, Kind::Part(..) | Kind::Section(_)) {
            blocks.push(Block {
                part: statement.part.as_ref(),
                section: statement.section,
                end: statement.next(),
                declares: false,
            });
        }
        if let Some(block) = blocks.last_mut() {
            block.end = statement.next();
            block.declares |= matches!(statement.kind, Kind::List(..) | Kind::Grafcet(_));
        }
    }
    blocks
}
