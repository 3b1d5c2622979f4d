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
mod kept;
mod stored;

use std::collections::HashMap;
use std::sync::{Arc, OnceLock};

use logic::{AtomId, Budget, Function, Name};
use rustc_hash::{FxHashMap, FxHashSet};

use crate::conditions::{Conditions, Variable, WriteKind};
use crate::successions::Facets;

pub use auxiliary::Auxiliaries;
use kept::Kept;

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
    /// The variable that holds it.
    variable: Arc<Variable>,
    /// Atoms that resolving its condition has asked about, ascending.
    asked: Vec<AtomId>,
    /// What comparing it with others needs, worked out once.
    pub(crate) facets: OnceLock<Box<Facets>>,
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
    pub states: Vec<Arc<State>>,
    /// Memories that repeat states.
    pub stored: Vec<StoredOutput>,
    /// Coils that were resolved into the states' conditions.
    pub auxiliaries: Auxiliaries,
    /// How many states were worked out, and not kept from before a change.
    pub anew: usize,
    places: FxHashMap<AtomId, usize>,
    names: HashMap<Name, usize>,
    /// Whether each variable was found to hold a state.
    holding: FxHashMap<AtomId, (Arc<Variable>, bool)>,
    /// What was worked out of each variable, repeaters too.
    worked_out: FxHashMap<AtomId, Arc<State>>,
    /// The timers and the copies that conditions were resolved by.
    resolvers: kept::Resolvers,
}

impl States {
    /// The state that `atom` is.
    pub fn state(&self, atom: AtomId) -> Option<&State> {
        self.places.get(&atom).map(|&at| &*self.states[at])
    }

    /// The place of the state that `atom` is, in [`States::states`].
    pub fn place(&self, atom: AtomId) -> Option<usize> {
        self.places.get(&atom).copied()
    }

    /// The state called `name`.
    pub fn find(&self, name: &str) -> Option<&State> {
        self.names.get(name).map(|&at| &*self.states[at])
    }
}

/// The states of a program with these conditions. What is known from `earlier`
/// of a variable that did not change, and whose condition is resolved by what
/// did not change, is kept.
pub fn states(conditions: &Conditions, earlier: Option<&States>, budget: &Budget) -> States {
    let resolvers = kept::Resolvers::of(conditions);
    let mut kept = Kept::new(earlier, &resolvers);
    let mut holding = FxHashMap::default();
    for variable in &conditions.variables {
        let holds = kept
            .holds(variable)
            .unwrap_or_else(|| holds_state(variable, conditions, budget));
        holding.insert(variable.atom, (Arc::clone(variable), holds));
    }
    let candidates: Vec<&Arc<Variable>> = conditions
        .variables
        .iter()
        .filter(|variable| holding[&variable.atom].1)
        .collect();
    let atoms: FxHashSet<AtomId> = candidates.iter().map(|variable| variable.atom).collect();
    let auxiliaries = Auxiliaries::find(conditions, &atoms, budget);
    kept.resolve_by(&auxiliaries);
    let mut anew = 0;
    let found = candidates.into_iter().filter_map(|variable| {
        if let Some(state) = kept.state(variable) {
            return Some(Arc::clone(state));
        }
        anew += 1;
        state(variable, &auxiliaries, conditions, budget).map(Arc::new)
    });
    let mut states: Vec<Arc<State>> = found.collect();
    let mut worked_out: FxHashMap<AtomId, Arc<State>> = states
        .iter()
        .map(|state| (state.atom, Arc::clone(state)))
        .collect();
    let stored = stored::take_repeaters(&mut states);
    let left: FxHashSet<AtomId> = states.iter().map(|state| state.atom).collect();
    for state in &mut states {
        let closed = state.variable.closed_contacts.iter().copied();
        let interlocks = closed.filter(|other| left.contains(other));
        if !interlocks.clone().eq(state.interlocks.iter().copied()) {
            let interlocks = interlocks.collect();
            let state = Arc::make_mut(state);
            state.interlocks = interlocks;
            state.facets = OnceLock::new();
        }
        worked_out.insert(state.atom, Arc::clone(state));
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
        anew,
        places,
        holding,
        worked_out,
        resolvers,
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
    variable: &Arc<Variable>,
    auxiliaries: &Auxiliaries,
    conditions: &Conditions,
    budget: &Budget,
) -> Option<State> {
    let next = variable.next.as_ref().ok()?;
    let plain = auxiliary::without_copies(next, conditions, budget);
    let asked = auxiliaries.asked_by(next, conditions);
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
        // Known when all states are.
        interlocks: Vec::new(),
        variable: Arc::clone(variable),
        asked,
        facets: OnceLock::new(),
    })
}
