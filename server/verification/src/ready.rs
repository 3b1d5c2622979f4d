use grafcet::Spec;
use grafcet::evolution::{Machine, Net};

use crate::program::Bounds;
use crate::refusal::Refusal;

/// A spec, and its grafcet before its first scan: written out once for all who
/// follow it or run it.
pub(crate) struct Ready<'s> {
    pub(crate) spec: &'s Spec,
    pub(crate) machine: Machine,
}

impl<'s> Ready<'s> {
    pub(crate) fn new(spec: &'s Spec, bounds: &Bounds) -> Result<Self, Refusal> {
        let machine = Machine::try_new(&spec.grafcet, || bounds.is_wanted())?;
        Ok(Self { spec, machine })
    }

    /// What the grafcet runs.
    pub(crate) fn net(&self) -> &Net {
        self.machine.net()
    }
}
