use std::collections::BTreeSet;

use logic::{AtomId, Budget, Function};
use rustc_hash::{FxHashMap, FxHashSet};

use crate::conditions::{Conditions, Variable, WriteKind};

/// Auxiliary coils: coils that hold nothing and carry a condition from the
/// states to other rungs, as the transition bits of a step chain do.
///
/// They are resolved, replaced by their conditions, where they stand in the
/// conditions of a state. Only coils near a state are: those that read one,
/// or a timer that one runs, directly or through a few coils between. All
/// others keep their names, which the reader knows.
#[derive(Clone, Debug, Default)]
pub struct Auxiliaries {
    conditions: FxHashMap<AtomId, Function>,
}

/// Coils between a state and its condition. Real step chains have one; more
/// than three are not a transition any more.
const FARTHEST: usize = 3;

/// A condition over more atoms than this is not made clearer by resolving
/// coils into it.
const MOST_ATOMS: usize = 48;

/// Nor is one whose diagram has more nodes than this.
const MOST_NODES: usize = 1_000;

impl Auxiliaries {
    /// The auxiliary coils of a program whose states are `states`.
    pub(super) fn find(
        conditions: &Conditions,
        states: &FxHashSet<AtomId>,
        budget: &Budget,
    ) -> Self {
        let mut near: FxHashSet<AtomId> = states.clone();
        let mut found = FxHashMap::default();
        let candidates: Vec<(AtomId, &Function)> = conditions
            .variables
            .iter()
            .filter(|variable| !states.contains(&variable.atom))
            .filter_map(|variable| Some((variable.atom, carried(variable)?)))
            .collect();
        for _ in 0..FARTHEST {
            let before = near.len();
            let reads_near = |function: &Function| {
                function.support().iter().any(|atom| {
                    near.contains(atom)
                        || conditions.timers.get(atom).is_some_and(|timer| {
                            let input = timer.input.as_ref();
                            input.is_ok_and(|f| f.support().iter().any(|a| near.contains(a)))
                        })
                })
            };
            let new: Vec<_> = candidates
                .iter()
                .filter(|(atom, function)| !near.contains(atom) && reads_near(function))
                .copied()
                .collect();
            for (atom, function) in new {
                near.insert(atom);
                found.insert(atom, function.clone());
            }
            if near.len() == before {
                break;
            }
        }
        let mut auxiliaries = Self { conditions: found };
        auxiliaries.add_copies(conditions, budget);
        auxiliaries
    }

    fn add_copies(&mut self, conditions: &Conditions, budget: &Budget) {
        for variable in &conditions.variables {
            if let Some(source) = copied_from(variable) {
                let source = Function::atom(source);
                self.conditions
                    .insert(variable.atom, without_copies(&source, conditions, budget));
            }
        }
    }

    /// The atoms whose conditions, timers and copies decide what resolving
    /// `function` gives, ascending.
    pub(super) fn asked_by(&self, function: &Function, conditions: &Conditions) -> Vec<AtomId> {
        let mut asked: BTreeSet<AtomId> = BTreeSet::new();
        let mut open = function.support().to_vec();
        while let Some(atom) = open.pop() {
            if !asked.insert(atom) {
                continue;
            }
            if let Some(condition) = self.conditions.get(&atom) {
                open.extend(condition.support());
            }
            if let Some(timer) = conditions.timers.get(&atom) {
                open.extend(timer.input.iter().flat_map(Function::support));
            }
            open.extend(conditions.variable(atom).and_then(copied_from));
        }
        asked.into_iter().collect()
    }

    /// All of them.
    pub(super) fn all(&self) -> &FxHashMap<AtomId, Function> {
        &self.conditions
    }

    /// The condition of an auxiliary coil, as its rung has it.
    pub fn condition(&self, atom: AtomId) -> Option<&Function> {
        self.conditions.get(&atom)
    }

    /// Whether the coil is auxiliary.
    pub fn contains(&self, atom: AtomId) -> bool {
        self.conditions.contains_key(&atom)
    }

    /// `function` with auxiliary coils resolved and the laws of the timers
    /// that states run applied. Where that would grow past all use the
    /// function stays as it is at that point: it says the same, in terms of
    /// more coils.
    pub fn resolve(
        &self,
        function: &Function,
        conditions: &Conditions,
        budget: &Budget,
    ) -> Function {
        let budget = &Budget {
            nodes: budget.nodes.min(MOST_NODES),
            ..budget.clone()
        };
        let mut resolved = function.clone();
        for _ in 0..=FARTHEST {
            let inside: Vec<AtomId> = resolved
                .support()
                .iter()
                .copied()
                .filter(|atom| self.conditions.contains_key(atom))
                .collect();
            if inside.is_empty() {
                break;
            }
            for atom in inside {
                let by = self.lawful(&self.conditions[&atom], conditions, budget);
                match resolved.substitute(atom, &by, budget) {
                    Ok(next) if next.support().len() <= MOST_ATOMS => resolved = next,
                    _ => return resolved,
                }
            }
        }
        resolved
    }

    /// `function` with every timer output replaced by what the timer's law
    /// says of it.
    fn lawful(&self, function: &Function, conditions: &Conditions, budget: &Budget) -> Function {
        let mut lawful = function.clone();
        for &atom in function.support() {
            let Some(timer) = conditions.timers.get(&atom) else {
                continue;
            };
            let applied = timer
                .applied(Function::atom(atom), budget)
                .and_then(|full| lawful.substitute(atom, &full, budget));
            match applied {
                Ok(next) if next.support().len() <= MOST_ATOMS => lawful = next,
                _ => {}
            }
        }
        lawful
    }
}

/// The condition that a coil carries, if it carries one: a single plain coil
/// without memory, in a rung that is always solved.
fn carried(variable: &Variable) -> Option<&Function> {
    let [write] = &variable.writes[..] else {
        return None;
    };
    let plain = matches!(
        write.kind,
        WriteKind::Coil(ladder::CoilKind::Plain | ladder::CoilKind::Negated)
    );
    let next = variable.next.as_ref().ok()?;
    (plain && !next.depends_on(variable.atom)).then_some(next)
}

/// The bit that a bit is a copy of in every scan: `State.3` where the whole
/// of `Next` is moved to `State`.
pub(super) fn copied_from(variable: &Variable) -> Option<AtomId> {
    match &variable.writes[..] {
        [write] => match (&write.kind, &write.guard) {
            (WriteKind::BitOf(source), Ok(guard)) if guard.is_true() => Some(*source),
            _ => None,
        },
        _ => None,
    }
}

/// `function` with bits that are copies replaced by what they copy: a chain
/// coded in two words, one holding the next state, then shows its memory.
pub(super) fn without_copies(
    function: &Function,
    conditions: &Conditions,
    budget: &Budget,
) -> Function {
    let mut resolved = function.clone();
    for &atom in function.support() {
        let source = conditions.variable(atom).and_then(copied_from);
        if let Some(source) = source
            && let Ok(next) = resolved.substitute(atom, &Function::atom(source), budget)
        {
            resolved = next;
        }
    }
    resolved
}
