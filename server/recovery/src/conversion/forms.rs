//! In which form each variable is said, so that the spec does what the ladder
//! does scan by scan.
//!
//! A memory is a grafcet of two steps where that is the same as its rung. It
//! need not be: a grafcet evolves until it is stable, and on the way a
//! receptivity sees outputs as the last scan left them and other memories
//! now before and now after they have changed. Where a memory could be led
//! astray by that it is said as its rung says it, by a continuous action that
//! reads its own last value.
//!
//! What a rung sees of the last scan is followed by two steps of its own where
//! a continuous action has to see it.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use logic::{AtomId, Budget, Function, Stop};

use super::astray::Beside;
use super::decisions::Accepted;
use super::seen::Seen;
use super::unsaid::Unsaid;
use crate::Analysis;
use crate::conditions::{Variable, WriteKind};

/// How a variable is said.
#[derive(Clone, Debug)]
pub(super) enum Form {
    /// Two steps; over what receptivities read: outputs of the last scan, and
    /// the steps of other memories.
    Steps(Function),
    /// A continuous action; its own atom is the last value.
    Action(Function),
    /// What it becomes is not known exactly, or a sequence decides it: said
    /// over the steps as they are.
    Rough,
}

/// The forms of all own variables that coils write.
#[derive(Debug)]
pub(super) struct Forms {
    pub(super) seen: Seen,
    forms: BTreeMap<AtomId, Form>,
    /// States that belong to sequences.
    members: BTreeSet<AtomId>,
    /// Why what is said roughly is, and no sequence is the reason.
    pub(super) unsaid: BTreeMap<AtomId, Unsaid>,
    /// Variables whose last value actions read, by their atoms.
    pub(super) followed: BTreeSet<AtomId>,
    /// Variables that have to be there since something reads them.
    pub(super) read: BTreeSet<AtomId>,
}

/// A condition over more atoms than this is not made clearer by putting others
/// into it.
const MOST_ATOMS: usize = 48;

/// Nor is one whose diagram has more nodes than this.
const MOST_NODES: usize = 1_000;

/// Coils put into each other.
const DEEPEST: usize = 8;

impl Forms {
    /// The forms in a spec in which this is accepted.
    pub(super) fn of_spec(analysis: &Analysis, accepted: &Accepted, budget: &Budget) -> Arc<Self> {
        let members = accepted.members().into_iter().collect();
        let known = &analysis.forms;
        known.of(members, budget, |it| Self::new(analysis, it, budget))
    }

    fn new(analysis: &Analysis, members: BTreeSet<AtomId>, budget: &Budget) -> Self {
        let mut choice = Choice {
            analysis,
            seen: Seen::new(analysis, budget),
            members,
            steps: BTreeSet::new(),
            budget: Budget {
                nodes: budget.nodes.min(MOST_NODES),
                ..budget.clone()
            },
        };
        let own: Vec<&Variable> = super::actions::own_variables(analysis)
            .filter(|it| is_coil(it) && choice.seen.is_own(it.atom))
            .collect();
        let mut exact: BTreeMap<AtomId, Function> = BTreeMap::new();
        let mut forms = BTreeMap::new();
        let mut unsaid = BTreeMap::new();
        for variable in own {
            let atom = variable.atom;
            let next = choice.seen.next(atom).cloned();
            if choice.members.contains(&atom) {
                continue;
            }
            match next {
                Ok(next) => {
                    let next = choice.near(&next, atom);
                    if choice.is_touched(&next) {
                        forms.insert(atom, Form::Rough);
                        // What others know of it is that it has two steps.
                        if next.depends_on(atom) {
                            choice.steps.insert(atom);
                        }
                    } else {
                        exact.insert(atom, next);
                    }
                }
                Err(why) => {
                    forms.insert(atom, Form::Rough);
                    unsaid.insert(atom, why);
                    let next = variable.next.as_ref();
                    if next.is_ok_and(|next| next.depends_on(atom)) {
                        choice.steps.insert(atom);
                    }
                }
            }
        }
        for (atom, form) in choice.settled(exact) {
            let form = match form {
                Form::Action(next) => match choice.begun(&next, atom) {
                    Ok(next) => Form::Action(next),
                    Err(_) => {
                        unsaid.insert(atom, Unsaid::TooLarge);
                        Form::Rough
                    }
                },
                form => form,
            };
            forms.insert(atom, form);
        }
        let mut forms = Self {
            seen: choice.seen,
            forms,
            members: choice.members,
            unsaid,
            followed: BTreeSet::new(),
            read: BTreeSet::new(),
        };
        forms.find_read(analysis);
        forms
    }

