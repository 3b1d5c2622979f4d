//! What a spec declares and marks, against what a text does.

use std::collections::{HashMap, HashSet};

use logic::Name;

use super::edits::Edits;
use super::lists::{self, Fate, Fates, Wanted};
use super::spots::OpenList;
use super::{part_names, spots};
use crate::Spec;
use crate::rules::syntax::{Document, Item, Kind};
use crate::rules::words::Word;
use crate::rules::write::{chart_lists, global_lists, is_bare, item_text, list_lines, step_names};

/// Makes the edits of all lists, and inserts what is missing.
pub(super) fn edit(document: &Document<'_>, target: &Spec, edits: &mut Edits<'_>) {
    let mut fates = Fates::new();
    let mut missing: Vec<Wanted> = Vec::new();

    let (mut declared, mut instances) = (Vec::new(), Vec::new());
    let mut marks: HashMap<Word, Vec<Wanted>> = HashMap::new();
    for (part, chart) in target.grafcet.charts() {
        for (word, items) in chart_lists(chart) {
            let list = match word.declares_step() {
                true => &mut declared,
                false => marks.entry(word).or_default(),
            };
            list.extend(wanted(word, part, items));
        }
    }
    for (word, items) in global_lists(&target.grafcet) {
        let list = match word {
            Word::Instance => &mut instances,
            _ => &mut declared,
        };
        list.extend(wanted(word, None, items));
    }
    let is_variable_or_step = |word: Word| word.declares_step() || word.declares_variable();
    missing.extend(lists::declarations(
        document,
        declared,
        is_variable_or_step,
        &mut fates,
    ));
    let is_instance = |word: Word| word == Word::Instance;
    missing.extend(lists::declarations(
        document,
        instances,
        is_instance,
        &mut fates,
    ));
    for word in [Word::Marking, Word::Activation, Word::Transition] {
        let wanted = marks.remove(&word).unwrap_or_default();
        missing.extend(missing_marks(document, target, word, wanted, &mut fates));
    }

    for at in 0..document.statements.len() {
        lists::edit(document, at, &fates, edits);
    }
    insert_declarations(document, missing, &fates, edits);
}

fn wanted(word: Word, part: Option<&Name>, items: Vec<Item>) -> impl Iterator<Item = Wanted> {
    let part = part.cloned();
    items.into_iter().map(move |item| Wanted {
        word,
        part: part.clone(),
        item,
    })
}

/// Decides about a list of names that are declared elsewhere: marks of steps,
/// and labels of transitions.
fn missing_marks(
    document: &Document<'_>,
    target: &Spec,
    word: Word,
    wanted: Vec<Wanted>,
    fates: &mut Fates,
) -> Vec<Wanted> {
    let names: HashSet<Name> = wanted
        .iter()
        .map(|wanted| wanted.item.name().clone())
        .collect();
    // A name that means nothing before and after may stay.
    let (before, after): (HashSet<Name>, HashSet<Name>) = match word {
        Word::Transition => (rules_of_transitions(document), HashSet::new()),
        _ => (document.step_names(), step_names(&target.grafcet)),
    };
    let stays =
        |name: &Name| names.contains(name) || !before.contains(name) && !after.contains(name);
    let mut missing = lists::marks(document, wanted, word, stays, fates);
    if word == Word::Transition {
        // A rule that stood there undeclared may go on so.
        missing.retain(|wanted| !before.contains(wanted.item.name()));
    }
    missing
}

fn rules_of_transitions(document: &Document<'_>) -> HashSet<Name> {
    let rules = document.statements.iter();
    rules
        .filter_map(|statement| match &statement.kind {
            Kind::Transition(rule) => Some(rule.name.clone()),
            _ => None,
        })
        .collect()
}

fn insert_declarations(
    document: &Document<'_>,
    mut missing: Vec<Wanted>,
    fates: &Fates,
    edits: &mut Edits<'_>,
) {
    let known = part_names(document);
    // New parts bring their declarations along.
    missing.retain(|wanted| wanted.part.as_ref().is_none_or(|part| known.contains(part)));
    missing.sort_by_key(|wanted| wanted.word);
    let same_place = |a: &Wanted, b: &Wanted| a.word == b.word && a.part == b.part;
    for group in missing.chunk_by(same_place) {
        if let [first, ..] = group {
            insert_group(
                document,
                first.word,
                first.part.as_ref(),
                group,
                fates,
                edits,
            );
        }
    }
}

/// Inserts what one word declares in one part: bare names at the end of a list
/// that no other change touches, as long as they fit, the others on new lines.
fn insert_group(
    document: &Document<'_>,
    word: Word,
    part: Option<&Name>,
    group: &[Wanted],
    fates: &Fates,
    edits: &mut Edits<'_>,
) {
    let room = spots::room(document, part, word);
    let list = room
        .list
        .filter(|list| is_untouched(document, list.at, fates));
    let mut appended = String::new();
    let mut items: Vec<Item> = Vec::new();
    for Wanted { item, .. } in group {
        let text = item_text(item);
        let fits = |list: &OpenList| list.fits(&format!("{appended}{text}"));
        if is_bare(item) && list.as_ref().is_some_and(fits) {
            appended = format!("{appended}, {text}");
        } else {
            items.push(item.clone());
        }
    }
    if let Some(list) = list.filter(|_| !appended.is_empty()) {
        edits.replace(list.end, list.end, appended);
    }
    edits.insert_lines(room.line, &list_lines(word, &items));
}

fn is_untouched(document: &Document<'_>, at: usize, fates: &Fates) -> bool {
    let statement = document.statements.get(at);
    let entries = match statement.map(|statement| &statement.kind) {
        Some(Kind::List(_, entries)) => entries.len(),
        _ => 0,
    };
    (0..entries).all(|nth| matches!(fates.get(&(at, nth)), None | Some(Fate::Keep)))
}
