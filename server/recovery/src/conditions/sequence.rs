//! Which rungs are solved, and the order of atoms that results.
//!
//! The order of atoms is that of the names in the program, then that in which
//! the rungs, one after the other, first ask for anything else. So a change in
//! one rung may change the order, and with it the conditions of other rungs:
//! of those that ask for an atom which comes to stand elsewhere. They are
//! solved anew as well, and all others are kept from before the change.

use std::collections::HashMap;
use std::sync::Arc;

use imbl::Vector;
use ladder::{Program, Routine, Rung, flow};
use logic::{Atom, AtomId, Atoms, Budget, Function};
use rustc_hash::FxHashSet;

use super::naming::Names;
use super::rung::{self, Solved};
use super::{Conditions, Walk};

/// A program as it was before a change, and its conditions.
#[derive(Clone, Copy)]
pub(super) struct Earlier<'e> {
    pub(super) program: &'e Program,
    pub(super) conditions: &'e Conditions,
}

/// The rungs of a program that have been solved, by routine.
#[derive(Clone, Debug, Default)]
pub(super) struct Rungs(Vec<Vector<Option<Arc<Solved>>>>);

/// All rungs that are ever visited, solved.
pub(super) struct Solution {
    pub(super) rungs: Rungs,
    pub(super) atoms: Atoms,
    /// How many rungs were solved anew.
    pub(super) anew: usize,
}

/// Rounds until the order of atoms must have settled. The names of edges hold
/// conditions, so that a new order may give new names and these another order.
const ROUNDS: usize = 4;

/// Solves the rungs of `program`, but those that did not change.
pub(super) fn solve_all(
    program: &Program,
    execution: &flow::Execution,
    names: &Names,
    earlier: Option<Earlier<'_>>,
    budget: &Budget,
) -> Solution {
    let visited = visited(program, execution);
    let named = names.order(&program.declarations);
    let mut anew = 0;
    if let Some(earlier) = earlier {
        let mut rungs = Rungs::unchanged(earlier, program);
        let mut known = earlier.conditions.atoms.clone();
        for _ in 0..ROUNDS {
            let mut atoms = Atoms::following(&known, order(&named, &rungs, &visited, &known));
            rungs.forget(&known.missing_in(&atoms));
            let last_named = named.len().checked_sub(1).and_then(|last| atoms.at(last));
            let solved = rungs.solve_missing(program, &visited, &mut atoms, budget);
            anew += solved.len();
            // Nothing but names was asked for, or it comes where it did.
            let asks = |it: &Arc<Solved>| it.atoms.iter().any(|atom| Some(*atom) > last_named);
            let settled = !solved
                .iter()
                .any(|place| rungs.get(*place).is_some_and(asks))
                || {
                    let wanted = order(&named, &rungs, &visited, &atoms);
                    atoms.iter().map(|(_, atom)| atom).eq(&wanted)
                };
            if settled {
                return Solution { rungs, atoms, anew };
            }
            known = atoms;
        }
    }
    let mut rungs = Rungs::none(program);
    let mut atoms = Atoms::following(&Atoms::new(), named);
    anew += rungs
        .solve_missing(program, &visited, &mut atoms, budget)
        .len();
    Solution { rungs, atoms, anew }
}

/// Routine and rung of everything that is visited, in the order of the first
/// visit.
fn visited(program: &Program, execution: &flow::Execution) -> Vec<(usize, usize)> {
    let definitions = execution.definitions.iter().map(|(_, order)| order);
    let orders = std::iter::once(&execution.scan).chain(definitions);
    let visits = orders.flat_map(|order| &order.visits);
    let unreachable = execution.unreachable.iter().flat_map(|&routine| {
        let rungs = 0..program.routines[routine].rungs.len();
        rungs.map(move |rung| (routine, rung))
    });
    let mut seen = FxHashSet::default();
    let all = visits.map(|visit| (visit.routine, visit.rung));
    all.chain(unreachable)
        .filter(|place| seen.insert(*place))
        .collect()
}

/// All atoms that are named, then those that the solved rungs ask for beside
/// them. `known` knows the latter.
fn order(named: &[Atom], rungs: &Rungs, visited: &[(usize, usize)], known: &Atoms) -> Vec<Atom> {
    let mut order = named.to_vec();
    let mut seen: FxHashSet<AtomId> = named.iter().filter_map(|atom| known.find(atom)).collect();
    for &place in visited {
        for atom in rungs.get(place).iter().flat_map(|solved| &solved.atoms) {
            if seen.insert(*atom) {
                order.push(known.atom(*atom).clone());
            }
        }
    }
    order
}

