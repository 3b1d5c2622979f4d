//! What the tool says about a ladder without being asked: findings that are
//! not errors of its text but of its meaning.
//!
//! Each finding is a file with one function; what the text of a file reveals
//! is said by its reader.
//!
//! Most are about one variable, and hold as long as its conditions and its
//! uses are what they were. [`Findings`] keeps them so while a program is
//! edited.

mod constant;
mod double_coil;
mod found;
mod interlock;
mod latches;
mod order;
mod oscillator;
mod too_large;
mod unwritten;
mod words;

use std::sync::Arc;

use imbl::OrdMap;
use ladder::{Program, Rung};
use logic::{AtomId, Budget};
use source::{Diagnostic, Severity};

use crate::conditions::{Conditions, Place, Uses, Variable};
use found::{Found, Mark, Message};

/// A ladder and what is known of it.
struct Subject<'s> {
    program: &'s Program,
    conditions: &'s Conditions,
    budget: &'s Budget,
}

impl<'s> Subject<'s> {
    fn new(program: &'s Program, conditions: &'s Conditions, budget: &'s Budget) -> Self {
        Self {
            program,
            conditions,
            budget,
        }
    }
}

/// What the conditions of a program reveal.
#[derive(Debug, Default)]
pub struct Findings {
    of_variables: OrdMap<AtomId, OfVariable>,
    others: Vec<Found>,
    /// What is wrong with calls and jumps.
    steering: Vec<Diagnostic>,
    is_whole: bool,
}

/// What there is to say of a variable, and what it was told from.
#[derive(Clone, Debug)]
struct OfVariable {
    variable: Arc<Variable>,
    uses: Arc<Uses>,
    /// The variables that lock it out.
    locking: Arc<[Option<Arc<Variable>>]>,
    found: Option<Arc<[Found]>>,
}

/// Everything that the conditions of `program` reveal, in the order of the
/// places.
pub fn findings(program: &Program, conditions: &Conditions, budget: &Budget) -> Vec<Diagnostic> {
    Findings::of(program, conditions, None, budget).told(program, usize::MAX)
}

impl Findings {
    /// Everything that `conditions` reveal. What is the same in `earlier`, the
    /// findings about the program before it was edited, is kept.
    pub(crate) fn of(
        program: &Program,
        conditions: &Conditions,
        earlier: Option<&Self>,
        budget: &Budget,
    ) -> Self {
        let subject = Subject::new(program, conditions, budget);
        let mut of_variables = earlier.map_or_else(OrdMap::new, |it| it.of_variables.clone());
        let gone = of_variables
            .keys()
            .filter(|atom| conditions.variable(**atom).is_none());
        for atom in gone.copied().collect::<Vec<_>>() {
            of_variables.remove(&atom);
        }
        for variable in &conditions.variables {
            let was = of_variables.get(&variable.atom);
            if !was.is_some_and(|was| was.is_true_of(variable, conditions)) {
                of_variables.insert(variable.atom, of_variable(&subject, variable));
            }
        }
        Self::with(of_variables, &subject)
    }

    /// The same after edits that touched nothing but these variables.
    pub(crate) fn after(
        &self,
        touched: &[AtomId],
        program: &Program,
        conditions: &Conditions,
        budget: &Budget,
    ) -> Self {
        let subject = Subject::new(program, conditions, budget);
        let locked_by = |variable: &Arc<Variable>| variable.closed_contacts.clone();
        let was = touched
            .iter()
            .filter_map(|it| Some(&self.of_variables.get(it)?.variable));
        let is = touched.iter().filter_map(|it| conditions.kept(*it));
        let mut anew: Vec<AtomId> = was.chain(is).flat_map(locked_by).collect();
        anew.extend(touched);
        anew.sort_unstable();
        anew.dedup();
        let mut of_variables = self.of_variables.clone();
        for atom in anew {
            match conditions.kept(atom) {
                Some(variable) => of_variables.insert(atom, of_variable(&subject, variable)),
                None => of_variables.remove(&atom),
            };
        }
        Self::with(of_variables, &subject)
    }

    fn with(of_variables: OrdMap<AtomId, OfVariable>, subject: &Subject<'_>) -> Self {
        Self {
            of_variables,
            others: unwritten::find(subject),
            steering: subject.conditions.steering.clone(),
            is_whole: !subject.budget.cancel.is_cancelled(),
        }
    }

    /// Whether nobody ended the work early.
    pub(crate) fn is_whole(&self) -> bool {
        self.is_whole
    }

    /// The findings in the order of the places, as the text of `program` now
    /// stands. Of the hints that have one code no more than the first `most`
    /// are told; the last of them says how many there are.
    pub(crate) fn told(&self, program: &Program, most: usize) -> Vec<Diagnostic> {
        let found = self
            .of_variables
            .values()
            .filter_map(|it| it.found.as_deref());
        let mut found: Vec<&Found> = found.flatten().chain(&self.others).collect();
        let mut told = self.steering.clone();
        found.sort_by_key(|it| (it.code(), it.place()));
        for alike in found.chunk_by(|a, b| a.code() == b.code()) {
            let most = match alike[0].code().severity() {
                Severity::Hint => most,
                _ => usize::MAX,
            };
            let shown = alike.iter().take(most).map(|it| it.told(program));
            told.extend(shown);
            if let (true, Some(last)) = (alike.len() > most, told.last_mut()) {
                let more = alike.len() - most;
                last.message +=
                    &format!(" (and {more} more like it, which `gradus check --hints` lists)");
            }
        }
        told.sort_by_key(|diagnostic| (diagnostic.span, diagnostic.code));
        told
    }
}

impl OfVariable {
    /// Whether it was told from what is known of `variable` now.
    fn is_true_of(&self, variable: &Arc<Variable>, conditions: &Conditions) -> bool {
        let is_same =
            |(atom, was): (&AtomId, &Option<Arc<Variable>>)| match (conditions.kept(*atom), was) {
                (Some(now), Some(was)) => Arc::ptr_eq(now, was),
                (now, was) => now.is_none() && was.is_none(),
            };
        let locking = variable.closed_contacts.iter().zip(&*self.locking);
        Arc::ptr_eq(&self.variable, variable)
            && conditions.names.is_used_as(&variable.name, &self.uses)
            && locking.into_iter().all(is_same)
    }
}

fn of_variable(subject: &Subject<'_>, variable: &Arc<Variable>) -> OfVariable {
    let uses = subject.conditions.names.uses(&variable.name);
    let uses = uses.cloned().unwrap_or_default();
    let locking = interlock::locking(subject, variable);
    let mut found = Vec::new();
    for find in [
        constant::find,
        double_coil::find,
        latches::find,
        oscillator::find,
        too_large::find,
        words::find,
    ] {
        find(subject, variable, &mut found);
    }
    interlock::find(variable, &locking, &mut found);
    order::find(subject, variable, &uses, &mut found);
    OfVariable {
        variable: Arc::clone(variable),
        uses,
        locking: locking.into(),
        found: (!found.is_empty()).then(|| found.into()),
    }
}

impl Subject<'_> {
    fn rung(&self, place: Place) -> Option<&Rung> {
        let routine = self.program.routines.get(place.routine)?;
        routine.rungs.get(place.rung)
    }
}
