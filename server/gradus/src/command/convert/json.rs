//! What came of a conversion, as JSON. The keys are part of the command line's
//! promise: see the help of `gradus convert`.

use logic::Name;
use recovery::successions::Succession;
use serde_json::{Value, json as value};

use super::outcome::{Inexact, OfState, Outcome};
use super::spec_file::State;
use super::verdict::Found;
use crate::program::Ladder;
use crate::report::{self, Findings};

/// The outcome in one document; `text` is the spec.
pub fn json(
    ladder: &Ladder,
    outcome: &Outcome<'_>,
    state: State,
    findings: &Findings,
    text: &str,
    verdict: &Found,
) -> Value {
    let is_printed = state == State::Printed;
    let (sequence, reason) = &outcome.verdict;
    let mut diagnostics = report::json(std::slice::from_ref(findings));
    value!({
        "file": ladder.name(),
        "spec": (!is_printed).then(|| findings.path.display().to_string()),
        "state": state.word(),
        "steps": outcome.steps,
        "transitions": outcome.transitions,
        "actions": outcome.actions,
        "states": outcome.states.iter().map(of_state).collect::<Vec<_>>(),
        "two_step": names(&outcome.two_step),
        "unreached": names(&outcome.unreached),
        "as_rungs": names(&outcome.as_rungs),
        "in_definitions": names(&outcome.in_definitions),
        "inexact": outcome.inexact.iter().map(inexact).collect::<Vec<_>>(),
        "sequence": sequence,
        "reason": reason,
        "verdict": verdict.word,
        "settled": verdict.settled,
        "diagnostics": diagnostics["diagnostics"].take(),
        "text": is_printed.then_some(text),
    })
}

fn of_state(state: &OfState<'_>) -> Value {
    let accepted = state.accepted.iter();
    value!({
        "state": &*state.name,
        "accepted": accepted
            .map(|it| value!({ "to": names(&it.to), "new": it.new }))
            .collect::<Vec<_>>(),
        "written": names(&state.written),
        "open": state.open.iter().map(|it| open(it)).collect::<Vec<_>>(),
        "rejected": names(&state.rejected),
        "initial": state.initial,
    })
}

fn inexact(of: &Inexact) -> Value {
    value!({ "name": &*of.name, "rungs": of.rungs, "reason": of.reason })
}

fn open(succession: &Succession) -> Value {
    value!({
        "to": &*succession.to,
        "evidence": succession.evidence.word(),
        "kind": succession.kind.word(),
    })
}

fn names(list: &[Name]) -> Vec<&str> {
    list.iter().map(|name| &**name).collect()
}
