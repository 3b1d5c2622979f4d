//! Declarations and marks: which stay, which change, which go, and the edits
//! that make it so, name by name.

use std::collections::{BTreeSet, HashMap, HashSet};

use logic::Name;

use super::edits::Edits;
use super::lines::remove_statement;
use crate::model::{SaysTheSame, comment_serves};
use crate::rules::spell::comment_line;
use crate::rules::syntax::{Document, Entry, Item, Kind, Statement};
use crate::rules::words::Word;
use crate::rules::write::{item_text, list_lines};

/// What becomes of an entry.
#[derive(Clone, Debug)]
pub(super) enum Fate {
    Keep,
    Replace(Item),
    Remove,
}

/// The entries of a text by the places of their statements, with their fates.
pub(super) type Fates = HashMap<(usize, usize), Fate>;

/// Something that a list is to declare.
pub(super) struct Wanted {
    pub(super) word: Word,
    pub(super) part: Option<Name>,
    pub(super) item: Item,
}

/// An entry where it stands.
struct Found<'d> {
    at: (usize, usize),
    word: Word,
    part: Option<&'d Name>,
    item: &'d Item,
}

fn found<'d>(document: &'d Document<'_>, counts: fn(Word) -> bool) -> Vec<Found<'d>> {
    let mut all = Vec::new();
    for (at, statement) in document.statements.iter().enumerate() {
        let Kind::List(word, entries) = &statement.kind else {
            continue;
        };
        if counts(*word) {
            all.extend(entries.iter().enumerate().map(|(nth, entry)| Found {
                at: (at, nth),
                word: *word,
                part: statement.part.as_ref().filter(|_| !word.is_global()),
                item: &entry.item,
            }));
        }
    }
    all
}

/// Decides about the declarations whose words `counts`, of which the first of
/// a name is the one that means something. Gives what is wanted and not there.
pub(super) fn declarations(
    document: &Document<'_>,
    wanted: Vec<Wanted>,
    counts: fn(Word) -> bool,
    fates: &mut Fates,
) -> Vec<Wanted> {
    let mut by_name: HashMap<&Name, Vec<Found<'_>>> = HashMap::new();
    for found in found(document, counts) {
        by_name.entry(found.item.name()).or_default().push(found);
    }
    let mut missing = Vec::new();
    let mut kept: HashSet<&Name> = HashSet::new();
    for wanted in wanted {
        let Some((name, all)) = by_name.get_key_value(wanted.item.name()) else {
            missing.push(wanted);
            continue;
        };
        let serves =
            |found: &Found<'_>| found.word == wanted.word && found.part == wanted.part.as_ref();
        let Some(first) = all.iter().position(serves) else {
            missing.push(wanted);
            continue;
        };
        if !kept.insert(name) {
            continue;
        }
        for (nth, found) in all.iter().enumerate() {
            let fate = match nth.cmp(&first) {
                std::cmp::Ordering::Less => Fate::Remove,
                // A second declaration means nothing, and stays as it is.
                std::cmp::Ordering::Greater => Fate::Keep,
                std::cmp::Ordering::Equal if says(found.item, &wanted.item) => Fate::Keep,
                std::cmp::Ordering::Equal => Fate::Replace(wanted.item.clone()),
            };
            fates.insert(found.at, fate);
        }
    }
    for (name, all) in &by_name {
        if !kept.contains(*name) {
            fates.extend(all.iter().map(|found| (found.at, Fate::Remove)));
        }
    }
    missing
}

fn says(own: &Item, wanted: &Item) -> bool {
    match (own, wanted) {
        (Item::Step(own), Item::Step(wanted)) => own.says(wanted),
        (Item::Variable(own), Item::Variable(wanted)) => own.says(wanted),
        (Item::Instance(own), Item::Instance(wanted)) => own.says(wanted),
        (own, wanted) => own == wanted,
    }
}

/// Decides about lists of bare names, where all entries of a name say the
/// same. `stays` tells which names may stay. Gives what is wanted and not
/// there.
pub(super) fn marks(
    document: &Document<'_>,
    wanted: Vec<Wanted>,
    word: Word,
    stays: impl Fn(&Name) -> bool,
    fates: &mut Fates,
) -> Vec<Wanted> {
    let mut there: HashSet<&Name> = HashSet::new();
    for (at, statement) in document.statements.iter().enumerate() {
        let Kind::List(other, entries) = &statement.kind else {
            continue;
        };
        for (nth, entry) in entries.iter().enumerate().filter(|_| *other == word) {
            let name = entry.item.name();
            let fate = match stays(name) {
                true => Fate::Keep,
                false => Fate::Remove,
            };
            there.insert(name);
            fates.insert((at, nth), fate);
        }
    }
    let missing = |wanted: &Wanted| !there.contains(wanted.item.name());
    wanted.into_iter().filter(missing).collect()
}

