//! Rows of sequencers: what proof engines are compared on.
//!
//! Each row is a cycle of eight steps; step k is left for the next one when the
//! row's input k+1 is 1. The steps drive three actions. All rows run at once
//! and know nothing of each other, so that the number of states is eight to the
//! power of the rows. The same behaviour is built in three ways.

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

/// So many rows in an encoding.
pub fn rows(rows: usize, encoding: Encoding, fault: Option<Fault>) -> Netlist {
    let mut netlist = Netlist::default();
    for row in 0..rows {
        let inputs: Vec<Signal> = (0..STEPS)
            .map(|step| netlist.input(format!("r{row}t{step}")))
            .collect();
        let leaves: Vec<Signal> = (0..STEPS)
            .map(|step| {
                let own = inputs[(step + 1) % STEPS];
                match fault {
                    Some(fault) if (fault.row, fault.step) == (row, step) => {
                        netlist.or(own, inputs[(step + 2) % STEPS])
                    }
                    _ => own,
                }
            })
            .collect();
        let steps = match encoding {
            Encoding::Register => register(&mut netlist, row, &leaves),
            _ => latches(&mut netlist, row, &leaves, encoding),
        };
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
