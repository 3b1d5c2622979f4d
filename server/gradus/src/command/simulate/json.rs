//! A simulation for scripts. The keys are part of the command line's promise:
//! see the help of `gradus simulate`.

use logic::{Datum, Name};
use recovery::simulation::{Failure, Row, Side, Simulation, Subject, Wanted};
use scenario::{Scenario, Test};
use serde_json::{Map, Value, json};

use crate::report::value;

/// The whole answer.
pub fn json(
    scenario: &Scenario,
    simulation: &Simulation,
    subject: Subject<'_>,
    line_of: impl Fn(usize) -> Option<usize>,
) -> Value {
    let scans: Vec<Value> = simulation
        .rows
        .iter()
        .map(|row| scan(simulation, subject, row, line_of(row.step)))
        .collect();
    let stopped = simulation.stopped.as_ref().map(|(step, stop)| {
        json!({
            "step": step,
            "line": line_of(*step),
            "reason": stop.sentence(scenario.cycle_ms),
        })
    });
    let is_pair = subject.ladder.is_some() && subject.grafcet.is_some();
    json!({
        "scans": scans,
        "agree": is_pair.then(|| simulation.agrees()),
        "passed": simulation.failures().next().is_none() && simulation.stopped.is_none(),
        "stopped": stopped,
    })
}

fn scan(simulation: &Simulation, subject: Subject<'_>, row: &Row, line: Option<usize>) -> Value {
    let values = &row.values;
    let ladder = subject
        .ladder
        .map(|_| object(&simulation.ladder, &values.ladder));
    let grafcet = subject.grafcet.map(|_| {
        json!({
            "active": strings(&values.active),
            "outputs": object(&simulation.grafcet, &values.grafcet),
        })
    });
    let failed: Vec<Value> = row.failures.iter().map(failure).collect();
    json!({
        "scan": row.scan,
        "time": row.time_ms,
        "step": row.step,
        "line": line,
        "inputs": object(&simulation.inputs, &values.inputs),
        "ladder": ladder,
        "grafcet": grafcet,
        "differ": strings(&row.differences),
        "expected_failed": failed,
    })
}

fn object(names: &[Name], values: &[Datum]) -> Value {
    let members = names.iter().zip(values);
    let members = members.map(|(name, it)| (name.to_string(), value(*it)));
    Value::Object(members.collect::<Map<_, _>>())
}

fn strings(names: &[Name]) -> Vec<&str> {
    names.iter().map(|name| &**name).collect()
}

fn failure(failure: &Failure) -> Value {
    let (relation, wanted) = match failure.wanted {
        Wanted::Test(_, Test::On) => ("=", json!(true)),
        Wanted::Test(_, Test::Off) => ("=", json!(false)),
        Wanted::Test(_, Test::Compares(relation, number)) => (relation.sign(), value(number)),
        Wanted::Unchanged(before) => ("unchanged", value(before)),
    };
    json!({
        "name": &*failure.name,
        "in": match failure.side {
            Side::Ladder => "ladder",
            Side::Grafcet => "grafcet",
        },
        "relation": relation,
        "expected": wanted,
        "value": value(failure.value),
    })
}
