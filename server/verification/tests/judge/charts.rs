//! Random grafcets, run by the machine and as transition systems.

use grafcet::evolution::Machine;
use grafcet::{Grafcet, Spec};
use logic::Datum;
use proof::{Trace, replay};
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::select;
use verification::chart::{Evolved, follow};
use verification::inputs::Source;
use verification::program::Bounds;

use crate::plain;

/// So many evolutions are followed; a scan that takes more is not compared.
const EVOLUTIONS: usize = 7;

/// Runs both on the same inputs: in each scan these bits, one for each input of
/// the translation, after so much time.
fn compare(grafcet: &Grafcet, scans: &[(u64, u64)]) -> Result<(), TestCaseError> {
    let spec = Spec {
        grafcet: grafcet.clone(),
        ..Spec::default()
    };
    let Ok(evolved) = follow(&spec, None, EVOLUTIONS, &Bounds::default()) else {
        return Err(TestCaseError::reject("refused"));
    };
    let opaque: Vec<usize> = (0..evolved.inputs.sources.len())
        .filter(|at| matches!(evolved.inputs.sources[*at], Source::Opaque(_)))
        .collect();
    let touched = evolved.netlist.touched_by(&opaque);
    let mut netlist = evolved.netlist.clone();
    netlist.output("unstable", evolved.unstable);
    for (name, active) in &evolved.active {
        netlist.output(name.clone(), *active);
    }
    let mut shown = Vec::new();
    for name in evolved.outputs() {
        let cases = evolved.cases(name);
        if !cases.is_empty() && !cases.iter().any(|(_, when)| touched.contains(*when)) {
            for (value, when) in cases {
                netlist.output(format!("{name}={value}"), *when);
            }
            shown.push((name, cases));
        }
    }
    let mut machine = Machine::new(grafcet);
    let mut inputs = Vec::new();
    let mut seen = Vec::new();
    for (bits, elapsed) in scans {
        inputs.push(latch(&evolved, &mut machine, *bits, *elapsed));
        let is_stable = machine.scan(*elapsed).is_ok();
        let active: Vec<bool> = evolved
            .active
            .iter()
            .map(|(name, _)| machine.is_active(name))
            .collect();
        let values: Vec<Datum> = shown.iter().map(|(name, _)| machine.value(name)).collect();
        seen.push((
            is_stable.then(|| machine.evolutions().count()),
            active,
            values,
        ));
    }
    let trace = Trace {
        initial: Vec::new(),
        inputs,
    };
    let replayed = replay(&netlist, &trace);
    let may_differ = touched.contains(evolved.unstable);
    for (scan, (row, (evolutions, active, values))) in
        replayed.outputs.iter().zip(&seen).enumerate()
    {
        let mut row = row.iter().copied();
        let is_unstable = row.next();
        match evolutions {
            Some(number) if *number < EVOLUTIONS => {
                prop_assert!(may_differ || is_unstable == Some(false), "scan {}", scan)
            }
            _ => return Ok(()),
        }
        for ((name, own), expected) in evolved.active.iter().zip(active) {
            let is_active = row.next();
            let is_judged = !touched.contains(*own);
            prop_assert!(
                !is_judged || is_active == Some(*expected),
                "{} in scan {}",
                name,
                scan
            );
        }
        for ((name, cases), expected) in shown.iter().zip(values) {
            let on: Vec<[u64; 2]> = cases
                .iter()
                .filter(|_| row.next() == Some(true))
                .map(|(value, _)| value.key())
                .collect();
            prop_assert_eq!(on, vec![expected.key()], "{} in scan {}", name, scan);
        }
    }
    Ok(())
}

/// Gives the machine its inputs, and the translation the same.
fn latch(evolved: &Evolved, machine: &mut Machine, bits: u64, elapsed: u64) -> Vec<bool> {
    let mut row = Vec::new();
    let resting = &evolved.inputs.resting;
    for (name, value) in resting {
        machine.set_input(name, *value);
    }
    let mut chosen = std::collections::BTreeSet::new();
    for (at, source) in evolved.inputs.sources.iter().enumerate() {
        let on = bits >> (at % 64) & 1 == 1;
        row.push(match source {
            Source::Bit(name) => {
                machine.set_input(name, on);
                on
            }
            Source::Choice { variable, value } => {
                if on && chosen.insert(variable) {
                    machine.set_input(variable, *value);
                }
                on
            }
            Source::Elapsed { step, time_ms } => {
                machine.is_active(step) && machine.active_ms(step) + elapsed >= *time_ms
            }
            Source::WordBit { .. } | Source::Event(_) | Source::Opaque(_) => on,
        });
    }
    row
}

