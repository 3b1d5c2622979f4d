//! Ladder and grafcet as one transition system, by scans or by settled inputs.
//!
//! In `scan` timing a step of the system is a scan. In `settled` timing it is as
//! many scans as are needed until one more changes nothing, all with the same
//! inputs; no time passes after the first of them. How many that are is not
//! known at first, as with the evolutions of a grafcet: so many are followed as
//! are asked for, and a signal says whether another would still change anything.

use proof::{Gates, Netlist, Placed, Signal};

use crate::Timing;
use crate::chart::Evolved;
use crate::inputs::Source;
use crate::program::Bounds;
use crate::refusal::Refusal;

/// The system, step by step.
pub(crate) struct Frame {
    pub(crate) netlist: Netlist,
    /// Where the signals of a scan are; as they are where a step is a scan.
    last: Option<Placed>,
    /// Whether the grafcet finds no stable situation in some scan.
    pub(crate) unstable: Signal,
    /// Whether another scan would still change something.
    pub(crate) restless: Signal,
}

impl Frame {
    /// The system of one scan, which it takes over, in steps of this timing, where
    /// a step is followed through so many scans.
    pub(crate) fn new(
        evolved: &mut Evolved,
        timing: Timing,
        scans: usize,
        bounds: &Bounds,
    ) -> Result<Self, Refusal> {
        let scan = std::mem::take(&mut evolved.netlist);
        match timing {
            Timing::Scan => Ok(Self {
                netlist: scan,
                last: None,
                unstable: evolved.unstable,
                restless: Signal::FALSE,
            }),
            Timing::Settled => Self::settled(evolved, &scan, scans, bounds),
        }
    }

    fn settled(
        evolved: &Evolved,
        scan: &Netlist,
        scans: usize,
        bounds: &Bounds,
    ) -> Result<Self, Refusal> {
        bounds.is_wanted()?;
        let mut netlist = Netlist::default();
        let inputs = scan
            .inputs()
            .iter()
            .map(|it| netlist.input(it.name.clone()));
        let inputs: Vec<Signal> = inputs.collect();
        let latches = scan
            .latches()
            .iter()
            .map(|it| netlist.latch(it.name.clone(), it.initial));
        let latches: Vec<Signal> = latches.collect();
        bounds.look(&netlist)?;
        // Time passes in the first scan only.
        let passes = |source: &Source| matches!(source, Source::Event(_) | Source::Elapsed { .. });
        let sources = evolved.inputs.sources.iter().zip(&inputs);
        let rested = sources.map(|(source, signal)| match passes(source) {
            true => Signal::FALSE,
            false => *signal,
        });
        let rested: Vec<Signal> = rested.collect();
        let mut now = latches.clone();
        let mut unstable = Vec::new();
        let mut first = true;
        let mut run = |netlist: &mut Netlist, now: &[Signal]| {
            let inputs = if first { &inputs } else { &rested };
            first = false;
            let look = |netlist: &Netlist| bounds.look(netlist);
            let placed = netlist.try_place(scan, inputs, now, look)?;
            let next = scan.latches().iter().map(|latch| placed.of(latch.next));
            Ok((next.collect::<Vec<Signal>>(), placed))
        };
        let (next, mut last) = run(&mut netlist, &now)?;
        unstable.push(last.of(evolved.unstable));
        now = next;
        for _ in 1..scans {
            let (next, placed) = run(&mut netlist, &now)?;
            unstable.push(placed.of(evolved.unstable));
            (now, last) = (next, placed);
        }
        let (further, _) = run(&mut netlist, &now)?;
        let differ = now.iter().zip(&further);
        bounds.look(&netlist)?;
        let differ: Vec<Signal> = differ
            .map(|(one, other)| netlist.xor(*one, *other))
            .collect();
        for (latch, next) in latches.iter().zip(&now) {
            netlist.set_next(*latch, *next);
        }
        Ok(Self {
            unstable: netlist.any(&unstable),
            restless: netlist.any(&differ),
            last: Some(last),
            netlist,
        })
    }

    /// What a signal of a scan is at the end of a step.
    pub(crate) fn of(&self, signal: Signal) -> Signal {
        match &self.last {
            Some(placed) => placed.of(signal),
            None => signal,
        }
    }
}
