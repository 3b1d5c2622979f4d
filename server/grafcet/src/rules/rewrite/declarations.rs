//! What a spec declares and marks, against what a text does.

use std::collections::{HashMap, HashSet};

use logic::Name;

use super::edits::Edits;
use super::lists::{self, Fate, Fates, Wanted};
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
    // Names that went to the end of a list, by the place where that is.
    let mut appended: HashMap<usize, String> = HashMap::new();
    let mut lines: Vec<(Word, Option<Name>, Vec<Item>)> = Vec::new();
    for Wanted { word, part, item } in missing {
        let text = item_text(&item);
        let room = spots::open_list(document, part.as_ref(), word, &text);
        let intact = room.filter(|(at, _)| {
            let entries = match document
                .statements
                .get(*at)
                .map(|statement| &statement.kind)
            {
                Some(Kind::List(_, entries)) => entries.len(),
                _ => 0,
            };
            (0..entries).all(|nth| {
                let fate = fates.get(&(*at, nth));
                matches!(fate, None | Some(Fate::Keep))
            })
        });
        if let Some((_, end)) = intact.filter(|_| is_bare(&item)) {
            let names = appended.entry(end).or_default();
            let room = spots::open_list(document, part.as_ref(), word, &format!("{names}{text}"));
            if room.is_some() {
                names.push_str(", ");
                names.push_str(&text);
                continue;
            }
        }
        match lines.last_mut() {
            Some((other, place, items)) if *other == word && *place == part => items.push(item),
            _ => lines.push((word, part, vec![item])),
        }
    }
    for (end, names) in appended {
        edits.replace(end, end, names);
    }
    for (word, part, items) in lines {
        let at = spots::for_declaration(document, part.as_ref(), word);
        edits.insert_lines(at, &list_lines(word, &items));
    }
}
