//! Times that can be compared: taken in turn, several times, the median of
//! each.
//!
//! Where the system tells it, a time is that which the processor worked for
//! this thread. On a busy machine the time on the wall says how often others
//! had their turn, and more of them have one while a long piece of work runs
//! than while a short one does. All that is measured here works in the thread
//! that calls it.

use std::hint::black_box;
use std::time::Duration;

/// A round lasts at least this long for each contender, so that the clock's
/// own grain does not show.
const LEAST: Duration = Duration::from_millis(4);

/// The time that `work` takes, and not that to drop what it gives.
pub fn time<T>(work: impl FnOnce() -> T) -> Duration {
    let start = now();
    let result = black_box(work());
    let time = now().saturating_sub(start);
    drop(result);
    time
}

/// What this thread has worked so far.
#[cfg(unix)]
pub fn now() -> Duration {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
    Duration::try_from(time).unwrap_or_default()
}

/// The time since the first call.
#[cfg(not(unix))]
pub fn now() -> Duration {
    static FIRST: std::sync::OnceLock<std::time::Instant> = std::sync::OnceLock::new();
    FIRST.get_or_init(std::time::Instant::now).elapsed()
}

/// The median time of each contender, which measures itself with [`time`].
///
/// In every round each has its turn, so that what else the machine does falls
/// on all of them alike. Contenders that are done sooner than the clock can
/// tell are repeated within their turn.
pub fn in_turn(rounds: usize, contenders: &mut [&mut dyn FnMut() -> Duration]) -> Vec<Duration> {
    let repeats: Vec<u32> = contenders.iter_mut().map(|it| repeats(it())).collect();
    let mut times = vec![Vec::with_capacity(rounds); contenders.len()];
    for _ in 0..rounds {
        for (at, contender) in contenders.iter_mut().enumerate() {
            let turn: Duration = (0..repeats[at]).map(|_| contender()).sum();
            times[at].push(turn / repeats[at]);
        }
    }
    times.into_iter().map(median).collect()
}

/// How often a contender that takes `once` is called in a turn.
fn repeats(once: Duration) -> u32 {
    let times = LEAST.as_nanos() / once.as_nanos().max(20);
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
    #[cfg(unix)]
    fn waiting_is_no_work() {
        let waiting = Duration::from_millis(200);
        assert!(time(|| std::thread::sleep(waiting)) < waiting / 2);
    }

    #[test]
    fn each_contender_has_a_turn_in_every_round() {
        let turns = std::cell::RefCell::new(Vec::new());
        let long = |name| {
            let turns = &turns;
            move || {
                turns.borrow_mut().push(name);
                LEAST
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
