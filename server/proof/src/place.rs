use std::convert::Infallible;

use crate::limits::STRIDE;
use crate::{Gates, Netlist, Signal};

/// Where the signals of a netlist came to be when its gates were placed in
/// another one.
#[derive(Clone, Debug)]
pub struct Placed(Vec<Signal>);

impl Placed {
    /// What a signal of the placed netlist is in the other.
    pub fn of(&self, signal: Signal) -> Signal {
        self.0[signal.node()].flipped(signal.is_complement())
    }
}

/// Copies the gates of a netlist into something else; see [`Netlist::place`].
///
/// `look` is asked now and then whether to go on, and sees what there is so far.
pub(crate) fn copy<G: Gates, E>(
    netlist: &Netlist,
    inputs: &[Signal],
    latches: &[Signal],
    into: &mut G,
    mut look: impl FnMut(&G) -> Result<(), E>,
) -> Result<Placed, E> {
    let mut placed = Placed(vec![Signal::FALSE; netlist.size()]);
    let leaves = netlist.inputs.iter().map(|input| input.signal);
    for (leaf, &signal) in leaves.zip(inputs) {
        placed.0[leaf.node()] = signal;
    }
    let leaves = netlist.latches.iter().map(|latch| latch.signal);
    for (leaf, &signal) in leaves.zip(latches) {
        placed.0[leaf.node()] = signal;
    }
    for node in 0..netlist.size() {
        if node.is_multiple_of(STRIDE) {
            look(into)?;
        }
        if let Some([a, b]) = netlist.graph.gate(node) {
            placed.0[node] = into.and(placed.of(a), placed.of(b));
        }
    }
    Ok(placed)
}

impl Netlist {
    /// Copies the gates of `other` into this netlist, fed by these signals:
    /// one scan of `other`.
    ///
    /// `inputs` and `latches` say what takes the place of each input and latch,
    /// in their order; missing ones are 0. Nothing else of `other` is taken
    /// over: next states, outputs, constraints and properties are asked of
    /// what is returned. Placed several times in a row, each fed by the next
    /// states of the one before, it is a run of scans within one.
    pub fn place(&mut self, other: &Netlist, inputs: &[Signal], latches: &[Signal]) -> Placed {
        let go_on = |_: &Self| Ok::<(), Infallible>(());
        let Ok(placed) = self.try_place(other, inputs, latches, go_on);
        placed
    }

    /// The same, stopped by an error of `look`, which is called again and again
    /// meanwhile and sees this netlist grow.
    pub fn try_place<E>(
        &mut self,
        other: &Netlist,
        inputs: &[Signal],
        latches: &[Signal],
        look: impl FnMut(&Self) -> Result<(), E>,
    ) -> Result<Placed, E> {
        copy(other, inputs, latches, self, look)
    }

    /// Takes `other` in as a whole: its inputs are shared by name, its latches
    /// are added under `prefix`, its constraints and properties hold here too.
    /// Its outputs are asked of what is returned.
    pub fn include(&mut self, other: &Netlist, prefix: &str) -> Placed {
        let go_on = |_: &Self| Ok::<(), Infallible>(());
        let Ok(placed) = self.try_include(other, prefix, go_on);
        placed
    }

    /// The same, stopped by an error of `look` as [`Netlist::try_place`] is.
    pub(crate) fn try_include<E>(
        &mut self,
        other: &Netlist,
        prefix: &str,
        look: impl FnMut(&Self) -> Result<(), E>,
    ) -> Result<Placed, E> {
        let inputs: Vec<Signal> = other
            .inputs
            .iter()
            .map(|input| self.input(input.name.clone()))
            .collect();
        let latches: Vec<Signal> = other
            .latches
            .iter()
            .map(|latch| self.latch(format!("{prefix}{}", latch.name), latch.initial))
            .collect();
        let placed = self.try_place(other, &inputs, &latches, look)?;
        for (latch, &signal) in other.latches.iter().zip(&latches) {
            self.set_next(signal, placed.of(latch.next));
        }
        for &constraint in &other.constraints {
            self.constrain(placed.of(constraint));
        }
        for property in &other.properties {
            self.never(property.name.clone(), placed.of(property.signal));
        }
        Ok(placed)
    }
}
