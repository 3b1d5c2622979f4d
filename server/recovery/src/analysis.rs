use std::collections::HashSet;
use std::sync::Arc;

use ladder::{Class, Program, Role};
use logic::{AtomId, Budget, Function, Name};

use crate::conditions::{Conditions, Variable, conditions};
use crate::conversion::Sums;
use crate::groups::{Group, groups};
use crate::registers::{Register, registers};
use crate::states::{States, states};
use crate::successions::{Succession, ranked};

/// All that is recovered from a ladder before anybody decides anything.
#[derive(Clone, Debug)]
pub struct Analysis {
    /// The ladder.
    pub program: Arc<Program>,
    /// The conditions of its coils.
    pub conditions: Conditions,
    /// Its states.
    pub states: States,
    /// Its step registers.
    pub registers: Vec<Register>,
    /// Which state may follow which, best first.
    pub successions: Vec<Succession>,
    /// The groups of dependent rungs that hold states.
    pub groups: Vec<Group>,
    /// Atoms that the condition of another variable, a timer or a number
    /// depends on.
    read: HashSet<AtomId>,
    /// What conversions have put into words.
    pub(crate) sums: Sums,
}

/// Recovers everything from `program`. When `budget` is cancelled the answer
/// comes early and is not complete.
pub fn analyse(program: &Arc<Program>, budget: &Budget) -> Analysis {
    let mut conditions = conditions(program, budget);
    let states = states(&conditions, budget);
    let registers = registers(program, &mut conditions, budget);
    let successions = ranked(&conditions, &states, &registers, budget);
    let groups = groups(&conditions, &states, &registers, &successions);
    Analysis {
        program: Arc::clone(program),
        read: atoms_read(&conditions),
        sums: Sums::default(),
        conditions,
        states,
        registers,
        successions,
        groups,
    }
}

fn atoms_read(conditions: &Conditions) -> HashSet<AtomId> {
    let by_coils = conditions.variables.iter().flat_map(|variable| {
        let support = variable.next.as_ref().map_or(&[][..], Function::support);
        support.iter().filter(|atom| **atom != variable.atom)
    });
    let by_timers = conditions
        .timers
        .values()
        .flat_map(|timer| timer.input.as_ref().map_or(&[][..], Function::support));
    let by_numbers = conditions
        .register_writes
        .iter()
        .flat_map(|write| write.guard.as_ref().map_or(&[][..], Function::support));
    by_coils
        .chain(by_timers)
        .chain(by_numbers)
        .copied()
        .collect()
}

impl Analysis {
    /// Whether the plant sees the variable: it is declared an output, has an
    /// output's address, or no rung reads it, so that whoever does is outside.
    pub fn is_output(&self, variable: &Variable) -> bool {
        let declared = self.program.declarations.find(&variable.name);
        let outside = |address: &str| {
            address.starts_with("%Q") || address.contains(":O.") || address.contains(":O:")
        };
        if outside(&variable.name) {
            return true;
        }
        match declared {
            Some(it) if it.class == Class::Output => true,
            Some(it) if it.address.as_deref().is_some_and(outside) => true,
            _ => !self.is_read(variable.atom),
        }
    }

    /// Whether the condition of some other variable, a timer or a number
    /// depends on the atom.
    pub fn is_read(&self, atom: AtomId) -> bool {
        self.read.contains(&atom)
    }

    /// Whether all writes of the variable stand in the definition of a block:
    /// then it belongs to the instances, not to the program.
    pub fn is_in_definition(&self, variable: &Variable) -> bool {
        variable.writes.iter().all(|write| {
            let routine = self.program.routines.get(write.place.routine);
            routine.is_some_and(|routine| routine.role == Role::Definition)
        })
    }

    /// What the source says about a variable, in one line.
    pub fn description(&self, name: &str) -> Option<Name> {
        let description = self.program.declarations.find(name)?.description.as_ref()?;
        let words: Vec<&str> = description.split_whitespace().collect();
        (!words.is_empty()).then(|| words.join(" ").into())
    }
}
