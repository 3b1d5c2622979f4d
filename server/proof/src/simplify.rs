use logic::{Cancel, Stop};

use crate::{Netlist, Signal, Trace, violation};

/// The trace with no change of an input that is not needed: what is `bad` in its
/// last scan still is there, and nothing forbids it.
///
/// It costs a replay for each change; of a long trace only as many are tried as
/// are worth `most` nodes evaluated, and none after a cancel.
pub fn simplified(
    netlist: &Netlist,
    trace: &Trace,
    bad: &[Signal],
    most: usize,
    cancel: &Cancel,
) -> Trace {
    let mut judge = netlist.clone();
    judge.properties.clear();
    for signal in bad {
        judge.never("violated", *signal);
    }
    let last = trace.scans().saturating_sub(1);
    let is_good = |tried: &Trace| {
        let look = || match cancel.is_cancelled() {
            true => Err(Stop::Cancelled),
            false => Ok(()),
        };
        let seen = violation(&judge, tried, look).ok().flatten();
        let violated = seen.filter(|(at, _)| *at == last);
        violated.is_some_and(|(_, names)| names.iter().any(|name| &**name == "violated"))
    };
    let mut best = trace.clone();
    if !is_good(&best) {
        return best;
    }
    let mut left = most / (netlist.size() * trace.scans()).max(1);
    // Twice: what one change allows may be found only after another.
    for _ in 0..2 {
        for scan in 0..best.inputs.len() {
            for input in 0..best.inputs[scan].len() {
                let before = scan.checked_sub(1).is_some_and(|at| best.inputs[at][input]);
                if best.inputs[scan][input] != before && left > 0 && !cancel.is_cancelled() {
                    left -= 1;
                    let mut tried = best.clone();
                    tried.inputs[scan][input] = before;
                    if is_good(&tried) {
                        best = tried;
                    }
                }
            }
        }
    }
    best
}
