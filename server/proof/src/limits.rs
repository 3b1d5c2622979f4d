use logic::Cancel;

/// How much [`crate::check`] may cost.
///
/// There is no clock. A *step* is a small piece of work that takes about as
/// long in every engine, some ten nanoseconds: a gate evaluated for 256 runs, a
/// literal propagated in the search for a satisfying assignment, a pair of
/// nodes visited in an operation on decision diagrams. So the same question
/// under the same limits gets the same answer on every machine.
#[derive(Clone, Debug)]
pub struct Limits {
    /// Steps in all.
    pub steps: u64,
    /// Most gates of the netlist unrolled over scans; about 40 bytes each.
    pub gates: usize,
    /// Most clauses that a search keeps; about 50 bytes each.
    pub clauses: usize,
    /// Most nodes visited by one operation on decision diagrams, which bounds
    /// its result as well; about 100 bytes each.
    pub nodes: usize,
    /// The longest sequence that is tried, in scans.
    pub scans: usize,
    /// Obeyed within a tenth of a second, mostly within milliseconds.
    pub cancel: Cancel,
}

impl Default for Limits {
    /// About a minute. What a question takes before the engines begin is bounded by
    /// the gates, and comes on top of their half a gigabyte: a plant of 10,000 rungs,
    /// both sides followed until they rest, took 717 MB in all.
    fn default() -> Self {
        Self {
            steps: 5_000_000_000,
            gates: 4_000_000,
            clauses: 4_000_000,
            nodes: 1_000_000,
            scans: 10_000,
            cancel: Cancel::default(),
        }
    }
}

/// Why an answer is not known.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Why {
    /// Somebody asked to stop.
    Cancelled,
    /// The steps are used up.
    Steps,
    /// More gates, clauses or nodes would be needed than the limits allow.
    Memory,
    /// No sequence of as many scans as the limits allow shows a difference, and
    /// no proof was found that a longer one does not either.
    Scans,
    /// What an engine found did not happen when it was replayed. A fault of
    /// this program; nothing is told that was not seen.
    Unconfirmed,
}

/// Nodes of a netlist that are walked over between two looks at the limits.
pub(crate) const STRIDE: usize = 1 << 12;

/// Looks at a cancel in a walk over nodes that uses up no steps, many nodes at a
/// time.
pub(crate) fn glance(cancel: &Cancel, node: usize) -> Result<(), Why> {
    match node.is_multiple_of(STRIDE) && cancel.is_cancelled() {
        true => Err(Why::Cancelled),
        false => Ok(()),
    }
}

/// What is left of the limits for one engine in one turn.
#[derive(Clone, Debug)]
pub(crate) struct Meter {
    pub left: u64,
    pub gates: usize,
    pub clauses: usize,
    pub nodes: usize,
    pub cancel: Cancel,
}

impl Meter {
    /// A turn of at most `steps`.
    pub fn new(limits: &Limits, steps: u64) -> Self {
        Self {
            left: steps,
            gates: limits.gates,
            clauses: limits.clauses,
            nodes: limits.nodes,
            cancel: limits.cancel.clone(),
        }
    }

    /// Uses up some steps; an error when there are none left, or on a cancel.
    pub fn spend(&mut self, steps: usize) -> Result<(), Why> {
        self.left = self.left.saturating_sub(steps as u64);
        self.look()?;
        match self.left {
            0 => Err(Why::Steps),
            _ => Ok(()),
        }
    }

    /// Stops on a cancel.
    pub fn look(&self) -> Result<(), Why> {
        match self.cancel.is_cancelled() {
            true => Err(Why::Cancelled),
            false => Ok(()),
        }
    }

    /// Uses up the steps of a walk over the nodes of a netlist, many nodes at a
    /// time, so that a walk over millions of them can be stopped as well.
    pub fn walk(&mut self, node: usize, steps_a_node: usize) -> Result<(), Why> {
        match node.is_multiple_of(STRIDE) {
            true => self.spend(STRIDE * steps_a_node),
            false => Ok(()),
        }
    }

    /// Stops where a graph has outgrown the limits.
    pub fn fits(&self, gates: usize) -> Result<(), Why> {
        if gates > self.gates {
            Err(Why::Memory)
        } else {
            Ok(())
        }
    }
}
