//! Signals that are equal in every scan, proved all at once by induction (van
//! Eijk: Sequential equivalence checking based on structural similarities, IEEE
//! TCAD 2000).
//!
//! Random runs give the candidates: classes of signals that were never seen to
//! differ. If the classes hold in the first scan, and if in any two scans in a
//! row of which the first satisfies them the second does too, they hold for
//! ever. Where the second does not, the counterexample splits a class, and it
//! all begins again with what is left. Nothing has to be known about which
//! states can be reached: the classes themselves describe them.

use crate::classes::Classes;
use crate::frame::{Frame, Framing, State};
use crate::graph::Graph;
use crate::lanes::{ALL, Lanes, WORDS, Word, zip};
use crate::limits::{Meter, Why};
use crate::random::Random;
use crate::solver::{Answer, Solver};
use crate::{Gates, Netlist, Signal};

/// Most steps for one question; a candidate that needs more is dropped.
const QUESTION: u64 = 5_000_000;

/// Scans that are tried after a counterexample.
const FURTHER: usize = 12;

/// The coarsest refinement of `classes` that can be proved by induction over
/// one scan, within what single questions may cost.
pub(crate) fn corresponding(
    framing: &Framing<'_>,
    mut classes: Classes,
    meter: &mut Meter,
) -> Result<Classes, Why> {
    let netlist = framing.netlist;
    for node in 1..netlist.size() {
        if !framing.may_merge(node) {
            classes.detach(node);
        }
    }
    let mut random = Random::new(2);
    while refine(framing, &mut classes, Start::Initial, &mut random, meter)? {}
    while refine(framing, &mut classes, Start::Anywhere, &mut random, meter)? {}
    Ok(classes)
}

/// Which scan is looked at.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Start {
    /// The first.
    Initial,
    /// One after any other that satisfies the classes.
    Anywhere,
}

/// Checks every candidate in one scan and splits the classes that fail: whether
/// any did.
fn refine(
    framing: &Framing<'_>,
    classes: &mut Classes,
    start: Start,
    random: &mut Random,
    meter: &mut Meter,
) -> Result<bool, Why> {
    let netlist = framing.netlist;
    let mut graph = Graph::default();
    let mut solver = Solver::default();
    let mut before = None;
    let state: Vec<Signal> = match start {
        Start::Initial => netlist
            .latches
            .iter()
            .map(|latch| match latch.initial.value() {
                Some(value) => Signal::constant(value),
                None => graph.leaf(),
            })
            .collect(),
        Start::Anywhere => {
            let frame = framing.frame(&mut graph, classes, State::Any, meter)?;
            framing.constrain(&frame, &graph, &mut solver, meter)?;
            framing.suppose(&frame, &mut graph, &mut solver, meter)?;
            let next = frame.next(netlist);
            before = Some(frame);
            next
        }
    };
    let frame = framing.frame(&mut graph, classes, State::Is(&state), meter)?;
    framing.constrain(&frame, &graph, &mut solver, meter)?;
    let mut has_failed = false;
    for &(node, own, by) in &frame.obligations {
        if own == by {
            continue;
        }
        if classes.0[node].node() == node || frame.of(classes.0[node]) != by {
            // Split by an earlier counterexample; looked at in the next round.
            continue;
        }
        let differ = graph.xor(own, by);
        let mut question = meter.clone();
        question.left = question.left.min(QUESTION);
        let given = question.left;
        let answer = solver.ask(&graph, &[differ], &mut question);
        let stopped = meter.spend((given - question.left) as usize);
        match answer {
            Ok(Answer::No) => solver.assert(&graph, !differ, meter)?,
            Ok(Answer::Yes) => {
                let first = before.as_ref();
                let seen = Counterexample {
                    netlist,
                    values: graph.values(|leaf| solver.value(leaf) == Some(true)),
                    state: &state,
                };
                seen.split(classes, first, &frame, random, meter)?;
                has_failed = true;
                if classes.0[node].node() != node && frame.of(classes.0[node]) == by {
                    classes.detach(node);
                }
            }
            Err(Why::Steps) => {
                stopped?;
                classes.detach(node);
                has_failed = true;
            }
            Err(why) => return Err(why),
        }
        stopped?;
    }
    Ok(has_failed)
}

/// Two scans that the solver found, or the first scan alone.
struct Counterexample<'s> {
    netlist: &'s Netlist,
    /// The value of every node of the graph.
    values: Vec<bool>,
    state: &'s [Signal],
}

impl Counterexample<'_> {
    /// Splits the classes by what happens in the last scan; in all lanes but
    /// one some inputs are others than those found, where constraints allow it.
    ///
    /// The scan now satisfies the classes, so they must also hold in any that
    /// follows it, and a few of these are tried as well: a counterexample that
    /// is seldom found splits all that it can.
    fn split(
        &self,
        classes: &mut Classes,
        before: Option<&Frame>,
        frame: &Frame,
        random: &mut Random,
        meter: &mut Meter,
    ) -> Result<(), Why> {
        let mut lanes = Lanes::new(self.netlist, || [0; WORDS]);
        let latches = self.netlist.latches.iter();
        match before {
            None => {
                for (latch, &signal) in latches.zip(self.state) {
                    lanes.set(latch.signal, self.spread(signal));
                }
            }
            Some(before) => {
                for latch in latches {
                    lanes.set(latch.signal, self.spread(before.of(latch.signal)));
                }
                for (input, &signal) in self.netlist.inputs.iter().zip(&before.inputs) {
                    lanes.set(input.signal, self.spread(signal));
                }
                lanes.solve();
                lanes.advance();
            }
        }
        let mut inputs: Vec<Word> = frame.inputs.iter().map(|&it| self.spread(it)).collect();
        let mut allowed = ALL;
        for scan in 0..=FURTHER {
            meter.spend(2 * self.netlist.size())?;
            for (input, word) in self.netlist.inputs.iter().zip(&mut inputs) {
                let mut others: Word = std::array::from_fn(|at| random.rare(at as u32 + 1));
                if scan == 0 {
                    others[0] &= !1;
                }
                *word = zip(word, &others, |a, b| a ^ b);
                lanes.set(input.signal, *word);
            }
            lanes.solve();
            allowed = zip(&allowed, &lanes.allowed(), |a, b| a & b);
            classes.refine(&lanes, &allowed);
            lanes.advance();
        }
        Ok(())
    }

    fn spread(&self, signal: Signal) -> Word {
        let value = self.values[signal.node()] != signal.is_complement();
        [0_u64.wrapping_sub(value.into()); WORDS]
    }
}
