//! Whether a memory can be a grafcet of two steps: whether nothing leads it
//! astray while the situation evolves.
//!
//! A scan of a ladder solves each rung once, and what it sees is settled. A
//! grafcet evolves until it is stable: a receptivity is looked at again and
//! again, while the steps of other memories change, each at its own time, and
//! edges are over after the first evolution. A memory is right if it changes
//! at most once, and just when its rung would have it changed.

use std::collections::BTreeSet;

use logic::{Atom, AtomId, Atoms, Budget, Function, Stop};

use super::seen::Seen;

/// What is beside a memory.
pub(super) struct Beside<'b> {
    pub(super) seen: &'b Seen,
    /// Variables that have two steps.
    pub(super) steps: &'b BTreeSet<AtomId>,
    pub(super) budget: &'b Budget,
}

impl Beside<'_> {
    /// Whether a memory of the condition `said` changes as its rung has it,
    /// whatever changes beside it, and when.
    ///
    /// While the situation evolves the steps of another memory are what they
    /// were up to some evolution and what they become from then on; an edge is
    /// what it is in the first evolution and then off. Between the first moment
    /// and the last two others are looked at, one after the other: at the
    /// earlier `some` of them have changed, at the later `more` besides.
    pub(super) fn holds(&self, own: AtomId, said: &Function) -> Result<bool, Stop> {
        let budget = self.budget;
        let mut fresh = Fresh::new(&self.seen.atoms);
        let mut read = said.clone();
        let mut right = said.clone();
        let mut paths = Vec::new();
        let mut done = BTreeSet::new();
        let mut becoming = Vec::new();
        let new_own = fresh.atom();
        for &atom in said.support() {
            let of = self.seen.of_before(atom).unwrap_or(atom);
            if of == own || !done.insert(of) {
                continue;
            }
            if matches!(self.seen.atoms.atom(atom), Atom::Rise(_) | Atom::Fall(_)) {
                let here = fresh.atom();
                read = read.substitute(atom, &Function::atom(here), budget)?;
                paths.push((here, Function::atom(atom), Function::constant(false)));
                continue;
            }
            if !self.steps.contains(&of) {
                continue;
            }
            let (Some(before), Ok(next)) = (self.seen.before(of), self.seen.next(of)) else {
                return Ok(false);
            };
            let next = next.substitute(own, &Function::atom(new_own), budget)?;
            let next = next.substitute(of, &Function::atom(before), budget)?;
            let (here, after) = (fresh.atom(), fresh.atom());
            for atom in [of, before] {
                read = read.substitute(atom, &Function::atom(here), budget)?;
            }
            right = right.substitute(of, &Function::atom(after), budget)?;
            right = right.substitute(after, &next, budget)?;
            paths.push((here, Function::atom(before), next.clone()));
            becoming.push((of, next));
        }
        // What one of them becomes may depend on what another becomes.
        for (of, next) in &becoming {
            for (_, _, path) in &mut paths {
                *path = path.substitute(*of, next, budget)?;
            }
            right = right.substitute(*of, next, budget)?;
        }
        let care = self.exclusive(own, new_own, &right, &becoming)?;
        let mut moments = [read.clone(), read.clone(), read.clone(), read];
        for (here, before, next) in paths {
            let (some, more) = (fresh.atom(), fresh.atom());
            let either = Function::atom(some).or(&Function::atom(more), budget)?;
            let values = [
                before.clone(),
                chosen(&Function::atom(some), &next, &before, budget)?,
                chosen(&either, &next, &before, budget)?,
                next,
            ];
            for (moment, value) in moments.iter_mut().zip(values) {
                *moment = moment.substitute(here, &value, budget)?;
            }
        }
        for was in [false, true] {
            let bound = |function: &Function, value: bool, right: &Function| {
                let bound = function.restrict(own, value);
                let bound = match self.seen.before(own) {
                    Some(before) => bound.restrict(before, was),
                    None => bound,
                };
                bound.substitute(new_own, right, budget)
            };
            let changes = |function: &Function| match was {
                true => function.not(),
                false => function.clone(),
            };
            let unknown = Function::atom(new_own);
            let right = changes(&bound(&right, was, &unknown)?);
            let new = changes(&right);
            let first = changes(&bound(&moments[0], was, &new)?);
            let some = changes(&bound(&moments[1], was, &new)?);
            let back = changes(&bound(&moments[2], !was, &new)?).not();
            let last = changes(&bound(&moments[3], was, &new)?);
            let wrong = some.and_not(&right, budget)?;
            let undone = some.and(&back, budget)?;
            let missed = right.and_not(&first, budget)?.and_not(&last, budget)?;
            let care = bound(&care, was, &new)?;
            for fault in [wrong, undone, missed] {
                if fault.meets(&care, budget)? {
                    return Ok(false);
                }
            }
        }
        Ok(true)
    }

    /// What is so before every scan: that a memory is not on together with
    /// another beside which it is never switched on, as where they interlock
    /// each other. `right` is what it becomes, `becoming` what the others do.
    fn exclusive(
        &self,
        own: AtomId,
        new_own: AtomId,
        right: &Function,
        becoming: &[(AtomId, Function)],
    ) -> Result<Function, Stop> {
        let budget = self.budget;
        let mut care = Function::constant(true);
        for (of, next) in becoming {
            let Some(before) = self.seen.before(*of) else {
                continue;
            };
            let both_before = Function::atom(own).and(&Function::atom(before), budget)?;
            let mut next = next.substitute(new_own, right, budget)?;
            if let Some(before) = self.seen.before(own) {
                next = next.substitute(before, &Function::atom(own), budget)?;
            }
            let both = right.and(&next, budget)?;
            let never = both.and_not(&both_before, budget)?.is_false();
            let begin = self.seen.is_initial(own) && self.seen.is_initial(*of);
            if never && !begin {
                care = care.and_not(&both_before, budget)?;
            }
        }
        Ok(care)
    }
}

fn chosen(
    which: &Function,
    one: &Function,
    other: &Function,
    budget: &Budget,
) -> Result<Function, Stop> {
    let one = which.and(one, budget)?;
    one.or(&other.and_not(which, budget)?, budget)
}

/// Atoms that nothing else has.
struct Fresh {
    atoms: Atoms,
    given: usize,
}

impl Fresh {
    fn new(atoms: &Atoms) -> Self {
        Self {
            atoms: atoms.clone(),
            given: 0,
        }
    }

    fn atom(&mut self) -> AtomId {
        self.given += 1;
        // A line end keeps these apart from all that a program can name.
        let name = format!("\nmoment {} of an evolution", self.given).into();
        self.atoms.add_variable(&name)
    }
}
