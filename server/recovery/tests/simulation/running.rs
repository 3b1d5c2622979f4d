//! How a scenario runs: rows, timings, waits, expectations.

use logic::Cancel;
use recovery::simulation::{Simulation, Subject, findings, recorded, simulate, unknown_names};

const MOTOR: &str = "\
input start
input stop
output motor
output lamp
internal t1 : TON
rung: (start + motor)*/stop -> motor
rung: motor -> TON(t1, 2s)
rung: t1.Q -> lamp
";

const SPEC: &str = "\
Step X0, Xmotor
Transition t1, t2
Input start, stop, t1.Q
Output motor, lamp
Marking X0
Transitions:
t1: X0*start*/stop |- @Xmotor
t2: Xmotor*stop |- @X0
Steps:
Xmotor: |- motor
Xmotor: t1.Q |- lamp
";

/// Runs `scenario` on a ladder, a spec, or both.
fn run(ladder: &str, spec: &str, scenario: &str) -> (scenario::Scenario, Simulation) {
    let reading = scenario::read(scenario);
    assert_eq!(reading.diagnostics, []);
    let program = ladder::read(ladder.as_bytes()).program;
    let grafcet = grafcet::read(spec).spec.grafcet;
    let subject = Subject {
        ladder: (!ladder.is_empty()).then_some(&program),
        grafcet: (!spec.is_empty()).then_some(&grafcet),
    };
    assert_eq!(unknown_names(&reading.scenario, subject), []);
    let simulation = simulate(&reading.scenario, subject, &Cancel::default());
    (reading.scenario, simulation)
}

/// The rows as lines: scan, time, what is on, differences.
fn rows(simulation: &Simulation) -> Vec<String> {
    let on = |names: &[logic::Name], values: &[logic::Datum]| {
        let all = names.iter().zip(values).filter(|(_, value)| value.is_on());
        let on: Vec<_> = all.map(|(name, _)| name.to_string()).collect();
        on.join(" ")
    };
    let row = |row: &recovery::simulation::Row| {
        let values = &row.values;
        let mut line = format!(
            "{} {}ms: {} | {} | {}",
            row.scan,
            row.time_ms,
            on(&simulation.ladder, &values.ladder),
            values.active.join(" "),
            on(&simulation.grafcet, &values.grafcet),
        );
        if !row.differences.is_empty() {
            line += &format!(" | differ: {}", row.differences.join(" "));
        }
        line
    };
    simulation.rows.iter().map(row).collect()
}

/// What is said of the text, each with the text that it is said of.
fn said(text: &str, scenario: &scenario::Scenario, simulation: &Simulation) -> Vec<String> {
    let found = findings(scenario, simulation).into_iter();
    let said = found.map(|it| format!("{}: {}", &text[it.span.range()], it.message));
    said.collect()
}

#[test]
fn a_row_for_what_changes_and_for_the_end_of_a_step() {
    let (_, simulation) = run(
        MOTOR,
        SPEC,
        "on start => on motor\noff start\nwait 3s => on lamp\n",
    );
    assert_eq!(
        rows(&simulation),
        [
            "1 10ms: motor | Xmotor | motor",
            "2 20ms: motor | Xmotor | motor",
            "201 2010ms: motor lamp | Xmotor | motor lamp",
            "302 3020ms: motor lamp | Xmotor | motor lamp",
        ]
    );
    assert!(simulation.agrees());
}

#[test]
fn a_side_may_run_alone() {
    let (_, ladder) = run(MOTOR, "", "on start");
    assert_eq!(rows(&ladder), ["1 10ms: motor |  | "]);
    let (_, spec) = run("", SPEC, "on start, on t1.Q => on Xmotor, on lamp");
    assert_eq!(rows(&spec), ["1 10ms:  | Xmotor | motor lamp"]);
    assert_eq!(spec.failures().count(), 0);
}

#[test]
fn a_wait_ends_when_the_time_has_passed() {
    let (_, simulation) = run(MOTOR, "", "cycle 400ms\non start\nwait 1s\n");
    assert_eq!(
        rows(&simulation),
        ["1 400ms: motor |  | ", "4 1400ms: motor |  | "]
    );
}

#[test]
fn what_is_not_so_is_said_at_its_place() {
    let text =
        "on start => off motor, on Xmotor, lamp = 0\nscan => only on lamp\non stop => only\n";
    let (scenario, simulation) = run(MOTOR, SPEC, text);
    assert_eq!(
        said(text, &scenario, &simulation),
        [
            "off motor: motor should be off after scan 1, but the ladder has it on",
            "off motor: motor should be off after scan 1, but the spec has it on",
            "on lamp: lamp should be on after scan 2, but the ladder has it off",
            "on lamp: lamp should be on after scan 2, but the spec has it off",
            "on stop => only: motor should stay on after scan 3, but the ladder has it off",
            "on stop => only: motor should stay on after scan 3, but the spec has it off",
        ]
    );
}

