use ladder::scan::Power;
use logic::{Datum, Name};

use super::sides::{Ladder, Powers, Spec};

/// What is in ladder and grafcet after a scan: any value, not only what is
/// shown of a run, and the power that was in the rungs.
#[derive(Clone, Debug)]
pub struct Moment<'s> {
    pub(super) ladder: Option<Ladder<'s>>,
    pub(super) spec: Option<Spec>,
    pub(super) powers: Powers,
}

impl Moment<'_> {
    /// The value in the ladder of a variable that it knows, by name or address,
    /// or of a term.
    pub fn in_ladder(&self, name: &str) -> Option<Datum> {
        self.ladder.as_ref()?.value(name)
    }

    /// The value in the grafcet of a variable or step that it knows.
    pub fn in_grafcet(&self, name: &str) -> Option<Datum> {
        let machine = &self.spec.as_ref()?.machine;
        machine.knows(name).then(|| machine.value(name))
    }

    /// The active steps, in the order they are declared.
    pub fn active(&self) -> impl Iterator<Item = &Name> {
        let machine = self.spec.iter().map(|spec| &spec.machine);
        machine.flat_map(grafcet::evolution::Machine::active)
    }

    /// The power that was in a rung when the scan solved it, by routine and
    /// place there; `None` of one that the scan left out.
    pub fn power(&self, routine: usize, rung: usize) -> Option<&Power> {
        self.powers.get(&(routine, rung))
    }
}
