use std::collections::HashSet;
use std::sync::{Arc, OnceLock};

use ladder::{Class, Program, Role};
use logic::{AtomId, Budget, Function, Name};
use source::Diagnostic;

use crate::conditions::{Conditions, Variable, conditions, conditions_after};
use crate::conversion::{KnownForms, Sums};
use crate::findings::Findings;
use crate::groups::{Group, groups};
use crate::order::Order;
use crate::registers::{Register, registers};
use crate::states::{States, states};
use crate::successions::{Comparisons, Sights, Succession, ranked, with_sights};

/// All that is recovered from a ladder before anybody decides anything.
///
/// What stands between states is worked out when somebody first asks for it:
/// the findings about a ladder that is being typed need its conditions only.
#[derive(Clone, Debug)]
pub struct Analysis {
    /// The ladder.
    pub program: Arc<Program>,
    /// The conditions of its coils.
    pub conditions: Conditions,
    /// Its step registers.
    pub registers: Vec<Register>,
    recovered: OnceLock<Arc<Recovered>>,
    /// What somebody saw happen, and the suggestions with it.
    seen: Option<Arc<(Sights, Vec<Succession>)>>,
    /// What was known before a change.
    earlier: Earlier,
    findings: OnceLock<Arc<Findings>>,
    budget: Budget,
    /// Atoms that the condition of another variable, a timer or a number
    /// depends on.
    read: OnceLock<HashSet<AtomId>>,
    order: OnceLock<Arc<Order>>,
    /// What conversions have put into words, and found to be right.
    pub(crate) sums: Sums,
    pub(crate) forms: KnownForms,
}

/// What was known of a program before it was changed.
#[derive(Clone, Debug, Default)]
struct Earlier {
    recovered: Option<Arc<Recovered>>,
    findings: Option<Arc<Findings>>,
    /// The variables that were touched since the findings were made; `None` if
    /// it may have been any.
    touched: Option<Vec<AtomId>>,
}

/// What is recovered of a program's states.
#[derive(Debug)]
struct Recovered {
    states: States,
    successions: Vec<Succession>,
    comparisons: Comparisons,
    groups: Vec<Group>,
    /// Whether nobody ended the work early.
    is_whole: bool,
}

/// What of a program was computed, and not kept from before a change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Anew {
    /// Rungs that were solved.
    pub rungs: usize,
    /// Variables whose writes were folded into a next value.
    pub variables: usize,
    /// States that were worked out.
    pub states: usize,
    /// Pairs of states that were compared.
    pub pairs: usize,
}

/// Recovers everything from `program`. When `budget` is cancelled the answer
/// comes early and is not complete.
pub fn analyse(program: &Arc<Program>, budget: &Budget) -> Analysis {
    let conditions = conditions(program, budget);
    analysed(program, conditions, Earlier::default(), budget)
}

/// The same for a program that was changed since `before`. Whatever the change
/// does not touch is kept: the answer is that of [`analyse`], but for the
/// numbers of atoms.
pub fn analyse_after(before: &Analysis, program: &Arc<Program>, budget: &Budget) -> Analysis {
    let conditions = conditions_after(&before.program, &before.conditions, program, budget);
    let recovered = before.recovered.get().filter(|it| it.is_whole);
    let findings = before.findings.get().filter(|it| it.is_whole());
    let touched = match findings {
        Some(_) => Some(Vec::new()),
        None => before.earlier.touched.clone(),
    };
    let earlier = Earlier {
        recovered: recovered.or(before.earlier.recovered.as_ref()).cloned(),
        findings: findings.or(before.earlier.findings.as_ref()).cloned(),
        touched: touched
            .zip(conditions.touched.as_ref())
            .map(|(mut all, new)| {
                all.extend(new);
                all
            }),
    };
    analysed(program, conditions, earlier, budget)
}

fn analysed(
    program: &Arc<Program>,
    mut conditions: Conditions,
    earlier: Earlier,
    budget: &Budget,
) -> Analysis {
    let registers = registers(program, &mut conditions, budget);
    conditions.atoms.settle();
    Analysis {
        program: Arc::clone(program),
        conditions,
        registers,
        recovered: OnceLock::new(),
        seen: None,
        findings: OnceLock::new(),
        earlier,
        budget: budget.clone(),
        read: OnceLock::new(),
        order: OnceLock::new(),
        sums: Sums::default(),
        forms: KnownForms::default(),
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
    /// Its states.
    pub fn states(&self) -> &States {
        &self.recovered().states
    }

    /// Which state may follow which, best first; with what was
    /// [seen](Self::seeing), if somebody has told.
    pub fn successions(&self) -> &[Succession] {
        match self.seen.as_deref() {
            Some((_, successions)) => successions,
            None => &self.recovered().successions,
        }
    }

    /// The same with what a search through the sequences of inputs has seen.
    pub fn seeing(&self, sights: Sights) -> Self {
        let recovered = self.recovered();
        let successions = with_sights(
            &recovered.successions,
            &sights,
            &recovered.states,
            &self.budget,
        );
        Self {
            seen: Some(Arc::new((sights, successions))),
            ..self.clone()
        }
    }

    /// What was seen, if somebody has told.
    pub fn sights(&self) -> Option<&Sights> {
        self.seen.as_deref().map(|(sights, _)| sights)
    }

    /// The groups of dependent rungs that hold states.
    pub fn groups(&self) -> &[Group] {
        &self.recovered().groups
    }

    /// Whether the work on its conditions came to its end, and so can be built
    /// on when the program changes.
    pub fn is_whole(&self) -> bool {
        self.conditions.is_whole()
    }

    /// What was computed for it, its states included.
    pub fn anew(&self) -> Anew {
        let recovered = self.recovered();
        Anew {
            rungs: self.conditions.work.rungs,
            variables: self.conditions.work.variables,
            states: recovered.states.anew,
            pairs: recovered.comparisons.anew,
        }
    }

    /// What its conditions reveal, in the order of the places. Of the hints that
    /// have one code no more than the first `most` are told; the last of them
    /// says how many there are.
    pub fn findings(&self, most: usize) -> Vec<Diagnostic> {
        let findings = self.findings.get_or_init(|| {
            let (program, conditions) = (&self.program, &self.conditions);
            let found = match (&self.earlier.findings, &self.earlier.touched) {
                (Some(earlier), Some(touched)) => {
                    earlier.after(touched, program, conditions, &self.budget)
                }
                (earlier, _) => Findings::of(program, conditions, earlier.as_deref(), &self.budget),
            };
            found.into()
        });
        findings.told(&self.program, most)
    }

    fn recovered(&self) -> &Recovered {
        self.recovered.get_or_init(|| {
            let was = self.earlier.recovered.as_deref();
            let (conditions, budget) = (&self.conditions, &self.budget);
            let states = states(conditions, was.map(|it| &it.states), budget);
            let (successions, comparisons) = ranked(
                conditions,
                &states,
                &self.registers,
                was.map(|it| &it.comparisons),
                budget,
            );
            let groups = groups(conditions, &states, &self.registers, &successions);
            let is_whole = !budget.cancel.is_cancelled();
            Arc::new(Recovered {
                states,
                successions,
                comparisons,
                groups,
                is_whole,
            })
        })
    }

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
        self.read
            .get_or_init(|| atoms_read(&self.conditions))
            .contains(&atom)
    }

    /// When its rungs are solved, and who writes what there.
    pub(crate) fn order(&self) -> &Order {
        let order = || Arc::new(Order::new(&self.program));
        self.order.get_or_init(order)
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
