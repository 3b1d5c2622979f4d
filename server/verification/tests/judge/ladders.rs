//! Random ladders with everything that rungs can hold.

use crate::beside::{Compared, compare_text};
use crate::program::Program;
use crate::random::Random;
use crate::text;

const PROGRAMS: u64 = 600;
const SCANS: usize = 40;

#[test]
fn random_ladders_do_what_their_translations_do() {
    let mut random = Random::new(11);
    let mut all = Compared::default();
    for _ in 0..PROGRAMS {
        let text = text::text(&Program::random(&mut random));
        all += compare_text(&text, SCANS, &mut random);
    }
    println!("{all:?}");
    assert!(4 * all.changing > all.variables, "{all:?}");
    assert!(all.variables > all.left_out, "{all:?}");
}
