//! Random transition systems, described so simply that they can be run without
//! the code under test, and built in many ways that all mean the same.

use proof::{Gates, Initial, Netlist, Signal};
use proptest::prelude::*;

/// A system: what is computed in a scan, in order.
#[derive(Clone, Debug)]
pub struct Plan {
    pub inputs: usize,
    /// What each latch holds first (nothing: either), and then takes.
    pub latches: Vec<(Option<bool>, Operand)>,
    pub steps: Vec<Step>,
    pub outputs: Vec<Operand>,
    pub constraints: Vec<Operand>,
}

/// A value computed before, by its number modulo how many there are: inputs,
/// latches, steps. The flag complements it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Operand(pub u8, pub bool);

/// One value out of others.
#[derive(Clone, Copy, Debug)]
pub enum Step {
    And(Operand, Operand),
    Xor(Operand, Operand),
    Ite(Operand, Operand, Operand),
}

fn operand() -> impl Strategy<Value = Operand> + Clone {
    (any::<u8>(), any::<bool>()).prop_map(|(number, complement)| Operand(number, complement))
}

fn step() -> impl Strategy<Value = Step> {
    prop_oneof![
        4 => (operand(), operand()).prop_map(|(a, b)| Step::And(a, b)),
        1 => (operand(), operand()).prop_map(|(a, b)| Step::Xor(a, b)),
        2 => (operand(), operand(), operand()).prop_map(|(a, b, c)| Step::Ite(a, b, c)),
    ]
}

/// Small systems.
pub fn plans(latches: usize, steps: usize) -> impl Strategy<Value = Plan> {
    let initial = prop_oneof![
        5 => Just(Some(false)),
        2 => Just(Some(true)),
        1 => Just(None),
    ];
    let latch = (initial, operand());
    (
        1..=3_usize,
        prop::collection::vec(latch, 1..=latches),
        prop::collection::vec(step(), 2..=steps),
        prop::collection::vec(operand(), 1..=3),
        prop_oneof![2 => Just(0), 1 => Just(1), 1 => Just(2)],
        prop::collection::vec((operand(), operand()), 2),
    )
        .prop_map(
            |(inputs, latches, mut steps, outputs, constrained, pairs)| {
                // A constraint that is a sum of two values leaves something possible.
                let constraints: Vec<Operand> = pairs[..constrained]
                    .iter()
                    .map(|&(a, b)| {
                        steps.push(Step::And(a, b));
                        Operand((inputs + latches.len() + steps.len() - 1) as u8, true)
                    })
                    .collect();
                Plan {
                    inputs,
                    latches,
                    steps,
                    outputs,
                    constraints,
                }
            },
        )
}

impl Plan {
    fn place(&self, operand: Operand, known: usize) -> usize {
        operand.0 as usize % known
    }

    /// Number of values of a scan.
    fn values(&self) -> usize {
        self.inputs + self.latches.len() + self.steps.len()
    }

    /// All values of a scan, one bit each.
    pub fn run(&self, inputs: u32, state: u32) -> Vec<bool> {
        let mut values: Vec<bool> = (0..self.inputs).map(|at| inputs >> at & 1 == 1).collect();
        values.extend((0..self.latches.len()).map(|at| state >> at & 1 == 1));
        for step in &self.steps {
            let of = |operand: Operand| values[self.place(operand, values.len())] != operand.1;
            values.push(match *step {
                Step::And(a, b) => of(a) && of(b),
                Step::Xor(a, b) => of(a) != of(b),
                Step::Ite(a, b, c) => {
                    if of(a) {
                        of(b)
                    } else {
                        of(c)
                    }
                }
            });
        }
        values
    }

    /// One of the values of a scan.
    pub fn value(&self, operand: Operand, values: &[bool]) -> bool {
        values[self.place(operand, self.values())] != operand.1
    }

    /// All states before the first scan.
    pub fn initial(&self) -> Vec<u32> {
        let mut states = vec![0];
        for (at, (initial, _)) in self.latches.iter().enumerate() {
            states = match initial {
                Some(value) => states
                    .iter()
                    .map(|state| state | u32::from(*value) << at)
                    .collect(),
                None => states
                    .iter()
                    .flat_map(|state| [*state, state | 1 << at])
                    .collect(),
            };
        }
        states
    }

