use crate::{Netlist, Signal};

/// How many machine words of lanes are run at once.
pub(crate) const WORDS: usize = 4;

/// One bit for each lane.
pub(crate) type Word = [u64; WORDS];

pub(crate) const NONE: Word = [0; WORDS];
pub(crate) const ALL: Word = [u64::MAX; WORDS];

/// Number of lanes.
pub(crate) const LANES: usize = 64 * WORDS;

/// The bit of one lane.
pub(crate) fn bit(word: &Word, lane: usize) -> bool {
    word[lane / 64] >> (lane % 64) & 1 == 1
}

/// The lowest lane that is set.
pub(crate) fn first(word: &Word) -> Option<usize> {
    let at = word.iter().position(|&bits| bits != 0)?;
    Some(64 * at + word[at].trailing_zeros() as usize)
}

/// Combines two words bit by bit.
#[inline]
pub(crate) fn zip(a: &Word, b: &Word, f: impl Fn(u64, u64) -> u64) -> Word {
    std::array::from_fn(|at| f(a[at], b[at]))
}

/// Runs a netlist many times at once: each of the 256 lanes is a run of its
/// own, a bit in every word, and one pass over the gates is a scan of all.
#[derive(Clone, Debug)]
pub(crate) struct Lanes<'n> {
    netlist: &'n Netlist,
    values: Vec<Word>,
}

impl<'n> Lanes<'n> {
    /// All lanes before their first scan; free latches hold what `free` gives.
    pub fn new(netlist: &'n Netlist, mut free: impl FnMut() -> Word) -> Self {
        let mut values = vec![NONE; netlist.size()];
        for latch in &netlist.latches {
            values[latch.signal.node()] = match latch.initial.value() {
                Some(value) => [0_u64.wrapping_sub(value.into()); WORDS],
                None => free(),
            };
        }
        Self { netlist, values }
    }

    /// Sets the value of an input or latch.
    pub fn set(&mut self, leaf: Signal, word: Word) {
        self.values[leaf.node()] = word;
    }

    /// Computes every gate from the inputs and latches.
    pub fn solve(&mut self) {
        for node in 1..self.values.len() {
            if let Some([a, b]) = self.netlist.graph.gate(node) {
                self.values[node] = zip(&self.value(a), &self.value(b), |a, b| a & b);
            }
        }
    }

    /// Number of nodes.
    pub fn len(&self) -> usize {
        self.values.len()
    }

    /// The value of a signal in this scan.
    #[inline]
    pub fn value(&self, signal: Signal) -> Word {
        let flip = 0_u64.wrapping_sub(signal.is_complement().into());
        self.values[signal.node()].map(|bits| bits ^ flip)
    }

    /// The value of a node.
    #[inline]
    pub fn node(&self, node: usize) -> &Word {
        &self.values[node]
    }

    /// The lanes in which every constraint holds.
    pub fn allowed(&self) -> Word {
        let constraints = self.netlist.constraints.iter();
        constraints.fold(ALL, |all, &constraint| {
            zip(&all, &self.value(constraint), |a, b| a & b)
        })
    }

    /// Lets the latches take what the scan computed for them.
    pub fn advance(&mut self) {
        let latches = self.netlist.latches.iter();
        let next: Vec<Word> = latches.map(|latch| self.value(latch.next)).collect();
        for (latch, word) in self.netlist.latches.iter().zip(next) {
            self.values[latch.signal.node()] = word;
        }
    }

    /// Puts the lanes of `which` before their first scan again.
    pub fn restart(&mut self, which: &Word, mut free: impl FnMut() -> Word) {
        for latch in &self.netlist.latches {
            let initial = match latch.initial.value() {
                Some(value) => [0_u64.wrapping_sub(value.into()); WORDS],
                None => free(),
            };
            let now = &mut self.values[latch.signal.node()];
            for at in 0..WORDS {
                now[at] = now[at] & !which[at] | initial[at] & which[at];
            }
        }
    }
}
