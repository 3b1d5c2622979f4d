//! Suggestions for people: by group of rungs, then by state, best first.

use std::collections::{HashMap, HashSet};

use logic::{Budget, Name};
use recovery::groups::{self, Group};
use recovery::successions::{Evidence, Kind, Succession, Witness};

use super::Found;
use crate::colour::Paint;
use ide::legible;

use crate::condition::broken;
use crate::input::numbered;
use crate::program;
use crate::report::printable;

/// Of a group without a sequence only so many states are named.
const MOST_NAMED: usize = 8;

/// Suggestions by the state that ends.
struct ByState<'f> {
    found: &'f Found<'f>,
    followers: HashMap<&'f Name, Vec<&'f Succession>>,
    budget: &'f Budget,
}

impl<'f> ByState<'f> {
    fn new(found: &'f Found<'_>, budget: &'f Budget) -> Self {
        let mut followers: HashMap<&Name, Vec<&Succession>> = HashMap::new();
        for succession in &found.suggestions {
            followers
                .entry(&succession.from)
                .or_default()
                .push(succession);
        }
        Self {
            found,
            followers,
            budget,
        }
    }
}

/// Every group of dependent rungs: its sequence, or why there is none.
pub fn by_group(found: &Found<'_>, budget: &Budget, paint: Paint) -> String {
    let groups = found.analysis.groups();
    let by_state = ByState::new(found, budget);
    let mut out = String::new();
    if groups.is_empty() {
        out += &no_sequence_anywhere(groups, paint);
    }
    for group in groups {
        if group.sequence {
            sequence(&mut out, group, &by_state, paint);
        } else {
            no_sequence(&mut out, group, paint);
        }
    }
    let in_groups: HashSet<&Name> = groups
        .iter()
        .filter(|group| group.sequence)
        .flat_map(|group| &group.states)
        .collect();
    let elsewhere = found.suggestions.iter();
    let elsewhere = elsewhere.filter(|it| !in_groups.contains(&it.from)).count();
    if elsewhere > 0 {
        out += &format!(
            "\n{} between other states not shown; --json lists all\n",
            numbered(elsewhere, "suggestion")
        );
    }
    out
}

/// Every coil with what may follow it.
pub fn by_coil(found: &Found<'_>, budget: &Budget, paint: Paint) -> String {
    let by_state = ByState::new(found, budget);
    let mut out = String::new();
    for name in &found.states {
        if by_state.followers.contains_key(name) {
            state(&mut out, name, &by_state, paint);
        }
    }
    out += &format!("{}\n", numbered(found.suggestions.len(), "suggestion"));
    if found.suggestions.is_empty() {
        out += &no_sequence_anywhere(found.analysis.groups(), paint);
    }
    out
}

fn no_sequence_anywhere(groups: &[Group], paint: Paint) -> String {
    let (_, reason) = groups::verdict(groups);
    let head = paint.bold("No sequence here:");
    format!("{head} {}\n", printable(&reason))
}

fn sequence(out: &mut String, group: &Group, by_state: &ByState<'_>, paint: Paint) {
    let head = paint.bold(&format!("Sequence of {}:", listed(&group.states)));
    out.push_str(&format!("{head} {}\n\n", printable(&group.reason)));
    for name in &group.states {
        state(out, name, by_state, paint);
    }
}

fn no_sequence(out: &mut String, group: &Group, paint: Paint) {
    let head = paint.bold("No sequence here:");
    let names = listed(&group.states);
    let reason = printable(&group.reason);
    // A single state and sets of modes are named by their reasons.
    if group.states.len() == 1 || !group.modes.is_empty() {
        out.push_str(&format!("{head} {reason}\n"));
    } else {
        out.push_str(&format!("{head} {names}: {reason}\n"));
    }
}

/// `v1, v2, v3`, cut where there are many.
fn listed(names: &[Name]) -> String {
    let named: Vec<String> = names
        .iter()
        .take(MOST_NAMED)
        .map(|name| printable(name))
        .collect();
    let more = names.len().saturating_sub(MOST_NAMED);
    let more = match more {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    named.join(", ") + &more
}

/// A state and what may follow it, followed by an empty line.
fn state(out: &mut String, name: &Name, by_state: &ByState<'_>, paint: Paint) {
    let followers = by_state.followers.get(name).map_or(&[][..], Vec::as_slice);
    out.push_str(&paint.bold(&printable(name)));
    if let Some(description) = program::description(by_state.found.analysis, name) {
        out.push_str(&format!("  {}", printable(&description)));
    }
    out.push('\n');
    if followers.is_empty() {
        out.push_str("  nothing is known to follow\n");
    }
    let (coincidences, others): (Vec<&Succession>, Vec<&Succession>) =
        followers.iter().partition(|it| is_coincidence(it));
    let width = others.iter().map(|it| it.to.chars().count());
    let width = width.max().unwrap_or(0);
    for follower in others {
        let to = printable(&follower.to);
        let why = why(follower);
        let line = format!("  -> {to:width$}  {why:<14}  ");
        let when = match &follower.condition {
            None => String::new(),
            Some(condition) => match legible(
                condition,
                &by_state.found.analysis.conditions,
                by_state.budget,
            ) {
                Some(text) => broken(&printable(&text), line.chars().count()),
                None => "too long to show".to_owned(),
            },
        };
        out.push_str(format!("{line}{when}").trim_end());
        out.push('\n');
        if let Some(witness) = &follower.witness {
            out.push_str(&seen(witness, width + 7));
        }
    }
    if !coincidences.is_empty() {
        let names: Vec<Name> = coincidences.iter().map(|it| it.to.clone()).collect();
        let names = listed(&names);
        out.push_str(&format!(
            "  -> {names}  seen only where several inputs change at once\n"
        ));
    }
    out.push('\n');
}

/// Whether nothing but a coincidence speaks for it.
fn is_coincidence(succession: &Succession) -> bool {
    let is_seen = matches!(succession.evidence, Evidence::Witnessed | Evidence::Delayed);
    is_seen && succession.witness.as_ref().is_some_and(|it| !it.is_calm)
}

/// The shortest sequence of inputs in which it happens.
fn seen(witness: &Witness, indent: usize) -> String {
    let scans = numbered(witness.scans(), "scan");
    let manner = match witness.is_calm {
        true => "in",
        false => "several at once, in",
    };
    let words = printable(&witness.in_words());
    let line = format!("{:indent$}{manner} {scans}: {words}", "");
    wrapped(&line, indent + 2)
}

/// Where lines are broken, counted in characters.
const WIDTH: usize = 100;

/// `line` in several where it is long, broken behind semicolons.
fn wrapped(line: &str, indent: usize) -> String {
    let mut out = String::new();
    let mut column = 0;
    for part in line.split_inclusive("; ") {
        let length = part.trim_end().chars().count();
        if column > 0 && column + length > WIDTH {
            out.truncate(out.trim_end().len());
            out += &format!("\n{:indent$}", "");
            column = indent;
        }
        out += part;
        column += part.chars().count();
    }
    out + "\n"
}

/// `handover, and`.
fn why(succession: &Succession) -> String {
    let evidence = succession.evidence.word();
    match (succession.evidence, succession.kind) {
        (Evidence::Handover | Evidence::Witnessed, Kind::And) => format!("{evidence}, and"),
        _ => evidence.to_owned(),
    }
}
