use logic::Datum;
use logic::notation::{quoted, time};

use crate::parse::spelled;
use crate::{Change, DEFAULT_CYCLE_MS, Expectation, Passing, Scenario, Step, Test, Timing, format};

/// The scenario as a canonical text, which reads back as it was.
pub fn write(scenario: &Scenario) -> String {
    let mut head = Vec::new();
    if let Some(title) = &scenario.title {
        let title = title.replace(['"', '\r', '\n'], "'");
        head.push(format!("scenario \"{title}\""));
    }
    if !scenario.files.is_empty() {
        let files = scenario.files.iter().map(|file| quoted(&file.path));
        head.push(format!("for {}", files.collect::<Vec<_>>().join(", ")));
    }
    if scenario.timing == Timing::Settled {
        head.push("timing settled".to_owned());
    }
    if scenario.cycle_ms != DEFAULT_CYCLE_MS {
        head.push(format!("cycle {}", time(scenario.cycle_ms)));
    }
    let steps: Vec<String> = scenario.steps.iter().map(step).collect();
    let parts = [head, steps].map(|lines| lines.join("\n"));
    let parts: Vec<String> = parts.into_iter().filter(|it| !it.is_empty()).collect();
    match parts.is_empty() {
        true => String::new(),
        false => format(&(parts.join("\n\n") + "\n")).text,
    }
}

/// What a step does, as its line says it: `on s, wait 5s`.
pub fn done(step: &Step) -> String {
    let mut done: Vec<String> = step.changes.iter().map(change).collect();
    match step.passing {
        Passing::Scans(1) if !done.is_empty() => {}
        Passing::Scans(1) => done.push("scan".to_owned()),
        Passing::Scans(number) => done.push(format!("scan {number}")),
        Passing::Wait(length) => done.push(format!("wait {}", time(length))),
    }
    done.join(", ")
}

/// What a step expects, as its line says it behind the arrow: `only on v1`.
/// Empty if it expects nothing.
pub fn expected(step: &Step) -> String {
    let expected: Vec<String> = step.expected.iter().map(expectation).collect();
    let all = expected.join(", ");
    match (step.only, all.is_empty()) {
        (true, true) => "only".to_owned(),
        (true, false) => format!("only {all}"),
        (false, _) => all,
    }
}

fn step(step: &Step) -> String {
    let mut text = done(step);
    let expected = expected(step);
    if !expected.is_empty() {
        text += &format!(" => {expected}");
    }
    let comment = step.comment.as_deref().unwrap_or_default();
    let comment = comment.replace(['\r', '\n'], " ");
    match comment.trim() {
        "" => text,
        said => format!("{text}  // {said}"),
    }
}

fn change(change: &Change) -> String {
    let name = spelled(&change.name);
    match change.value {
        Datum::Bool(true) => format!("on {name}"),
        Datum::Bool(false) => format!("off {name}"),
        number => format!("{name} = {}", value(number)),
    }
}

/// An expectation as a line says it: `on v1`, `Count = 3`.
pub fn expectation(expectation: &Expectation) -> String {
    let name = spelled(&expectation.name);
    match expectation.test {
        Test::On => format!("on {name}"),
        Test::Off => format!("off {name}"),
        Test::Compares(relation, number) => {
            format!("{name} {} {}", relation.sign(), value(number))
        }
    }
}

/// A number as the notation writes it: one with a fraction keeps its point.
fn value(value: Datum) -> String {
    match value {
        Datum::Real(number) if number.is_finite() => format!("{number:?}"),
        Datum::Real(_) => "0".to_owned(),
        other => other.to_string(),
    }
}
