//! Random ladders about words, and grafcets beside them: bits that are written one
//! by one, and words that are compared and copied whole.

use std::collections::BTreeSet;

use grafcet::evolution;
use ladder::scan::{Machine, bit_of_word};
use proof::{Trace, replay};
use verification::chart;
use verification::program::{Bounds, Followed, follow};

use crate::beside::{Compared, Shown, compare_text, program};
use crate::random::Random;

const PROGRAMS: u64 = 400;
const SCANS: usize = 40;

const INPUTS: [&str; 4] = ["i0", "i1", "i2", "i3"];
const BITS: [&str; 3] = ["q0", "q1", "q2"];

/// Words that the program writes, with their types; the last have none, as
/// members of structures.
const WORDS: [(&str, &str); 8] = [
    ("narrow", "SINT"),
    ("short", "INT"),
    ("wide", "DINT"),
    ("bits", "WORD"),
    ("many", "DWORD"),
    ("Unit.Flags", ""),
    ("Unit.Rows[1]", ""),
    ("Unit.Rows[n]", ""),
];

/// Words that come from the plant.
const GIVEN: [(&str, &str); 3] = [("state", "SINT"), ("mask", "BYTE"), ("Plant.State", "")];

const NUMBERS: [&str; 9] = [
    "0",
    "1",
    "-1",
    "8",
    "127",
    "-128",
    "65535",
    "16#80000000",
    "2.5",
];
const PLACES: [u32; 8] = [0, 1, 3, 7, 15, 16, 31, 63];
const RELATIONS: [&str; 6] = ["=", "<>", "<", "<=", ">", ">="];

/// A random ladder. `words` of the words take part in it.
struct Maker<'r> {
    random: &'r mut Random,
    words: usize,
    places: usize,
}

impl Maker<'_> {
    fn text(&mut self) -> String {
        let mut out = String::from("program Words\n\n");
        for input in INPUTS {
            out += &format!("input {input}\n");
        }
        for (name, kind) in GIVEN.iter().filter(|(_, kind)| !kind.is_empty()) {
            out += &format!("input {name} : {kind}\n");
        }
        for (name, kind) in WORDS.iter().filter(|(_, kind)| !kind.is_empty()) {
            out += &format!("internal {name} : {kind}\n");
        }
        out += "internal n : DINT\n";
        // What has no type is known to be a word by its bits.
        out += "\nrung: Plant.State.2 -> q2\nrung: i0 -> n := 1\n";
        for _ in 0..4 + self.random.below(6) {
            let condition = self.condition(2);
            out += &format!("rung: {condition} -> {}\n", self.output());
        }
        out
    }

    /// A grafcet of two steps that reads the words.
    fn chart(&mut self) -> String {
        let mut steps = String::new();
        let conditions: Vec<String> = (0..4).map(|_| self.condition(1)).collect();
        for (step, output) in [("A", "x"), ("B", "x"), ("B", "y")] {
            steps += &format!("{step}: {} |- {output}\n", self.condition(1));
        }
        for (step, output) in [("A", "Out"), ("B", "Out"), ("B", "Copy")] {
            steps += &format!("{step}: |- {output} := {}\n", self.operand());
        }
        let words = GIVEN.iter().chain(&WORDS[..self.words]);
        let words = words.map(|(name, _)| *name);
        let bits = words.clone().flat_map(|name| {
            let bits = PLACES.iter().map(move |place| format!("{name}.{place}"));
            std::iter::once(name.to_owned()).chain(bits)
        });
        let names: Vec<String> = bits.map(|name| spelled(&name)).collect();
        format!(
            "Step A, B\nTransition t, u\nInput {}, {}\nOutput x, y, Out, Copy\nMarking A\nTransitions:\n\
             t: A*({})*({}) |- @B\nu: B*({})*({}) |- @A\nSteps:\n{steps}",
            INPUTS.join(", "),
            names.join(", "),
            conditions[0],
            conditions[1],
            conditions[2],
            conditions[3],
        )
    }

    fn word(&mut self) -> &'static str {
        WORDS[self.random.below(self.words)].0
    }

    fn any_word(&mut self) -> &'static str {
        match self.random.below(4) {
            0 => self.random.one_of(&GIVEN).0,
            _ => self.word(),
        }
    }

    fn bit_of(&mut self, word: &str) -> String {
        let place = PLACES[self.random.below(self.places)];
        spelled(&format!("{word}.{place}"))
    }

    fn operand(&mut self) -> String {
        match self.random.below(3) {
            0 => self.random.one_of(&NUMBERS).to_owned(),
            _ => spelled(self.any_word()),
        }
    }

    fn output(&mut self) -> String {
        match self.random.below(10) {
            9 => format!("n := {}", self.random.one_of(&["-1", "0", "1", "2"])),
            0..=4 => {
                let word = self.word();
                let bit = self.bit_of(word);
                let kind = self.random.one_of(&["", "", "/", "set ", "reset "]);
                format!("{kind}{bit}")
            }
            5 => format!("{} := {}", spelled(self.word()), self.operand()),
            6 => format!("{} := {}", spelled(self.word()), spelled(self.any_word())),
            7 => {
                let word = self.any_word();
                let bit = self.bit_of(word);
                format!("{} := {bit}", spelled(self.word()))
            }
            _ => self.random.one_of(&BITS).to_owned(),
        }
    }

    fn condition(&mut self, depth: usize) -> String {
        match self.random.below(if depth == 0 { 8 } else { 12 }) {
            0 | 1 => {
                let word = self.any_word();
                self.bit_of(word)
            }
            2 => {
                let word = self.any_word();
                format!("/{}", self.bit_of(word))
            }
            3 | 4 => {
                // Compilers refuse to compare constants.
                let (word, relation) = (spelled(self.any_word()), self.random.one_of(&RELATIONS));
                format!("({word} {relation} {})", self.operand())
            }
            5 => spelled(self.any_word()),
            6 => format!("rise({})", self.random.one_of(&INPUTS)),
            7 => self.random.one_of(&INPUTS).to_owned(),
            8..=9 => format!(
                "{} * {}",
                self.condition(depth - 1),
                self.condition(depth - 1)
            ),
            _ => format!(
                "({} + {})",
                self.condition(depth - 1),
                self.condition(depth - 1)
            ),
        }
    }
}

