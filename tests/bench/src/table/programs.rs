//! Everything from bytes to suggestions, large programs against small ones.

use bench::measure::{in_turn, time};
use bench::plant::plant;
use bench::whole;

use super::Row;

const ROUNDS: usize = 5;

/// The aim: ten times the rungs take at most so many times as long.
const MOST: f64 = 11.0;

/// A row for each larger program.
pub fn rows() -> Vec<Row> {
    let [small, middle, large] = [1_000, 3_000, 10_000].map(plant);
    let times = in_turn(
        ROUNDS,
        &mut [
            &mut || time(|| whole::successions(&small)),
            &mut || time(|| whole::successions(&middle)),
            &mut || time(|| whole::successions(&large)),
        ],
    );
    let against = "itself, 1,000 rungs";
    match times[..] {
        [small, middle, large] => vec![
            Row::times(
                "bytes to suggestions, 3,000 rungs",
                against,
                (middle, small),
                None,
            ),
            Row::times(
                "bytes to suggestions, 10,000 rungs",
                against,
                (large, small),
                Some(MOST),
            ),
        ],
        _ => Vec::new(),
    }
}
