//! Conditions after an edit of a few rungs, made from those before it.
//!
//! Nearly every keystroke changes one rung and leaves the number of rungs,
//! declarations and calls alone. Then what is known of the program is taken
//! over as a whole, sharing what it holds, and only what the edited rungs said
//! and say is taken out and put in: their names, their atoms, their writes.
//! The cost is that of the edited rungs, and of the logarithm of the rest.
//!
//! Whatever could reach further is left to the whole computation: then the
//! answer is `None`. It reaches further when an edited rung steers the scan or
//! writes numbers, when its boxes or edges ask for other atoms than before, or
//! when addresses decide the order of atoms.

use std::collections::HashSet;
use std::sync::Arc;

use ladder::{ElementKind, Network, Program, Value, flow};
use logic::{Atom, AtomId, Atoms, Budget, Function, Name};
use rustc_hash::FxHashSet;

use super::naming::Names;
use super::rung::{self, Effect, Solved};
use super::sequence::{Earlier, Rungs};
use super::visits::{Circumstances, Visits};
use super::{Conditions, Walk, Work, Write, fold, whole, writes};

/// More rungs than this are not patched one by one.
const MOST: usize = 64;

/// What a program says beyond the names of its contacts and coils.
#[derive(Debug)]
pub(super) struct Beyond {
    /// Atoms that some rung asks for without a contact or coil of that name.
    atoms: FxHashSet<AtomId>,
    /// Words that are written as a whole, or copied.
    words: FxHashSet<Name>,
}

impl Beyond {
    pub(super) fn of(rungs: &Rungs, names: &Names, atoms: &Atoms) -> Self {
        let mut beyond = Self {
            atoms: FxHashSet::default(),
            words: FxHashSet::default(),
        };
        for (place, solved) in rungs.iter() {
            let is_named = |atom: &&AtomId| is_named(**atom, place, names, atoms);
            let asked = solved.atoms.iter().filter(|atom| !is_named(atom));
            beyond.atoms.extend(asked);
            for event in &solved.events {
                match &event.effect {
                    Effect::Coil(..) => {}
                    Effect::Assign(assignment) => {
                        beyond.words.insert(assignment.target.name.clone());
                        if let Value::Copy(source) = &assignment.value {
                            beyond.words.insert(source.name.clone());
                        }
                    }
                    Effect::Unknown { target, .. } => {
                        beyond.words.insert(target.clone());
                    }
                }
            }
        }
        beyond
    }

    /// Whether a name that moves is a matter of rungs that do not name it.
    fn is_concerned(&self, name: &str) -> bool {
        let is_bit =
            |(word, bit): (&str, &str)| bit.parse::<u32>().is_ok() && self.words.contains(word);
        self.words.contains(name) || name.rsplit_once('.').is_some_and(is_bit)
    }
}

/// Whether a contact or a coil of a rung names an atom.
fn is_named(atom: AtomId, rung: (usize, usize), names: &Names, atoms: &Atoms) -> bool {
    match atoms.atom(atom) {
        Atom::Variable(name) => names.uses(name).is_some_and(|it| it.stands_in(rung)),
        _ => false,
    }
}

/// The conditions of `program`; `None` if more may have changed than can be
/// told from the edited rungs.
pub(super) fn patched(
    earlier: Earlier<'_>,
    program: &Program,
    budget: &Budget,
) -> Option<Conditions> {
    let was = earlier.conditions;
    let edited = edited(earlier.program, program)?;
    let mut names = was.names.clone();
    let mut moved = Vec::new();
    let mut used_otherwise = Vec::new();
    for &place in &edited {
        let [before, after] = [earlier.program, program].map(|it| network(it, place));
        let here = names.edited(place, before?, after?, &program.declarations)?;
        moved.extend(here.moved);
        used_otherwise.extend(here.used_otherwise);
    }
    let mut atoms = was.atoms.editing();
    atoms.end_at(was.last_atom);
    let mut rungs = edited;
    for name in renumbered(moved, was, &names, &mut atoms, program)? {
        let uses = names.uses(&name)?;
        let named = uses.coils.iter().chain(&uses.contacts);
        rungs.extend(named.map(|place| place.rung()));
    }
    rungs.sort_unstable();
    rungs.dedup();
    if rungs.len() > MOST {
        return None;
    }
    let patch = Patch {
        was,
        program,
        rungs,
        budget,
    };
    let mut after = Conditions {
        names,
        atoms,
        allowed: None,
        ..was.clone()
    };
    patch.solve(&mut after)?;
    let mut touched = patch.fold(&mut after)?;
    for name in &used_otherwise {
        let both = [&was.atoms, &after.atoms].map(|atoms| atoms.find_variable(name));
        touched.extend(both.into_iter().flatten());
    }
    touched.sort_unstable();
    touched.dedup();
    after.touched = Some(touched);
    for write in &mut after.register_writes {
        write.span = write.place.span(program);
    }
    if !was.steering.is_empty() {
        after.steering = flow::execution(program).diagnostics;
    }
    after.last_atom = after.atoms.last();
    after.allowed = whole(budget);
    Some(after)
}

