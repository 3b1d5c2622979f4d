//! The conditions of every coil (semantics, section 2).
//!
//! [`conditions`] solves a program once, symbolically: it walks the rungs in
//! the order of the scan, takes the guard of every coil off its network, and
//! folds the writes of each variable into one function, its *next value*: what
//! the variable holds after the scan, over the values that its contacts see.
//! All conditions are cofactors of that function:
//!
//! | condition | of the next value g of Q |
//! |---|---|
//! | activation | `g` |
//! | turns on | `g[Q:=0]` |
//! | stays on | `g[Q:=1]` |
//! | deactivation | `/g[Q:=1]` |
//!
//! For one plain coil g is its guard, so that this is the paper's definition;
//! for a latch pair g is `(Q + set)*/reset` or `Q*/reset + set`, by the order
//! of the rungs; for a coil driven from several rungs the last one decides.

mod fold;
mod naming;
mod patch;
mod power;
mod rung;
mod sequence;
mod solving;
mod timers;
mod variables;
mod visits;
mod writes;

use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use ladder::{Program, flow};
use logic::{AtomId, Atoms, Budget, Expr, Function, Name, Stop};

pub(crate) use fold::{AT_START, value_after};
pub(crate) use naming::{Names, Uses};
use patch::Beyond;
pub use power::{Powers, Walk, powers};
use sequence::{Earlier, Rungs, Solution};
pub(crate) use solving::{changing, leading_to, sees_several_moments};
use source::Diagnostic;
pub use timers::TimerLaw;
pub use variables::Variables;
use visits::{Visited, Visits};
pub use writes::{Place, RegisterWrite, Write, WriteKind};

/// The conditions of a whole program.
#[derive(Clone, Debug)]
pub struct Conditions {
    /// Every atom that occurs: coils first, then inputs, then the rest.
    pub atoms: Atoms,
    /// Variables that a coil writes, in the order of their atoms.
    pub variables: Variables,
    /// Atoms that stand for what an unknown box does.
    pub opaque: HashSet<AtomId>,
    /// Laws of timers, by the atom of their output.
    pub timers: HashMap<AtomId, TimerLaw>,
    /// Writes of whole numbers, in the order of the scan.
    pub register_writes: Vec<RegisterWrite>,
    /// What was computed anew.
    pub work: Work,
    rungs: Rungs,
    pub(crate) names: Names,
    /// What is wrong with its calls and jumps.
    pub(crate) steering: Vec<Diagnostic>,
    visited: Arc<Visited>,
    beyond: Arc<Beyond>,
    /// The variables that an edit has touched, themselves or where they are
    /// used; `None` if it may have been any.
    pub(crate) touched: Option<Vec<AtomId>>,
    /// The last atom that conditions ask for; registers may ask for more.
    last_atom: Option<AtomId>,
    /// What each operation was allowed, if nobody ended the work early.
    allowed: Option<[usize; 2]>,
}

/// What of a program was computed, and not kept from before a change.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Rungs whose power flow was turned into conditions.
    pub rungs: usize,
    /// Variables whose writes were folded into a next value.
    pub variables: usize,
}

/// A variable that coils write, and its conditions.
#[derive(Clone, Debug)]
pub struct Variable {
    /// Its name.
    pub name: Name,
    /// Its atom.
    pub atom: AtomId,
    /// All its writes, in the order of the scan.
    pub writes: Vec<Write>,
    /// Its value after a scan, over what its contacts see.
    pub next: Result<Function, Stop>,
    /// Whether `next` depends on the variable only because the rung that
    /// writes it is skipped at times: it then keeps its value without having
    /// been made to.
    pub kept_when_skipped: bool,
    /// Coils of other variables that stand as normally closed contacts before
    /// its own, in the order of their atoms.
    pub closed_contacts: Vec<AtomId>,
    /// Whether raising the variable never makes its next value fall; `None`
    /// where that does not depend on it, or could not be told.
    grows: Option<bool>,
}

impl Variable {
    /// `g[Q:=0]`: what starts it.
    pub fn turns_on(&self) -> Result<Function, Stop> {
        Ok(self.next.clone()?.restrict(self.atom, false))
    }

    /// `g[Q:=1]`: what keeps it.
    pub fn stays_on(&self) -> Result<Function, Stop> {
        Ok(self.next.clone()?.restrict(self.atom, true))
    }

