//! The order in which a program is solved in one scan.
//!
//! A file lists routines; a controller solves rungs. Between the two stand
//! calls, jumps, returns and zones, which decide what is solved, when, and
//! how often. [`execution`] follows them once, without knowing any value, and
//! lays the rungs out in a row: the *visits*. Whatever steers is kept as a
//! [`Guard`] on the visits that it decides about, so that a reader of
//! conditions sees a straight list and never a jump.
//!
//! Guards name the element whose power decides; what that power is under
//! which inputs is not known here. A visit's guards are a chain that visits
//! share ([`Order::last_guard`]), so memory and the work of whoever computes
//! with them grow with the program and not with its nesting.
//!
//! What this is not: an interpreter. `scan` runs the same stretches with
//! actual power, and jumps where this only notes that one may.

mod layout;
mod walk;

use std::collections::HashMap;
use std::ops::Range;

use logic::Name;
use petgraph::graph::NodeIndex;
use source::Diagnostic;

use crate::{Program, Role};

pub(crate) use layout::{Layout, Steer, layouts};

/// How a program is solved, scan by scan.
#[derive(Clone, Debug)]
pub struct Execution {
    /// What every scan solves: the routines of [`Role::Main`] and all that
    /// they call.
    pub scan: Order,
    /// What every use of a block that the user defines solves, for each unit
    /// with routines of [`Role::Definition`].
    pub definitions: Vec<(Name, Order)>,
    /// Routines that nothing calls, as places in [`Program::routines`].
    pub unreachable: Vec<usize>,
    /// Calls and jumps that lead nowhere, backwards or round in a circle, and
    /// rungs that are never solved.
    pub diagnostics: Vec<Diagnostic>,
}

/// Visits in the order of solving, with what guards each.
#[derive(Clone, Debug, Default)]
pub struct Order {
    /// The visits.
    pub visits: Vec<Visit>,
    /// Every guard set but the empty one: a guard, and the set it was added
    /// to.
    sets: Vec<(Guard, GuardSet)>,
}

/// One solving of a rung, or of a stretch of it.
///
/// Nearly always the whole rung. A rung is cut behind a call, jump, return or
/// zone that has elements behind it, and before a label that has elements
/// before it, since what is on the two sides is not solved together.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Visit {
    /// The routine, as a place in [`Program::routines`].
    pub routine: usize,
    /// The rung, as a place in its routine.
    pub rung: usize,
    /// The elements of the rung that are solved here, by their indices.
    pub elements: Range<usize>,
    /// What decides whether they are solved.
    pub guards: GuardSet,
}

/// An element as it is solved in one visit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Place {
    /// The visit, as a place in [`Order::visits`]; always an earlier one than
    /// the visit that is guarded.
    pub visit: usize,
    /// The element of that visit's rung.
    pub element: NodeIndex,
}

/// Something that decides whether, or how, a visit is solved.
///
/// The *power at a place* is the power that arrives at the element while its
/// visit is solved, and off while it is not: a jump that was jumped over does
/// not jump.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Guard {
    /// The visit is solved only while the power at the place is `solved_when`,
    /// and writes nothing otherwise: on for a call, off for a jump or return.
    Skipped {
        /// The call, jump or return.
        by: Place,
        /// The power with which the visit is solved.
        solved_when: bool,
    },
    /// The visit lies in a zone, which reaches from the rung behind its begin
    /// to the rung of its end. The zone is switched off when its begin has
    /// been solved this scan and had no power; then the visit is solved, but
    /// no element in it has power. So plain coils are written 0, and set and
    /// reset coils, assignments and calls do nothing.
    Zone {
        /// The element that begins the zone.
        begin: Place,
    },
    /// The visit lies between a label and a jump back to it: how often it is
    /// solved in a scan is not known.
    Repeated {
        /// The rung of the jump, in the visit's own routine.
        rung: usize,
        /// The jump.
        jump: NodeIndex,
    },
}

/// Identifies the guards of a visit in their [`Order`]. Visits with the same
/// guards have the same set.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct GuardSet(u32);

impl GuardSet {
    /// The set of a visit that every scan solves.
    pub const NONE: Self = Self(0);

    /// Whether there is no guard.
    pub fn is_empty(self) -> bool {
        self == Self::NONE
    }
}

impl Order {
    /// The guard added last to a set, and the set without it. A set is
    /// always made after the one it extends, so a table of conditions by set
    /// can be filled step by step.
    pub fn last_guard(&self, set: GuardSet) -> Option<(Guard, GuardSet)> {
        let at = (set.0 as usize).checked_sub(1)?;
        self.sets.get(at).copied()
    }

    /// All guards of a set, the innermost first.
    pub fn guards(&self, set: GuardSet) -> impl Iterator<Item = Guard> + '_ {
        let mut rest = set;
        std::iter::from_fn(move || {
            let (guard, outer) = self.last_guard(rest)?;
            rest = outer;
            Some(guard)
        })
    }

    /// The number of guards in a set.
    pub fn depth(&self, set: GuardSet) -> usize {
        self.guards(set).count()
    }

    fn extend(&mut self, set: GuardSet, guard: Guard) -> GuardSet {
        self.sets.push((guard, set));
        GuardSet(self.sets.len() as u32)
    }
}

/// Lays out in which order `program` is solved. See the module's page.
///
/// Linear in the size of the program: a call graph that would unfold into far
/// more visits than there are rungs is cut with a diagnostic.
pub fn execution(program: &Program) -> Execution {
    let (layouts, mut diagnostics) = layouts(program);
    let mut walk = walk::Walk::new(program, &layouts);
    let mut mains = Vec::new();
    let mut units: Vec<(Name, Vec<usize>)> = Vec::new();
    let mut unit_places = HashMap::new();
    for (at, routine) in program.routines.iter().enumerate() {
        match routine.role {
            Role::Main => mains.push(at),
            Role::Called => {}
            Role::Definition => {
                let place = *unit_places.entry(&*routine.unit).or_insert(units.len());
                if place == units.len() {
                    units.push((routine.unit.clone(), Vec::new()));
                }
                units[place].1.push(at);
            }
        }
    }
    let scan = walk.order(&mains);
    let definitions = units
        .into_iter()
        .map(|(unit, roots)| (unit, walk.order(&roots)))
        .collect();
    let (unreachable, found) = walk.finish();
    diagnostics.extend(found);
    diagnostics.sort_by_key(|diagnostic| (diagnostic.span, diagnostic.code));
    Execution {
        scan,
        definitions,
        unreachable,
        diagnostics,
    }
}
