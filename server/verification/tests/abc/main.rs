//! Generated ladders with their specs, judged by ABC: equal ones, and ones with a
//! fault in the ladder.
//!
//! A chart is sketched, and written twice: as a spec, and as a ladder that codes
//! it. Every receptivity has an edge, so that a scan clears each chain once. The
//! question is exported as it was asked, and ABC says after how many scans there is a
//! difference, or that there never is; and each side is exported by itself, for
//! ABC to compare.

mod fixtures;
mod sketch;
#[path = "../../../proof/tests/judge/tool.rs"]
mod tool;

#[path = "../../../ladder/tests/against_c/random.rs"]
#[allow(dead_code)]
mod random;

use std::fs;
use std::path::Path;

use grafcet::Spec;
use ladder::Program;
use proof::{Limits, Netlist};
use verification::{Timing, Verdict, alone, verify};

use random::Random;
use sketch::Sketch;

const PAIRS: usize = 220;

/// Each side as a netlist by itself.
fn sides(ladder: &Program, spec: &Spec) -> [Netlist; 2] {
    let limits = Limits::default();
    let ladder = alone::of_ladder(ladder, &limits).expect("a ladder");
    let mut sides = [ladder, alone::of_spec(spec, &limits).expect("a chart")];
    // What one side does not look at is an input of the pair all the same.
    for side in &mut sides {
        for input in sketch::INPUTS {
            side.input(input);
        }
    }
    sides
}

#[test]
fn abc_agrees_about_generated_ladders_and_their_specs() {
    let Some(abc) = tool::abc() else { return };
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("abc-ladders");
    fs::create_dir_all(&folder).expect("a folder");
    let mut random = Random::new(23);
    let (mut equal, mut deep) = (0, 0);
    for pair in 0..PAIRS {
        let sketch = Sketch::random(&mut random);
        let coded = match pair % 2 {
            0 => sketch.clone(),
            _ => sketch.with_fault(&mut random),
        };
        let (ladder_text, spec_text) = (coded.ladder(&mut random), sketch.spec());
        let texts = format!("pair {pair}:\n{ladder_text}\n{spec_text}");
        let ladder = ladder::read(ladder_text.as_bytes());
        let spec = grafcet::read(&spec_text);
        assert!(
            ladder.diagnostics.is_empty(),
            "{:?}\n{texts}",
            ladder.diagnostics
        );
        assert!(
            spec.diagnostics.is_empty(),
            "{:?}\n{texts}",
            spec.diagnostics
        );
        let found = verify(
            &ladder.program,
            &spec.spec,
            Timing::Scan,
            &Limits::default(),
        )
        .expect("a translation");
        let said = match &found.verdict {
            Verdict::Equivalent => None,
            Verdict::Different(it) => {
                assert!(it.is_shortest, "{texts}");
                Some(it.trace.steps.len())
            }
            Verdict::Unknown { why, .. } => panic!("{why:?}\n{texts}"),
        };
        assert!(pair % 2 == 1 || said.is_none(), "{said:?}\n{texts}");
        let says = tool::model_checked(&abc, &folder, &found.question, said);
        assert_eq!(said, says, "{texts}");
        let [left, right] = sides(&ladder.program, &spec.spec);
        assert_eq!(
            tool::dsec(&abc, &folder, [&left, &right]),
            said.is_none(),
            "{texts}"
        );
        equal += usize::from(said.is_none());
        deep += usize::from(said.is_some_and(|scans| scans > 1));
    }
    println!("{PAIRS} pairs judged: {equal} equal, {deep} differ after the first scan");
    assert!(equal >= 100 && deep >= 40, "the pairs are lopsided");
}