/// A name as the notation has it.
fn spelled(name: &str) -> String {
    match name.contains('[') {
        true => format!("\"{name}\""),
        false => name.to_owned(),
    }
}

/// Some ladders, each with a grafcet that reads its words.
fn each(mut judge: impl FnMut(&str, &str, &mut Random)) {
    let mut random = Random::new(23);
    for _ in 0..PROGRAMS {
        let (words, places) = (
            1 + random.below(WORDS.len()),
            1 + random.below(PLACES.len()),
        );
        let mut maker = Maker {
            random: &mut random,
            words,
            places,
        };
        let ladder = maker.text();
        // Which element an index leads to only the ladder knows.
        maker.words = words.min(WORDS.len() - 1);
        let chart = maker.chart();
        judge(&ladder, &chart, &mut random);
    }
}

#[test]
fn words_do_what_their_translations_do() {
    let mut all = Compared::default();
    each(|text, _, random| all += compare_text(text, SCANS, random));
    println!("{all:?}");
    assert!(4 * all.changing > all.variables, "{all:?}");
    assert!(all.variables > 8 * all.left_out, "{all:?}");
}

/// A grafcet beside a ladder is followed through so many evolutions.
const EVOLUTIONS: usize = 4;

#[test]
fn grafcets_that_read_words_do_what_their_translations_do() {
    let (mut compared, mut on) = (0, 0);
    each(|ladder, chart, random| {
        let program = program(ladder);
        let reading = grafcet::read(chart);
        let mut found = reading.diagnostics.iter();
        let error = found.find(|it| it.severity == source::Severity::Error);
        assert!(error.is_none(), "{error:?}\n{chart}");
        let followed = follow(&program, Some(&reading.spec), &Bounds::default())
            .unwrap_or_else(|refusal| panic!("{refusal}\n{ladder}"));
        let (all, differing) = beside(&program, &followed, &reading.spec, random)
            .unwrap_or_else(|wrong| panic!("{wrong}\n{ladder}\n{chart}"));
        compared += all;
        on += differing;
    });
    println!("{compared} values, {on} of them not 0");
    assert!(compared > 10_000 && 4 * on > compared, "{compared} {on}");
}

/// Runs a ladder and a grafcet that reads its variables, and compares what the
/// grafcet publishes with its translation. How many values were compared, and how
/// many of them were not 0.
fn beside(
    program: &ladder::Program,
    followed: &Followed,
    spec: &grafcet::Spec,
    random: &mut Random,
) -> Result<(usize, usize), String> {
    let evolved = chart::follow(spec, Some(followed), EVOLUTIONS, &Bounds::default())
        .map_err(|refusal| refusal.to_string())?;
    let sources = &evolved.inputs.sources;
    let free = (0..sources.len()).filter(|at| !sources[*at].is_given());
    let touched = evolved.netlist.touched_by(&free.collect::<Vec<_>>());
    let mut netlist = evolved.netlist.clone();
    let names = evolved.outputs().iter();
    let shown = names.filter_map(|name| {
        let held = (evolved.cases(name), evolved.bits(name));
        let own = Shown::of(name, held, &touched, &mut netlist)?;
        Some((name, own))
    });
    let shown: Vec<_> = shown.collect();
    let known: BTreeSet<&str> = followed.variables().map(|it| &**it).collect();
    let is_known = |name: &str| {
        let word = bit_of_word(name).map(|(word, _)| word);
        known.contains(name) || word.is_some_and(|it| known.contains(it))
    };
    let mut machine = Machine::new(program);
    let mut grafcet = evolution::Machine::new(&spec.grafcet);
    let (mut inputs, mut seen) = (Vec::new(), Vec::new());
    for _ in 0..SCANS {
        let row: Vec<bool> = sources.iter().map(|_| random.below(3) == 0).collect();
        for (name, value) in evolved.inputs.values(&row) {
            machine.set_input(&name, value);
            grafcet.set_input(&name, value);
        }
        machine.scan(10);
        let read: Vec<_> = grafcet.free().cloned().collect();
        for name in read.iter().filter(|it| is_known(it)) {
            grafcet.set_input(name, machine.value(name));
        }
        if grafcet.scan(10).is_err() || grafcet.evolutions().count() >= EVOLUTIONS {
            break;
        }
        inputs.push(row);
        seen.push(
            shown
                .iter()
                .map(|(name, _)| grafcet.value(name))
                .collect::<Vec<_>>(),
        );
    }
    let trace = Trace {
        initial: Vec::new(),
        inputs,
    };
    let replayed = replay(&netlist, &trace);
    let (mut compared, mut on) = (0, 0);
    for (scan, (row, seen)) in replayed.outputs.iter().zip(&seen).enumerate() {
        let mut row = row.iter().copied();
        for ((name, own), expected) in shown.iter().zip(seen) {
            let signals: Vec<bool> = row.by_ref().take(own.outputs()).collect();
            if !own.held(&signals, *expected) {
                return Err(format!(
                    "{name} in scan {scan}: {own:?} {signals:?}, but {expected:?}"
                ));
            }
            compared += 1;
            on += usize::from(expected.is_on());
        }
    }
    Ok((compared, on))
}
