//! Random ladders with everything that rungs can hold.

use verification::program::{Bounds, follow};

use crate::beside::{Compared, compare};
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
        let program = ladder::read(text.as_bytes()).program;
        let followed = follow(&program, None, &Bounds::default())
            .unwrap_or_else(|refusal| panic!("{refusal}\n{text}"));
        let one = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| {
            compare(&program, &followed, SCANS, &mut random)
        }));
        let one = one.unwrap_or_else(|_| panic!("{text}"));
        all.values += one.values;
        all.variables += one.variables;
        all.changing += one.changing;
        all.left_out += one.left_out;
    }
    println!("{all:?}");
    assert!(4 * all.changing > all.variables, "{all:?}");
    assert!(all.variables > all.left_out, "{all:?}");
}
