//! Step invariants, as gates: of a chain of steps exactly one is active. Such a
//! fact is seldom an equality of two signals that are there already, but it is
//! needed to prove others. So gates are added that say it: the class of the
//! constants then tells, among all other candidates, whether it holds.

use crate::explore::Explored;
use crate::lanes::{NONE, Word};
use crate::limits::{Meter, Why};
use crate::{Gates, Netlist, Signal};

/// A latch or its complement, whichever was 1 less often, and when it was.
struct Member<'e> {
    signal: Signal,
    seen: &'e [Word],
    complement: bool,
}

/// Adds gates for groups of latches of which never two were 1 at once.
///
/// The groups are found in one pass: a latch joins the first of them with none
/// of whose members it was ever 1 together. Latches that were equal to others,
/// or that never changed, stay out.
pub(crate) fn observe(
    netlist: &mut Netlist,
    explored: &Explored,
    meter: &mut Meter,
) -> Result<(), Why> {
    let mut groups: Vec<(Vec<Signal>, Vec<Word>)> = Vec::new();
    for member in members(netlist, explored) {
        let value = |scan: usize| member.value(scan, &explored.allowed[scan]);
        let mut place = groups.len();
        for (at, (_, seen)) in groups.iter().enumerate() {
            let mut tried = 0;
            let meets = seen.iter().enumerate().any(|(scan, seen)| {
                tried += 1;
                let value = value(scan);
                (0..seen.len()).any(|at| seen[at] & value[at] != 0)
            });
            meter.spend(tried)?;
            if !meets {
                place = at;
                break;
            }
        }
        if place == groups.len() {
            groups.push((Vec::new(), vec![NONE; explored.allowed.len()]));
        }
        let (signals, seen) = &mut groups[place];
        signals.push(member.signal);
        for (scan, seen) in seen.iter_mut().enumerate() {
            *seen = crate::lanes::zip(seen, &value(scan), |a, b| a | b);
        }
    }
    for (signals, _) in groups {
        // One gate for each member says that it meets none before it; the last
        // sum says that there is one.
        let mut any = Signal::FALSE;
        for signal in signals {
            netlist.and(any, signal);
            any = netlist.or(any, signal);
        }
    }
    Ok(())
}

fn members<'e>(netlist: &Netlist, explored: &'e Explored) -> Vec<Member<'e>> {
    let latches = netlist.latches.iter().zip(&explored.latches);
    latches
        .filter(|(latch, _)| {
            let node = latch.signal.node();
            explored.classes.0[node].node() == node
        })
        .map(|(latch, seen)| {
            let ones: u64 = count(seen);
            let complement = 2 * ones > count(&explored.allowed);
            Member {
                signal: latch.signal.flipped(complement),
                seen,
                complement,
            }
        })
        .collect()
}

fn count(words: &[Word]) -> u64 {
    let bits = words.iter().flatten();
    bits.map(|bits| u64::from(bits.count_ones())).sum()
}

impl Member<'_> {
    fn value(&self, scan: usize, allowed: &Word) -> Word {
        let flip = 0_u64.wrapping_sub(self.complement.into());
        std::array::from_fn(|at| (self.seen[scan][at] ^ flip) & allowed[at])
    }
}
