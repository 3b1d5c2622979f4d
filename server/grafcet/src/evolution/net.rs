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

#[derive(Clone, Debug, Default)]
pub(super) struct Net {
    pub(super) steps: Vec<Step>,
    pub(super) step_names: HashMap<Name, usize>,
    pub(super) variables: Vec<Name>,
    pub(super) variable_names: HashMap<Name, usize>,
    /// Variables by their addresses, in capital letters.
    pub(super) addresses: HashMap<String, usize>,
    /// Variables that are published, in the order they are declared.
    pub(super) outputs: Vec<usize>,
    pub(super) transitions: Vec<Transition>,
    /// Inner edges stand before the edges that look at them.
    pub(super) edges: Vec<Edge>,
    /// How many of them are sampled when a scan begins. The others stand in
    /// conditions of continuous actions, and are sampled when these are.
    pub(super) sampled_first: usize,
    pub(super) stored: Vec<Stored>,
    /// Outputs with continuous actions, those first that others depend on.
    pub(super) continuous: Vec<Vec<Continuous>>,
    /// Whether a variable is the output of a continuous action.
    pub(super) is_continuous: Vec<bool>,
    pub(super) orders: Vec<Order>,
    pub(super) parts: Vec<Part>,
}

#[derive(Clone, Debug)]
pub(super) struct Step {
    pub(super) name: Name,
    pub(super) is_initial: bool,
    pub(super) kind: Kind,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Plain,
    /// A macro-step with an expansion.
    Macro(Expansion),
    /// An enclosing step, with the parts that it encloses.
    Enclosing(Vec<usize>),
}

/// What stands for a macro-step, down to steps that hold activity.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Expansion {
    pub(super) entry: Option<usize>,
    pub(super) exit: Option<usize>,
    pub(super) steps: Vec<usize>,
}

#[derive(Clone, Debug)]
pub(super) struct Transition {
    pub(super) name: Name,
    /// `None` if a step before it does not exist: then nothing enables it.
    pub(super) from: Option<Vec<usize>>,
    pub(super) to: Vec<usize>,
    pub(super) receptivity: Condition,
    /// The part it belongs to; none for the main chart.
    pub(super) part: Option<usize>,
}

/// A stored action.
#[derive(Clone, Debug)]
pub(super) struct Stored {
    pub(super) step: usize,
    pub(super) on: On,
    pub(super) condition: Condition,
    pub(super) variable: usize,
    pub(super) effect: Effect,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum On {
    Activation,
    Deactivation,
    /// When this edge occurs.
    Event(usize),
}

/// In the order in which those of one moment are performed.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Effect {
    Assign(Term),
    Set,
    Reset,
}

impl Effect {
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
pub(super) struct Continuous {
    pub(super) variable: usize,
    /// The step and what else must hold.
    pub(super) acts: Vec<(usize, Condition)>,
    /// The edges in what must hold, which compare one stable situation with
    /// the next.
    pub(super) edges: Vec<usize>,
}

/// A forcing order.
#[derive(Clone, Debug)]
pub(super) struct Order {
    pub(super) step: usize,
    pub(super) condition: Condition,
    pub(super) part: usize,
    pub(super) situation: Imposed,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Imposed {
    Steps(Vec<usize>),
    Current,
    Initial,
}

#[derive(Clone, Debug, Default)]
pub(super) struct Part {
    /// Steps that hold activity, those of expansions below it included.
    pub(super) owned: Vec<usize>,
    /// Steps that the activation of an enclosing step activates.
    pub(super) linked: Vec<usize>,
    /// The steps that enclose it; without one it is always free to run.
    pub(super) enclosed_by: Vec<usize>,
    /// The macro-steps that it expands.
    pub(super) expands: Vec<usize>,
    /// The parts whose forcing freezes it: itself, and those that hold the
    /// macro-steps that it expands.
    pub(super) frozen_with: Vec<usize>,
}

impl Net {
    /// The step that is activated where an arc leads to `step`.
    pub(super) fn entry(&self, step: usize) -> Option<usize> {
        match &self.steps.get(step)?.kind {
            Kind::Macro(expansion) => expansion.entry,
            _ => Some(step),
        }
    }

    /// The step that must be active where an arc leads from `step`.
    pub(super) fn exit(&self, step: usize) -> Option<usize> {
        match &self.steps.get(step)?.kind {
            Kind::Macro(expansion) => expansion.exit,
            _ => Some(step),
        }
    }

    /// Whether some action writes the variable.
    pub(super) fn is_written(&self, variable: usize) -> bool {
        let mut stored = self.stored.iter();
        self.is_continuous[variable] || stored.any(|action| action.variable == variable)
    }

    /// The variable called `name`, or the one that has it as its address.
    pub(super) fn variable(&self, name: &str) -> Option<usize> {
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
