//! Suggestions as JSON. The keys are part of the command line's promise: see
//! the help of `gradus suggest`.

use logic::{Budget, Name};
use recovery::groups::{self, Group};
use recovery::successions::Succession;
use serde_json::{Value, json as value};

use super::Found;
use ide::legible;

/// All that was found, in one document.
pub fn json(found: &Found<'_>, budget: &Budget) -> Value {
    let (sequence, reason) = groups::verdict(found.analysis.groups());
    let suggestions = found.suggestions.iter();
    let groups = found.analysis.groups().iter();
    value!({
        "states": names(&found.states),
        "suggestions": suggestions
            .map(|succession| suggestion(succession, found, budget))
            .collect::<Vec<_>>(),
        "sequence": sequence,
        "reason": reason,
        "groups": groups.map(group).collect::<Vec<_>>(),
    })
}

fn suggestion(succession: &Succession, found: &Found<'_>, budget: &Budget) -> Value {
    let condition = succession.condition.as_ref();
    value!({
        "from": &*succession.from,
        "to": &*succession.to,
        "evidence": succession.evidence.word(),
        "kind": succession.kind.word(),
        "condition": condition.and_then(|it| legible(it, &found.analysis.conditions, budget)),
        "witness": [],
    })
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
