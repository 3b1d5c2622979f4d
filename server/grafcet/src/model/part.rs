use logic::Name;

use super::Chart;

/// A named piece of a grafcet with steps and transitions of its own.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Part {
    /// Its name.
    pub name: Name,
    /// What it is.
    pub kind: PartKind,
    /// Its steps, transitions and actions.
    pub chart: Chart,
}

/// What a part is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PartKind {
    /// A partial grafcet: it evolves beside the others, and can be enclosed or
    /// forced by its name (IEC 60848, clause 7).
    Partial,
    /// The expansion of a macro-step.
    Expansion {
        /// The step that the macro-step's activation activates.
        entry: Name,
        /// The step that must be active for the transitions after the
        /// macro-step to be enabled.
        exit: Name,
    },
    /// A reusable grafcet: nothing runs until an [`Instance`] names it.
    Reusable {
        /// The names in its rules that an instance replaces.
        parameters: Vec<Name>,
    },
}

/// A copy of a reusable grafcet that runs, with variables of its own.
///
/// The step `E1` of its instance `d1` is called `d1.E1`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Instance {
    /// Its name.
    pub name: Name,
    /// The reusable grafcet it copies.
    pub of: Name,
    /// The variables that take the places of the parameters, in their order.
    pub arguments: Vec<Name>,
    /// What it is for.
    pub comment: Option<Name>,
}