/// The rungs whose networks differ, if nothing else does and they neither steer
/// nor write numbers.
fn edited(before: &Program, after: &Program) -> Option<Vec<(usize, usize)>> {
    let is_alike = before.format == after.format
        && before.declarations.is_moved(&after.declarations)
        && before.routines.len() == after.routines.len();
    if !is_alike {
        return None;
    }
    let mut edited = Vec::new();
    for (at, (before, after)) in before.routines.iter().zip(&after.routines).enumerate() {
        let is_alike = before.rungs.len() == after.rungs.len()
            && before.role == after.role
            && before.scope == after.scope
            && before.unit == after.unit
            && before.name == after.name;
        if !is_alike {
            return None;
        }
        for (rung, (before, after)) in before.rungs.iter().zip(&after.rungs).enumerate() {
            if !Arc::ptr_eq(&before.network, &after.network) {
                edited.push((at, rung));
                let reaches_further = |it: &Network| it.elements().any(|(_, it)| reaches(&it.kind));
                if edited.len() > MOST
                    || reaches_further(&before.network)
                    || reaches_further(&after.network)
                {
                    return None;
                }
            }
        }
    }
    Some(edited)
}

/// Whether an element decides what is solved, or writes more than its variable.
fn reaches(kind: &ElementKind) -> bool {
    rung::steers(kind)
        || matches!(
            kind,
            ElementKind::Label(_) | ElementKind::Assign(_) | ElementKind::Block(_)
        )
}

fn network(program: &Program, (routine, rung): (usize, usize)) -> Option<&Network> {
    let rung = program.routines.get(routine)?.rungs.get(rung)?;
    Some(&rung.network)
}

/// Lets the atoms of names that moved come, go, or stand where the names now
/// do. The answer are the names that have another number than before.
fn renumbered(
    mut moved: Vec<Name>,
    was: &Conditions,
    names: &Names,
    atoms: &mut Atoms,
    program: &Program,
) -> Option<Vec<Name>> {
    let declarations = &program.declarations;
    // Each finds the name before it in its place.
    moved.sort_by_cached_key(|name| names.key(name, declarations));
    moved.dedup();
    for name in &moved {
        if was.beyond.is_concerned(name) {
            return None;
        }
        let known = atoms.find_variable(name);
        if known.is_some() != was.names.key(name, declarations).is_some() {
            return None;
        }
        if let Some(id) = known {
            if was.beyond.atoms.contains(&id) {
                return None;
            }
            atoms.remove(id);
        }
    }
    let mut renumbered = Vec::new();
    for name in moved {
        let Some(key) = names.key(&name, declarations) else {
            continue;
        };
        let before = match names.before(key) {
            Some(other) => Some(atoms.find_variable(other)?),
            None => None,
        };
        let known = was.atoms.find_variable(&name);
        // It may have moved and still stand between the same two.
        let next = atoms.next_behind(before.unwrap_or(AtomId(0)));
        let fits = |id: &AtomId| before < Some(*id) && next.is_none_or(|next| *id < next);
        match known.filter(fits) {
            Some(id) => atoms.put_back(id, Atom::Variable(name)),
            None => {
                atoms.insert_behind(before, Atom::Variable(name.clone()))?;
                renumbered.push(name);
            }
        }
    }
    Some(renumbered)
}

/// The rungs to be solved anew, and what is known around them.
struct Patch<'p> {
    was: &'p Conditions,
    program: &'p Program,
    /// In the order of the source.
    rungs: Vec<(usize, usize)>,
    budget: &'p Budget,
}

