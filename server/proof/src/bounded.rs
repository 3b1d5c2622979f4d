//! Bounded model checking (Biere, Cimatti, Clarke, Zhu: Symbolic model checking
//! without BDDs, TACAS 1999): the netlist is unrolled scan by scan from its
//! start, and after each scan one question is asked: can a property be violated
//! in this very scan? The first yes is a shortest trace.

use crate::graph::Graph;
use crate::limits::{Meter, STRIDE, Why};
use crate::place::copy;
use crate::solver::{Answer, Solver};
use crate::{Gates, Netlist, Signal, Trace};

/// A search for the shortest trace, which can be interrupted and resumed.
pub(crate) struct Bounded<'n> {
    netlist: &'n Netlist,
    graph: Graph,
    solver: Solver,
    initial: Vec<Signal>,
    /// The inputs of each scan that was unrolled.
    inputs: Vec<Vec<Signal>>,
    /// What the latches hold before the next scan to be unrolled.
    state: Vec<Signal>,
    /// The properties in the last scan unrolled, until it is known to be clean.
    last: Option<Vec<Signal>>,
    /// No trace of so many scans or fewer violates a property.
    pub clean: usize,
}

/// What a further scan showed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Scan {
    /// No property can be violated in it.
    Clean,
    /// A property can: a shortest trace.
    Violated(Trace),
    /// The environment allows no such scan, so none after it either.
    Forbidden,
}

impl<'n> Bounded<'n> {
    pub fn new(netlist: &'n Netlist) -> Self {
        let mut graph = Graph::default();
        let latches = netlist.latches.iter();
        let initial: Vec<Signal> = latches
            .map(|latch| match latch.initial.value() {
                Some(value) => Signal::constant(value),
                None => graph.leaf(),
            })
            .collect();
        Self {
            netlist,
            graph,
            solver: Solver::default(),
            state: initial.clone(),
            initial,
            inputs: Vec::new(),
            last: None,
            clean: 0,
        }
    }

    /// Looks at one scan more, for the properties that `is_open` names by
    /// their place. After an error, or when a property that was violated is no
    /// longer open, the same call goes on where it stopped.
    pub fn advance(
        &mut self,
        is_open: impl Fn(usize) -> bool,
        meter: &mut Meter,
    ) -> Result<Scan, Why> {
        if self.last.is_none() {
            self.last = Some(self.unroll(meter)?);
        }
        let last = self.last.iter().flatten().enumerate();
        let wrong = last.filter(|(at, _)| is_open(*at)).map(|(_, it)| *it);
        let wrong: Vec<Signal> = wrong.collect();
        let wrong = self.graph.any(&wrong);
        if wrong != Signal::FALSE {
            match self.solver.ask(&self.graph, &[wrong], meter)? {
                Answer::Yes => return Ok(Scan::Violated(self.trace())),
                Answer::No => self.solver.assert(&self.graph, !wrong, meter)?,
            }
        }
        let is_constrained = !self.netlist.constraints.is_empty();
        if is_constrained && self.solver.ask(&self.graph, &[], meter)? == Answer::No {
            return Ok(Scan::Forbidden);
        }
        self.last = None;
        self.clean += 1;
        Ok(Scan::Clean)
    }

    /// Unrolls one scan: its properties.
    fn unroll(&mut self, meter: &mut Meter) -> Result<Vec<Signal>, Why> {
        meter.fits(self.graph.len() + self.netlist.size())?;
        let inputs: Vec<Signal> = (0..self.netlist.inputs.len())
            .map(|_| self.graph.leaf())
            .collect();
        let look = |_: &Graph| meter.spend(STRIDE);
        let placed = copy(self.netlist, &inputs, &self.state, &mut self.graph, look)?;
        for &constraint in &self.netlist.constraints {
            let signal = placed.of(constraint);
            self.solver.assert(&self.graph, signal, meter)?;
        }
        let properties = self.netlist.properties.iter();
        let last = properties.map(|it| placed.of(it.signal)).collect();
        let latches = self.netlist.latches.iter();
        self.state = latches.map(|latch| placed.of(latch.next)).collect();
        self.inputs.push(inputs);
        Ok(last)
    }

    fn trace(&self) -> Trace {
        let values = |signals: &Vec<Signal>| -> Vec<bool> {
            let values = signals.iter().map(|&signal| self.solver.value(signal));
            values.map(|value| value == Some(true)).collect()
        };
        Trace {
            initial: values(&self.initial),
            inputs: self.inputs.iter().map(values).collect(),
        }
    }
}
