//! How soon a proof stops when somebody asks it to, and what memory it takes.
//!
//! `cargo run --release -p gradus-bench --bin gradus-bench-cancel` prints the
//! table that `docs/proof.md` explains. Work looks again and again whether it is
//! to stop; what it does between two looks is what somebody waits for who asks.
//! Each question is asked in a process of its own, for the sake of the memory.

use std::process::{Command, ExitCode};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use bench::measure::now;
use bench::memory::peak;
use bench::plant::plant;
use bench::questions::rows;
use bench::real;
use bench::sequencer::{Coupling, Encoding};
use grafcet::Spec;
use ladder::Program;
use logic::{Budget, Cancel};
use proof::{Limits, Netlist, check, compare};
use recovery::conversion::{Accept, decide, spec};
use verification::{Timing, verify};

#[path = "../../../server/proof/tests/judge/multiplier.rs"]
mod multiplier;

const HEAD: &str = "\
| question | verdict | worked | looks | longest between two | memory |
|---|---|---|---|---|---|";

/// What is asked under limits once all is ready.
type Ask = Box<dyn Fn(&Limits) -> String>;

/// A question, and what makes it ready.
type Question = (&'static str, fn() -> Ask);

const QUESTIONS: [Question; 7] = [
    ("a multiplier of 24 bits, its factors exchanged", || {
        let [one, other] = [false, true].map(|it| multiplier::multiplier(24, it));
        proved(compare(&one, &other).netlist)
    }),
    ("1,000 latches in rows that wait for each other", || {
        proved(rows(1_000, Encoding::Cleared, Coupling::Waiting).equal)
    }),
    ("10,000 rungs against their products, `scan`", || {
        product(plant(10_000).as_bytes(), Timing::Scan)
    }),
    ("10,000 rungs against their products, `settled`", || {
        product(plant(10_000).as_bytes(), Timing::Settled)
    }),
    ("a scan that goes through 400 steps", || {
        let program = ladder::read(b"input go\nrung: go -> out\n").program;
        let spec = grafcet::read(&row_of_steps(400)).spec;
        verified(program, spec, Timing::Scan)
    }),
    ("the largest real program, `scan`", || largest(Timing::Scan)),
    ("the largest real program, `settled`", || {
        largest(Timing::Settled)
    }),
];

fn main() -> ExitCode {
    let asked = std::env::args().nth(1).and_then(|it| it.parse().ok());
    if let Some(question) = asked.and_then(|at: usize| QUESTIONS.get(at)) {
        println!("{}", row(question));
        return ExitCode::SUCCESS;
    }
    println!("{HEAD}");
    for at in 0..QUESTIONS.len() {
        let own = std::env::current_exe();
        let ended = own.and_then(|own| Command::new(own).arg(at.to_string()).status());
        if !ended.is_ok_and(|it| it.success()) {
            return ExitCode::FAILURE;
        }
    }
    ExitCode::SUCCESS
}

/// What is known about the looks at a cancel.
struct Looks {
    count: u64,
    last: Duration,
    longest: Duration,
}

fn row((name, ready): &Question) -> String {
    let looks = Arc::new(Mutex::new(Looks {
        count: 0,
        last: now(),
        longest: Duration::ZERO,
    }));
    let look = {
        let looks = looks.clone();
        move || {
            let mut looks = looks.lock().expect("nobody panics");
            let at = now();
            looks.longest = looks.longest.max(at.saturating_sub(looks.last));
            looks.last = at;
            looks.count += 1;
            false
        }
    };
    let limits = Limits {
        steps: 1_000_000_000,
        cancel: Cancel::when(look),
        ..Limits::default()
    };
    let ask = ready();
    let before = now();
    looks.lock().expect("nobody panics").last = before;
    let verdict = ask(&limits);
    let worked = now().saturating_sub(before);
    // What follows the last look is waited for as well.
    limits.cancel.is_cancelled();
    let looks = looks.lock().expect("nobody panics");
    let memory = peak().map_or(String::new(), |it| format!("{} MB", it / 1_000_000));
    format!(
        "| {name} | {verdict} | {:.2} s | {} | {:.1} ms | {memory} |",
        worked.as_secs_f64(),
        looks.count,
        1e3 * looks.longest.as_secs_f64(),
    )
}

fn proved(question: Netlist) -> Ask {
    Box::new(move |limits| match check(&question, limits).verdict {
        proof::Verdict::Equivalent => "equivalent".into(),
        proof::Verdict::Different(_) => "different".into(),
        proof::Verdict::Unknown { why, .. } => format!("unknown: {why:?}"),
    })
}

fn verified(program: Arc<Program>, spec: Spec, timing: Timing) -> Ask {
    Box::new(
        move |limits| match verify(&program, &spec, timing, limits) {
            Err(refusal) => format!("refused: {refusal}"),
            Ok(found) => match found.verdict {
                verification::Verdict::Equivalent => "equivalent".into(),
                verification::Verdict::Different(_) => "different".into(),
                verification::Verdict::Unknown { why, .. } => format!("unknown: {why:?}"),
            },
        },
    )
}

/// A ladder against what `convert --accept none` makes of it.
fn product(bytes: &[u8], timing: Timing) -> Ask {
    let program = ladder::read(bytes).program;
    let budget = Budget::default();
    let analysis = recovery::analyse(&program, &budget);
    let decisions = decide(&analysis, &[], &Accept::None);
    let spec = spec(&analysis, &decisions, &budget);
    verified(program, spec, timing)
}

/// Steps in a row, each left for the next while `go` is 1, which `out` follows.
fn row_of_steps(steps: usize) -> String {
    let list = |sign: &str, count: usize| {
        let names = (0..count).map(|at| format!("{sign}{at}"));
        names.collect::<Vec<String>>().join(", ")
    };
    let [names, transitions] = [list("X", steps), list("t", steps - 1)];
    let mut text = format!(
        "Step O, {names}\nTransition {transitions}\nInput go\nOutput out\nMarking O, X0\n\nTransitions:\n"
    );
    for at in 1..steps {
        text += &format!("t{}: X{}*go |- @X{at}\n", at - 1, at - 1);
    }
    text + "\nSteps:\nO: go |- out\n"
}

/// The largest real program.
fn largest(timing: Timing) -> Ask {
    let files = real::files("l5x").into_iter();
    match files.max_by_key(|it| it.bytes.len()) {
        Some(file) => product(&file.bytes, timing),
        None => Box::new(|_| "no corpus".into()),
    }
}
