use crate::{Gates, Initial, Netlist, Output, Signal};

impl Netlist {
    /// The same netlist for tools that know neither constraints nor latches
    /// whose initial value is free.
    ///
    /// Outputs and properties are 0 from the scan on in which a constraint
    /// does not hold, so what the environment excludes shows nothing. A free
    /// latch reads an input of its own in the first scan, `initial.NAME`, and
    /// looks at it never again.
    pub fn plain(&self) -> Netlist {
        let mut plain = Netlist::default();
        let inputs: Vec<Signal> = self
            .inputs
            .iter()
            .map(|input| plain.input(input.name.clone()))
            .collect();
        let is_free = |initial| initial == Initial::Free;
        let later = match self.latches.iter().any(|latch| is_free(latch.initial)) {
            true => plain.delayed("later", Signal::TRUE, false),
            false => Signal::TRUE,
        };
        let mut latches = Vec::new();
        let mut values = Vec::new();
        for latch in &self.latches {
            let initial = latch.initial.value().unwrap_or(false);
            let signal = plain.latch(latch.name.clone(), initial);
            latches.push(signal);
            values.push(match latch.initial {
                Initial::Free => {
                    let first = plain.input(format!("initial.{}", latch.name));
                    plain.ite(later, signal, first)
                }
                _ => signal,
            });
        }
        let placed = plain.place(self, &inputs, &values);
        for (latch, signal) in self.latches.iter().zip(latches) {
            plain.set_next(signal, placed.of(latch.next));
        }
        let mut allowed = Signal::TRUE;
        if !self.constraints.is_empty() {
            let before = plain.latch("allowed", true);
            let constraints = self.constraints.iter().map(|&it| placed.of(it));
            let holds: Vec<Signal> = constraints.chain([before]).collect();
            allowed = plain.all(&holds);
            plain.set_next(before, allowed);
        }
        for Output { name, signal } in &self.outputs {
            let shown = plain.and(placed.of(*signal), allowed);
            plain.output(name.clone(), shown);
        }
        for Output { name, signal } in &self.properties {
            let bad = plain.and(placed.of(*signal), allowed);
            plain.never(name.clone(), bad);
        }
        plain
    }

    /// What a file shows: the properties, if there are any, else the outputs.
    pub(crate) fn shown(&self) -> &[Output] {
        match self.properties.is_empty() {
            true => &self.outputs,
            false => &self.properties,
        }
    }
}
