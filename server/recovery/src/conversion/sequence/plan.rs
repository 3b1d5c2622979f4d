use std::collections::BTreeSet;

use logic::{AtomId, Function, Name};

/// A sequence, planned but not yet worded.
pub(in crate::conversion) struct Plan {
    pub(super) steps: Vec<PlannedStep>,
    pub(super) arcs: Vec<PlannedArc>,
    pub(super) members: BTreeSet<AtomId>,
    /// Whether several of its steps can be active at once.
    pub(in crate::conversion) forks: bool,
}

/// A step, of a state or waiting between states.
pub(super) struct PlannedStep {
    pub(super) name: Name,
    pub(super) initial: bool,
    pub(super) state: Option<AtomId>,
    pub(super) comment: Option<Name>,
}

/// A transition whose condition is not in words yet.
pub(super) struct PlannedArc {
    pub(super) label: String,
    pub(super) from: Vec<Name>,
    pub(super) to: Vec<Name>,
    pub(super) condition: Function,
}

impl Plan {
    /// Whether a state belongs to the sequence.
    pub(in crate::conversion) fn holds(&self, state: AtomId) -> bool {
        self.members.contains(&state)
    }
}
