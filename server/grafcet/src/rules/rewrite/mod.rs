//! Making a text say something else, and leaving alone all that it says
//! already.

mod declarations;
mod edits;
mod lines;
mod lists;
mod rules;
mod spots;

use std::collections::HashSet;
use std::hash::Hash;
use std::mem::discriminant;

use logic::Name;

use self::edits::Edits;
use self::lines::remove_statement;
use self::rules::{Counts, How, Placed};
pub(crate) use self::spots::{Room, room};
use super::parse;
use super::syntax::{Document, Kind};
use super::words::Section;
use super::write::{grafcet_line, part_blocks, section_lines, step_names, write};
use super::{decisions, spell};
use crate::model::SaysTheSame;
use crate::{Action, ActionKind, Chart, Decision, EnvironmentRule, Property, Spec, Transition};

/// The text that says what `target` says, made from `text` with as little
/// change as can be.
///
/// * A declaration, rule or decision that already says what it should stays
///   byte for byte, with its comments, in its place. That includes rules whose
///   expressions merely mean the same.
/// * A changed one is replaced in place. Rules are found by their label,
///   actions by step, output and kind, declarations by name.
/// * One that should no longer be there goes, with the comment on its own line
///   and no other.
/// * A new one comes at the end of its section; the section is made if it is
///   missing.
/// * What was not understood stays as it is, as do blank lines, other comments,
///   the byte order mark and the style of line ends.
///
/// Reading the result gives a spec that [says the same](Spec::says_the_same)
/// as `target`; its things may stand in another order. A comment of `target`
/// that is missing leaves the one in the text alone.
pub fn rewrite(text: &str, target: &Spec) -> String {
    let document = parse::parse(text);
    if document
        .statements
        .iter()
        .all(|statement| matches!(statement.kind, Kind::Blank))
    {
        return fresh(text, &document, target);
    }
    let steps = step_names(&target.grafcet);
    let mut edits = Edits::new(&document);
    name(&document, target, &mut edits);
    declarations::edit(&document, target, &mut edits);
    parts(&document, target, &mut edits);
    let mut charts = transitions(&document, target, &steps, &mut edits);
    charts.extend(actions(&document, target, &mut edits));
    insert(charts, &mut edits);
    let mut sections = environment(&document, target, &mut edits);
    sections.extend(never(&document, target, &mut edits));
    new_parts(&document, target, &steps, &mut edits);
    insert(sections, &mut edits);
    decided(&document, target, &mut edits);
    edits.apply()
}

/// A text that holds nothing yet.
fn fresh(text: &str, document: &Document<'_>, target: &Spec) -> String {
    let written = write(target);
    if written.is_empty() {
        return text.to_owned();
    }
    let mark = match text.starts_with('\u{feff}') {
        true => "\u{feff}",
        false => "",
    };
    mark.to_owned() + &written.replace('\n', document.line_end())
}

fn name(document: &Document<'_>, target: &Spec, edits: &mut Edits<'_>) {
    let wanted = target.grafcet.name.as_ref();
    let mut first = true;
    for (at, statement) in document.statements.iter().enumerate() {
        let Kind::Grafcet(name) = &statement.kind else {
            continue;
        };
        match wanted {
            None => remove_statement(document, at, edits),
            Some(wanted) if first && wanted != name => {
                let range = statement.span().range();
                edits.replace(range.start, range.end, grafcet_line(wanted));
            }
            Some(_) => {}
        }
        first = false;
    }
    if let (true, Some(wanted)) = (first, wanted) {
        let mut all = document.statements.iter();
        let begins = all.find(|statement| !statement.tokens.is_empty());
        let at = begins.map_or(document.text.len(), |statement| statement.start());
        edits.insert_lines(at, &[grafcet_line(wanted), String::new()]);
    }
}

fn part_names(document: &Document<'_>) -> HashSet<Name> {
    let statements = document.statements.iter();
    statements
        .filter_map(|statement| statement.part.clone())
        .collect()
}

/// Heads of parts that changed or are gone.
fn parts(document: &Document<'_>, target: &Spec, edits: &mut Edits<'_>) {
    let mut seen: HashSet<&Name> = HashSet::new();
    for (at, statement) in document.statements.iter().enumerate() {
        let part = statement
            .part
            .as_ref()
            .map(|name| target.grafcet.part(name));
        match (&statement.kind, part) {
            (Kind::Part(..), Some(None)) => {
                remove_statement(document, at, edits);
            }
            (Kind::Broken(Some(_)), Some(None)) if statement.section.is_none() => {
                move_to_first_block(document, at, edits);
            }
            (Kind::Section(section), Some(None)) if is_free(document, at, *section) => {
                remove_statement(document, at, edits);
            }
            (Kind::Part(name, kind), Some(Some(part)))
                if seen.insert(name) && *kind != part.kind =>
            {
                let range = statement.span().range();
                edits.replace(range.start, range.end, spell::part(part));
            }
            _ => {}
        }
    }
}