impl Patch<'_> {
    /// Solves the rungs.
    fn solve(&self, after: &mut Conditions) -> Option<()> {
        let always = Ok(Function::constant(true));
        // Names come first in the order of atoms.
        let last_name = after
            .names
            .last()
            .and_then(|name| after.atoms.find_variable(name));
        for &place in &self.rungs {
            let network = network(self.program, place)?;
            if network.elements().any(|(_, it)| reaches(&it.kind)) {
                return None;
            }
            let before = self.was.rungs.get(place)?;
            let mut walk = Walk {
                atoms: &mut after.atoms,
                opaque: &mut HashSet::new(),
                budget: self.budget,
            };
            let solved = Arc::new(rung::solve(network, &always, &mut walk));
            let asked = |it: &Solved| -> Vec<AtomId> {
                let asked = it.atoms.iter().copied();
                asked.filter(|id| Some(*id) > last_name).collect()
            };
            // A contact of a timer's output may have gone from the timer's own
            // rung, which goes on asking for that output.
            let is_known = |atom: &AtomId| {
                is_named(*atom, place, &after.names, &after.atoms)
                    || self.was.beyond.atoms.contains(atom)
            };
            if !solved.atoms.iter().all(is_known) {
                return None;
            }
            if asked(before) != asked(&solved) || before.opaque != solved.opaque {
                return None;
            }
            // No law holds for a timer that several rungs run.
            let is_shared = |kind: &ElementKind| match kind {
                ElementKind::Timer(timer) => after
                    .names
                    .uses(&timer.instance.name)
                    .is_none_or(|uses| uses.written_otherwise.len() > 1),
                _ => false,
            };
            if network.elements().any(|(_, it)| is_shared(&it.kind)) {
                return None;
            }
            let circumstances = self.circumstances(place)?;
            for (was, timer) in before.timers.iter().zip(&solved.timers) {
                if was.output != timer.output {
                    return None;
                }
                let law = after.timers.get_mut(&timer.output)?;
                *law = circumstances.law(timer, self.budget);
            }
            if before.timers.len() != solved.timers.len() {
                return None;
            }
            after.rungs.set(place, solved);
        }
        Some(())
    }

    fn circumstances(&self, place: (usize, usize)) -> Option<Arc<Circumstances>> {
        match self.was.visited.get(place) {
            Visits::Once { circumstances, .. } => Some(Arc::clone(circumstances)),
            Visits::Never | Visits::Often { .. } => None,
        }
    }

    /// The place of a write in the scan.
    fn rank(&self, write: &Write) -> Option<(usize, usize)> {
        match self.was.visited.get(write.place.rung()) {
            Visits::Once { rank, .. } => Some((*rank, write.place.element)),
            Visits::Never | Visits::Often { .. } => None,
        }
    }

    fn is_anew(&self, place: (usize, usize)) -> bool {
        self.rungs.binary_search(&place).is_ok()
    }

    /// Gives the variables that these rungs wrote or write their next values.
    /// The answer are these variables.
    fn fold(&self, after: &mut Conditions) -> Option<Vec<AtomId>> {
        let mut opaque = HashSet::new();
        let mut walk = Walk {
            atoms: &mut after.atoms,
            opaque: &mut opaque,
            budget: self.budget,
        };
        let mut occurrences = Vec::new();
        let mut targets = Vec::new();
        for &place in &self.rungs {
            targets.extend(self.was.rungs.get(place)?.targets());
            let circumstances = self.circumstances(place)?;
            let solved = after.rungs.get(place)?;
            targets.extend(solved.targets());
            let met = circumstances.met(solved, network(self.program, place)?, &mut walk);
            let events = met.events.iter();
            occurrences.extend(events.map(|event| circumstances.occurrence(event, place)));
        }
        targets.sort_unstable();
        targets.dedup();
        let (fresh, _) = writes::writes(&occurrences, self.program, &mut walk);
        let mut folded = 0;
        for &target in &targets {
            let known = self.was.kept(target);
            let kept = known.iter().flat_map(|it| &it.writes);
            let kept = kept.filter(|write| !self.is_anew(write.place.rung()));
            let fresh = fresh.iter().filter(|write| write.target == target);
            let ranked = kept
                .chain(fresh)
                .map(|it| Some((self.rank(it)?, it.clone())));
            let mut ranked: Vec<_> = ranked.collect::<Option<_>>()?;
            // The order of the scan.
            ranked.sort_by_key(|(rank, _)| *rank);
            let writes = ranked.into_iter().map(|(_, write)| write).collect();
            let found = fold::variable_after(target, writes, known, &mut walk);
            folded += usize::from(found.as_ref().is_some_and(|it| it.is_anew));
            let found = found.map(|it| it.variable);
            after.variables.put(target, found);
        }
        after.work = Work {
            rungs: self.rungs.len(),
            variables: folded,
        };
        Some(targets)
    }
}