fn scans() -> impl Strategy<Value = Vec<(u64, u64)>> {
    vec((any::<u64>(), select(vec![0u64, 10, 20])), 1..14)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1_000))]

    #[test]
    fn random_grafcets_do_what_their_translations_do(grafcet in plain::grafcets(), scans in scans()) {
        compare(&grafcet, &scans)?;
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(600))]

    #[test]
    fn grafcets_with_parts_do_what_their_translations_do(spec in crate::specs::specs(), scans in scans()) {
        compare(&spec.grafcet, &scans)?;
    }
}

/// Specs with every kind of hierarchy, where random ones seldom get anywhere.
const HIERARCHIES: [&str; 4] = [
    "Step A, B
     Macro M(Load)
     Transition t1, t2, t3
     Input a, b, c
     Output x, y
     Marking A
     Transitions:
     t1: A*a |- @M
     t2: M*c |- @B
     t3: B*/a |- @A
     Steps:
     M: |- x
     M: |- y after 20ms

     Expansion Load(E, S)
     Step E, S
     Macro N(Inner)
     Transition u, v
     Transitions:
     u: E*b |- @N
     v: N*/b |- @S

     Expansion Inner(I, J)
     Step I, J
     Transition w
     Transitions:
     w: I*c |- @J",
    "Step A
     Enclosing E(G, H)
     Transition t1, t2
     Input a, b, c
     Output x
     Marking A
     Transitions:
     t1: A*a |- @E
     t2: E*/a |- @A

     Partial G
     Step P, Q
     Transition u1, u2
     Activation P
     Transitions:
     u1: P*rise(b) |- @Q
     u2: rise(b) |- @P
     Steps:
     Q: |- set x
     P: |- reset x on deactivation

     Partial H
     Step R
     Enclosing F(K)
     Transition v1, v2
     Activation R
     Transitions:
     v1: R*c |- @F
     v2: F*rise(b) |- @R

     Partial K
     Step S, T
     Transition w1
     Activation S
     Transitions:
     w1: S*b |- @T",
    "Step A, B, C
     Transition t1, t2, t3
     Input stop, a, b
     Output n, m
     Marking A
     Transitions:
     t1: A*stop |- @B
     t2: B*/stop |- @C
     t3: C*b |- @A
     Steps:
     B: |- force G{Q}
     A: b |- force G{INIT}
     B: a |- force G{}
     C: |- force G{*}

     Partial G
     Step P, Q, R
     Transition u1, u2, u3
     Marking P
     Transitions:
     u1: P*a |- @Q
     u2: Q*/a |- @R
     u3: R*rise(a) |- @P
     Steps:
     Q: |- n := 1
     R: |- n := n + 1
     P: |- n := 0
     Q: |- m",
    "Step A, B
     Transition t1, t2
     Input a, b
     Output x
     Marking A
     Transitions:
     t1: A*a*/b |- @B
     t2: B*/a |- @A
     Steps:
     A: b |- force H{V}
     B: |- force H{U}

     Partial H
     Step U, V
     Transition u1, u2
     Marking U
     Transitions:
     u1: U*a |- @V
     u2: V*/a |- @U
     Steps:
     V: |- force K{Y}
     U: |- x

     Partial K
     Step X, Y
     Transition v1, v2
     Marking X
     Transitions:
     v1: X*a |- @Y
     v2: Y*b |- @X",
];

#[test]
fn hierarchies_do_what_their_translations_do() {
    let mut random = crate::random::Random::new(3);
    for text in HIERARCHIES {
        let reading = grafcet::read(text);
        let errors = reading
            .diagnostics
            .iter()
            .filter(|it| it.severity == source::Severity::Error);
        assert_eq!(errors.count(), 0, "{:?}", reading.diagnostics);
        for _ in 0..60 {
            let scans =
                (0..60).map(|_| (random.below(1 << 20) as u64, [0, 10, 20][random.below(3)]));
            let scans: Vec<(u64, u64)> = scans.collect();
            compare(&reading.spec.grafcet, &scans)
                .unwrap_or_else(|wrong| panic!("{wrong}\n{text}"));
        }
    }
}
