//! A verdict for people.

use ladder::Program;
use logic::notation::{quoted, time};
use logic::{Datum, Name, Relation};
use proof::Why;
use verification::inputs::Source;
use verification::{Difference, Reason, Step, Timing, Verdict, Verification, What, rungs_of};

use crate::colour::Paint;
use crate::input::numbered;
use crate::report::{on, printable};

/// The whole answer.
pub fn text(found: &Verification, program: &Program, paint: Paint) -> String {
    let mut out = verdict(found, paint);
    if let Verdict::Different(difference) = &found.verdict {
        out += &shown(difference, found.timing, paint);
        if let What::Outputs(outputs) = &difference.what {
            out += &rungs(program, outputs);
        }
    }
    for (name, verdict) in &found.properties {
        out += &property(name, verdict, found.timing, paint);
    }
    out + &notes(found)
}

/// The first line.
fn verdict(found: &Verification, paint: Paint) -> String {
    let outputs = numbered(found.outputs.len(), "output");
    let timing = match found.timing {
        Timing::Scan => "after every scan",
        Timing::Settled => "when both sides rest",
    };
    let line = match &found.verdict {
        Verdict::Equivalent if found.outputs.is_empty() => "no outputs are compared".to_owned(),
        Verdict::Equivalent => format!(
            "{}: {outputs} equal {timing}, {}",
            paint.bold("equivalent"),
            match found.rules {
                0 => "whatever the inputs".to_owned(),
                rules => format!(
                    "whatever the inputs that {} allow",
                    numbered(rules, "environment rule")
                ),
            }
        ),
        Verdict::Different(difference) => {
            let steps = steps(difference.trace.steps.len(), found.timing);
            let shortest = match difference.is_shortest {
                true => ", and never before",
                false => "",
            };
            let what = match &difference.what {
                What::Outputs(names) => format!("{} {}", names_of(names), differs(names.len())),
                What::Unstable(unstable) => {
                    format!("the spec {}", printable(&unstable.to_string()))
                }
                What::Restless => {
                    "ladder and spec do not come to rest: something changes in every scan"
                        .to_owned()
                }
                What::Property => "a property is violated".to_owned(),
            };
            let word = paint.error("different");
            format!(
                "{word} ({}): {what} after {steps}{shortest}",
                found.timing.word()
            )
        }
        Verdict::Unknown { bound, why } => unknown(*bound, why, found.timing, paint),
    };
    line + "\n"
}

fn differs(number: usize) -> &'static str {
    if number == 1 { "differs" } else { "differ" }
}

fn unknown(bound: usize, why: &Reason, timing: Timing, paint: Paint) -> String {
    let far = match bound {
        0 => String::new(),
        bound => format!("; no difference within {}", steps(bound, timing)),
    };
    let why = match why {
        Reason::Limits(Why::Steps) => "the effort is used up; --effort allows more".to_owned(),
        Reason::Limits(Why::Memory) => "it would take more memory than is allowed".to_owned(),
        Reason::Limits(Why::Scans) => "the depth is reached; --depth allows more".to_owned(),
        Reason::Limits(Why::Cancelled) => "it was stopped".to_owned(),
        Reason::Limits(Why::Unconfirmed) => {
            "what was found did not happen again; this is a fault of Gradus".to_owned()
        }
        Reason::Nothing => {
            "there is nothing to compare: the spec has no output that the ladder knows".to_owned()
        }
        Reason::Numbers(names) => {
            format!(
                "{} {} numbers that are not followed",
                names_of(names),
                match names.len() {
                    1 => "holds",
                    _ => "hold",
                }
            )
        }
        Reason::Unconfirmed => {
            "a difference was found that needs what is left free to be as it was not seen to be"
                .to_owned()
        }
        Reason::Rounds => "the spec takes too many evolutions in a scan to be followed".to_owned(),
    };
    format!("{}: {why}{far}", paint.error("unknown"))
}

fn steps(number: usize, timing: Timing) -> String {
    match timing {
        Timing::Scan => numbered(number, "scan"),
        Timing::Settled => numbered(number, "settled step"),
    }
}

fn names_of(names: &[Name]) -> String {
    let names: Vec<String> = names.iter().map(|name| printable(&quoted(name))).collect();
    names.join(", ")
}