/// Makes the edits of one list.
pub(super) fn edit(document: &Document<'_>, at: usize, fates: &Fates, edits: &mut Edits<'_>) {
    let Some(statement) = document.statements.get(at) else {
        return;
    };
    let Kind::List(word, entries) = &statement.kind else {
        return;
    };
    let mut moved = Vec::new();
    let fates: Vec<Fate> = entries
        .iter()
        .enumerate()
        .map(|(nth, entry)| match fates.get(&(at, nth)) {
            None => Fate::Keep,
            // Its line has no room for a comment of its own.
            Some(Fate::Replace(item)) if !entry.alone && speaks_anew(entry, item) => {
                moved.push(item.clone());
                Fate::Remove
            }
            Some(fate) => fate.clone(),
        })
        .collect();
    if fates.iter().all(|fate| matches!(fate, Fate::Keep)) {
        return;
    }
    for (entry, fate) in entries.iter().zip(&fates) {
        if let Fate::Replace(item) = fate {
            replace(statement, entry, item, edits);
        }
    }
    let removed: Vec<bool> = fates
        .iter()
        .map(|fate| matches!(fate, Fate::Remove))
        .collect();
    if statement.problem.is_none() && removed.iter().all(|removed| *removed) {
        remove_statement(document, at, edits);
    } else {
        remove(statement, entries, &removed, edits);
    }
    let lines: Vec<String> = moved
        .into_iter()
        .flat_map(|item| list_lines(*word, &[item]))
        .collect();
    edits.insert_lines(statement.next(), &lines);
}

fn speaks_anew(entry: &Entry, item: &Item) -> bool {
    !comment_serves(entry.item.comment(), item.comment())
}

fn replace(statement: &Statement, entry: &Entry, item: &Item, edits: &mut Edits<'_>) {
    let text = item_text(item);
    if text != item_text(&entry.item) {
        let range = entry.span.range();
        edits.replace(range.start, range.end, text);
    }
    if let (true, Some(said), Some(line)) = (
        speaks_anew(entry, item),
        item.comment(),
        statement.lines.get(entry.line),
    ) {
        edits.comment(line, &comment_line(said));
    }
}

/// Takes entries out of a list that keeps others, or that has something in it
/// that was not understood. That stays, with a comma before it, so that it
/// never moves up to where it could be read.
fn remove(statement: &Statement, entries: &[Entry], removed: &[bool], edits: &mut Edits<'_>) {
    let gone = |nth: usize| removed.get(nth).copied().unwrap_or(false);
    let last_kept = removed.iter().rposition(|removed| !removed);
    let broken = statement.problem.is_some();
    let next_on_line = |nth: usize| {
        let line = entries.get(nth).map(|entry| entry.line);
        let next = entries.get(nth + 1);
        next.filter(|next| Some(next.line) == line)
    };
    let comma = last_kept
        .filter(|last| last + 1 < entries.len() && !broken)
        .and_then(|last| Some((last, entries.get(last)?.comma?)));
    if let Some((last, comma)) = comma {
        let next = next_on_line(last).map(|next| next.span.range().start);
        edits.remove(comma.range().start, next.unwrap_or(comma.range().end));
    }
    let whole = whole_lines(entries, removed, broken);
    for line in whole.iter().filter_map(|line| statement.lines.get(*line)) {
        edits.remove(line.start, line.next);
    }
    for (nth, entry) in entries.iter().enumerate() {
        if !gone(nth) || whole.contains(&entry.line) {
            continue;
        }
        let range = entry.span.range();
        let is_last = nth + 1 == entries.len();
        match (next_on_line(nth), entry.comma) {
            _ if is_last && broken => edits.replace(range.start, range.end, ","),
            _ if is_last => edits.remove(range.start, range.end),
            (Some(next), _) => edits.remove(range.start, next.span.range().start),
            (None, Some(comma)) => edits.remove(range.start, comma.range().end),
            (None, None) => edits.remove(range.start, range.end),
        }
        let comment = statement
            .lines
            .get(entry.line)
            .and_then(|line| line.comment);
        if let Some(comment) = comment.filter(|_| entry.alone) {
            edits.remove(comment.span.range().start, comment.span.range().end);
        }
    }
}

/// The lines whose names all go, which therefore go whole. The first stays,
/// for the word stands there, and so does one that was not understood.
fn whole_lines(entries: &[Entry], removed: &[bool], broken: bool) -> BTreeSet<usize> {
    let last = entries.last().map(|entry| entry.line);
    let mut whole: BTreeSet<usize> = entries
        .iter()
        .map(|entry| entry.line)
        .filter(|line| *line > 0 && !(broken && Some(*line) == last))
        .collect();
    for (entry, removed) in entries.iter().zip(removed) {
        if !removed {
            whole.remove(&entry.line);
        }
    }
    whole
}
