use super::edits::Edits;
use crate::rules::syntax::{Document, Kind};

/// Whether the statement at `at` comes right after one that was not
/// understood and may not be finished. Were its line to vanish altogether, the
/// next line could be taken for the rest of that one.
fn follows_unfinished(document: &Document<'_>, at: usize) -> bool {
    let before = document.statements.get(..at).unwrap_or_default();
    let mut before = before.iter().rev();
    let last = before.find(|statement| !matches!(statement.kind, Kind::Comment));
    last.is_some_and(|statement| statement.problem.is_some())
}

/// Removes the statement at `at` with its own comment. Comment lines inside it
/// stay, and so does a blank line where one is needed to keep what was not
/// understood apart from what comes next.
pub(super) fn remove_statement(document: &Document<'_>, at: usize, edits: &mut Edits<'_>) {
    let Some(statement) = document.statements.get(at) else {
        return;
    };
    let leave_blank = follows_unfinished(document, at);
    for line in &statement.lines {
        let is_comment = line.tokens.is_empty() && statement.lines.len() > 1;
        if is_comment {
            continue;
        }
        let before = document.text.get(..line.start).unwrap_or_default();
        let after = document.text.get(line.end..).unwrap_or_default();
        match leave_blank {
            false => edits.remove(line.start, line.next),
            // Left alone, the two signs would be one line end.
            true if before.ends_with('\r') && after.starts_with('\n') => {
                edits.replace(line.start, line.next, "\r");
            }
            true => edits.remove(line.start, line.end),
        }
    }
}
