//! Random ladders of Rockwell instructions that join, move and compare words.

use crate::beside::{Compared, compare_text};
use crate::random::Random;

const PROGRAMS: u64 = 200;
const SCANS: usize = 40;

const WORDS: [&str; 4] = ["Mill.Bits[0]", "Mill.Bits[1]", "Alarms", "Copy"];
const GIVEN: [&str; 2] = ["Status", "Mask"];
const NUMBERS: [&str; 5] = ["0", "-1", "16#F0", "255", "8"];
const PLACES: [u32; 6] = [0, 3, 4, 7, 15, 31];

struct Maker<'r>(&'r mut Random);

impl Maker<'_> {
    fn text(&mut self) -> String {
        let rungs = (0..5 + self.0.below(6)).map(|_| {
            let conditions = self.condition() + &self.condition();
            format!("\tN: {conditions}{};\n", self.output())
        });
        let rungs: String = rungs.collect();
        // What has no type is known to be a word by its bits.
        format!(
            "CONTROLLER C ()\nPROGRAM P (MAIN := \"R\")\nTAG\n\tAlarms : DINT := 0;\n\tCopy : INT := 0;\n\
             \tStatus : DINT := 0;\n\tMask : SINT := 0;\nEND_TAG\nROUTINE R\n\
             \tN: XIC(Mill.Bits[0].0)XIC(Mill.Bits[1].0)OTE(q);\n{rungs}END_ROUTINE\nEND_PROGRAM\nEND_CONTROLLER\n"
        )
    }

    fn word(&mut self) -> &'static str {
        self.0.one_of(&WORDS)
    }

    fn operand(&mut self) -> &'static str {
        match self.0.below(6) {
            0 => self.0.one_of(&NUMBERS),
            1 => self.0.one_of(&GIVEN),
            _ => self.word(),
        }
    }

    /// A word that has a type: the complement of what has none and was never
    /// written is not followed.
    fn typed(&mut self) -> &'static str {
        self.0.one_of(&["Alarms", "Copy", "Status", "Mask"])
    }

    fn bit(&mut self) -> String {
        let word = match self.0.below(3) {
            0 => self.0.one_of(&GIVEN),
            _ => self.word(),
        };
        format!("{word}.{}", self.0.one_of(&PLACES))
    }

    fn condition(&mut self) -> String {
        match self.0.below(7) {
            0..=1 => format!("XIC({})", self.bit()),
            2 => format!("XIO({})", self.bit()),
            3 => format!("XIC(i{})", self.0.below(3)),
            4 => format!("XIO(i{})", self.0.below(3)),
            _ => {
                let relation = self.0.one_of(&["EQU", "NEQ", "LES", "LEQ", "GRT", "GEQ"]);
                format!("{relation}({},{})", self.word(), self.operand())
            }
        }
    }

    fn output(&mut self) -> String {
        match self.0.below(9) {
            0..=3 => {
                let kind = self.0.one_of(&["OTE", "OTE", "OTL", "OTU"]);
                format!("{kind}({}.{})", self.word(), self.0.one_of(&PLACES))
            }
            4 => format!("MOV({},{})", self.operand(), self.word()),
            5 => format!("CLR({})", self.word()),
            6 => format!("NOT({},{})", self.typed(), self.word()),
            7 => {
                let (one, other, third) = (self.typed(), self.operand(), self.typed());
                let term = match self.0.below(2) {
                    0 => format!("({one} XOR 16#F0F0) AND NOT {third}"),
                    _ => format!("({one} OR {other}) AND {third}"),
                };
                format!("CPT({},{term})", self.word())
            }
            _ => {
                let kind = self.0.one_of(&["AND", "OR", "XOR"]);
                format!(
                    "{kind}({},{},{})",
                    self.operand(),
                    self.operand(),
                    self.word()
                )
            }
        }
    }
}

#[test]
fn boxes_that_join_words_do_what_their_translations_do() {
    let mut random = Random::new(31);
    let mut all = Compared::default();
    for _ in 0..PROGRAMS {
        let text = Maker(&mut random).text();
        all += compare_text(&text, SCANS, &mut random);
    }
    println!("{all:?}");
    assert!(2 * all.changing > all.variables, "{all:?}");
    assert!(all.variables > 8 * all.left_out, "{all:?}");
}
