use std::ops::Range;
use std::rc::Rc;

use crate::lanes::{ALL, LANES, Lanes, NONE, Word, bit, first, zip};
use crate::random::Random;
use crate::{Netlist, Signal, Trace};

/// Where random runs came from, and where they should go on.
///
/// Sequences are deep: to see the last step a run must have passed all others.
/// So whenever a latch takes a value for the first time, the state is
/// remembered, and later runs go on from there as often as from the start.
pub(crate) struct Runs {
    /// The inputs of all lanes in every scan.
    pub inputs: Vec<Vec<Word>>,
    latches: Vec<Signal>,
    /// For each lane, the state that it went on from, and since which scan.
    from: Vec<(Rc<State>, usize)>,
    /// Whether each latch was ever 0, and ever 1.
    seen: Vec<[bool; 2]>,
    remembered: Vec<Rc<State>>,
}

/// A state, and how it was reached.
struct State {
    latches: Vec<bool>,
    /// The state before, and the lane and scans in which it led to this one;
    /// nothing, if this is a state to start from.
    before: Option<(Rc<State>, usize, Range<usize>)>,
    /// Scans from the start.
    scans: usize,
}

/// Most states that are remembered in a scan.
const AT_ONCE: usize = 8;

impl Runs {
    /// All lanes at the start.
    pub fn new(netlist: &Netlist, lanes: &Lanes<'_>) -> Self {
        let mut runs = Self {
            inputs: Vec::new(),
            latches: netlist.latches.iter().map(|latch| latch.signal).collect(),
            from: Vec::new(),
            seen: vec![[false; 2]; netlist.latches.len()],
            remembered: Vec::new(),
        };
        for lane in 0..LANES {
            let state = runs.state(lanes, lane, None);
            runs.from.push((Rc::new(state), 0));
        }
        runs.news(lanes, &ALL);
        runs
    }

    /// Number of scans that the run in a lane took from the start.
    pub fn scans(&self, lane: usize) -> usize {
        let (state, since) = &self.from[lane];
        state.scans + self.inputs.len() - since
    }

    /// The run in a lane, from the start.
    pub fn trace(&self, lane: usize) -> Trace {
        let (state, since) = &self.from[lane];
        let mut state = state;
        let mut ways = vec![(lane, *since..self.inputs.len())];
        while let Some((before, lane, scans)) = &state.before {
            ways.push((*lane, scans.clone()));
            state = before;
        }
        let scans = ways.into_iter().rev();
        let scans = scans.flat_map(|(lane, scans)| scans.map(move |scan| (lane, scan)));
        Trace {
            initial: state.latches.clone(),
            inputs: scans
                .map(|(lane, scan)| {
                    self.inputs[scan]
                        .iter()
                        .map(|word| bit(word, lane))
                        .collect()
                })
                .collect(),
        }
    }

    /// Remembers the states of those lanes of `which` in which a latch has just
    /// taken a value that it never had.
    pub fn remember(&mut self, lanes: &Lanes<'_>, which: &Word) {
        for lane in self.news(lanes, which) {
            let (before, since) = self.from[lane].clone();
            let way = (before, lane, since..self.inputs.len());
            let state = self.state(lanes, lane, Some(way));
            self.remembered.push(Rc::new(state));
        }
    }

    /// Says that the lanes of `which` are at the start; lets half of them go on
    /// from a remembered state instead.
    pub fn restart(&mut self, lanes: &mut Lanes<'_>, which: &Word, random: &mut Random) {
        let now = self.inputs.len();
        let mut moved = NONE;
        let mut values = vec![NONE; self.latches.len()];
        for lane in (0..LANES).filter(|&lane| bit(which, lane)) {
            let state = match self.drawn(random) {
                None => Rc::new(self.state(lanes, lane, None)),
                Some(state) => {
                    let (word, shift) = (lane / 64, lane % 64);
                    moved[word] |= 1 << shift;
                    for (values, &value) in values.iter_mut().zip(&state.latches) {
                        values[word] |= u64::from(value) << shift;
                    }
                    state
                }
            };
            self.from[lane] = (state, now);
        }
        for (&latch, values) in self.latches.iter().zip(&values) {
            let kept = zip(lanes.node(latch.node()), &moved, |a, b| a & !b);
            lanes.set(latch, zip(&kept, values, |a, b| a | b));
        }
    }

    /// A remembered state, among the newest quarter of them in half of the cases.
    fn drawn(&self, random: &mut Random) -> Option<Rc<State>> {
        let [is_start, is_new] = [random.bits(), random.bits()].map(|bits| bits & 1 == 0);
        let count = self.remembered.len();
        if is_start || count == 0 {
            return None;
        }
        let among = if is_new { count.div_ceil(4) } else { count };
        let back = random.bits() % among as u64;
        Some(self.remembered[count - 1 - back as usize].clone())
    }

    fn state(
        &self,
        lanes: &Lanes<'_>,
        lane: usize,
        before: Option<(Rc<State>, usize, Range<usize>)>,
    ) -> State {
        let latches = self.latches.iter();
        State {
            latches: latches.map(|it| bit(lanes.node(it.node()), lane)).collect(),
            scans: before
                .as_ref()
                .map_or(0, |(state, _, scans)| state.scans + scans.len()),
            before,
        }
    }

    /// Lanes of `which` in which a latch has a value that none had before.
    fn news(&mut self, lanes: &Lanes<'_>, which: &Word) -> Vec<usize> {
        let mut news = Vec::new();
        for (latch, seen) in self.latches.iter().zip(&mut self.seen) {
            let zeros = zip(which, lanes.node(latch.node()), |which, ones| which & !ones);
            let ones = zip(which, lanes.node(latch.node()), |which, ones| which & ones);
            for (word, seen) in [zeros, ones].iter().zip(seen) {
                if !*seen && let Some(lane) = first(word) {
                    *seen = true;
                    news.push(lane);
                }
            }
        }
        news.sort_unstable();
        news.dedup();
        news.truncate(AT_ONCE);
        news
    }
}
