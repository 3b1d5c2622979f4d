//! A plant of many small machines, as a ladder.

use std::fmt::Write;

/// Rungs of one machine.
pub const MACHINE: usize = 10;

/// A program of `rungs` rungs in machines of ten, the same on every run.
///
/// Three kinds of machine take turns, one for each usual way to write a
/// sequence: coils that seal in and hand over by a sensor, coils that release
/// the one before, and latches. Each also has a timer, an interlocked pair and
/// outputs of several states, and one stop button stands in every rung of the
/// plant, as it does in real ones. All that no rung writes is declared.
pub fn plant(rungs: usize) -> String {
    let mut text = String::from("program Plant\n\ninput stop %I0 // Stop button of the plant\n");
    for machine in 0..rungs / MACHINE {
        let own = match machine % 3 {
            0 => ["start", "full", "hot", "low"].as_slice(),
            1 => &["start", "home", "at", "tight", "manual", "jam"],
            _ => &["start", "loaded", "there", "free", "manual"],
        };
        for input in own.iter().chain(&COMMON_INPUTS) {
            let written = writeln!(text, "input m{machine}_{input}");
            debug_assert!(written.is_ok(), "writing to a string cannot fail");
        }
    }
    for machine in 0..rungs / MACHINE {
        let written = match machine % 3 {
            0 => by_sensors(&mut text, machine),
            1 => by_release(&mut text, machine),
            _ => by_latches(&mut text, machine),
        };
        debug_assert!(written.is_ok(), "writing to a string cannot fail");
    }
    text
}

/// Inputs of every machine: those of its doors and its lamp.
const COMMON_INPUTS: [&str; 5] = ["open_button", "opened", "close_button", "closed", "test"];

/// What ends a state is the sensor that starts the next.
fn by_sensors(text: &mut String, m: usize) -> std::fmt::Result {
    write!(
        text,
        "
rung \"Tank {m}: fill\": (m{m}_start*/m{m}_drain + m{m}_fill) * /m{m}_full * /stop -> m{m}_fill
rung \"Heat\": (m{m}_full*/m{m}_hot + m{m}_heat) * /m{m}_hot * m{m}_low * /stop -> m{m}_heat
rung \"Hold\": (m{m}_hot*m{m}_low + m{m}_hold) * /m{m}_t.Q * /stop -> m{m}_hold
rung \"Time to hold\": m{m}_hold * /stop -> TON(m{m}_t, 5s)
rung \"Drain\": (m{m}_t.Q + m{m}_drain) * m{m}_low * /stop -> m{m}_drain
rung \"Mix\": (m{m}_heat + m{m}_hold) * /stop -> m{m}_mixer
"
    )?;
    doors(text, m)?;
    writeln!(
        text,
        "rung \"Ready\": /m{m}_fill * /m{m}_drain * /m{m}_low * /stop -> m{m}_ready"
    )?;
    lamp(text, m)
}

/// The next state releases the one before.
fn by_release(text: &mut String, m: usize) -> std::fmt::Result {
    write!(
        text,
        "
rung \"Press {m}: advance\": (m{m}_start*m{m}_home + m{m}_advance) * /m{m}_clamp * /stop -> m{m}_advance
rung \"Clamp\": (m{m}_advance*m{m}_at + m{m}_clamp) * /m{m}_press * /stop -> m{m}_clamp
rung \"Press\": (m{m}_clamp*(m{m}_tight + m{m}_manual) + m{m}_press) * /m{m}_return * /stop -> m{m}_press
rung \"Time to press\": m{m}_press * /stop -> TON(m{m}_t, 2s)
rung \"Return\": (m{m}_press*m{m}_t.Q + m{m}_return) * /m{m}_home * /stop -> m{m}_return
rung \"Oil\": (m{m}_advance + m{m}_press + m{m}_return) * /stop -> m{m}_pump
"
    )?;
    doors(text, m)?;
    writeln!(
        text,
        "rung \"Fault\": (m{m}_advance*m{m}_return + m{m}_jam) * /stop -> m{m}_fault"
    )?;
    lamp(text, m)
}

/// Each transition latches a state and unlatches the one before.
fn by_latches(text: &mut String, m: usize) -> std::fmt::Result {
    write!(
        text,
        "
rung \"Feeder {m}: load\": m{m}_start * /m{m}_load * /m{m}_move * /m{m}_drop * /stop -> set m{m}_load
rung \"Loaded\": m{m}_load * m{m}_loaded * /stop -> reset m{m}_load, set m{m}_move
rung \"There\": m{m}_move * m{m}_there * (m{m}_free + m{m}_manual) * /stop -> reset m{m}_move, set m{m}_drop
rung \"Dropped\": m{m}_drop * m{m}_t.Q * /stop -> reset m{m}_drop
rung \"Time to drop\": m{m}_drop * /stop -> TON(m{m}_t, 1s)
rung \"Motor\": (m{m}_load + m{m}_move*/m{m}_there) * /stop -> m{m}_motor
"
    )?;
    doors(text, m)?;
    writeln!(
        text,
        "rung \"Busy\": (m{m}_load + m{m}_move + m{m}_drop) * /stop -> m{m}_busy"
    )?;
    lamp(text, m)
}

/// Two coils of which only one may be on.
fn doors(text: &mut String, m: usize) -> std::fmt::Result {
    write!(
        text,
        "rung \"Open\": (m{m}_open_button + m{m}_opening) * /m{m}_closing * /m{m}_opened * /stop -> m{m}_opening
rung \"Close\": (m{m}_close_button + m{m}_closing) * /m{m}_opening * /m{m}_closed * /stop -> m{m}_closing
"
    )
}

fn lamp(text: &mut String, m: usize) -> std::fmt::Result {
    writeln!(
        text,
        "rung \"Lamp\": (m{m}_opening + m{m}_closing + m{m}_test) * /stop -> m{m}_lamp"
    )
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use ladder::ElementKind;

    use super::*;

    #[test]
    fn a_plant_has_the_rungs_asked_for_and_no_findings() {
        let reading = ladder::read(plant(300).as_bytes());
        assert_eq!(reading.diagnostics, []);
        assert_eq!(reading.program.rungs().count(), 300);
    }

    #[test]
    fn whatever_is_read_is_written_or_declared() {
        let program = ladder::read(plant(300).as_bytes()).program;
        let elements = || {
            let rungs = program.rungs();
            rungs.flat_map(|(_, rung)| rung.network.elements().map(|(_, it)| &it.kind))
        };
        let mut known: HashSet<&str> = HashSet::new();
        known.extend(program.declarations.iter().map(|it| &*it.name));
        for kind in elements() {
            known.extend(kind.writes().iter().map(|it| &*it.name));
            if let ElementKind::Timer(timer) = kind {
                known.insert(&*timer.output);
            }
        }
        let read = elements().flat_map(ElementKind::reads);
        let unknown: Vec<_> = read.filter(|it| !known.contains(&*it.name)).collect();
        assert!(unknown.is_empty(), "{unknown:?}");
    }

    #[test]
    fn every_machine_holds_a_sequence() {
        let reading = ladder::read(plant(30).as_bytes());
        let analysis = recovery::analyse(&reading.program, &logic::Budget::default());
        for (from, to) in [
            ("m0_fill", "m0_heat"),
            ("m1_advance", "m1_clamp"),
            ("m2_load", "m2_move"),
        ] {
            let found = analysis.successions().iter().any(|succession| {
                &*succession.from == from
                    && &*succession.to == to
                    && succession.evidence == recovery::successions::Evidence::Handover
            });
            assert!(found, "{from} hands over to {to}");
        }
    }
}
