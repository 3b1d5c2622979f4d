//! Followers that start instead of each other, or alone.

use logic::{AtomId, Function, Name, Stop};

use super::builder::Builder;
use crate::conversion::branches::BranchId;
use crate::states::State;
use crate::successions::{handed_over, started_apart};

impl Builder<'_> {
    /// An OR divergence, or a plain succession.
    pub(super) fn alternatives(
        &mut self,
        state: &State,
        branch: BranchId,
        step: &Name,
        followers: &[AtomId],
        leave: Function,
    ) {
        let followers: Vec<&State> = followers.iter().filter_map(|a| self.state(*a)).collect();
        if self.start_as_it_ends(state, &followers) {
            for follower in followers {
                let condition = self
                    .handed_over(state, follower)
                    .or_else(|| {
                        let starts = follower.turns_on.restrict(state.atom, true);
                        leave.and(&starts, self.budget).ok()
                    })
                    .unwrap_or_else(|| leave.clone());
                let target = self.target(follower.atom, branch);
                self.arc(std::slice::from_ref(step), vec![target], condition);
            }
            return;
        }
        let wait = self.wait(
            &format!("D{}", state.name),
            format!("{} has ended; waits for what follows", state.name),
        );
        self.arc(std::slice::from_ref(step), vec![wait.clone()], leave);
        for follower in followers {
            self.start_from(&wait, follower, state.atom, branch);
        }
    }

    /// A transition from a waiting step to a state that now starts.
    pub(super) fn start_from(
        &mut self,
        wait: &Name,
        follower: &State,
        ended: AtomId,
        branch: BranchId,
    ) {
        let starts = follower
            .turns_on
            .restrict(follower.atom, false)
            .restrict(ended, false);
        let target = self.target(follower.atom, branch);
        self.arc(std::slice::from_ref(wait), vec![target], starts);
    }

    fn handed_over(&self, from: &State, to: &State) -> Option<Function> {
        let (states, conditions) = (&self.analysis.states(), &self.analysis.conditions);
        handed_over(from, to, states, conditions, self.budget)
    }

    /// Whether leaving a state always means starting one of its followers, in
    /// the plain form of the conditions, in which a chain's transition bits
    /// say so, or in the resolved one.
    fn start_as_it_ends(&self, state: &State, followers: &[&State]) -> bool {
        let plain = (
            state.plain_turns_on(),
            state.plain_deactivation(),
            followers.iter().map(|f| f.plain_turns_on()).collect(),
        );
        let resolved = (
            state.turns_on.clone(),
            state.deactivation.clone(),
            followers.iter().map(|f| f.turns_on.clone()).collect(),
        );
        [plain, resolved].into_iter().any(|(again, ends, starts)| {
            let starts: Vec<Function> = starts;
            self.covers(state.atom, followers, &again, &ends, &starts) == Ok(true)
        })
    }

    fn covers(
        &self,
        from: AtomId,
        followers: &[&State],
        again: &Function,
        ends: &Function,
        starts: &[Function],
    ) -> Result<bool, Stop> {
        let situation = |function: &Function| {
            followers
                .iter()
                .fold(function.restrict(from, true), |function, follower| {
                    function.restrict(follower.atom, false)
                })
        };
        let mut ends = situation(ends);
        // As in a handover: not started again at that same moment.
        if starts.iter().all(|start| started_apart(again, start)) {
            ends = ends.and_not(again, self.budget)?;
        }
        let sum = starts
            .iter()
            .try_fold(Function::constant(false), |sum, start| {
                sum.or(&situation(start), self.budget)
            })?;
        ends.implies(&sum, self.budget)
    }
}
