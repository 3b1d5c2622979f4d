//! Times that can be compared: taken in turn, several times, the median of
//! each.

use std::time::{Duration, Instant};

/// A round lasts at least this long for each contender, so that the clock's
/// own grain does not show.
const LEAST: Duration = Duration::from_millis(4);

/// The median time of one call of each contender.
///
/// In every round each has its turn, so that what else the machine does falls
/// on all of them alike. Calls that are over sooner than the clock can tell
/// are repeated within the turn.
pub fn in_turn(rounds: usize, contenders: &mut [&mut dyn FnMut()]) -> Vec<Duration> {
    let repeats: Vec<u32> = contenders.iter_mut().map(|it| repeats(*it)).collect();
    let mut times = vec![Vec::with_capacity(rounds); contenders.len()];
    for _ in 0..rounds {
        for (at, contender) in contenders.iter_mut().enumerate() {
            let start = Instant::now();
            for _ in 0..repeats[at] {
                contender();
            }
            times[at].push(start.elapsed() / repeats[at]);
        }
    }
    times.into_iter().map(median).collect()
}

/// How often a contender is called in a turn. Warms it up, too.
fn repeats(contender: &mut dyn FnMut()) -> u32 {
    let start = Instant::now();
    contender();
    let once = start.elapsed().max(Duration::from_nanos(20));
    let times = LEAST.as_nanos() / once.as_nanos();
    u32::try_from(times).unwrap_or(u32::MAX).max(1)
}

fn median(mut times: Vec<Duration>) -> Duration {
    times.sort();
    times.get(times.len() / 2).copied().unwrap_or_default()
}

/// How many times longer `time` is than `peer`.
pub fn ratio(time: Duration, peer: Duration) -> f64 {
    time.as_secs_f64() / peer.as_secs_f64().max(f64::MIN_POSITIVE)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_contender_has_a_turn_in_every_round() {
        let turns = std::cell::RefCell::new(Vec::new());
        let long = |name| {
            let turns = &turns;
            move || {
                turns.borrow_mut().push(name);
                std::thread::sleep(LEAST);
            }
        };
        let times = in_turn(2, &mut [&mut long('a'), &mut long('b')]);
        assert!(times.iter().all(|time| *time >= LEAST), "{times:?}");
        // The first call of each says how often it fits into a turn.
        assert_eq!(*turns.borrow(), ['a', 'b', 'a', 'b', 'a', 'b']);
    }

    #[test]
    fn the_median_is_the_time_in_the_middle() {
        let times = [9, 1, 5].map(Duration::from_secs).to_vec();
        assert_eq!(median(times), Duration::from_secs(5));
    }
}