/// The trace as a table, and what else is to be said of it.
fn shown(difference: &Difference, timing: Timing, paint: Paint) -> String {
    let trace = &difference.trace.steps;
    let takes_time = trace.iter().any(|step| step.elapsed_ms > 0);
    let mut passed = 0;
    let mut cells = Vec::new();
    for (at, step) in trace.iter().enumerate() {
        passed += step.elapsed_ms;
        cells.push(vec![
            (at + 1).to_string(),
            time(passed).to_string(),
            on(pairs(&step.inputs)),
            on(pairs(&step.ladder)),
            on(pairs(&step.grafcet)),
            printable(&step.active.join(" ")),
            printable(&differing(step).join(" ")),
        ]);
    }
    let head = timing.word().replace("settled", "step");
    let heads = [
        &head,
        "time",
        "inputs",
        "ladder",
        "spec",
        "active steps",
        "differ",
    ];
    let differ = cells
        .iter()
        .any(|row| row.last().is_some_and(|it| !it.is_empty()));
    let is_shown = [true, takes_time, true, true, true, true, differ];
    let shown = |row: Vec<String>| -> Vec<String> {
        let all = row.into_iter().zip(is_shown);
        all.filter_map(|(cell, is_shown)| is_shown.then_some(cell))
            .collect()
    };
    let mut rows = vec![shown(heads.map(str::to_owned).to_vec())];
    rows.extend(cells.into_iter().map(shown));
    let mut out = table(&rows, paint);
    if difference.is_brief {
        out += "  It is over after another scan with the same inputs, as where a rung looks at\n  \
                what a rung below it decides.\n";
    }
    out
}

/// The outputs in which the two sides differ after a step.
fn differing(step: &Step) -> Vec<Name> {
    let differs = |(name, value): &&(Name, Datum)| {
        let own = step.ladder.iter().find(|(it, _)| it == name);
        own.is_some_and(|(_, own)| !own.compares(Relation::Equal, *value))
    };
    let all = step.grafcet.iter().filter(differs);
    all.map(|(name, _)| name.clone()).collect()
}

fn table(rows: &[Vec<String>], paint: Paint) -> String {
    let width = |text: &String| unicode_width::UnicodeWidthStr::width(text.as_str());
    let columns = rows.first().map_or(0, Vec::len);
    let widths: Vec<usize> = (0..columns)
        .map(|at| rows.iter().map(|row| width(&row[at])).max().unwrap_or(0))
        .collect();
    let mut out = String::new();
    for (at, row) in rows.iter().enumerate() {
        let cells = row.iter().zip(&widths);
        let line: String = cells
            .map(|(cell, column)| format!("{cell}{}", " ".repeat(column + 2 - width(cell))))
            .collect();
        let line = line.trim_end();
        out += &match at {
            0 => format!("  {}\n", paint.bold(line)),
            _ => format!("  {line}\n"),
        };
    }
    out
}

fn pairs(values: &[(Name, Datum)]) -> impl Iterator<Item = (&Name, &Datum)> {
    values.iter().map(|(name, value)| (name, value))
}

/// Which rungs write the outputs that differ.
fn rungs(program: &Program, outputs: &[Name]) -> String {
    let mut out = String::new();
    for output in outputs {
        let (rungs, others) = rungs_of(program, output);
        for rung in rungs {
            let comment = rung
                .comment
                .as_ref()
                .map(|it| format!(" \"{}\"", printable(it)));
            out += &format!(
                "  {} is written by rung {} of {}{}",
                printable(&quoted(output)),
                rung.number,
                printable(&rung.scope),
                comment.unwrap_or_default(),
            );
            out += &match others {
                0 => "\n".to_owned(),
                others => format!(", on which {} can tell\n", numbered(others, "other rung")),
            };
        }
    }
    out
}

fn property(name: &Name, verdict: &Verdict, timing: Timing, paint: Paint) -> String {
    let label = printable(name);
    match verdict {
        Verdict::Equivalent => format!("never {label}: {}\n", paint.bold("proved")),
        Verdict::Different(difference) => {
            let steps = steps(difference.trace.steps.len(), timing);
            let word = paint.error("violated");
            format!("never {label}: {word} after {steps}\n") + &shown(difference, timing, paint)
        }
        Verdict::Unknown { bound, why } => {
            format!("never {label}: {}\n", unknown(*bound, why, timing, paint))
        }
    }
}

/// What a reader should know besides.
fn notes(found: &Verification) -> String {
    let mut out = String::new();
    if !found.missing.is_empty() {
        let names = names_of(&found.missing);
        out += &format!("  not compared, since the ladder does not know them: {names}\n");
    }
    if !found.absent.is_empty() {
        let names = names_of(&found.absent);
        out += &format!("  not compared, since the spec does not have them: {names}\n");
    }
    if let Some(steps) = found.deadlock {
        out += &format!(
            "  the environment rules allow no sequence of more than {steps} steps: what is proved says little\n"
        );
    }
    let mut free: Vec<String> = found.free.iter().map(left_free).collect();
    free.dedup();
    if !free.is_empty() {
        out += &format!("  left free: {}\n", free.join("; "));
    }
    out
}

/// What is left free, in words.
pub fn left_free(source: &Source) -> String {
    match source {
        Source::Event(of) => format!("when {} is done", printable(of)),
        Source::Elapsed { step, time_ms } => {
            format!(
                "when {} has been active for {}",
                printable(step),
                time(*time_ms)
            )
        }
        Source::Opaque(text) => printable(text),
        Source::Bit(name)
        | Source::Choice { variable: name, .. }
        | Source::WordBit { variable: name, .. } => printable(name),
    }
}
