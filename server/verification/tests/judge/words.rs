//! Random ladders about words: bits that are written one by one, and words that
//! are compared and copied whole.

use verification::program::{Bounds, follow};

use crate::beside::{Compared, compare};
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

#[test]
fn words_do_what_their_translations_do() {
    let mut random = Random::new(23);
    let mut all = Compared::default();
    for _ in 0..PROGRAMS {
        let (words, places) = (
            1 + random.below(WORDS.len()),
            1 + random.below(PLACES.len()),
        );
        let text = Maker {
            random: &mut random,
            words,
            places,
        }
        .text();
        let reading = ladder::read(text.as_bytes());
        assert!(
            reading.diagnostics.is_empty(),
            "{:?}\n{text}",
            reading.diagnostics
        );
        let followed = follow(&reading.program, None, &Bounds::default())
            .unwrap_or_else(|refusal| panic!("{refusal}\n{text}"));
        let one = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| {
            compare(&reading.program, &followed, SCANS, &mut random)
        }));
        let one = one.unwrap_or_else(|_| panic!("{text}"));
        all.values += one.values;
        all.variables += one.variables;
        all.changing += one.changing;
        all.left_out += one.left_out;
    }
    println!("{all:?}");
    assert!(4 * all.changing > all.variables, "{all:?}");
    assert!(all.variables > 8 * all.left_out, "{all:?}");
}
