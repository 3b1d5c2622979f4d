//! Random runs: they find most differences in no time, and tell which signals
//! may be equal.
//!
//! Every lane is a run of its own from the start. The lanes of one machine word
//! take new inputs in every scan. In the others some inputs, drawn for each run,
//! rest at one value and seldom leave it: a run in which the emergency stop is
//! pressed in every other scan gets nowhere. In a lane whose constraints do not hold the inputs that
//! they depend on are drawn again a few times; if that does not help, the lane
//! starts anew. Lanes also start anew now and then, so that none stays in a
//! corner that it cannot leave.

use rustc_hash::FxHashMap;

use crate::classes::Classes;
use crate::lanes::{ALL, Lanes, NONE, WORDS, Word, bit, first, zip};
use crate::limits::{Meter, Why};
use crate::netlist::Leaf;
use crate::random::{Random, mixed};
use crate::runs::Runs;
use crate::{Netlist, Signal, Trace};

/// How often forbidden inputs are drawn again.
const REPAIRS: usize = 8;
/// So many scans are run before it is asked whether they still show anything.
const BATCH: usize = 16;
/// Batches that show nothing new before the runs end, in a large netlist. Where
/// scans cost less there are more, up to `MOST_QUIET`.
const QUIET: usize = 4;
const MOST_QUIET: usize = 6;
/// Gates evaluated that are always worth their while.
const WORTH: usize = 200_000;
/// Every so many scans the lanes of one word start anew.
const RESTART: usize = 24;
/// Most scans; a run is kept from its start, to tell its inputs. Fewer where the
/// memory for so many would be more than that of the gates that are allowed.
const MOST: usize = 1024;

/// What the random runs showed.
pub(crate) struct Explored {
    prints: Prints,
    /// The shortest run found under which a property is violated.
    pub trace: Option<Trace>,
    /// What each latch held, scan by scan; lanes that do not count hold 0.
    pub latches: Vec<Vec<Word>>,
    /// The lanes that count in each scan.
    pub allowed: Vec<Word>,
}

/// Runs `netlist` on random inputs until they show nothing new.
pub(crate) fn explore(netlist: &Netlist, meter: &mut Meter) -> Result<Explored, Why> {
    let mut random = Random::new(1);
    let mut lanes = Lanes::new(netlist, || std::array::from_fn(|_| random.bits()));
    let depends = supports(netlist);
    let mut runs = Runs::new(netlist, &lanes);
    let mut inputs = vec![NONE; netlist.inputs.len()];
    let mut manners = vec![Manner::new(); inputs.len()];
    manners.iter_mut().for_each(|it| it.draw(&ALL, &mut random));
    let mut explored = Explored {
        prints: Prints::default(),
        trace: None,
        latches: vec![Vec::new(); netlist.latches.len()],
        allowed: Vec::new(),
    };
    let (mut kinds, mut quiet) = (0, 0);
    let enough = (WORTH / netlist.size() / BATCH).clamp(QUIET, MOST_QUIET);
    let kept = netlist.inputs.len() + netlist.latches.len();
    for scan in 0..(meter.gates / kept.max(1)).clamp(1, MOST) {
        meter.spend(netlist.size() * 2)?;
        for (word, manner) in inputs.iter_mut().zip(&manners) {
            *word = manner.next(&mut random);
        }
        let mut allowed = solved(netlist, &mut lanes, &inputs);
        meter.look()?;
        for _ in 0..REPAIRS {
            if allowed == ALL {
                break;
            }
            meter.spend(netlist.size())?;
            repair(netlist, &lanes, &depends, &mut inputs, &mut random);
            allowed = solved(netlist, &mut lanes, &inputs);
        }
        runs.inputs.push(inputs.clone());
        explored.prints.add(0, &lanes, &allowed);
        meter.look()?;
        for (latch, seen) in netlist.latches.iter().zip(&mut explored.latches) {
            seen.push(zip(&lanes.value(latch.signal), &allowed, |a, b| a & b));
        }
        explored.allowed.push(allowed);
        if let Some(lane) = violation(netlist, &lanes, &allowed)
            && explored
                .trace
                .as_ref()
                .is_none_or(|it| runs.scans(lane) < it.scans())
        {
            explored.trace = Some(runs.trace(lane));
        }
        lanes.advance();
        runs.remember(&lanes, &allowed);
        let mut ended = allowed.map(|bits| !bits);
        if scan % RESTART == RESTART - 1 {
            ended[scan / RESTART % WORDS] = u64::MAX;
        }
        if ended != NONE {
            lanes.restart(&ended, || std::array::from_fn(|_| random.bits()));
            runs.restart(&mut lanes, &ended, &mut random);
            manners
                .iter_mut()
                .for_each(|it| it.draw(&ended, &mut random));
        }
        if scan % BATCH == BATCH - 1 {
            meter.look()?;
            let now = explored.prints.kinds();
            meter.look()?;
            quiet = if now > kinds { 0 } else { quiet + 1 };
            kinds = now;
            if quiet == enough {
                break;
            }
        }
    }
    Ok(explored)
}

impl Explored {
    /// Signals that were equal in every scan of every run.
    pub fn classes(&self) -> Classes {
        self.prints.classes()
    }