    /// `/g[Q:=1]`: what ends it.
    pub fn deactivation(&self) -> Result<Function, Stop> {
        Ok(self.stays_on()?.not())
    }

    /// Whether the rung holds a state: its next value grows with its value.
    pub fn is_persistent(&self) -> bool {
        self.grows == Some(true)
    }

    /// Whether raising the coil makes its own condition fall (an oscillator).
    pub fn falls_in_itself(&self) -> bool {
        self.grows == Some(false)
    }
}

impl Conditions {
    /// The variable that `atom` is, if coils write it.
    pub fn variable(&self, atom: AtomId) -> Option<&Variable> {
        self.kept(atom).map(Arc::as_ref)
    }

    /// The variable that `atom` is, to be kept.
    pub(crate) fn kept(&self, atom: AtomId) -> Option<&Arc<Variable>> {
        self.variables.get(atom)
    }

    /// The variable called `name`, if coils write it.
    pub fn find(&self, name: &str) -> Option<&Variable> {
        self.variable(self.atoms.find_variable(&name.into())?)
    }

    /// Whether nobody ended the work early.
    pub fn is_whole(&self) -> bool {
        self.allowed.is_some()
    }

    /// The place of the first visit to a rung in the order of the scan; `None`
    /// if no scan solves it.
    pub(crate) fn solved_at(&self, rung: (usize, usize)) -> Option<usize> {
        self.visited.get(rung).in_scan()
    }

    /// Whether the rung is ever solved, or shown although nothing leads to it.
    pub(crate) fn is_visited(&self, rung: (usize, usize)) -> bool {
        !matches!(self.visited.get(rung), Visits::Never)
    }

    /// A function as a canonical expression.
    pub fn expr(&self, function: &Function, budget: &Budget) -> Result<Expr, Stop> {
        function.to_expr(&self.atoms, budget)
    }

    /// The opaque atoms that a function depends on.
    pub fn opaque_in(&self, function: &Function) -> Vec<AtomId> {
        let support = function.support().iter().copied();
        support.filter(|atom| self.opaque.contains(atom)).collect()
    }
}

/// The conditions of every coil of `program`, each operation within `budget`.
pub fn conditions(program: &Program, budget: &Budget) -> Conditions {
    computed(program, None, budget)
}

/// The same after a change: what `earlier`, the conditions of the program
/// `before`, says of unchanged rungs, and of what they alone decide, is kept.
/// The answer is that of [`conditions`], but for the numbers of atoms.
pub fn conditions_after(
    before: &Program,
    earlier: &Conditions,
    program: &Program,
    budget: &Budget,
) -> Conditions {
    if earlier.allowed != Some(allowed(budget)) {
        return computed(program, None, budget);
    }
    let earlier = Earlier {
        program: before,
        conditions: earlier,
    };
    patch::patched(earlier, program, budget)
        .unwrap_or_else(|| computed(program, Some(earlier), budget))
}

fn computed(program: &Program, earlier: Option<Earlier<'_>>, budget: &Budget) -> Conditions {
    let execution = flow::execution(program);
    let names = Names::of(program);
    let Solution {
        rungs,
        mut atoms,
        anew,
    } = sequence::solve_all(program, &execution, &names, earlier, budget);
    let mut opaque = HashSet::new();
    let mut walk = Walk {
        atoms: &mut atoms,
        opaque: &mut opaque,
        budget,
    };
    let happening = visits::happening(program, &execution, &rungs, &mut walk);
    let (writes, register_writes) = writes::writes(&happening.occurrences, program, &mut walk);
    let was = earlier.map(|earlier| earlier.conditions);
    let (variables, folded) = fold::variables(writes, was, &mut walk);
    Conditions {
        variables,
        timers: happening.timers,
        register_writes,
        opaque,
        last_atom: atoms.last(),
        beyond: Beyond::of(&rungs, &names, &atoms).into(),
        atoms,
        work: Work {
            rungs: anew,
            variables: folded,
        },
        rungs,
        names,
        steering: execution.diagnostics,
        touched: None,
        visited: happening.visited.into(),
        allowed: whole(budget),
    }
}

/// What each operation was allowed, if nobody ended the work early.
fn whole(budget: &Budget) -> Option<[usize; 2]> {
    (!budget.cancel.is_cancelled()).then(|| allowed(budget))
}

fn allowed(budget: &Budget) -> [usize; 2] {
    [budget.nodes, budget.products]
}
