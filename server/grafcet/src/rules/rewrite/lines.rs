use super::edits::Edits;
use crate::rules::syntax::{Document, Kind, Statement};

/// Whether the statement at `at` comes right after one that was not
/// understood and may not be finished. Were its line to vanish altogether, the
/// next line could be taken for the rest of that one.
pub(super) fn follows_unfinished(document: &Document<'_>, at: usize) -> bool {
    let before = document.statements.get(..at).unwrap_or_default();
    let mut before = before.iter().rev();
    let last = before.find(|statement| !matches!(statement.kind, Kind::Comment));
    last.is_some_and(|statement| statement.problem.is_some())
}

/// Removes a statement with its own comment. Comment lines inside it stay.
pub(super) fn remove_statement(statement: &Statement, leave_line_end: bool, edits: &mut Edits<'_>) {
    for line in &statement.lines {
        let is_comment = line.tokens.is_empty() && statement.lines.len() > 1;
        if !is_comment {
            let end = match leave_line_end {
                true => line.end,
                false => line.next,
            };
            edits.remove(line.start, end);
        }
    }
}