    /// Takes in the gates that were added to `netlist` since, over latches alone:
    /// what the latches did in the runs tells what these would have done.
    pub fn take_in(&mut self, netlist: &Netlist, meter: &mut Meter) -> Result<(), Why> {
        let known = self.prints.prints.len();
        let mut lanes = Lanes::new(netlist, || NONE);
        for (scan, allowed) in self.allowed.iter().enumerate() {
            meter.spend(2 * netlist.size())?;
            for (latch, seen) in netlist.latches.iter().zip(&self.latches) {
                lanes.set(latch.signal, seen[scan]);
            }
            lanes.solve();
            meter.look()?;
            self.prints.add(known, &lanes, allowed);
        }
        Ok(())
    }
}

/// How an input behaves in each lane until the lane starts anew.
#[derive(Clone)]
struct Manner {
    /// Whether it is drawn in every scan. Else it rests,
    lively: Word,
    /// at this value, and leaves it once in 64 scans.
    rest: Word,
}

impl Manner {
    fn new() -> Self {
        Self {
            lively: NONE,
            rest: NONE,
        }
    }

    /// Draws how it behaves from now on in the lanes of `which`: all inputs are
    /// lively in the first word, and fewer from word to word.
    fn draw(&mut self, which: &Word, random: &mut Random) {
        let quiet = [0, random.rare(3), random.rare(2), random.rare(1)];
        for at in 0..WORDS {
            let kept = !which[at];
            self.lively[at] = self.lively[at] & kept | !quiet[at] & which[at];
            self.rest[at] = self.rest[at] & kept | random.bits() & which[at];
        }
    }

    fn next(&self, random: &mut Random) -> Word {
        std::array::from_fn(|at| {
            let at_rest = self.rest[at] ^ random.rare(6);
            random.bits() & self.lively[at] | at_rest & !self.lively[at]
        })
    }
}

fn solved(netlist: &Netlist, lanes: &mut Lanes<'_>, inputs: &[Word]) -> Word {
    for (input, word) in netlist.inputs.iter().zip(inputs) {
        lanes.set(input.signal, *word);
    }
    lanes.solve();
    lanes.allowed()
}

/// Draws the inputs of violated constraints again, in the lanes concerned.
fn repair(
    netlist: &Netlist,
    lanes: &Lanes<'_>,
    depends: &[Vec<usize>],
    inputs: &mut [Word],
    random: &mut Random,
) {
    for (&constraint, depends) in netlist.constraints.iter().zip(depends) {
        let violated = lanes.value(!constraint);
        if violated != NONE {
            for &input in depends {
                let bits: Word = std::array::from_fn(|_| random.bits());
                inputs[input] = zip(
                    &inputs[input],
                    &zip(&bits, &violated, |a, b| a & b),
                    |a, b| a ^ b,
                );
            }
        }
    }
}

fn violation(netlist: &Netlist, lanes: &Lanes<'_>, allowed: &Word) -> Option<usize> {
    let mut violated = NONE;
    for property in &netlist.properties {
        violated = zip(&violated, &lanes.value(property.signal), |a, b| a | b);
    }
    first(&zip(&violated, allowed, |a, b| a & b))
}

/// The inputs that each constraint depends on within a scan.
fn supports(netlist: &Netlist) -> Vec<Vec<usize>> {
    let constraints = netlist.constraints.iter();
    constraints
        .map(|&constraint| {
            let mut inputs: Vec<usize> = netlist
                .leaves_below(constraint, usize::MAX)
                .into_iter()
                .filter_map(|node| match netlist.leaf(node) {
                    Some(Leaf::Input(at)) => Some(at),
                    _ => None,
                })
                .collect();
            inputs.sort_unstable();
            inputs
        })
        .collect()
}

/// What each node did, in one number: two nodes with the same number were most
/// likely equal in every scan of every lane, or always each other's complement.
#[derive(Default)]
struct Prints {
    prints: Vec<u64>,
    /// What each node was in the first lane that counted: nodes that were 1
    /// there are looked at through their complement.
    complement: Vec<bool>,
}

impl Prints {
    /// Adds what the nodes from this one on did in a scan.
    fn add(&mut self, from: usize, lanes: &Lanes<'_>, allowed: &Word) {
        self.prints.resize(lanes.len(), 0);
        let Some(lane) = first(allowed) else { return };
        let unseen = self.complement.len()..self.prints.len();
        let seen = unseen.map(|node| bit(lanes.node(node), lane));
        self.complement.extend(seen);
        for (node, print) in self.prints.iter_mut().enumerate().skip(from) {
            let flip = 0_u64.wrapping_sub(self.complement[node].into());
            let seen = zip(lanes.node(node), allowed, |bits, allowed| {
                (bits ^ flip) & allowed
            });
            let [a, b, c, d] = seen;
            let all = a
                ^ b.wrapping_mul(0x9e37_79b9_7f4a_7c15)
                ^ c.rotate_left(32).wrapping_mul(0xbf58_476d_1ce4_e5b9)
                ^ d.rotate_left(17).wrapping_mul(0x94d0_49bb_1331_11eb);
            *print = mixed(print.wrapping_add(all));
        }
    }

    fn kinds(&self) -> usize {
        let mut sorted = self.prints.clone();
        sorted.sort_unstable();
        sorted.dedup();
        sorted.len()
    }

    fn classes(&self) -> Classes {
        let mut leaders: FxHashMap<u64, usize> = FxHashMap::default();
        let flipped = |node: usize| self.complement.get(node) == Some(&true);
        let leader = self.prints.iter().enumerate().map(|(node, &print)| {
            let leader = *leaders.entry(print).or_insert(node);
            Signal::new(leader, flipped(leader) != flipped(node))
        });
        Classes(leader.collect())
    }
}
