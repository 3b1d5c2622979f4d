//! What came of a conversion, for people.

use logic::Name;
use recovery::successions::{Evidence, Succession};

use super::outcome::{OfState, Outcome};
use super::spec_file::State;
use crate::colour::Paint;
use crate::input::numbered;
use crate::report::printable;

/// Of many names only so many are listed.
const MOST_NAMED: usize = 8;

/// Of the states of which nothing is decided only so many are listed.
const MOST_UNDECIDED: usize = 20;

/// Of the rungs of a variable only so many are listed.
const MOST_RUNGS: usize = 3;

/// What was accepted, what is open, and what the spec holds now.
pub fn summary(outcome: &Outcome<'_>, name: &str, state: State, paint: Paint) -> String {
    let mut out = String::new();
    let states = shown(&outcome.states);
    for state in &states {
        of_state(&mut out, state, paint);
    }
    if let more @ 1.. = outcome.states.len() - states.len() {
        let more = numbered(more, "other state");
        out += &format!("{more} with open suggestions: `gradus suggest` lists them\n\n");
    }
    let (is_sequence, reason) = &outcome.verdict;
    if !is_sequence {
        let head = paint.bold("No sequence here:");
        out += &format!("{head} {}\n", printable(reason));
    }
    for (states, what) in [
        (&outcome.two_step, "left as a grafcet of two steps each"),
        (
            &outcome.as_rungs,
            "said as the rungs have them, since two steps would not do the same",
        ),
        (&outcome.unreached, "not reached by what is accepted"),
        (
            &outcome.in_definitions,
            "in definitions of blocks, not drawn",
        ),
    ] {
        if !states.is_empty() {
            let count = numbered(states.len(), "state");
            out += &format!("{count} {what}: {}\n", listed(states.iter()));
        }
    }
    let open: usize = outcome.states.iter().map(|state| state.open.len()).sum();
    if open > 0 {
        let open = numbered(open, "suggestion");
        out += &format!("{open} open: decide with --interactive, or accept with --accept\n");
    }
    let word = match state {
        State::New => "written",
        State::Changed => "updated",
        State::Unchanged => "unchanged",
        State::WouldChange => "would change",
        State::Printed => "printed",
    };
    let name = paint.bold(&printable(name));
    out += &format!(
        "{name}: {word}: {}, {}, {}\n",
        numbered(outcome.steps, "step"),
        numbered(outcome.transitions, "transition"),
        numbered(outcome.actions, "action")
    );
    out
}

/// Why a spec that was not proved may differ from its ladder: what it does not
/// say exactly, a line each.
pub fn inexact(outcome: &Outcome<'_>) -> String {
    let all = &outcome.inexact;
    let mut out = String::new();
    for of in all.iter().take(MOST_NAMED) {
        let rungs = of.rungs.iter().take(MOST_RUNGS);
        let mut rungs = rungs.map(|it| printable(it)).collect::<Vec<_>>().join(", ");
        if of.rungs.len() > MOST_RUNGS {
            rungs += " and more";
        }
        let (name, reason) = (printable(&of.name), printable(&of.reason));
        out += &format!("  {name} is not said exactly: {reason} ({rungs})\n");
    }
    if let more @ 1.. = all.len().saturating_sub(MOST_NAMED) {
        out += &format!("  so are {}\n", numbered(more, "other variable"));
    }
    out
}

/// The states that are listed, in their order: all of which something is decided,
/// and of the others first those for whose followers more speaks than that they
/// are possible.
fn shown<'o, 'a>(states: &'o [OfState<'a>]) -> Vec<&'o OfState<'a>> {
    let is_decided = |state: &OfState<'_>| {
        let lists = [&state.written, &state.rejected];
        state.initial || !state.accepted.is_empty() || lists.iter().any(|it| !it.is_empty())
    };
    let is_weak = |state: &OfState<'_>| {
        let mut open = state.open.iter();
        open.all(|it| it.evidence == Evidence::Possible)
    };
    let (mut shown, mut others): (Vec<_>, Vec<_>) = states
        .iter()
        .enumerate()
        .partition(|(_, it)| is_decided(it));
    others.sort_by_key(|(_, it)| is_weak(it));
    shown.extend(others.into_iter().take(MOST_UNDECIDED));
    shown.sort_by_key(|(at, _)| *at);
    shown.into_iter().map(|(_, state)| state).collect()
}

fn of_state(out: &mut String, state: &OfState<'_>, paint: Paint) {
    out.push_str(&paint.bold(&printable(&state.name)));
    if let Some(description) = &state.description {
        out.push_str(&format!("  {}", printable(description)));
    }
    out.push('\n');
    if state.initial {
        out.push_str("  initial\n");
    }
    for accepted in &state.accepted {
        let to: Vec<String> = accepted.to.iter().map(|name| printable(name)).collect();
        let new = if accepted.new { "  (new)" } else { "" };
        out.push_str(&format!("  accepted  -> {}{new}\n", to.join(" & ")));
    }
    if !state.written.is_empty() {
        let names = listed(state.written.iter());
        out.push_str(&format!("  written   -> {names}\n"));
    }
    for (word, evidence) in [
        ("open", Evidence::Handover),
        ("witnessed", Evidence::Witnessed),
        ("delayed", Evidence::Delayed),
        ("possible", Evidence::Possible),
    ] {
        let open: Vec<&&Succession> = state
            .open
            .iter()
            .filter(|it| it.evidence == evidence)
            .collect();
        if !open.is_empty() {
            let names = listed(open.iter().map(|it| &it.to));
            out.push_str(&format!("  {word:<9} -> {names}\n"));
        }
    }
    if !state.rejected.is_empty() {
        let names = listed(state.rejected.iter());
        out.push_str(&format!("  rejected  -> {names}\n"));
    }
    out.push('\n');
}

fn listed<'n>(names: impl ExactSizeIterator<Item = &'n Name>) -> String {
    let more = names.len().saturating_sub(MOST_NAMED);
    let named: Vec<String> = names.take(MOST_NAMED).map(|name| printable(name)).collect();
    match more {
        0 => named.join(", "),
        more => format!("{} and {more} more", named.join(", ")),
    }
}
