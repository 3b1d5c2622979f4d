use logic::Name;
use rustc_hash::FxHashMap;

use crate::graph::Graph;
use crate::{Gates, Signal};

/// A transition system: what a program computes in a scan, as gates.
///
/// In each scan the *inputs* take new values, the *latches* hold what they
/// were given by the scan before, and every other [`Signal`] follows from
/// these. Before the first scan a latch holds its [`Initial`] value. *Outputs*
/// are signals with a name. *Constraints* are signals that the environment
/// keeps at 1: a sequence of inputs under which one of them is 0 in some scan
/// cannot happen from that scan on. *Properties* are named signals that must
/// never be 1; all that the engines do is to look for a sequence under which
/// one is, or to prove that there is none.
///
/// What is built is built once: equal gates are one gate, and gates whose
/// value is plain from their parts are never made. The order in which a
/// netlist is built decides every number in it and nothing else does.
#[derive(Clone, Debug, Default)]
pub struct Netlist {
    pub(crate) graph: Graph,
    pub(crate) leaves: FxHashMap<usize, Leaf>,
    pub(crate) inputs: Vec<Input>,
    pub(crate) latches: Vec<Latch>,
    pub(crate) outputs: Vec<Output>,
    pub(crate) constraints: Vec<Signal>,
    pub(crate) properties: Vec<Output>,
    by_name: FxHashMap<Name, usize>,
}

/// What a leaf of the graph is: its place among the inputs or latches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Leaf {
    Input(usize),
    Latch(usize),
}

/// A value that is new in each scan.
#[derive(Clone, Debug)]
pub struct Input {
    /// Its name, unique among the inputs.
    pub name: Name,
    /// Its signal.
    pub signal: Signal,
}

/// A value that is kept from scan to scan.
#[derive(Clone, Debug)]
pub struct Latch {
    /// Its name, for people; not necessarily unique.
    pub name: Name,
    /// Its signal: the value that the scan before left, in the first scan the
    /// initial one.
    pub signal: Signal,
    /// What it holds in the first scan.
    pub initial: Initial,
    /// What it will hold in the next scan.
    pub next: Signal,
}

/// What a latch holds before the first scan.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Initial {
    /// 0
    Zero,
    /// 1
    One,
    /// Either: what is proved holds for both, and a trace tells which.
    Free,
}

/// A signal with a name.
#[derive(Clone, Debug)]
pub struct Output {
    /// Its name.
    pub name: Name,
    /// Its signal.
    pub signal: Signal,
}

impl From<bool> for Initial {
    fn from(value: bool) -> Self {
        if value { Self::One } else { Self::Zero }
    }
}

impl Initial {
    /// The value, unless it is free.
    pub fn value(self) -> Option<bool> {
        match self {
            Self::Zero => Some(false),
            Self::One => Some(true),
            Self::Free => None,
        }
    }
}

impl Netlist {
    /// The input called `name`, which is added if there is none yet.
    pub fn input(&mut self, name: impl Into<Name>) -> Signal {
        let name = name.into();
        if let Some(&at) = self.by_name.get(&name) {
            return self.inputs[at].signal;
        }
        let signal = self.graph.leaf();
        let at = self.inputs.len();
        self.leaves.insert(signal.node(), Leaf::Input(at));
        self.by_name.insert(name.clone(), at);
        self.inputs.push(Input { name, signal });
        signal
    }

    /// A new latch. It keeps its value until [`Netlist::set_next`] says what
    /// else it takes.
    pub fn latch(&mut self, name: impl Into<Name>, initial: impl Into<Initial>) -> Signal {
        let signal = self.graph.leaf();
        self.leaves
            .insert(signal.node(), Leaf::Latch(self.latches.len()));
        self.latches.push(Latch {
            name: name.into(),
            signal,
            initial: initial.into(),
            next: signal,
        });
        signal
    }

    /// Says what `latch` takes at the end of each scan. Does nothing if the
    /// signal is not one that [`Netlist::latch`] gave.
    pub fn set_next(&mut self, latch: Signal, next: Signal) {
        if let Some(&Leaf::Latch(at)) = self.leaves.get(&latch.node()) {
            self.latches[at].next = next.flipped(latch.is_complement());
        }
    }

    /// What `signal` was in the scan before, and `initial` in the first: the
    /// way for a rule to speak of two scans. Environment rules whose left side
    /// speaks of the last scan and whose right side of this one are
    /// `constrain(implies(delayed(left), right))`; since before the first scan
    /// everything counts as 0, `initial` is what `left` is when all is 0.
    pub fn delayed(&mut self, name: impl Into<Name>, signal: Signal, initial: bool) -> Signal {
        let latch = self.latch(name, initial);
        self.set_next(latch, signal);
        latch
    }

    /// Gives a signal a name under which it can be compared.
    pub fn output(&mut self, name: impl Into<Name>, signal: Signal) {
        let name = name.into();
        self.outputs.push(Output { name, signal });
    }

    /// The environment keeps `signal` at 1, from the first scan on.
    pub fn constrain(&mut self, signal: Signal) {
        if signal != Signal::TRUE {
            self.constraints.push(signal);
        }
    }

    /// `bad` must never be 1; see [`crate::check`].
    pub fn never(&mut self, name: impl Into<Name>, bad: Signal) {
        let name = name.into();
        self.properties.push(Output { name, signal: bad });
    }

    /// The inputs, in the order in which they were made. A [`crate::Trace`]
    /// lists their values in this order.
    pub fn inputs(&self) -> &[Input] {
        &self.inputs
    }

    /// The latches, in the order in which they were made.
    pub fn latches(&self) -> &[Latch] {
        &self.latches
    }

    /// The outputs, in the order in which they were named.
    pub fn outputs(&self) -> &[Output] {
        &self.outputs
    }

    /// What the environment keeps at 1.
    pub fn constraints(&self) -> &[Signal] {
        &self.constraints
    }

    /// What must never be 1.
    pub fn properties(&self) -> &[Output] {
        &self.properties
    }

    /// Number of nodes: the constant, inputs, latches and gates. It is the
    /// work of one evaluation, and bounds the memory of a copy.
    pub fn size(&self) -> usize {
        self.graph.len()
    }

    /// What a node is if it is a leaf and not the constant.
    pub(crate) fn leaf(&self, node: usize) -> Option<Leaf> {
        self.leaves.get(&node).copied()
    }
}

impl Gates for Netlist {
    fn and(&mut self, a: Signal, b: Signal) -> Signal {
        self.graph.and(a, b)
    }
}
