use grafcet::evolution::Machine;
use logic::{Cancel, Name};
use proof::Limits;
use recovery::simulation::{Stop, Subject, simulate};
use verification::{Difference, Timing, Verdict, What, verify};

use crate::{halves, small};

/// Evolves the spec after the line of `=` for each byte before it, which says
/// what inputs are on and how much time has passed. A scan that finds no stable
/// situation leaves all as it was.
pub fn evolves(bytes: &[u8]) {
    let Some((scans, spec)) = halves(bytes) else {
        return;
    };
    let grafcet = grafcet::read(spec).spec.grafcet;
    let mut machine = Machine::new(&grafcet);
    let inputs: Vec<Name> = machine.free().cloned().collect();
    for byte in scans.bytes().take(100) {
        for (at, name) in inputs.iter().enumerate() {
            machine.set_input(name, byte >> (at % 7) & 1 == 1);
        }
        let before = machine.clone();
        match machine.scan(u64::from(byte) * 10) {
            Ok(()) => {
                let mut active = machine.active();
                assert!(active.all(|step| machine.is_active(step)));
            }
            Err(_) => assert!(machine.is_as_in(&before), "a scan in vain"),
        }
    }
}

/// Verifies the ladder before the line of `=` against the spec after it, or
/// against its own products where there is no such line. What is told to be
/// different must be so where the sequence is run as a scenario.
pub fn verifies(bytes: &[u8]) {
    let (ladder, spec) = match halves(bytes) {
        Some((ladder, spec)) => (ladder.as_bytes(), Some(grafcet::read(spec).spec)),
        None => (bytes, None),
    };
    let program = ladder::read(ladder).program;
    let spec = spec.unwrap_or_else(|| {
        let budget = small();
        let analysis = recovery::analyse(&program, &budget);
        recovery::conversion::spec(&analysis, &[], &budget)
    });
    let limits = Limits {
        steps: 4_000_000,
        gates: 100_000,
        clauses: 100_000,
        nodes: 20_000,
        scans: 40,
        ..Limits::default()
    };
    let subject = Subject {
        ladder: Some(&program),
        grafcet: Some(&spec.grafcet),
    };
    for timing in [Timing::Scan, Timing::Settled] {
        let Ok(found) = verify(&program, &spec, timing, &limits) else {
            continue;
        };
        if let Verdict::Different(difference) = &found.verdict {
            happens(difference, subject);
        }
    }
}

fn happens(difference: &Difference, subject: Subject<'_>) {
    let scenario = difference.trace.scenario();
    let came = simulate(&scenario, subject, &Cancel::default());
    let is_so = match (&difference.what, &came.stopped) {
        (What::Outputs(names), None) => {
            let last = came.rows.last().map(|row| &row.differences);
            last.is_some_and(|differ| names.iter().all(|name| differ.contains(name)))
        }
        (What::Unstable(_), Some((_, Stop::Unstable(_)))) => true,
        (What::Restless, Some((_, Stop::Restless))) => true,
        _ => false,
    };
    assert!(is_so, "{difference:?}, but {came:?}: {}", scenario::write(&scenario));
}
