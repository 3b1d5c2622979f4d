//! The questions that proof engines are compared on.

use std::sync::Arc;

use grafcet::Spec;
use ladder::Program;
use proof::{Netlist, compare};
use verification::program::{Bounds, follow};
use verification::{Timing, verify};

use crate::sequencer::{Coupling, Encoding, Fault, Rows, STEPS};

/// Two systems that are equal, and two that are not.
pub struct Question {
    /// The latches of one side.
    pub latches: usize,
    /// What it is about.
    pub name: &'static str,
    /// The question whether the two differ, which they never do.
    pub equal: Netlist,
    /// The same where one thing is wrong.
    pub different: Netlist,
    /// Two netlists that are equal exactly if the two systems are.
    pub sides: [Netlist; 2],
}

/// Rows that keep a latch for each step, so many on each side, beside rows in
/// another encoding; in the row in the middle one transition is wrong.
pub fn rows(latches: usize, encoding: Encoding, coupling: Coupling) -> Question {
    let count = latches / STEPS;
    let rows = |encoding, fault| {
        let rows = Rows {
            count,
            encoding,
            coupling,
            fault,
        };
        rows.netlist()
    };
    let fault = Fault {
        row: count / 2,
        step: STEPS - 2,
    };
    let [left, right] = [Encoding::OneHot, encoding].map(|encoding| rows(encoding, None));
    Question {
        latches,
        name: match encoding {
            Encoding::OneHot => "itself",
            Encoding::Cleared => "steps that are cleared",
            Encoding::Register => "a register",
        },
        equal: compare(&left, &right).netlist,
        different: compare(&left, &rows(encoding, Some(fault))).netlist,
        sides: [left, right],
    }
}

/// The ladder of the case study's tank, its sequence, and the sequence without the
/// last but one of its rules about the plant.
pub fn tank_files() -> (Arc<Program>, [Spec; 2]) {
    let text = |name: &str| {
        let path = end_to_end::path(&format!("fixtures/neutralization/{name}"));
        std::fs::read_to_string(path).expect("a fixture")
    };
    let program = ladder::read(text("neutralization.ladder").as_bytes()).program;
    let spec = grafcet::read(&text("sequence.grafcet")).spec;
    let mut without = spec.clone();
    without.environment.retain(|rule| &*rule.name != "e6");
    (program, [spec, without])
}

/// The tank of the case study and its sequence, equal under seven rules about
/// the plant; and without one of them. What is compared for others is whether
/// the question's properties, 0 where a rule is broken, differ from 0.
pub fn tank() -> Question {
    let (program, [spec, without]) = tank_files();
    let asked = |spec| {
        let found = verify(&program, spec, Timing::Scan, &proof::Limits::default());
        found.expect("a translation").question
    };
    let equal = asked(&spec);
    let mut never = Netlist::default();
    for input in equal.inputs() {
        never.input(input.name.clone());
    }
    // ABC takes only what has a latch for a sequential network: one that never
    // becomes 1.
    let off = never.latch("off", false);
    for property in equal.properties() {
        never.output(property.name.clone(), off);
    }
    let ladder = follow(&program, Some(&spec), &Bounds::default()).expect("a translation");
    Question {
        latches: ladder.netlist.latches().len(),
        name: "the tank's sequence",
        different: asked(&without),
        sides: [equal.clone(), never],
        equal,
    }
}
