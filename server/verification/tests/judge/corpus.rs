//! Real programs, read in place.

use std::path::PathBuf;

use verification::program::{Bounds, follow};

use crate::beside::{Compared, compare};
use crate::random::Random;

const SCANS: usize = 25;

fn files(folder: PathBuf) -> Vec<PathBuf> {
    let mut open = vec![folder];
    let mut files = Vec::new();
    while let Some(folder) = open.pop() {
        for entry in std::fs::read_dir(folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            match path.is_dir() {
                true => open.push(path),
                false => files.push(path),
            }
        }
    }
    files.sort();
    files
}

/// Every real ladder is either translated, and does what the machine does, or
/// refused with a reason.
#[test]
fn real_ladders_do_what_their_translations_do() {
    let Some(folder) = end_to_end::corpus() else {
        return;
    };
    let mut random = Random::new(5);
    let mut all = Compared::default();
    let (mut taken, mut refused) = (0, 0);
    for path in files(folder) {
        let bytes = std::fs::read(&path).expect("a file");
        let program = ladder::read(&bytes).program;
        if program.rungs().next().is_none() {
            continue;
        }
        let name = path
            .file_name()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned();
        let followed = match follow(&program, None, &Bounds::default()) {
            Ok(followed) => followed,
            Err(refusal) => {
                println!("{name}: {refusal}");
                refused += 1;
                continue;
            }
        };
        taken += 1;
        let run = || compare(&program, &followed, SCANS, &mut random);
        let one = std::panic::catch_unwind(std::panic::AssertUnwindSafe(run));
        let Ok(one) = one else {
            panic!("{}", path.display())
        };
        all += one;
    }
    println!("{taken} taken, {refused} refused, {all:?}");
    assert!(
        taken > 20 * refused,
        "{refused} of {} are refused",
        taken + refused
    );
    assert!(2 * all.changing > all.variables, "{all:?}");
}
