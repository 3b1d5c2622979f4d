//! Everything from bytes to suggestions, large programs against small ones.

use bench::measure::{in_turn, time};
use bench::plant::plant;
use logic::Budget;

use super::Row;

const ROUNDS: usize = 5;

/// The aim: ten times the rungs take at most so many times as long.
const MOST: f64 = 11.0;

/// A row for each larger program.
pub fn rows() -> Vec<Row> {
    let texts = [1_000, 3_000, 10_000].map(|rungs| (rungs, plant(rungs)));
    let budget = Budget::default();
    let whole = |text: &str| {
        let reading = ladder::read(text.as_bytes());
        recovery::analyse(&reading.program, &budget)
            .successions
            .len()
    };
    let [(_, small), (_, middle), (_, large)] = &texts;
    let times = in_turn(
        ROUNDS,
        &mut [
            &mut || time(|| whole(small)),
            &mut || time(|| whole(middle)),
            &mut || time(|| whole(large)),
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
