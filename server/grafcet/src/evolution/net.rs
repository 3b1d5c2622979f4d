//! A grafcet with numbers in place of names: what a machine runs.
//!
//! Steps, variables, edges and parts are known by their places in lists. A
//! macro-step holds no activity of its own: its variable is true while some
//! step of its expansion is active, and an arc to or from it is one to the
//! expansion's entry or from its exit.

use std::collections::HashMap;

use logic::{Datum, Name};

use super::condition::{Condition, Edge, View};
use super::term::Term;

/// A grafcet with numbers in place of names.
#[derive(Clone, Debug, Default)]
pub struct Net {
    /// All steps, in the order they are declared.
    pub steps: Vec<Step>,
    /// Steps by name.
    pub step_names: HashMap<Name, usize>,
    /// The names of all variables.
    pub variables: Vec<Name>,
    /// Variables by name.
    pub variable_names: HashMap<Name, usize>,
    /// Variables by their addresses, in capital letters.
    pub addresses: HashMap<String, usize>,
    /// Variables that are published, in the order they are declared.
    pub outputs: Vec<usize>,
    /// Transitions, in the order of the text.
    pub transitions: Vec<Transition>,
    /// Inner edges stand before the edges that look at them.
    pub edges: Vec<Edge>,
    /// How many of them are sampled when a scan begins. The others stand in
    /// conditions of continuous actions, and are sampled when these are.
    pub sampled_first: usize,
    /// Stored actions, in the order in which those of one moment are performed.
    pub stored: Vec<Stored>,
    /// Outputs with continuous actions, those first that others depend on.
    pub continuous: Vec<Vec<Continuous>>,
    /// Whether a variable is the output of a continuous action.
    pub is_continuous: Vec<bool>,
    /// Whether a variable is the grafcet's own: an action writes it, or it is
    /// declared as an output.
    pub is_own: Vec<bool>,
    /// Forcing orders, in the order of the text.
    pub orders: Vec<Order>,
    /// Partial grafcets and expansions.
    pub parts: Vec<Part>,
}

/// A step.
#[derive(Clone, Debug)]
pub struct Step {
    /// Its name.
    pub name: Name,
    /// Whether it is active in the initial situation.
    pub is_initial: bool,
    /// What it is.
    pub kind: Kind,
}

/// What a step is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A step that holds its own activity.
    Plain,
    /// A macro-step with an expansion.
    Macro(Expansion),
    /// An enclosing step, with the parts that it encloses.
    Enclosing(Vec<usize>),
}

/// What stands for a macro-step, down to steps that hold activity.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Expansion {
    /// The step that entering it activates.
    pub entry: Option<usize>,
    /// The step that enables what comes after it.
    pub exit: Option<usize>,
    /// The steps that it is active with.
    pub steps: Vec<usize>,
}

/// A transition.
#[derive(Clone, Debug)]
pub struct Transition {
    /// Its name.
    pub name: Name,
    /// `None` if a step before it does not exist: then nothing enables it.
    pub from: Option<Vec<usize>>,
    /// The steps after it.
    pub to: Vec<usize>,
    /// Its condition.
    pub receptivity: Condition,
    /// The part it belongs to; none for the main chart.
    pub part: Option<usize>,
}

/// A stored action.
#[derive(Clone, Debug)]
pub struct Stored {
    /// The step it belongs to.
    pub step: usize,
    /// When it is performed.
    pub on: On,
    /// What must hold then.
    pub condition: Condition,
    /// What it writes.
    pub variable: usize,
    /// What it writes there.
    pub effect: Effect,
}

/// The event of a stored action.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum On {
    /// Its step is activated.
    Activation,
    /// Its step is deactivated.
    Deactivation,
    /// When this edge occurs.
    Event(usize),
}

/// What a stored action writes, in the order in which those of one moment are
/// performed.
#[derive(Clone, Debug, PartialEq)]
pub enum Effect {
    /// The value of a term.
    Assign(Term),
    /// On.
    Set,
    /// Off.
    Reset,
}

impl Effect {
    /// Its place among those of one moment.
    pub(super) fn rank(&self) -> u8 {
        match self {
            Self::Assign(_) => 0,
            Self::Set => 1,
            Self::Reset => 2,
        }
    }
}

/// An output with all its continuous actions: it is on while one of them acts.
#[derive(Clone, Debug)]
pub struct Continuous {
    /// The output.
    pub variable: usize,
    /// The step and what else must hold.
    pub acts: Vec<(usize, Condition)>,
    /// The edges in what must hold, which compare one stable situation with
    /// the next.
    pub edges: Vec<usize>,
}

