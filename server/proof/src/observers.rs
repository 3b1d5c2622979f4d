//! Step invariants, as gates: of a chain of steps exactly one is active. Such a
//! fact is seldom an equality of two signals that are there already, but it is
//! needed to prove others. So gates are added that say it: the class of the
//! constants then tells, among all other candidates, whether it holds.

use rustc_hash::FxHashMap;

use crate::explore::Explored;
use crate::lanes::{NONE, Word, zip};
use crate::limits::{Meter, Why};
use crate::{Gates, Netlist, Signal};

/// A latch or its complement, whichever was 1 less often, and when it was.
struct Member<'e> {
    signal: Signal,
    /// What the latch takes.
    next: Signal,
    seen: &'e [Word],
    complement: bool,
}

/// Latches of which never two were 1 at once.
struct Group {
    signals: Vec<Signal>,
    /// When one of them was.
    seen: Vec<Word>,
}

/// Gates looked at to find what decides a latch's next value.
const NEAR: usize = 300;

/// Adds gates for groups of latches of which never two were 1 at once.
///
/// The groups are found in one pass: a latch joins the first of them with none
/// of whose members it was ever 1 together and of which one has a say in what
/// it takes next, or it in theirs. Latches that were equal to others, or that
/// never changed, stay out.
pub(crate) fn observe(
    netlist: &mut Netlist,
    explored: &Explored,
    meter: &mut Meter,
) -> Result<(), Why> {
    let mut groups: Vec<Group> = Vec::new();
    // Of each latch, by its node, the group that it is in; of each node, the
    // groups with a member that it has a say in.
    let mut group_of: FxHashMap<usize, usize> = FxHashMap::default();
    let mut leading: FxHashMap<usize, Vec<usize>> = FxHashMap::default();
    for member in members(netlist, explored) {
        let value = |scan: usize| member.value(scan, &explored.allowed[scan]);
        let own = member.signal.node();
        let deciding = netlist.leaves_below(member.next, NEAR);
        let mut near: Vec<usize> = deciding
            .iter()
            .filter_map(|it| group_of.get(it).copied())
            .collect();
        near.extend(leading.get(&own).into_iter().flatten());
        near.sort_unstable();
        near.dedup();
        meter.spend(NEAR + near.len() * explored.allowed.len())?;
        let excludes = |group: &Group| {
            let mut seen = group.seen.iter().enumerate();
            seen.all(|(scan, seen)| zip(seen, &value(scan), |a, b| a & b) == NONE)
        };
        let place = near.into_iter().find(|&at| excludes(&groups[at]));
        let place = place.unwrap_or(groups.len());
        if place == groups.len() {
            groups.push(Group {
                signals: Vec::new(),
                seen: vec![NONE; explored.allowed.len()],
            });
        }
        let group = &mut groups[place];
        group.signals.push(member.signal);
        for (scan, seen) in group.seen.iter_mut().enumerate() {
            *seen = zip(seen, &value(scan), |a, b| a | b);
        }
        group_of.insert(own, place);
        for node in deciding {
            leading.entry(node).or_default().push(place);
        }
    }
    for group in groups {
        // One gate for each member says that it meets none before it; the last
        // sum says that there is one.
        let mut any = Signal::FALSE;
        for signal in group.signals {
            netlist.and(any, signal);
            any = netlist.or(any, signal);
        }
    }
    Ok(())
}

fn members<'e>(netlist: &Netlist, explored: &'e Explored) -> Vec<Member<'e>> {
    let classes = explored.classes();
    let latches = netlist.latches.iter().zip(&explored.latches);
    latches
        .filter(|(latch, _)| {
            let node = latch.signal.node();
            classes.0[node].node() == node
        })
        .map(|(latch, seen)| {
            let ones: u64 = count(seen);
            let complement = 2 * ones > count(&explored.allowed);
            Member {
                signal: latch.signal.flipped(complement),
                next: latch.next,
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
