//! Random ladders whose rungs look at coils above and below them, and write
//! coils that others write too.

use crate::random::Random;

const INPUTS: [&str; 3] = ["a", "b", "c"];
const COILS: [&str; 4] = ["p", "q", "r", "s"];

/// Whether contacts see edges.
#[derive(Clone, Copy, PartialEq)]
pub enum Contacts {
    Values,
    Edges,
}

/// A ladder of a few rungs.
pub fn ladder(random: &mut Random, contacts: Contacts) -> String {
    let mut text = "program Random\n".to_owned();
    for name in INPUTS {
        text += &format!("input {name}\n");
    }
    for name in COILS {
        let initial = random.one_of(&["", "", "", " = 1"]);
        text += &format!("output {name} : BOOL{initial}\n");
    }
    for _ in 0..2 + random.below(5) {
        let coil = random.one_of(&COILS);
        let kind = random.one_of(&["", "", "", "/", "set ", "reset "]);
        let on = condition(random, 2, contacts);
        text += &match random.below(5) {
            0 => {
                let held = condition(random, 0, contacts);
                format!("rung: {on} + {coil}*{held} -> {coil}\n")
            }
            1 => {
                let leg = condition(random, 1, contacts);
                let other = random.one_of(&COILS);
                format!("rung: {on} -> {kind}{coil}, ({leg} -> {other})\n")
            }
            _ => format!("rung: {on} -> {kind}{coil}\n"),
        };
    }
    text
}

fn condition(random: &mut Random, depth: usize, contacts: Contacts) -> String {
    let names = [&INPUTS[..], &COILS[..]].concat();
    let name = random.one_of(&names);
    match random.below(if depth == 0 { 6 } else { 10 }) {
        0 if contacts == Contacts::Edges => format!("rise({name})"),
        1 if contacts == Contacts::Edges => format!("fall({name})"),
        0..=3 => name.to_owned(),
        4..=5 => format!("/{name}"),
        kind => {
            let mut part = || condition(random, depth - 1, contacts);
            let (one, other) = (part(), part());
            match kind {
                6..=7 => format!("({one} + {other})"),
                _ => format!("{one}*{other}"),
            }
        }
    }
}
