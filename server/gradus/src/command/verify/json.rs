//! A verdict for scripts. The keys are part of the command line's promise: see
//! the help of `gradus verify`.

use ladder::Program;
use logic::{Datum, Name};
use proof::Why;
use serde_json::{Map, Value, json};
use verification::{Reason, Trace, Verdict, Verification, What, rungs_of};

use super::text::left_free;
use crate::report::value;

/// The whole answer.
pub fn json(found: &Verification, program: &Program) -> Value {
    let mut answer = Map::new();
    answer.insert("verdict".into(), word(&found.verdict).into());
    answer.insert("timing".into(), found.timing.word().into());
    about(&found.verdict, &mut answer);
    let mut free: Vec<String> = found.free.iter().map(left_free).collect();
    free.dedup();
    let properties = found.properties.iter().map(|(name, verdict)| {
        let mut property = Map::new();
        property.insert("name".into(), (**name).into());
        property.insert("verdict".into(), word(verdict).into());
        about(verdict, &mut property);
        Value::Object(property)
    });
    let rest = [
        ("states", json!(found.states.map(|it| it.to_string()))),
        ("deadlock", json!(found.deadlock)),
        ("outputs", json!(strings(&found.outputs))),
        ("not_in_ladder", json!(strings(&found.missing))),
        ("not_in_spec", json!(strings(&found.absent))),
        ("free", json!(free)),
        ("rungs", rungs(&found.verdict, program)),
        ("properties", properties.collect()),
    ];
    answer.extend(rest.map(|(key, value)| (key.to_owned(), value)));
    Value::Object(answer)
}

fn word(verdict: &Verdict) -> &'static str {
    match verdict {
        Verdict::Equivalent => "equivalent",
        Verdict::Different(_) => "different",
        Verdict::Unknown { .. } => "unknown",
    }
}

/// What an answer says of one verdict.
fn about(verdict: &Verdict, answer: &mut Map<String, Value>) {
    let difference = match verdict {
        Verdict::Different(difference) => Some(difference),
        _ => None,
    };
    let (bound, why) = match verdict {
        Verdict::Unknown { bound, why } => (Some(*bound), Some(reason(why))),
        _ => (None, None),
    };
    let all = [
        ("what", json!(difference.map(|it| what(&it.what)))),
        ("shortest", json!(difference.map(|it| it.is_shortest))),
        ("brief", json!(difference.map(|it| it.is_brief))),
        ("bound", json!(bound)),
        ("why", json!(why)),
        (
            "trace",
            difference.map_or_else(|| json!([]), |it| trace(&it.trace)),
        ),
    ];
    answer.extend(all.map(|(key, value)| (key.to_owned(), value)));
}

fn what(what: &What) -> Value {
    let (kind, outputs, cycle) = match what {
        What::Outputs(names) => ("outputs", strings(names), Vec::new()),
        What::Unstable(unstable) => (
            "unstable",
            Vec::new(),
            unstable.cycle.iter().map(|it| strings(it)).collect(),
        ),
        What::Restless => ("restless", Vec::new(), Vec::new()),
        What::Property => ("property", Vec::new(), Vec::new()),
    };
    json!({ "kind": kind, "outputs": outputs, "cycle": cycle })
}

fn reason(why: &Reason) -> &'static str {
    match why {
        Reason::Limits(Why::Steps) => "effort",
        Reason::Limits(Why::Memory) => "memory",
        Reason::Limits(Why::Scans) => "depth",
        Reason::Limits(Why::Cancelled) => "stopped",
        Reason::Limits(Why::Unconfirmed) => "fault",
        Reason::Nothing => "nothing",
        Reason::Numbers(_) => "numbers",
        Reason::Unconfirmed => "unconfirmed",
        Reason::Rounds => "evolutions",
    }
}

fn trace(trace: &Trace) -> Value {
    let steps = trace.steps.iter().map(|step| {
        json!({
            "elapsed": step.elapsed_ms,
            "inputs": object(&step.inputs),
            "ladder": object(&step.ladder),
            "grafcet": { "active": strings(&step.active), "outputs": object(&step.grafcet) },
        })
    });
    steps.collect()
}

fn object(values: &[(Name, Datum)]) -> Value {
    let members = values
        .iter()
        .map(|(name, datum)| (name.to_string(), value(*datum)));
    Value::Object(members.collect())
}

fn strings(names: &[Name]) -> Vec<&str> {
    names.iter().map(|name| &**name).collect()
}

/// The rungs that write the outputs that differ.
fn rungs(verdict: &Verdict, program: &Program) -> Value {
    let outputs = match verdict {
        Verdict::Different(difference) => match &difference.what {
            What::Outputs(names) => names.as_slice(),
            _ => &[],
        },
        _ => &[],
    };
    let all = outputs.iter().flat_map(|output| {
        let (rungs, others) = rungs_of(program, output);
        rungs.into_iter().map(move |rung| {
            json!({
                "output": &**output,
                "scope": &*rung.scope,
                "rung": rung.number,
                "comment": rung.comment.as_deref(),
                "depends_on": others,
            })
        })
    });
    all.collect()
}
