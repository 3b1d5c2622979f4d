//! Suggestions as JSON. The keys are part of the command line's promise: see
//! the help of `gradus suggest`.

use logic::{Budget, Name};
use recovery::groups::{self, Group};
use recovery::successions::{Succession, Witness};
use scenario::Passing;
use serde_json::{Value, json as value};

use super::Found;
use crate::report;
use ide::legible;

/// All that was found, in one document.
pub fn json(found: &Found<'_>, budget: &Budget) -> Value {
    let (sequence, reason) = groups::verdict(found.analysis.groups());
    let suggestions = found.suggestions.iter();
    let groups = found.analysis.groups().iter();
    let sights = found.analysis.sights();
    value!({
        "states": names(&found.states),
        "suggestions": suggestions
            .map(|succession| suggestion(succession, found, budget))
            .collect::<Vec<_>>(),
        "sequence": sequence,
        "reason": reason,
        "rules": sights.map(|it| it.environment.len()),
        "searched": sights.map(|it| it.is_whole),
        "groups": groups.map(group).collect::<Vec<_>>(),
    })
}

fn suggestion(succession: &Succession, found: &Found<'_>, budget: &Budget) -> Value {
    let condition = succession.condition.as_ref();
    let witness = succession.witness.as_deref();
    value!({
        "from": &*succession.from,
        "to": &*succession.to,
        "evidence": succession.evidence.word(),
        "kind": succession.kind.word(),
        "condition": condition.and_then(|it| legible(it, &found.analysis.conditions, budget)),
        "witness": witness.map(scans).unwrap_or_default(),
        "ended": witness.map(|it| it.ended + 1),
        "calm": witness.map(|it| it.is_calm),
    })
}

fn scans(witness: &Witness) -> Vec<Value> {
    let scenario = &witness.scenario;
    let scans = scenario.steps.iter().zip(&witness.on);
    let scan = |(step, on): (&scenario::Step, &Vec<Name>)| {
        let changes = step.changes.iter();
        let inputs: serde_json::Map<String, Value> = changes
            .map(|it| (it.name.to_string(), report::value(it.value)))
            .collect();
        let elapsed = match step.passing {
            Passing::Scans(_) => scenario.cycle_ms,
            Passing::Wait(length) => length,
        };
        value!({"inputs": inputs, "elapsed": elapsed, "on": names(on)})
    };
    scans.map(scan).collect()
}

fn group(group: &Group) -> Value {
    let modes = group.modes.iter();
    value!({
        "states": names(&group.states),
        "sequence": group.sequence,
        "reason": group.reason,
        "modes": modes.map(|set| names(set)).collect::<Vec<_>>(),
    })
}

fn names(list: &[Name]) -> Vec<&str> {
    list.iter().map(|name| &**name).collect()
}