#[test]
fn a_spec_that_does_something_else_differs() {
    let slow = SPEC.replace("X0*start*/stop", "X0*rise(start)*stop");
    let (_, simulation) = run(MOTOR, &slow, "on start\non stop\n");
    assert_eq!(
        rows(&simulation),
        ["1 10ms: motor | X0 |  | differ: motor", "2 20ms:  | X0 | ",]
    );
    assert!(!simulation.agrees());
}

#[test]
fn a_settled_step_lasts_until_nothing_changes() {
    // b follows a two scans late, since its rungs stand above what they read.
    let ladder = "input a\noutput b\nrung: m -> b\nrung: a -> m\n";
    let spec = "Step A, B\nTransition t1, t2\nInput a\nOutput b\nMarking A\nTransitions:\n\
                t1: A*a |- @B\nt2: B*/a |- @A\nSteps:\nB: |- b\n";
    let (_, scan) = run(ladder, spec, "on a => on b\n");
    assert_eq!(rows(&scan), ["1 10ms:  | B | b | differ: b"]);
    let (_, settled) = run(ladder, spec, "timing settled\non a => on b\n");
    assert_eq!(rows(&settled), ["1 10ms:  | B | b", "2 10ms: b | B | b"]);
    assert!(settled.agrees());
    assert_eq!(settled.failures().count(), 0);
}

#[test]
fn what_never_rests_or_takes_too_long_is_said() {
    let oscillator = "output q\nrung: /q -> q\n";
    let text = "timing settled\nscan => on q\n";
    let (scenario, simulation) = run(oscillator, "", text);
    assert_eq!(
        said(text, &scenario, &simulation),
        ["scan => on q: ladder and spec do not come to rest: something changes in every scan"]
    );
    let text = "wait 1d\n";
    let (scenario, simulation) = run(MOTOR, "", text);
    assert_eq!(
        said(text, &scenario, &simulation),
        ["wait 1d: the step would take 8640000 scans of 10ms; say a longer `cycle`"]
    );
    let unstable = "Step A, B\nTransition t1, t2\nInput a\nMarking A\nTransitions:\n\
                    t1: A*a |- @B\nt2: B*a |- @A\n";
    let text = "scan\non a\noff a\n";
    let (scenario, simulation) = run("", unstable, text);
    assert_eq!(
        said(text, &scenario, &simulation),
        ["on a: the spec never becomes stable: t1, t2, over and over (steps A, B)"]
    );
    assert_eq!(simulation.rows.len(), 1);
}

#[test]
fn unknown_names_are_said() {
    let program = ladder::read(MOTOR.as_bytes()).program;
    let subject = Subject {
        ladder: Some(&program),
        grafcet: None,
    };
    let text = "on Start => on motor, off Xmotor, on t1.Q\n";
    let found = unknown_names(&scenario::read(text).scenario, subject);
    let said: Vec<_> = found
        .iter()
        .map(|it| format!("{}: {}", &text[it.span.range()], it.message))
        .collect();
    assert_eq!(
        said,
        [
            "Start: the ladder does not know Start",
            "Xmotor: the ladder does not know Xmotor",
        ]
    );
}

#[test]
fn variables_answer_to_their_addresses() {
    let ladder = "input s %I0\noutput q %Q0\nrung: s -> q\nrung: s -> n := n + 1\n";
    let (_, simulation) = run(ladder, "", "on %I0 => only on %q0\nscan => n = 2, n > 1\n");
    assert_eq!(simulation.failures().count(), 0);
}

#[test]
fn a_record_expects_what_came_out() {
    let text = "cycle 500ms\non start\nwait 3s\non stop\n";
    let (scenario, simulation) = run(MOTOR, SPEC, text);
    let recorded = recorded(&scenario, &simulation);
    assert_eq!(
        scenario::write(&recorded),
        "cycle 500ms\n\n\
         on start => only on motor\n\
         wait 3s  => only on lamp\n\
         on stop  => only off motor, off lamp\n"
    );
    let program = ladder::read(MOTOR.as_bytes()).program;
    let subject = Subject {
        ladder: Some(&program),
        grafcet: None,
    };
    let again = simulate(&recorded, subject, &Cancel::default());
    assert_eq!(again.failures().count(), 0);
}
