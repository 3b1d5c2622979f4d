//! Which variables hold the states of a process (semantics, section 2).
//!
//! Not every memory is a state. A coil that seals in or a latch pair holds
//! one if something starts it and something ends it; but a latch that merely
//! repeats what other states say is an output with stored actions, and a coil
//! that only keeps its value because its rung is skipped holds nothing.
//!
//! The conditions of a state are *effective*: auxiliary coils that carry a
//! transition, such as `Y3 = X3*T3.DN`, are replaced by their own conditions,
//! and a timer's output by what its law adds to it. The plain conditions stay
//! in [`Conditions`]; answers show both.

mod auxiliary;
mod stored;

use std::collections::{BTreeSet, HashMap};

use logic::{AtomId, Budget, Function, Name};

use crate::conditions::{Conditions, Variable, WriteKind};

pub use auxiliary::Auxiliaries;

/// How a state is held.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Holding {
    /// By a normally open contact of the coil in its own rung.
    SealIn,
    /// By set and reset coils.
    Latch,
}

/// A state that the ladder holds in one bit.
#[derive(Clone, Debug)]
pub struct State {
    /// The variable.
    pub name: Name,
    /// Its atom.
    pub atom: AtomId,
    /// How it is held.
    pub holding: Holding,
    /// Its value after a scan, as its rungs have it.
    pub plain: Function,
    /// Its value after a scan, auxiliary coils and timer laws resolved.
    pub next: Function,
    /// What starts it: `next` with the state off.
    pub turns_on: Function,
    /// What ends it: the complement of `next` with the state on.
    pub deactivation: Function,
    /// States whose normally closed contacts stand before its coil.
    pub interlocks: Vec<AtomId>,
}

/// A state whose condition has more nodes than this is compared with no
/// other: with a condition of that size, which no person can read, every pair
/// would cost as much as all the rest of the program.
const LARGEST_COMPARED: usize = 500;

impl State {
    /// Whether the state's conditions are small enough to be compared with
    /// those of others, pair by pair.
    pub fn is_comparable(&self) -> bool {
        self.plain.nodes().max(self.next.nodes()) <= LARGEST_COMPARED
    }

    /// What starts it, as its rungs have it.
    pub fn plain_turns_on(&self) -> Function {
        self.plain.restrict(self.atom, false)
    }

    /// What ends it, as its rungs have it.
    pub fn plain_deactivation(&self) -> Function {
        self.plain.restrict(self.atom, true).not()
    }
}

/// An output that only repeats states: set on some steps, reset on others.
#[derive(Clone, Debug)]
pub struct StoredOutput {
    /// The variable.
    pub name: Name,
    /// Its atom.
    pub atom: AtomId,
    /// The condition that sets it, over states.
    pub set: Function,
    /// The condition that resets it, over states.
    pub reset: Function,
}

/// The states of a program, and what is left over.
#[derive(Clone, Debug)]
pub struct States {
    /// States, in the order of their atoms.
    pub states: Vec<State>,
    /// Memories that repeat states.
    pub stored: Vec<StoredOutput>,
    /// Coils that were resolved into the states' conditions.
    pub auxiliaries: Auxiliaries,
    places: HashMap<AtomId, usize>,
    names: HashMap<Name, usize>,
}

impl States {
    /// The state that `atom` is.
    pub fn state(&self, atom: AtomId) -> Option<&State> {
        self.places.get(&atom).map(|&at| &self.states[at])
    }

    /// The place of the state that `atom` is, in [`States::states`].
    pub fn place(&self, atom: AtomId) -> Option<usize> {
        self.places.get(&atom).copied()
    }

    /// The state called `name`.
    pub fn find(&self, name: &str) -> Option<&State> {
        self.names.get(name).map(|&at| &self.states[at])
    }
}

/// The states of a program with these conditions.
pub fn states(conditions: &Conditions, budget: &Budget) -> States {
    let candidates: Vec<&Variable> = conditions
        .variables
        .iter()
        .map(|variable| &**variable)
        .filter(|variable| holds_state(variable, conditions, budget))
        .collect();
    let atoms: BTreeSet<AtomId> = candidates.iter().map(|variable| variable.atom).collect();
    let auxiliaries = Auxiliaries::find(conditions, &atoms, budget);
    let mut states: Vec<State> = candidates
        .into_iter()
        .filter_map(|variable| state(variable, &atoms, &auxiliaries, conditions, budget))
        .collect();
    let stored = stored::take_repeaters(&mut states);
    let kept: BTreeSet<AtomId> = states.iter().map(|state| state.atom).collect();
    for state in &mut states {
        state.interlocks.retain(|other| kept.contains(other));
    }
    let places = states
        .iter()
        .enumerate()
        .map(|(at, state)| (state.atom, at))
        .collect();
    let names = states
        .iter()
        .enumerate()
        .map(|(at, state)| (state.name.clone(), at))
        .collect();
    States {
        names,
        states,
        stored,
        auxiliaries,
        places,
    }
}

/// Whether a variable is made to hold a value that something starts and
/// something ends.
fn holds_state(variable: &Variable, conditions: &Conditions, budget: &Budget) -> bool {
    if variable.kept_when_skipped {
        return false;
    }
    let Ok(next) = &variable.next else {
        return false;
    };
    let next = auxiliary::without_copies(next, conditions, budget);
    next.depends_on(variable.atom)
        && next.grows_in(variable.atom, budget) == Ok(true)
        && !next.restrict(variable.atom, false).is_false()
        && !next.restrict(variable.atom, true).is_true()
}

fn state(
    variable: &Variable,
    candidates: &BTreeSet<AtomId>,
    auxiliaries: &Auxiliaries,
    conditions: &Conditions,
    budget: &Budget,
) -> Option<State> {
    let next = variable.next.as_ref().ok()?;
    let plain = auxiliary::without_copies(next, conditions, budget);
    let next = auxiliaries.resolve(next, conditions, budget);
    let turns_on = next.restrict(variable.atom, false);
    let deactivation = next.restrict(variable.atom, true).not();
    if turns_on.is_false() || deactivation.is_false() {
        return None;
    }
    let latched = variable
        .writes
        .iter()
        .any(|write| matches!(write.kind, WriteKind::Coil(ladder::CoilKind::Set)));
    Some(State {
        name: variable.name.clone(),
        atom: variable.atom,
        holding: if latched {
            Holding::Latch
        } else {
            Holding::SealIn
        },
        plain,
        next,
        turns_on,
        deactivation,
        interlocks: variable
            .closed_contacts
            .iter()
            .copied()
            .filter(|other| candidates.contains(other))
            .collect(),
    })
}
