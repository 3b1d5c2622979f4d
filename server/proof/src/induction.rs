//! Induction over several scans (Sheeran, Singh, Stålmarck: Checking safety
//! properties using induction and a SAT-solver, FMCAD 2000): if no sequence of
//! k scans without a violation, wherever it starts, can go on to one, and the
//! first k scans are known to be without, there is none ever. The classes of
//! equal signals that are already proved are supposed in every scan, which
//! keeps out most states that cannot be reached.

use crate::Signal;
use crate::classes::Classes;
use crate::frame::{Framing, State};
use crate::graph::Graph;
use crate::limits::{Meter, Why};
use crate::solver::{Answer, Solver};
use crate::{Gates, Netlist};

/// An attempt that can be interrupted and resumed with one scan more.
pub(crate) struct Induction<'n> {
    framing: &'n Framing<'n>,
    classes: &'n Classes,
    graph: Graph,
    solver: Solver,
    /// The latches after the last scan; of the first, anything.
    state: Option<Vec<Signal>>,
    /// For each property, a signal that supposes it in all scans before the last.
    supposed: Vec<Signal>,
    /// The properties in the last scan, not yet asked about.
    last: Option<Vec<Signal>>,
    /// Number of scans in which the properties are supposed.
    pub scans: usize,
}

impl<'n> Induction<'n> {
    pub fn new(framing: &'n Framing<'n>, classes: &'n Classes) -> Self {
        let mut graph = Graph::default();
        let properties = framing.netlist.properties.iter();
        Self {
            supposed: properties.map(|_| graph.leaf()).collect(),
            framing,
            classes,
            graph,
            solver: Solver::default(),
            state: None,
            last: None,
            scans: 0,
        }
    }

    fn netlist(&self) -> &'n Netlist {
        self.framing.netlist
    }

    /// Which of the `open` properties, given by their places, hold together in
    /// the next scan after [`Induction::scans`] in which they did. They are
    /// proved if as many scans from the start are known to be without a
    /// violation. The attempt then goes on with one scan more.
    pub fn advance(&mut self, open: &[usize], meter: &mut Meter) -> Result<Vec<usize>, Why> {
        let last = match self.last.take() {
            Some(last) => last,
            None => self.unroll(meter)?,
        };
        let held = self.held(&last, open, meter);
        if held.is_err() {
            self.last = Some(last);
            return held;
        }
        for (&bad, &supposed) in last.iter().zip(&self.supposed) {
            self.solver
                .assert_any(&self.graph, &[!supposed, !bad], meter)?;
        }
        self.scans += 1;
        held
    }

    fn unroll(&mut self, meter: &mut Meter) -> Result<Vec<Signal>, Why> {
        let state = match &self.state {
            Some(latches) => State::Is(latches),
            None => State::Any,
        };
        let frame = self
            .framing
            .frame(&mut self.graph, self.classes, state, meter)?;
        self.framing
            .constrain(&frame, &self.graph, &mut self.solver, meter)?;
        self.framing
            .suppose(&frame, &mut self.graph, &mut self.solver, meter)?;
        self.state = Some(frame.next(self.netlist()));
        let properties = self.netlist().properties.iter();
        Ok(properties
            .map(|property| frame.of(property.signal))
            .collect())
    }

    /// The largest part of `open` of which no property is violated in the last
    /// scan when all of the part are supposed before.
    fn held(
        &mut self,
        last: &[Signal],
        open: &[usize],
        meter: &mut Meter,
    ) -> Result<Vec<usize>, Why> {
        let mut part = open.to_vec();
        // Their sum may be plain where they are not.
        for &at in &part {
            self.solver.watch(&self.graph, last[at], meter)?;
        }
        loop {
            let supposed: Vec<Signal> = part.iter().map(|&at| self.supposed[at]).collect();
            let bad: Vec<Signal> = part.iter().map(|&at| last[at]).collect();
            let mut question = supposed;
            question.push(self.graph.any(&bad));
            if self.solver.ask(&self.graph, &question, meter)? == Answer::No {
                return Ok(part);
            }
            part.retain(|&at| !self.is_violated(last[at]));
            if part.is_empty() {
                return Ok(part);
            }
        }
    }

    fn is_violated(&self, bad: Signal) -> bool {
        self.solver.value(bad) == Some(true)
    }
}