/// A forcing order.
#[derive(Clone, Debug)]
pub struct Order {
    /// The step that gives it.
    pub step: usize,
    /// What else must hold.
    pub condition: Condition,
    /// The part that is forced.
    pub part: usize,
    /// The situation that it imposes.
    pub situation: Imposed,
}

/// A situation that an order imposes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Imposed {
    /// These steps and no others.
    Steps(Vec<usize>),
    /// The one it is in.
    Current,
    /// The initial one.
    Initial,
}

/// A partial grafcet or expansion.
#[derive(Clone, Debug, Default)]
pub struct Part {
    /// Steps that hold activity, those of expansions below it included.
    pub owned: Vec<usize>,
    /// Steps that the activation of an enclosing step activates.
    pub linked: Vec<usize>,
    /// The steps that enclose it; without one it is always free to run.
    pub enclosed_by: Vec<usize>,
    /// The macro-steps that it expands.
    pub expands: Vec<usize>,
    /// The parts whose forcing freezes it: itself, and those that hold the
    /// macro-steps that it expands.
    pub frozen_with: Vec<usize>,
}

impl Net {
    /// The step that is activated where an arc leads to `step`.
    pub fn entry(&self, step: usize) -> Option<usize> {
        match &self.steps.get(step)?.kind {
            Kind::Macro(expansion) => expansion.entry,
            _ => Some(step),
        }
    }

    /// The step that must be active where an arc leads from `step`.
    pub fn exit(&self, step: usize) -> Option<usize> {
        match &self.steps.get(step)?.kind {
            Kind::Macro(expansion) => expansion.exit,
            _ => Some(step),
        }
    }

    /// The variable called `name`, or the one that has it as its address.
    pub fn variable(&self, name: &str) -> Option<usize> {
        let named = self.variable_names.get(name);
        let addressed = || match name.starts_with('%') {
            true => self.addresses.get(&name.to_ascii_uppercase()),
            false => None,
        };
        named.or_else(addressed).copied()
    }
}

/// What changes while a grafcet runs.
#[derive(Clone, Debug, Default)]
pub(super) struct State {
    /// By step; for a macro-step whether its expansion is active.
    pub(super) active: Vec<bool>,
    /// When each step was activated last, in milliseconds of the clock.
    pub(super) since: Vec<u64>,
    /// By variable, as everything reads it.
    pub(super) values: Vec<Datum>,
    /// What stored actions have made of outputs that have continuous actions
    /// too.
    pub(super) kept: Vec<bool>,
    /// What each edge looked at, when it looked last.
    pub(super) looked_at: Vec<bool>,
    /// The order that each part obeys.
    pub(super) obeyed: Vec<Option<usize>>,
}

impl State {
    /// What expressions see at a moment in which these edges occur.
    pub(super) fn view<'s>(&'s self, edges: &'s [bool], now: u64) -> View<'s> {
        View {
            active: &self.active,
            since: &self.since,
            values: &self.values,
            edges,
            now,
        }
    }

    /// Whether nothing differs. A number that is none (NaN) is the same as
    /// itself here, unlike where numbers are compared.
    pub(super) fn is_same(&self, other: &Self) -> bool {
        self.active == other.active
            && self.since == other.since
            && self.kept == other.kept
            && self.obeyed == other.obeyed
            && self.looked_at == other.looked_at
            && self.has_values_of(other)
    }

    pub(super) fn has_values_of(&self, other: &Self) -> bool {
        let mut pairs = self.values.iter().zip(&other.values);
        pairs.all(|(own, other)| own.key() == other.key())
    }

    /// The state as numbers, equal where states are the same; without what
    /// edges looked at, which does not change within a scan.
    pub(super) fn key(&self) -> Vec<u64> {
        let active = self.active.chunks(64).map(word);
        let kept = self.kept.chunks(64).map(word);
        let values = self.values.iter().flat_map(|value| value.key());
        let obeyed = self.obeyed.iter();
        let obeyed = obeyed.map(|order| order.map_or(0, |at| at as u64 + 1));
        let since = self.since.iter().copied();
        let all = active.chain(kept).chain(values).chain(obeyed).chain(since);
        all.collect()
    }
}

fn word(bits: &[bool]) -> u64 {
    let bits = bits.iter().rev();
    bits.fold(0, |word, bit| word << 1 | u64::from(*bit))
}
