//! The order-free rule against the paper's own, on pairs of rungs.

use bench::measure::{in_turn, ratio, time};
use bench::pair::pair;
use logic::Budget;
use recovery::conditions::conditions;
use recovery::successions::{cubes, possible};

use super::{Aim, Row, shown};

/// The aim: at sixteen shared variables the rule is so many times faster.
const LEAST: (usize, f64) = (16, 100.0);

/// The aim: it may take so many times longer for twenty variables than for
/// eight. Were it exponential, it would take 2^12 times as long.
const GROWTH: f64 = 20.0;

/// A row for each number of variables, and one for the growth of the rule.
pub fn rows() -> Vec<Row> {
    let budget = Budget::default();
    let mut rows = Vec::new();
    let mut ours_by_size = Vec::new();
    for (variables, rounds) in [(8, 9), (12, 9), (16, 5), (20, 3)] {
        let reading = ladder::read(pair(variables).as_bytes());
        let conditions = conditions(&reading.program, &budget);
        let mut ours = || time(|| possible(&conditions, &budget));
        let mut peer = || time(|| cubes(&conditions, &budget));
        let [ours, peer] = in_turn(rounds, &mut [&mut ours, &mut peer])[..] else {
            continue;
        };
        let is = ratio(peer, ours);
        rows.push(Row {
            what: format!("`possible`, {variables} shared variables"),
            against: "`cubes`, the paper's rule".into(),
            ours: shown(ours),
            peer: shown(peer),
            ratio: format!("{is:.0} times faster"),
            aim: match LEAST {
                (at, limit) if at == variables => Aim::Least { limit, is },
                _ => Aim::None,
            },
        });
        ours_by_size.push(ours);
    }
    if let [eight, .., twenty] = ours_by_size[..] {
        let times = (twenty, eight);
        let against = "itself, 8 variables";
        rows.push(Row::times(
            "`possible`, 20 variables",
            against,
            times,
            Some(GROWTH),
        ));
    }
    rows
}
