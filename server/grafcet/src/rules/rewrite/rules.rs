//! Rules and decisions: which stay, which change, which go.

use std::collections::{HashMap, HashSet, VecDeque};
use std::hash::Hash;

use logic::Name;

use super::edits::Edits;
use super::lines::remove_statement;
use crate::model::{SaysTheSame, comment_serves};
use crate::rules::spell::comment_line;
use crate::rules::syntax::{Document, Statement};

/// A rule and the part it belongs to; a rule of the whole spec to none.
pub(super) struct Placed<T> {
    pub(super) part: Option<Name>,
    pub(super) rule: T,
}

/// How rules of one kind are found and written.
pub(super) struct How<'h, T, K> {
    /// What a rule is found by.
    pub(super) key: fn(&Placed<T>) -> K,
    /// Whether only the first of a key counts. Others then mean nothing, and
    /// stay as long as the first does.
    pub(super) counts: Counts,
    /// The rule's text without its comment; of a decision, with it.
    pub(super) text: &'h dyn Fn(&T) -> String,
    /// The rule's comment.
    pub(super) comment: fn(&T) -> Option<&Name>,
}

/// Which rules of one key count.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Counts {
    First,
    Each,
}

/// A rule of the text and the place of its statement.
type Own<T> = (usize, Placed<T>);

/// Makes the edits that turn `own` into `wanted`. Gives the places in
/// `wanted` of the rules that are not there.
pub(super) fn edit<T: SaysTheSame, K: Eq + Hash>(
    document: &Document<'_>,
    own: impl Iterator<Item = Own<T>>,
    wanted: &[Placed<T>],
    how: &How<'_, T, K>,
    edits: &mut Edits<'_>,
) -> HashSet<usize> {
    let mut by_key: HashMap<K, VecDeque<Own<T>>> = HashMap::new();
    for own in own {
        by_key.entry((how.key)(&own.1)).or_default().push_back(own);
    }
    // What is there already stays, before anything is taken for the old form
    // of something new.
    let mut open = Vec::new();
    for (nth, wanted) in wanted.iter().enumerate() {
        let key = (how.key)(wanted);
        let candidates = by_key.get_mut(&key);
        let same = candidates.and_then(|all| {
            let mut candidates = all.iter().take(match how.counts {
                Counts::First => 1,
                Counts::Each => all.len(),
            });
            let at = candidates
                .position(|(_, own)| own.part == wanted.part && own.rule.says(&wanted.rule));
            at.and_then(|at| all.remove(at))
        });
        match same {
            Some(_) if how.counts == Counts::First => {
                by_key.remove(&key);
            }
            Some(_) => {}
            None => open.push((nth, key, wanted)),
        }
    }
    let mut missing = HashSet::new();
    for (nth, key, wanted) in open {
        let candidates = by_key.get_mut(&key);
        let old = candidates.and_then(|all| {
            let here = all.front().is_some_and(|(_, own)| own.part == wanted.part);
            here.then(|| all.pop_front()).flatten()
        });
        let Some((at, old)) = old else {
            missing.insert(nth);
            continue;
        };
        if let Some(statement) = document.statements.get(at) {
            replace(document, statement, (&old.rule, &wanted.rule), how, edits);
        }
        if how.counts == Counts::First {
            by_key.remove(&key);
        }
    }
    for (at, _) in by_key.into_values().flatten() {
        remove_statement(document, at, edits);
    }
    missing
}

fn replace<T, K>(
    document: &Document<'_>,
    statement: &Statement,
    (old, new): (&T, &T),
    how: &How<'_, T, K>,
    edits: &mut Edits<'_>,
) {
    // Comments inside it move above it.
    let inner = statement
        .lines
        .split_last()
        .map_or(&[][..], |(_, inner)| inner);
    for comment in inner.iter().filter_map(|line| line.comment) {
        let comment = comment.text(document.text).to_owned();
        edits.insert_lines(statement.start(), &[comment]);
    }
    let range = statement.span().range();
    edits.replace(range.start, range.end, (how.text)(new));
    let is_decision = statement.tokens.is_empty();
    let (old, new) = ((how.comment)(old), (how.comment)(new));
    if let (false, false, Some(said), Some(line)) = (
        is_decision,
        comment_serves(old, new),
        new,
        statement.lines.last(),
    ) {
        edits.comment(line, &comment_line(said));
    }
}
