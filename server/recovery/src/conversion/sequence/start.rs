//! Where a sequence starts.

use std::collections::BTreeSet;

use logic::{Atom, AtomId, Function};

use super::builder::{Activity, Builder};
use super::plan::PlannedStep;
use crate::conversion::branches::{Branch, BranchId};
use crate::conversion::naming::short;
use crate::registers::is_first_scan;
use crate::states::State;

impl Builder<'_> {
    /// The initial step: the state that the expert names, or that the first
    /// scan sets; else a step that waits for the first state to turn on.
    pub(super) fn begin(&mut self) {
        let members = self.plan.members.clone();
        let mut initial: Vec<AtomId> = members
            .iter()
            .copied()
            .filter(|atom| self.accepted.initial.contains(atom))
            .collect();
        if initial.is_empty() {
            let set_first = |atom: &AtomId| self.state(*atom).is_some_and(|s| self.is_set_first(s));
            initial = members.iter().copied().filter(set_first).collect();
        }
        if let Some(&first) = initial.first() {
            let start = self.name_step(first);
            self.branches.push(Branch::root(start.clone()));
            for atom in initial {
                let name = if atom == first {
                    start.clone()
                } else {
                    self.name_step(atom)
                };
                self.add_state(atom, BranchId::ROOT, name, Activity::Initial);
            }
            return;
        }
        let firsts = self.firsts();
        let of = firsts.first().map_or("", |atom| self.name(*atom));
        let start = self.names.step(&format!("{}_waits", short(of)));
        self.plan.steps.push(PlannedStep {
            name: start.clone(),
            initial: true,
            state: None,
            comment: Some("nothing runs yet".into()),
        });
        self.branches.push(Branch::root(start.clone()));
        for atom in firsts {
            let Some(state) = self.state(atom) else {
                continue;
            };
            let condition = self.with_all_off(&state.turns_on, &members);
            let target = self.step_of(atom, BranchId::ROOT);
            self.arc(std::slice::from_ref(&start), vec![target], condition);
        }
    }

    /// The states that start a sequence: those that follow none, or, where
    /// all follow some, the first that can start while all others are off; and
    /// as many more as it takes to reach every state.
    fn firsts(&self) -> Vec<AtomId> {
        let members = &self.plan.members;
        let followers: BTreeSet<AtomId> = self
            .accepted
            .followers
            .iter()
            .filter(|(from, _)| members.contains(from))
            .flat_map(|(_, groups)| groups.iter().flatten().copied())
            .collect();
        let mut firsts: Vec<AtomId> = members.difference(&followers).copied().collect();
        let mut reached = self.reachable(&firsts, &BTreeSet::new());
        for &atom in members {
            let starts = self
                .state(atom)
                .is_some_and(|s| !self.with_all_off(&s.turns_on, members).is_false());
            if !reached.contains(&atom) && starts {
                firsts.push(atom);
                reached = self.reachable(&firsts, &BTreeSet::new());
            }
        }
        firsts
    }

    /// The states that accepted successions lead to from `from`, these
    /// included, without going through `except`.
    pub(super) fn reachable(&self, from: &[AtomId], except: &BTreeSet<AtomId>) -> BTreeSet<AtomId> {
        let mut reached: BTreeSet<AtomId> = BTreeSet::new();
        let mut open: Vec<AtomId> = from.to_vec();
        while let Some(atom) = open.pop() {
            if except.contains(&atom) || !reached.insert(atom) {
                continue;
            }
            let groups = self.accepted.followers.get(&atom);
            open.extend(groups.into_iter().flatten().flatten().copied());
        }
        reached
    }

    fn is_set_first(&self, state: &State) -> bool {
        let by_first_scan = state.next.support().iter().any(|&atom| {
            matches!(self.analysis.conditions.atoms.atom(atom), Atom::Variable(n) if is_first_scan(n))
                && state.next.restrict(atom, true).is_true()
        });
        // Values in a Rockwell export are a snapshot of the running plant and
        // say nothing about the start.
        let declared = self.analysis.program.declarations.find(&state.name);
        let snapshot = matches!(
            self.analysis.program.format,
            ladder::Format::L5x | ladder::Format::L5k
        );
        let by_declaration = !snapshot
            && declared
                .and_then(|it| it.initial.as_deref())
                .is_some_and(|value| matches!(value, "1" | "TRUE" | "true"));
        by_first_scan || by_declaration
    }

    fn with_all_off(&self, function: &Function, members: &BTreeSet<AtomId>) -> Function {
        members.iter().fold(function.clone(), |function, atom| {
            function.restrict(*atom, false)
        })
    }
}