impl Rungs {
    fn none(program: &Program) -> Self {
        let routines = program.routines.iter();
        let none = |it: &Routine| std::iter::repeat_n(None, it.rungs.len()).collect();
        Self(routines.map(none).collect())
    }

    /// What is known from before the change: of each routine the rungs at its
    /// beginning and at its end that are what they were.
    fn unchanged(earlier: Earlier<'_>, program: &Program) -> Self {
        let mut places: HashMap<&str, usize> = HashMap::new();
        for (at, routine) in earlier.program.routines.iter().enumerate() {
            places.entry(&routine.scope).or_insert(at);
        }
        let routines = program.routines.iter().enumerate().map(|(at, routine)| {
            let here = earlier.program.routines.get(at);
            let at = match here.is_some_and(|it| it.scope == routine.scope) {
                true => Some(at),
                false => places.get(&*routine.scope).copied(),
            };
            let was = at.and_then(|at| {
                let rungs = &earlier.program.routines.get(at)?.rungs;
                Some((rungs, earlier.conditions.rungs.0.get(at)?))
            });
            match was {
                Some((rungs, solved)) => aligned(rungs, solved, &routine.rungs),
                None => std::iter::repeat_n(None, routine.rungs.len()).collect(),
            }
        });
        Self(routines.collect())
    }

    /// What a rung says, if it has been solved.
    pub(super) fn get(&self, (routine, rung): (usize, usize)) -> Option<&Arc<Solved>> {
        self.0.get(routine)?.get(rung)?.as_ref()
    }

    /// All rungs that have been solved, with their places.
    pub(super) fn iter(&self) -> impl Iterator<Item = ((usize, usize), &Arc<Solved>)> {
        self.0.iter().enumerate().flat_map(|(routine, rungs)| {
            let rungs = rungs.iter().enumerate();
            rungs.filter_map(move |(rung, it)| Some(((routine, rung), it.as_ref()?)))
        })
    }

    /// Takes down what a rung says.
    pub(super) fn set(&mut self, (routine, rung): (usize, usize), solved: Arc<Solved>) {
        if let Some(known) = self.0.get_mut(routine).and_then(|it| it.get_mut(rung)) {
            *known = Some(solved);
        }
    }

    /// Forgets the rungs that ask for any of these atoms.
    fn forget(&mut self, atoms: &[AtomId]) {
        if atoms.is_empty() {
            return;
        }
        let asks = |it: &Solved| it.atoms.iter().any(|it| atoms.binary_search(it).is_ok());
        for rungs in &mut self.0 {
            let asking = rungs.iter().enumerate();
            let asking = asking.filter(|(_, it)| it.as_ref().is_some_and(|it| asks(it)));
            for at in asking.map(|(at, _)| at).collect::<Vec<_>>() {
                rungs.set(at, None);
            }
        }
    }

    /// Solves what has not been solved. The answer is which rungs that were.
    fn solve_missing(
        &mut self,
        program: &Program,
        visited: &[(usize, usize)],
        atoms: &mut Atoms,
        budget: &Budget,
    ) -> Vec<(usize, usize)> {
        let always = Ok(Function::constant(true));
        let mut found = Vec::new();
        for &(routine, at) in visited {
            if self.get((routine, at)).is_some() || budget.cancel.is_cancelled() {
                continue;
            }
            let mut walk = Walk {
                atoms,
                opaque: &mut Default::default(),
                budget,
            };
            let network = &program.routines[routine].rungs[at].network;
            let solved = rung::solve(network, &always, &mut walk);
            self.set((routine, at), solved.into());
            found.push((routine, at));
        }
        found
    }
}

/// What is known of `rungs`, which stand where those of `was` stood.
fn aligned(
    was: &[Rung],
    solved: &Vector<Option<Arc<Solved>>>,
    rungs: &[Rung],
) -> Vector<Option<Arc<Solved>>> {
    let alike =
        |(a, b): &(&Rung, &Rung)| Arc::ptr_eq(&a.network, &b.network) || a.network == b.network;
    let before = was.iter().zip(rungs).take_while(alike).count();
    let (tail, was_tail) = (&rungs[before..], &was[before..]);
    let both = was_tail.iter().rev().zip(tail.iter().rev());
    let after = both.take_while(alike).count();
    let known = |at: usize| solved.get(at).cloned().flatten();
    let changed = std::iter::repeat_n(None, rungs.len() - after - before);
    let behind = (was.len() - after..was.len()).map(known);
    (0..before)
        .map(known)
        .chain(changed)
        .chain(behind)
        .collect()
}
