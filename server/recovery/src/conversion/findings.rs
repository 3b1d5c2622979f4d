//! What there is to say about a spec in the light of its ladder.

use std::collections::BTreeSet;

use grafcet::{Places, Reading, Role, rewrite};
use logic::{Budget, Name, notation};
use source::{Diagnostic, Edit, Span, codes};

use super::{Accepted, Departure, update};
use crate::Analysis;

/// Findings beyond this many carry no fix: each costs a pass over the text.
const MOST_FIXES: usize = 50;

/// Rules that the ladder does not support, states that it does not have any
/// more, decisions about states that it never had: each at its place in
/// `text`, the text that `reading` was made of.
pub fn spec_findings(
    analysis: &Analysis<'_>,
    reading: &Reading,
    text: &str,
    budget: &Budget,
) -> Vec<Diagnostic> {
    let spec = &reading.spec;
    let mut found = unknown_decisions(analysis, reading);
    found.extend(gone_states(analysis, reading));
    let updated = update(analysis, spec, &spec.decisions, budget);
    for (at, departure) in updated.departures.iter().enumerate() {
        let mut diagnostic = described(departure, &reading.places);
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

fn described(departure: &Departure, places: &Places) -> Diagnostic {
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
            rule(&spec.step, Role::Step),
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

fn declaration(places: &Places, step: Option<&Name>) -> Span {
    let mut mentions = places.mentions.iter();
    let found = mentions.find(|it| it.declares && it.role == Role::Step && Some(&it.name) == step);
    found.map_or(Span::default(), |mention| mention.span)
}

fn unknown_decisions(analysis: &Analysis<'_>, reading: &Reading) -> Vec<Diagnostic> {
    let decisions = reading.spec.decisions.iter();
    decisions
        .zip(&reading.places.decisions)
        .flat_map(|(decision, span)| {
            let accepted = Accepted::new(analysis, std::slice::from_ref(decision));
            accepted.unknown.into_iter().map(|name| {
                Diagnostic::new(
                    codes::DECISION_UNKNOWN,
                    *span,
                    format!("the ladder has no state `{name}`"),
                )
                .help("remove the line, or write the name as `gradus suggest` lists it")
            })
        })
        .collect()
}

fn gone_states(analysis: &Analysis<'_>, reading: &Reading) -> Vec<Diagnostic> {
    let values: BTreeSet<Name> = analysis
        .registers
        .iter()
        .flat_map(|register| register.states.iter().map(|s| register.state_name(s.value)))
        .collect();
    let is_known = |name: &Name| values.contains(name) || analysis.conditions.find(name).is_some();
    reading
        .places
        .mentions
        .iter()
        .filter(|mention| mention.role == Role::State && !is_known(&mention.name))
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