    /// The state after a scan.
    pub fn next(&self, values: &[bool]) -> u32 {
        let latches = self.latches.iter().enumerate();
        latches.fold(0, |state, (at, (_, next))| {
            state | u32::from(self.value(*next, values)) << at
        })
    }

    /// The system with one thing changed.
    pub fn with_fault(&self, place: u8, way: Operand) -> Self {
        let mut plan = self.clone();
        let fixed = plan.constraints.len();
        let steps = plan.steps.len() - fixed;
        let at = place as usize % (steps + plan.latches.len());
        let Operand(number, is_complement) = way;
        match plan.steps[..steps].get_mut(at) {
            Some(step) => {
                *step = match (*step, is_complement) {
                    (Step::And(a, b), true) => Step::And(Operand(a.0, !a.1), b),
                    (Step::And(a, _), false) => Step::And(a, way),
                    (Step::Xor(a, b), true) => Step::And(a, b),
                    (Step::Xor(a, _), false) => Step::Xor(a, way),
                    (Step::Ite(a, b, c), true) => Step::Ite(a, c, b),
                    (Step::Ite(a, b, _), false) => Step::Ite(a, b, way),
                };
            }
            None => {
                let latch = &mut plan.latches[at - steps];
                match number % 2 {
                    0 => latch.0 = latch.0.map(|value| !value),
                    _ => latch.1 = way,
                }
            }
        }
        plan
    }

    /// The netlist, built in the manner that `manner` picks: latches may hold
    /// the complement of their value or be there twice, and gates take detours.
    pub fn build(&self, manner: u64) -> Netlist {
        let mut picks = manner;
        let mut pick = move |ways: u64| {
            picks = picks
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            if manner == 0 { 0 } else { (picks >> 33) % ways }
        };
        let mut netlist = Netlist::default();
        let inputs: Vec<Signal> = (0..self.inputs)
            .map(|at| netlist.input(format!("i{at}")))
            .collect();
        let mut signals = inputs.clone();
        let mut latches = Vec::new();
        for (at, (initial, _)) in self.latches.iter().enumerate() {
            let is_complement = pick(3) == 1;
            let initial = match initial {
                Some(value) => Initial::from(*value != is_complement),
                None => Initial::Free,
            };
            // Two copies of a latch that starts with either value would differ.
            let copies = if initial == Initial::Free {
                1
            } else {
                1 + pick(3) / 2
            };
            let mut read = Signal::FALSE;
            for copy in 0..copies {
                let latch = netlist.latch(format!("l{at}.{copy}"), initial);
                read = if is_complement { !latch } else { latch };
                latches.push((at, read));
            }
            signals.push(read);
        }
        for step in &self.steps {
            let of = |operand: Operand| {
                let signal = signals[operand.0 as usize % signals.len()];
                if operand.1 { !signal } else { signal }
            };
            let detour = signals[pick(signals.len() as u64) as usize];
            let mut signal = match *step {
                Step::And(a, b) => netlist.and(of(a), of(b)),
                Step::Xor(a, b) => netlist.xor(of(a), of(b)),
                Step::Ite(a, b, c) => netlist.ite(of(a), of(b), of(c)),
            };
            if pick(3) == 1 {
                // x = x*d + x*/d
                let with = netlist.and(signal, detour);
                let without = netlist.and(signal, !detour);
                signal = netlist.or(with, without);
            }
            signals.push(signal);
        }
        let of = |operand: Operand| {
            let signal = signals[operand.0 as usize % signals.len()];
            if operand.1 { !signal } else { signal }
        };
        for (at, read) in latches {
            netlist.set_next(read, of(self.latches[at].1));
        }
        for (at, output) in self.outputs.iter().enumerate() {
            netlist.output(format!("o{at}"), of(*output));
        }
        for constraint in &self.constraints {
            netlist.constrain(of(*constraint));
        }
        netlist
    }
}