    /// Whether the variable is a state of a sequence.
    pub(super) fn is_member(&self, atom: AtomId) -> bool {
        self.members.contains(&atom)
    }

    /// The form of a variable; none if a sequence holds it, or no coil of the
    /// program's own that is ever solved.
    pub(super) fn of(&self, atom: AtomId) -> Option<&Form> {
        self.forms.get(&atom)
    }

    /// Finds out what has to be there since actions or receptivities read it.
    fn find_read(&mut self, analysis: &Analysis) {
        let auxiliaries = &analysis.states().auxiliaries;
        let mut open: Vec<AtomId> = Vec::new();
        for (&atom, form) in &self.forms {
            let is_aside = auxiliaries.contains(atom)
                && analysis
                    .conditions
                    .variable(atom)
                    .is_none_or(|it| !analysis.is_output(it));
            if !is_aside || matches!(form, Form::Steps(_)) {
                open.push(atom);
                self.read.insert(atom);
            }
        }
        while let Some(atom) = open.pop() {
            let (function, is_action) = match &self.forms[&atom] {
                Form::Steps(function) => (function, false),
                Form::Action(function) => (function, true),
                Form::Rough => continue,
            };
            let mut found = Vec::new();
            for &read in function.support() {
                if let Some(of) = self.seen.of_before(read) {
                    found.push((of, true));
                } else if self.seen.is_own(read) {
                    found.push((read, false));
                }
                found.extend(self.seen.in_edge(read));
            }
            for (of, is_before) in found {
                if is_before && is_action {
                    self.followed.insert(of);
                }
                if self.forms.contains_key(&of) && self.read.insert(of) {
                    open.push(of);
                }
            }
        }
    }

    /// Whether an action has to know which scan is the first.
    pub(super) fn acts_in_first(&self) -> bool {
        let mut forms = self.forms.values();
        forms.any(|form| match form {
            Form::Action(next) => next.depends_on(self.seen.first),
            Form::Steps(_) | Form::Rough => false,
        })
    }
}

fn is_coil(variable: &Variable) -> bool {
    let mut writes = variable.writes.iter();
    writes.any(|write| matches!(write.kind, WriteKind::Coil(_)))
}

/// Memories, while it is found out which of them are steps.
struct Choice<'a> {
    analysis: &'a Analysis,
    seen: Seen,
    members: BTreeSet<AtomId>,
    /// Variables that have two steps.
    steps: BTreeSet<AtomId>,
    budget: Budget,
}

