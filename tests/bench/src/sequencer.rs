//! Rows of sequencers: what proof engines are compared on.
//!
//! Each row is a cycle of eight steps; step k is left for the next one when the
//! row's input k+1 is 1. The steps drive three actions. All rows run at once, so
//! that the number of states is up to eight to the power of the rows. The same
//! behaviour is built in three ways.

use proof::{Gates, Netlist, Signal};

/// Steps in a row.
pub const STEPS: usize = 8;

/// How the steps of a row are kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Encoding {
    /// A latch for each step, which takes `enter + step */leave`.
    OneHot,
    /// A latch for each step; transitions clear the step before them, and what
    /// clears wins: `(step + enter) */clear`. It behaves as the first only
    /// because never two steps are active at once.
    Cleared,
    /// A register of three bits that counts, and is decoded. Three latches a
    /// row instead of eight.
    Register,
}

/// One thing that is wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fault {
    /// In this row,
    pub row: usize,
    /// this step is left also when the input of the step after it is 1.
    pub step: usize,
}

/// What rows have to do with each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coupling {
    /// Nothing.
    Alone,
    /// Each leaves its first step only while the row before it is in its step 4,
    /// and a stop button keeps all of them where they are.
    Waiting,
}

/// Rows of sequencers.
#[derive(Clone, Copy, Debug)]
pub struct Rows {
    /// How many.
    pub count: usize,
    /// How their steps are kept.
    pub encoding: Encoding,
    /// What they have to do with each other.
    pub coupling: Coupling,
    /// What is wrong.
    pub fault: Option<Fault>,
}

impl Rows {
    /// The rows as a transition system.
    pub fn netlist(&self) -> Netlist {
        let mut netlist = Netlist::default();
        let goes = match self.coupling {
            Coupling::Alone => Signal::TRUE,
            Coupling::Waiting => !netlist.input("stop"),
        };
        let mut before = Signal::TRUE;
        for row in 0..self.count {
            let steps = self.row(&mut netlist, row, goes, before);
            if self.coupling == Coupling::Waiting {
                before = steps[STEPS / 2];
            }
            let actions = [
                vec![steps[1], steps[2], steps[3]],
                vec![steps[4], steps[6]],
                vec![steps[7]],
            ];
            for (at, steps) in actions.iter().enumerate() {
                let action = netlist.any(steps);
                netlist.output(format!("r{row}a{at}"), action);
            }
        }
        netlist
    }

    /// The steps of a row, which `goes` on while the row `before` it lets it.
    fn row(&self, netlist: &mut Netlist, row: usize, goes: Signal, before: Signal) -> Vec<Signal> {
        let inputs: Vec<Signal> = (0..STEPS)
            .map(|step| netlist.input(format!("r{row}t{step}")))
            .collect();
        let leaves: Vec<Signal> = (0..STEPS)
            .map(|step| {
                let own = inputs[(step + 1) % STEPS];
                let asked = match self.fault {
                    Some(fault) if (fault.row, fault.step) == (row, step) => {
                        netlist.or(own, inputs[(step + 2) % STEPS])
                    }
                    _ => own,
                };
                let waits = if step == 0 { before } else { Signal::TRUE };
                netlist.all(&[asked, goes, waits])
            })
            .collect();
        match self.encoding {
            Encoding::Register => register(netlist, row, &leaves),
            _ => latches(netlist, row, &leaves, self.encoding),
        }
    }
}

fn latches(
    netlist: &mut Netlist,
    row: usize,
    leaves: &[Signal],
    encoding: Encoding,
) -> Vec<Signal> {
    let steps: Vec<Signal> = (0..STEPS)
        .map(|step| netlist.latch(format!("r{row}x{step}"), step == 0))
        .collect();
    let ends: Vec<Signal> = (0..STEPS)
        .map(|step| netlist.and(steps[step], leaves[step]))
        .collect();
    for step in 0..STEPS {
        let enters = ends[(step + STEPS - 1) % STEPS];
        let next = if encoding == Encoding::OneHot {
            let stays = netlist.and(steps[step], !leaves[step]);
            netlist.or(enters, stays)
        } else {
            let active = netlist.or(steps[step], enters);
            netlist.and(active, !ends[step])
        };
        netlist.set_next(steps[step], next);
    }
    steps
}

fn register(netlist: &mut Netlist, row: usize, leaves: &[Signal]) -> Vec<Signal> {
    let bits: Vec<Signal> = (0..3)
        .map(|bit| netlist.latch(format!("r{row}b{bit}"), false))
        .collect();
    let steps: Vec<Signal> = (0..STEPS)
        .map(|step| {
            let literals: Vec<Signal> = (0..3)
                .map(|bit| {
                    if step >> bit & 1 == 1 {
                        bits[bit]
                    } else {
                        !bits[bit]
                    }
                })
                .collect();
            netlist.all(&literals)
        })
        .collect();
    let ends: Vec<Signal> = (0..STEPS)
        .map(|step| netlist.and(steps[step], leaves[step]))
        .collect();
    let mut carry = netlist.any(&ends);
    for &bit in &bits {
        let next = netlist.xor(bit, carry);
        carry = netlist.and(bit, carry);
        netlist.set_next(bit, next);
    }
    steps
}
