//! Verdicts about ladders and their specs.

#[path = "../../../ladder/tests/against_c/program.rs"]
#[allow(dead_code)]
mod program;
#[path = "../../../ladder/tests/against_c/random.rs"]
mod random;
#[path = "../../../ladder/tests/against_c/text.rs"]
mod random_text;

mod corpus;
mod ladders;
mod limits;
mod neutralization;
mod product;
mod real;
mod timing;
mod words;

use std::sync::Arc;

use grafcet::Spec;
use ladder::Program;
use logic::{Datum, Name};
use proof::Limits;
use verification::{Timing, Verdict, Verification, What, verify};

/// A text of the repository.
pub fn text(path: &str) -> String {
    std::fs::read_to_string(end_to_end::path(path)).expect("a readable fixture")
}

/// What `text` holds.
pub fn program(text: &str) -> Arc<Program> {
    ladder::read(text.as_bytes()).program
}

/// The spec that `text` holds, without errors.
#[track_caller]
pub fn spec(text: &str) -> Spec {
    let reading = grafcet::read(text);
    let errors = reading
        .diagnostics
        .iter()
        .filter(|it| it.severity == source::Severity::Error);
    assert_eq!(errors.count(), 0, "{:?}", reading.diagnostics);
    reading.spec
}

/// What is found about both.
#[track_caller]
pub fn verified(ladder: &str, spec_text: &str, timing: Timing) -> Verification {
    verify(
        &program(ladder),
        &spec(spec_text),
        timing,
        &Limits::default(),
    )
    .expect("a translation")
}

/// A verdict as text: a line for each step, `inputs | ladder | spec`, and what
/// happens in the last.
pub fn told(verdict: &Verdict) -> String {
    let difference = match verdict {
        Verdict::Equivalent => return "equivalent".to_owned(),
        Verdict::Unknown { bound, why } => return format!("unknown after {bound}: {why:?}"),
        Verdict::Different(difference) => difference,
    };
    let mut out = String::new();
    for step in &difference.trace.steps {
        let time = match step.elapsed_ms {
            0 => String::new(),
            time => format!("{time} ms "),
        };
        out += &format!(
            "{time}{} | {} | {}\n",
            on(&step.inputs),
            on(&step.ladder),
            on(&step.grafcet)
        );
    }
    out + &match &difference.what {
        What::Outputs(names) => format!("differ: {}", names.join(" ")),
        What::Unstable(unstable) => unstable.to_string(),
        What::Restless => "never rests".to_owned(),
        What::Property => "violated".to_owned(),
    }
}

fn on(values: &[(Name, Datum)]) -> String {
    let on = values.iter().filter(|(_, value)| value.is_on());
    let on: Vec<String> = on
        .map(|(name, value)| match value {
            Datum::Bool(_) => name.to_string(),
            number => format!("{name}={number}"),
        })
        .collect();
    match on.is_empty() {
        true => "-".to_owned(),
        false => on.join(" "),
    }
}

/// Compares texts without their indentation.
#[track_caller]
pub fn assert_told(verdict: &Verdict, expected: &str) {
    let lines = |text: &str| {
        text.lines()
            .map(|line| line.trim().to_owned())
            .collect::<Vec<_>>()
            .join("\n")
    };
    assert_eq!(told(verdict), lines(expected.trim()));
}
