use std::collections::{BTreeMap, BTreeSet, VecDeque};

use logic::{AtomId, Budget, Function, Name};

use super::plan::{Plan, PlannedArc, PlannedStep};
use crate::Analysis;
use crate::conversion::branches::{Branch, BranchId};
use crate::conversion::decisions::Accepted;
use crate::conversion::naming::Names;
use crate::states::State;

/// A plan in the making: what is planned, and what still has to be.
pub(super) struct Builder<'b> {
    pub(super) analysis: &'b Analysis,
    pub(super) accepted: &'b Accepted,
    pub(super) names: &'b mut Names,
    pub(super) budget: &'b Budget,
    pub(super) plan: Plan,
    pub(super) branches: Vec<Branch>,
    pub(super) steps: BTreeMap<(AtomId, BranchId), Name>,
    open: VecDeque<(AtomId, BranchId)>,
}

impl<'b> Builder<'b> {
    pub(super) fn new(
        analysis: &'b Analysis,
        accepted: &'b Accepted,
        members: BTreeSet<AtomId>,
        names: &'b mut Names,
        budget: &'b Budget,
    ) -> Self {
        Self {
            analysis,
            accepted,
            names,
            budget,
            plan: Plan {
                steps: Vec::new(),
                arcs: Vec::new(),
                members,
                forks: false,
            },
            branches: Vec::new(),
            steps: BTreeMap::new(),
            open: VecDeque::new(),
        }
    }

    /// Plans the sequence from its start, state by state.
    pub(super) fn build(&mut self) {
        self.begin();
        while let Some((state, branch)) = self.open.pop_front() {
            self.expand(state, branch);
        }
    }

    /// The state of a member; members were found among the states.
    pub(super) fn state(&self, atom: AtomId) -> Option<&'b State> {
        self.analysis.states().state(atom)
    }

    pub(super) fn name(&self, atom: AtomId) -> &'b str {
        self.state(atom).map_or("", |state| &state.name)
    }

    /// Draws what follows a state in a branch.
    fn expand(&mut self, atom: AtomId, branch: BranchId) {
        let Some(state) = self.state(atom) else {
            return;
        };
        let step = self.step_of(atom, branch);
        let (forks, singles) = self.followers(atom, branch);
        let all: Vec<AtomId> = forks.iter().chain(&singles).copied().collect();
        // What ends it by itself; that a follower is on is not what it
        // waits for.
        let leave = all
            .iter()
            .fold(state.deactivation.clone(), |function, other| {
                function.restrict(*other, false)
            })
            .restrict(atom, true);
        if self.accepted.ends.contains(&atom) {
            self.arc(std::slice::from_ref(&step), Vec::new(), leave);
        } else if all.is_empty() {
            let end = self.branches[branch.0].end.clone();
            self.arc(std::slice::from_ref(&step), vec![end], leave);
        } else if forks.is_empty() {
            self.alternatives(state, branch, &step, &singles, leave);
        } else {
            self.divergence(state, branch, &step, &forks, &singles, leave);
        }
    }

    /// The accepted followers of a state that a branch can lead to: the first
    /// company that starts together, and all that start alone.
    fn followers(&self, atom: AtomId, branch: BranchId) -> (Vec<AtomId>, Vec<AtomId>) {
        let foreign = &self.branches[branch.0].foreign;
        let groups = self.accepted.followers.get(&atom);
        let mut company = Vec::new();
        let mut singles = Vec::new();
        for group in groups.into_iter().flatten() {
            let mut here: Vec<AtomId> = group
                .iter()
                .copied()
                .filter(|to| !foreign.contains(to) && *to != atom)
                .collect();
            here.dedup();
            if here.len() > 1 && company.is_empty() && !self.branches[branch.0].is_full(atom) {
                company = here;
            } else {
                singles.extend(here);
            }
        }
        singles.retain(|single| !company.contains(single));
        singles.dedup();
        (company, singles)
    }

    /// Names a step of a state.
    pub(super) fn name_step(&mut self, atom: AtomId) -> Name {
        let wanted = format!("X{}", self.name(atom));
        self.names.step(&wanted)
    }

    /// Adds a step of a state; what follows it is still to be planned.
    pub(super) fn add_state(
        &mut self,
        atom: AtomId,
        branch: BranchId,
        name: Name,
        activity: Activity,
    ) {
        self.plan.steps.push(PlannedStep {
            name: name.clone(),
            initial: activity == Activity::Initial,
            state: Some(atom),
            comment: None,
        });
        self.steps.insert((atom, branch), name);
        self.open.push_back((atom, branch));
    }

    /// The step of a state in a branch, made when first needed. A state that
    /// is reached in two branches has two steps.
    pub(super) fn step_of(&mut self, atom: AtomId, branch: BranchId) -> Name {
        if let Some(name) = self.steps.get(&(atom, branch)) {
            return name.clone();
        }
        let name = self.name_step(atom);
        self.add_state(atom, branch, name.clone(), Activity::Inactive);
        name
    }

    /// Where a transition to a state leads within a branch: to its step, or to
    /// the step in which the branch waits for the others to join it there.
    pub(super) fn target(&mut self, atom: AtomId, branch: BranchId) -> Name {
        match self.branches[branch.0].joins.get(&atom) {
            Some(wait) => wait.clone(),
            None => self.step_of(atom, branch),
        }
    }

    /// Adds a step that stands for no state.
    pub(super) fn wait(&mut self, wanted: &str, comment: String) -> Name {
        let name = self.names.step(wanted);
        self.plan.steps.push(PlannedStep {
            name: name.clone(),
            initial: false,
            state: None,
            comment: Some(comment.into()),
        });
        name
    }

    /// A transition from all of `from` to all of `to`, called after the first
    /// of each.
    pub(super) fn arc(&mut self, from: &[Name], to: Vec<Name>, condition: Function) {
        let bare = |name: &str| name.strip_prefix('X').unwrap_or(name).to_owned();
        let start = from.first().map_or("start", |name| name);
        let end = to.first().map_or("end", |name| name);
        self.plan.arcs.push(PlannedArc {
            label: format!("{}_to_{}", bare(start), bare(end)),
            from: from.to_vec(),
            to,
            condition,
        });
    }
}

/// Whether a step is active at the start.
#[derive(PartialEq)]
pub(super) enum Activity {
    Initial,
    Inactive,
}