/// Moves a rule that stands under no section, and therefore means nothing, to
/// where it goes on doing so: when the part before it goes, it would come to
/// stand under the section before that.
fn move_to_first_block(document: &Document<'_>, at: usize, edits: &mut Edits<'_>) {
    let Some(statement) = document.statements.get(at) else {
        return;
    };
    let mut lines = vec![String::new()];
    // Comment lines inside it stay where they are.
    let moved = statement
        .lines
        .iter()
        .filter(|line| !line.tokens.is_empty());
    for line in moved {
        let text = document.text.get(line.start..line.end);
        lines.push(text.unwrap_or_default().to_owned());
    }
    remove_statement(document, at, edits);
    edits.insert_lines(spots::end_of_first_block(document), &lines);
}

/// Whether the head of a section of a part that goes may go too: nothing that
/// was not understood stands under it, which might mean something elsewhere.
fn is_free(document: &Document<'_>, at: usize, section: Section) -> bool {
    let after = document.statements.iter().skip(at + 1);
    let mut under =
        after.take_while(|statement| !matches!(statement.kind, Kind::Section(_) | Kind::Part(..)));
    !section.is_global() && under.all(|statement| statement.problem.is_none())
}

/// A section that is not there yet, and where it goes.
struct NewSection {
    at: usize,
    lines: Vec<String>,
}

fn insert(sections: Vec<NewSection>, edits: &mut Edits<'_>) {
    for NewSection { at, lines } in sections {
        edits.insert_block(at, lines);
    }
}

/// Makes the edits of one kind of rule, and inserts those that are missing
/// where their section is there. Gives the sections that are not.
fn rules_of<T: SaysTheSame, K: Eq + Hash>(
    document: &Document<'_>,
    section: Section,
    own: impl Iterator<Item = (usize, Placed<T>)>,
    wanted: &[Placed<T>],
    how: &How<'_, T, K>,
    edits: &mut Edits<'_>,
) -> Vec<NewSection> {
    let missing = rules::edit(document, own, wanted, how, edits);
    let known = part_names(document);
    let mut lines: Vec<(Option<&Name>, Vec<String>)> = Vec::new();
    for (nth, wanted) in wanted.iter().enumerate() {
        // New parts bring their rules along.
        let is_new_part = wanted
            .part
            .as_ref()
            .is_some_and(|part| !known.contains(part));
        if !missing.contains(&nth) || is_new_part {
            continue;
        }
        let text = (how.text)(&wanted.rule);
        let comment = (how.comment)(&wanted.rule).map(|said| &**said);
        let line = spell::with_comment(text, comment);
        match lines.last_mut() {
            Some((part, lines)) if *part == wanted.part.as_ref() => lines.push(line),
            _ => lines.push((wanted.part.as_ref(), vec![line])),
        }
    }
    let mut sections = Vec::new();
    for (part, lines) in lines {
        if let Some(at) = spots::for_rule(document, part, section) {
            edits.insert_lines(at, &lines);
            continue;
        }
        let at = match section.is_global() {
            true => spots::for_global_section(document, section),
            false => spots::for_section(document, part, section),
        };
        let lines = section_lines(section, lines);
        sections.push(NewSection { at, lines });
    }
    sections
}

/// The statements that `pick` finds a rule in, each with its part.
fn own<'d, T: 'd>(
    document: &'d Document<'_>,
    pick: impl Fn(&Kind) -> Option<T> + 'd,
) -> impl Iterator<Item = (usize, Placed<T>)> + 'd {
    let all = document.statements.iter().enumerate();
    all.filter_map(move |(at, statement)| {
        let rule = pick(&statement.kind)?;
        let section = statement.section.filter(|section| !section.is_global());
        let part = statement.part.clone().filter(|_| section.is_some());
        Some((at, Placed { part, rule }))
    })
}

/// The rules of all charts, each with its part.
fn of_charts<T: Clone>(target: &Spec, rules: fn(&Chart) -> &[T]) -> Vec<Placed<T>> {
    let charts = target.grafcet.charts();
    let placed = charts.flat_map(|(part, chart)| {
        rules(chart).iter().map(move |rule| Placed {
            part: part.cloned(),
            rule: rule.clone(),
        })
    });
    placed.collect()
}