impl Choice<'_> {
    /// What an action says that reads its own last value: before the first scan
    /// nothing is published.
    fn begun(&self, next: &Function, own: AtomId) -> Result<Function, Stop> {
        if !self.seen.is_initial(own) {
            return Ok(next.clone());
        }
        let first = Function::atom(self.seen.first);
        let last = Function::atom(own).or(&first, &self.budget)?;
        next.substitute(own, &last, &self.budget)
    }

    /// Whether a sequence decides what the function is: a state that belongs
    /// to one, or a register.
    fn is_touched(&self, function: &Function) -> bool {
        let is_member = |atom: AtomId| self.members.contains(&atom);
        function.support().iter().any(|&atom| {
            let of = self.seen.of_before(atom).unwrap_or(atom);
            let registers = || {
                let expr = logic::Expr::Atom(self.seen.atoms.atom(atom).clone());
                let names = crate::order::names_in(&expr);
                let mut registers = self.analysis.registers.iter();
                registers.any(|register| names.contains(&register.name))
            };
            is_member(of)
                || self.seen.in_edge(atom).iter().any(|(of, _)| is_member(*of))
                || registers()
        })
    }

    /// `function`, of the variable `own`, with auxiliary coils resolved.
    fn near(&self, function: &Function, own: AtomId) -> Function {
        let auxiliaries = &self.analysis.states().auxiliaries;
        let (near, _) = self.put_in(function, own, |atom| auxiliaries.contains(atom));
        near
    }

    /// `function` with what the coils among `wanted` become put in their
    /// place, and whether all of them were.
    fn put_in(
        &self,
        function: &Function,
        own: AtomId,
        wanted: impl Fn(AtomId) -> bool,
    ) -> (Function, bool) {
        let mut known = function.clone();
        for _ in 0..DEEPEST {
            let inside: Vec<AtomId> = known
                .support()
                .iter()
                .copied()
                .filter(|atom| *atom != own && self.seen.is_own(*atom) && wanted(*atom))
                .collect();
            if inside.is_empty() {
                return (known, true);
            }
            for atom in inside {
                let Ok(by) = self.seen.next(atom) else {
                    return (known, false);
                };
                if by.depends_on(atom) {
                    return (known, false);
                }
                let put = known.substitute(atom, by, &self.budget);
                let put = put.and_then(|put| match self.seen.before(own) {
                    Some(before) => put.substitute(before, &Function::atom(own), &self.budget),
                    None => Ok(put),
                });
                match put {
                    Ok(put) if put.support().len() <= MOST_ATOMS => known = put,
                    _ => return (known, false),
                }
            }
        }
        (known, false)
    }

    /// The forms of these variables: as many memories as can be are steps.
    fn settled(&mut self, exact: BTreeMap<AtomId, Function>) -> Vec<(AtomId, Form)> {
        let memories: Vec<AtomId> = exact
            .iter()
            .filter(|(atom, next)| next.depends_on(**atom))
            .map(|(atom, _)| *atom)
            .collect();
        self.steps.extend(&memories);
        let mut readers: BTreeMap<AtomId, Vec<AtomId>> = BTreeMap::new();
        let mut receptive: BTreeMap<AtomId, Function> = BTreeMap::new();
        let mut open = memories;
        while let Some(atom) = open.pop() {
            if !self.steps.contains(&atom) {
                continue;
            }
            let said = self.receptive(&exact[&atom], atom);
            let said = said.filter(|said| self.is_memory(atom, said));
            match said.and_then(|said| self.as_read(&said)) {
                Some(said) => {
                    for read in said.support() {
                        readers.entry(*read).or_default().push(atom);
                    }
                    receptive.insert(atom, said);
                }
                None => {
                    self.steps.remove(&atom);
                    open.extend(readers.remove(&atom).unwrap_or_default());
                }
            }
        }
        let form = |(atom, next): (AtomId, Function)| {
            let steps = receptive
                .remove(&atom)
                .filter(|_| self.steps.contains(&atom));
            (atom, steps.map_or(Form::Action(next), Form::Steps))
        };
        exact.into_iter().map(form).collect()
    }

    /// Whether a memory of this condition can be two steps.
    fn is_memory(&self, own: AtomId, said: &Function) -> bool {
        let support = said.support().iter();
        let of = support.map(|atom| self.seen.of_before(*atom).unwrap_or(*atom));
        let steps = of.filter(|it| self.steps.contains(it)).collect();
        let holds = || self.beside().holds(own, said) == Ok(true);
        let known = &self.analysis.forms;
        known.is_memory(own, said, steps, &self.budget, holds)
    }

    /// What may lead a memory astray.
    fn beside(&self) -> Beside<'_> {
        Beside {
            seen: &self.seen,
            steps: &self.steps,
            budget: &self.budget,
        }
    }

    /// The condition of a memory over what receptivities can read; none if
    /// they cannot.
    fn receptive(&self, next: &Function, own: AtomId) -> Option<Function> {
        let (said, is_all) = self.put_in(next, own, |atom| !self.steps.contains(&atom));
        let of_outputs = |atom: &AtomId| !self.seen.in_edge(*atom).is_empty();
        (is_all && !said.support().iter().any(of_outputs)).then_some(said)
    }

    /// The condition as it reads in a receptivity: outputs there are what the
    /// last scan left, and steps what they are. None if that is too large, or
    /// was before the first scan what nobody had published.
    fn as_read(&self, said: &Function) -> Option<Function> {
        let mut read = said.clone();
        for &atom in said.support() {
            if let Some(of) = self.seen.of_before(atom) {
                if self.seen.is_initial(of) && !self.steps.contains(&of) {
                    return None;
                }
                let put = read.substitute(atom, &Function::atom(of), &self.budget);
                read = put.ok()?;
            }
        }
        Some(read)
    }
}
