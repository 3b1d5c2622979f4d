//! Followers that start together: where branches open and where they join.

use std::collections::BTreeSet;

use logic::{AtomId, Function, Name};

use super::builder::Builder;
use crate::conversion::branches::{Branch, BranchId, Divergence};
use crate::states::State;

impl Builder<'_> {
    /// An AND divergence: the followers of `company` start together, each in
    /// a branch of its own; `others` start instead of one of them.
    pub(super) fn divergence(
        &mut self,
        state: &State,
        branch: BranchId,
        step: &Name,
        company: &[AtomId],
        others: &[AtomId],
        leave: Function,
    ) {
        self.plan.forks = true;
        let outer = self.branches[branch.0].clone();
        let barred: BTreeSet<AtomId> = outer.foreign.iter().copied().chain([state.atom]).collect();
        let reach: Vec<BTreeSet<AtomId>> = company
            .iter()
            .map(|member| self.reachable(&[*member], &barred))
            .collect();
        let divergence = Divergence::new(state.atom, &reach, &self.accepted.followers);
        let attached = self.attached(company, others, &divergence);

        let mut entries = Vec::new();
        let mut inner = Vec::new();
        for (at, member) in company.iter().enumerate() {
            let name = self.name(*member).to_owned();
            let end = self.wait(
                &format!("E{name}"),
                format!("the branch of {name} waits for the others"),
            );
            let id = BranchId(self.branches.len());
            self.branches
                .push(divergence.branch(at, &outer, end.clone()));
            inner.push((id, end));
        }
        for (at, member) in company.iter().enumerate() {
            let (id, _) = inner[at];
            let Some(follower) = self.state(*member) else {
                continue;
            };
            let starts = follower
                .turns_on
                .restrict(state.atom, true)
                .restrict(follower.atom, false);
            let at_once = leave.implies(&starts, self.budget) == Ok(true);
            if at_once && attached[at].is_empty() {
                let target = self.target(*member, id);
                entries.push(target);
                continue;
            }
            let wait = self.wait(
                &format!("W{}", follower.name),
                format!("waits for {} to start", follower.name),
            );
            entries.push(wait.clone());
            self.start_from(&wait, follower, state.atom, id);
            for other in &attached[at] {
                if let Some(other) = self.state(*other) {
                    self.start_from(&wait, other, state.atom, id);
                }
            }
        }
        self.arc(std::slice::from_ref(step), entries, leave);
        self.convergence(state, branch, &outer, &divergence, &inner);
    }

    /// Which of `others` starts instead of which member of the company: of the
    /// one in whose branch it lies, or that it locks out.
    fn attached(
        &self,
        company: &[AtomId],
        others: &[AtomId],
        divergence: &Divergence,
    ) -> Vec<Vec<AtomId>> {
        let mut attached = vec![Vec::new(); company.len()];
        for &other in others {
            let excludes = |member: &AtomId| {
                let (Some(a), Some(b)) = (self.state(*member), self.state(other)) else {
                    return false;
                };
                a.interlocks.contains(&other)
                    || b.interlocks.contains(member)
                    || a.turns_on.meets(&b.turns_on, self.budget) == Ok(false)
            };
            let at = company
                .iter()
                .position(excludes)
                .or_else(|| divergence.own.iter().position(|own| own.contains(&other)))
                .unwrap_or(0);
            attached[at].push(other);
        }
        attached
    }

    /// Joins the branches of a divergence: first those that lead to a common
    /// state, there; in the end all that are left.
    fn convergence(
        &mut self,
        state: &State,
        branch: BranchId,
        outer: &Branch,
        divergence: &Divergence,
        inner: &[(BranchId, Name)],
    ) {
        let joining: Vec<Name> = divergence
            .joining
            .iter()
            .map(|at| inner[*at].1.clone())
            .collect();
        let mut left: Vec<Name> = (0..inner.len())
            .filter(|at| !divergence.joining.contains(at))
            .map(|at| inner[at].1.clone())
            .collect();
        if !joining.is_empty() {
            let after = if left.is_empty() {
                branch
            } else {
                let end = self.wait(
                    &format!("E{}_joined", state.name),
                    "the joined branches wait for the others".to_owned(),
                );
                left.push(end.clone());
                let id = BranchId(self.branches.len());
                self.branches.push(divergence.after_join(outer, end));
                id
            };
            let meeting: Vec<&State> = divergence
                .meeting
                .iter()
                .filter_map(|atom| self.state(*atom))
                .collect();
            for target in meeting {
                let starts = target.turns_on.restrict(target.atom, false);
                let step = self.step_of(target.atom, after);
                self.arc(&joining, vec![step], starts);
            }
        }
        if !left.is_empty() {
            let condition = Function::constant(true);
            self.arc(&left, vec![outer.end.clone()], condition);
        }
    }
}