fn global<T: Clone>(rules: &[T]) -> Vec<Placed<T>> {
    let placed = rules
        .iter()
        .cloned()
        .map(|rule| Placed { part: None, rule });
    placed.collect()
}

fn transitions(
    document: &Document<'_>,
    target: &Spec,
    steps: &HashSet<Name>,
    edits: &mut Edits<'_>,
) -> Vec<NewSection> {
    let own = own(document, |kind| match kind {
        Kind::Transition(rule) => Some(rule.meaning(steps)),
        _ => None,
    });
    let how = How {
        key: |placed: &Placed<Transition>| placed.rule.name.clone(),
        counts: Counts::First,
        text: &|transition| spell::transition(transition, steps),
        comment: |transition| transition.comment.as_ref(),
    };
    let wanted = of_charts(target, |chart| &chart.transitions);
    rules_of(document, Section::Transitions, own, &wanted, &how, edits)
}

fn actions(document: &Document<'_>, target: &Spec, edits: &mut Edits<'_>) -> Vec<NewSection> {
    let own = own(document, |kind| match kind {
        Kind::Action(action) => Some(action.clone()),
        _ => None,
    });
    let how = How {
        key: |placed: &Placed<Action>| {
            let Action {
                step, output, kind, ..
            } = &placed.rule;
            let stored = match kind {
                ActionKind::Stored { effect, on } => Some((discriminant(effect), discriminant(on))),
                _ => None,
            };
            let part = placed.part.clone();
            (
                part,
                step.clone(),
                output.clone(),
                discriminant(kind),
                stored,
            )
        },
        counts: Counts::Each,
        text: &spell::action,
        comment: |action| action.comment.as_ref(),
    };
    let wanted = of_charts(target, |chart| &chart.actions);
    rules_of(document, Section::Steps, own, &wanted, &how, edits)
}

fn new_parts(document: &Document<'_>, target: &Spec, steps: &HashSet<Name>, edits: &mut Edits<'_>) {
    let known = part_names(document);
    let at = spots::for_part(document);
    let all = target.grafcet.parts.iter();
    for part in all.filter(|part| !known.contains(&part.name)) {
        for block in part_blocks(part, steps) {
            edits.insert_block(at, block);
        }
    }
}

fn environment(document: &Document<'_>, target: &Spec, edits: &mut Edits<'_>) -> Vec<NewSection> {
    let own = own(document, |kind| match kind {
        Kind::Environment(rule) => Some(rule.clone()),
        _ => None,
    });
    let how = How {
        key: |placed: &Placed<EnvironmentRule>| placed.rule.name.clone(),
        counts: Counts::First,
        text: &spell::environment,
        comment: |rule| rule.comment.as_ref(),
    };
    let wanted = global(&target.environment);
    rules_of(document, Section::Environment, own, &wanted, &how, edits)
}

fn never(document: &Document<'_>, target: &Spec, edits: &mut Edits<'_>) -> Vec<NewSection> {
    let own = own(document, |kind| match kind {
        Kind::Never(property) => Some(property.clone()),
        _ => None,
    });
    let how = How {
        key: |placed: &Placed<Property>| placed.rule.name.clone(),
        counts: Counts::First,
        text: &spell::property,
        comment: |property| property.comment.as_ref(),
    };
    let wanted = global(&target.never);
    rules_of(document, Section::Never, own, &wanted, &how, edits)
}

fn decided(document: &Document<'_>, target: &Spec, edits: &mut Edits<'_>) {
    let own = document.statements.iter().enumerate();
    let own = own.filter_map(|(at, statement)| match &statement.kind {
        Kind::Decision(decision) => Some((
            at,
            Placed {
                part: None,
                rule: decision.clone(),
            },
        )),
        _ => None,
    });
    let how = How {
        key: |placed: &Placed<Decision>| placed.rule.verdict.clone(),
        counts: Counts::Each,
        text: &decisions::decision_text,
        comment: |decision| decision.comment.as_ref(),
    };
    let wanted = global(&target.decisions);
    let missing = rules::edit(document, own, &wanted, &how, edits);
    let all = target.decisions.iter().enumerate();
    let lines: Vec<String> = all
        .filter(|(nth, _)| missing.contains(nth))
        .map(|(_, decision)| decisions::decision_text(decision))
        .collect();
    match spots::for_decision(document) {
        (at, true) => edits.insert_lines(at, &lines),
        (at, false) if !lines.is_empty() => edits.insert_block(at, lines),
        _ => {}
    }
}
