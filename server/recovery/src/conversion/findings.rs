//! What there is to say about a spec in the light of its ladder.

use std::collections::BTreeSet;

use grafcet::{Action, Mention, Places, Reading, Role, rewrite};
use logic::{Budget, Name, notation};
use source::{Diagnostic, Edit, Span, codes};

use super::{Departure, update};
use crate::Analysis;

/// Findings beyond this many carry no fix: each costs a pass over the text.
const MOST_FIXES: usize = 50;

/// Rules that the ladder does not support, states that it does not have any
/// more, decisions about states that it never had: each at its place in
/// `text`, the text that `reading` was made of.
pub fn spec_findings(
    analysis: &Analysis,
    reading: &Reading,
    text: &str,
    budget: &Budget,
) -> Vec<Diagnostic> {
    let spec = &reading.spec;
    let mut found = unknown_decisions(analysis, reading);
    found.extend(gone_states(analysis, reading));
    let updated = update(analysis, spec, &spec.decisions, budget);
    for (at, departure) in updated.departures.iter().enumerate() {
        let mut diagnostic = described(departure, reading);
        if at < MOST_FIXES {
            let mut renewed = updated.spec.clone();
            departure.renew(&mut renewed);
            let after = rewrite(text, &renewed);
            if let Some(edit) = difference(text, &after) {
                diagnostic = diagnostic.fix("Take over what the ladder gives", vec![edit]);
            }
        }
        found.push(diagnostic.help(format!(
            "take over what the ladder gives, or write `//! keep {}`",
            notation::quoted(departure.label())
        )));
    }
    found.sort_by_key(|diagnostic| (diagnostic.span, diagnostic.code));
    found
}

fn described(departure: &Departure, reading: &Reading) -> Diagnostic {
    let places = &reading.places;
    let rule = |name: &Name, role: Role| {
        let mut rules = places.rules.iter();
        let found = rules.find(|rule| rule.role == role && rule.name == *name);
        found.map_or(Span::default(), |rule| rule.span)
    };
    let list = |names: &[Name]| names.join(" and ");
    let (span, message) = match departure {
        Departure::Transition { name, ladder } => (
            rule(name, Role::Transition),
            match ladder {
                Some(ladder) => format!(
                    "the ladder gives another rule for `{name}`: from {} to {} on {}",
                    list(&ladder.from),
                    list(&ladder.to),
                    ladder.receptivity
                ),
                None => format!("the ladder gives no rule `{name}`"),
            },
        ),
        Departure::MissingTransition(transition) => (
            declaration(places, transition.from.first()),
            format!(
                "the ladder also goes from {} to {} on {} (rule `{}`)",
                list(&transition.from),
                list(&transition.to),
                transition.receptivity,
                transition.name
            ),
        ),
        Departure::Action { spec, ladder } => (
            rule_of(spec, reading),
            match ladder {
                Some(ladder) => format!(
                    "the ladder gives `{}` on {} another condition: {}",
                    spec.output,
                    spec.step,
                    ladder
                        .condition
                        .as_ref()
                        .map_or("always".to_owned(), ToString::to_string)
                ),
                None => format!(
                    "the ladder does not write `{}` on {}",
                    spec.output, spec.step
                ),
            },
        ),
        Departure::MissingAction(action) => (
            declaration(places, Some(&action.step)),
            format!(
                "the ladder also writes `{}` on {}",
                action.output, action.step
            ),
        ),
    };
    Diagnostic::new(codes::RULE_NOT_SUPPORTED, span, message)
}

/// Where the rule of an action stands: rules of one step bear one label, and
/// stand in the order of its actions.
fn rule_of(action: &Action, reading: &Reading) -> Span {
    let chart = &reading.spec.grafcet.chart;
    let nth = chart.actions_of(&action.step).position(|it| it == action);
    let rules = reading.places.rules.iter();
    let mut rules = rules.filter(|rule| rule.role == Role::Step && rule.name == action.step);
    rules
        .nth(nth.unwrap_or(0))
        .map_or(Span::default(), |rule| rule.span)
}

fn declaration(places: &Places, step: Option<&Name>) -> Span {
    let mut mentions = places.mentions.iter();
    let found = mentions.find(|it| it.declares && it.role == Role::Step && Some(&it.name) == step);
    found.map_or(Span::default(), |mention| mention.span)
}

/// Names of states in decisions that the ladder does not have.
fn unknown_decisions(analysis: &Analysis, reading: &Reading) -> Vec<Diagnostic> {
    let values = register_values(analysis);
    let is_known = |name: &Name| values.contains(name) || analysis.states().find(name).is_some();
    state_mentions(reading)
        .filter(|mention| is_in_decision(mention, reading) && !is_known(&mention.name))
        .map(|mention| {
            Diagnostic::new(
                codes::DECISION_UNKNOWN,
                mention.span,
                format!("the ladder has no state `{}`", mention.name),
            )
            .help("remove the line, or write the name as `gradus suggest` lists it")
        })
        .collect()
}

/// States that steps stand for and that the ladder does not have.
fn gone_states(analysis: &Analysis, reading: &Reading) -> Vec<Diagnostic> {
    let values = register_values(analysis);
    let is_known = |name: &Name| values.contains(name) || analysis.conditions.find(name).is_some();
    state_mentions(reading)
        .filter(|mention| !is_in_decision(mention, reading) && !is_known(&mention.name))
        .map(|mention| {
            Diagnostic::new(
                codes::STATE_GONE,
                mention.span,
                format!("the ladder has no state `{}` any more", mention.name),
            )
            .help("remove the step and its rules, or name the state as the ladder does now")
        })
        .collect()
}

fn state_mentions(reading: &Reading) -> impl Iterator<Item = &Mention> {
    let mentions = reading.places.mentions.iter();
    mentions.filter(|mention| mention.role == Role::State)
}

fn is_in_decision(mention: &Mention, reading: &Reading) -> bool {
    let decisions = &reading.places.decisions;
    let after = decisions.partition_point(|span| span.start <= mention.span.start);
    let last = after.checked_sub(1).and_then(|at| decisions.get(at));
    last.is_some_and(|span| mention.span.start < span.end)
}

fn register_values(analysis: &Analysis) -> BTreeSet<Name> {
    let registers = analysis.registers.iter();
    registers
        .flat_map(|register| register.states.iter().map(|s| register.state_name(s.value)))
        .collect()
}

/// The one replacement that turns `before` into `after`.
fn difference(before: &str, after: &str) -> Option<Edit> {
    if before == after {
        return None;
    }
    let pairs = before.char_indices().zip(after.chars());
    let start = pairs
        .take_while(|((_, a), b)| a == b)
        .last()
        .map_or(0, |((at, a), _)| at + a.len_utf8());
    let (old, new) = (&before[start..], &after[start..]);
    let tail: usize = old
        .chars()
        .rev()
        .zip(new.chars().rev())
        .take_while(|(a, b)| a == b)
        .map(|(a, _)| a.len_utf8())
        .sum();
    Some(Edit {
        span: Span::new(start, before.len() - tail),
        text: new[..new.len() - tail].to_owned(),
    })
}
