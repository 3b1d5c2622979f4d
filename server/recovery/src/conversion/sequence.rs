//! Sequences: states merged by the successions that the expert accepted.
//!
//! A succession P -> F becomes P -> D -> F (the paper, section 3.3): the first
//! transition bears what ends P, the second what starts F, and D is a step
//! that waits between. D is left out where leaving P already means starting a
//! follower. Followers that start together open branches; see
//! [`branches`](super::branches) for how these end.

use std::collections::{BTreeMap, BTreeSet, HashMap, VecDeque};

use grafcet::{Chart, Step, Transition};
use logic::{Atom, AtomId, Budget, Function, Name, Stop};
use petgraph::unionfind::UnionFind;

use super::branches::{Branch, BranchId, Divergence};
use super::decisions::Accepted;
use super::naming::{Names, short};
use super::wording::Wording;
use crate::Analysis;
use crate::registers::is_first_scan;
use crate::states::State;
use crate::successions::{handed_over, started_apart};

/// A sequence, planned but not yet worded.
pub(super) struct Plan {
    steps: Vec<PlannedStep>,
    arcs: Vec<PlannedArc>,
    members: BTreeSet<AtomId>,
    /// Whether several of its steps can be active at once.
    pub(super) forks: bool,
}

struct PlannedStep {
    name: Name,
    initial: bool,
    state: Option<AtomId>,
    comment: Option<Name>,
}

struct PlannedArc {
    label: String,
    from: Vec<Name>,
    to: Vec<Name>,
    condition: Function,
}

impl Plan {
    /// Whether a state belongs to the sequence.
    pub(super) fn holds(&self, state: AtomId) -> bool {
        self.members.contains(&state)
    }

    /// Draws the plan into `chart`.
    pub(super) fn draw(
        &self,
        analysis: &Analysis,
        names: &mut Names,
        wording: &Wording<'_>,
        chart: &mut Chart,
    ) {
        for step in &self.steps {
            let state = step.state.and_then(|atom| analysis.states.state(atom));
            chart.steps.push(Step {
                initial: step.initial,
                state: state.map(|state| state.name.clone()),
                comment: match state {
                    Some(state) => analysis.description(&state.name),
                    None => step.comment.clone(),
                },
                ..Step::new(step.name.clone())
            });
        }
        for arc in &self.arcs {
            let name = names.transition(&arc.label);
            let receptivity = wording.say_or_name(&arc.condition, &name);
            chart.transitions.push(Transition {
                name,
                from: arc.from.clone(),
                to: arc.to.clone(),
                receptivity,
                comment: None,
            });
        }
    }
}

/// A plan for every set of states that accepted successions tie together, in
/// the order of their first states.
pub(super) fn plans(
    analysis: &Analysis,
    accepted: &Accepted,
    names: &mut Names,
    wording: &mut Wording<'_>,
    budget: &Budget,
) -> Vec<Plan> {
    components(accepted)
        .into_iter()
        .map(|members| {
            let mut builder = Builder::new(analysis, accepted, members, names, budget);
            builder.build();
            for ((state, _), step) in &builder.steps {
                wording.stands_for(*state, step.clone());
            }
            builder.plan
        })
        .collect()
}

fn components(accepted: &Accepted) -> Vec<BTreeSet<AtomId>> {
    let members: Vec<AtomId> = accepted.members().into_iter().collect();
    let place: HashMap<AtomId, usize> = members.iter().copied().zip(0..).collect();
    let mut union = UnionFind::new(members.len());
    for (from, groups) in &accepted.followers {
        for to in groups.iter().flatten() {
            union.union(place[from], place[to]);
        }
    }
    let mut classes: BTreeMap<usize, BTreeSet<AtomId>> = BTreeMap::new();
    for (at, member) in members.iter().enumerate() {
        classes.entry(union.find(at)).or_default().insert(*member);
    }
    let mut components: Vec<_> = classes.into_values().collect();
    components.sort_by_key(|members| members.first().copied());
    components
}

struct Builder<'b> {
    analysis: &'b Analysis,
    accepted: &'b Accepted,
    names: &'b mut Names,
    budget: &'b Budget,
    plan: Plan,
    branches: Vec<Branch>,
    steps: BTreeMap<(AtomId, BranchId), Name>,
    open: VecDeque<(AtomId, BranchId)>,
}

impl<'b> Builder<'b> {
    fn new(
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

    fn build(&mut self) {
        self.begin();
        while let Some((state, branch)) = self.open.pop_front() {
            self.expand(state, branch);
        }
    }

    /// The state of a member; members were found among the states.
    fn state(&self, atom: AtomId) -> Option<&'b State> {
        self.analysis.states.state(atom)
    }

    fn name(&self, atom: AtomId) -> &'b str {
        self.state(atom).map_or("", |state| &state.name)
    }

    /// The initial step: the state that the expert names, or that the first
    /// scan sets; else a step that waits for the first state to turn on.
    fn begin(&mut self) {
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
            self.arc(
                &start,
                std::slice::from_ref(&start),
                vec![target],
                condition,
            );
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
    fn reachable(&self, from: &[AtomId], except: &BTreeSet<AtomId>) -> BTreeSet<AtomId> {
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

    fn name_step(&mut self, atom: AtomId) -> Name {
        let wanted = format!("X{}", self.name(atom));
        self.names.step(&wanted)
    }

    fn add_state(&mut self, atom: AtomId, branch: BranchId, name: Name, activity: Activity) {
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
    fn step_of(&mut self, atom: AtomId, branch: BranchId) -> Name {
        if let Some(name) = self.steps.get(&(atom, branch)) {
            return name.clone();
        }
        let name = self.name_step(atom);
        self.add_state(atom, branch, name.clone(), Activity::Inactive);
        name
    }

    /// Where a transition to a state leads within a branch: to its step, or to
    /// the step in which the branch waits for the others to join it there.
    fn target(&mut self, atom: AtomId, branch: BranchId) -> Name {
        match self.branches[branch.0].joins.get(&atom) {
            Some(wait) => wait.clone(),
            None => self.step_of(atom, branch),
        }
    }

    fn wait(&mut self, wanted: &str, comment: String) -> Name {
        let name = self.names.step(wanted);
        self.plan.steps.push(PlannedStep {
            name: name.clone(),
            initial: false,
            state: None,
            comment: Some(comment.into()),
        });
        name
    }

    fn arc(&mut self, label_from: &str, from: &[Name], to: Vec<Name>, condition: Function) {
        let first = to.first().map_or("end", |name| name);
        let bare = |name: &str| name.strip_prefix('X').unwrap_or(name).to_owned();
        self.plan.arcs.push(PlannedArc {
            label: format!("{}_to_{}", bare(label_from), bare(first)),
            from: from.to_vec(),
            to,
            condition,
        });
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
            self.arc(&step, std::slice::from_ref(&step), Vec::new(), leave);
        } else if all.is_empty() {
            let end = self.branches[branch.0].end.clone();
            self.arc(&step, std::slice::from_ref(&step), vec![end], leave);
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

    /// An OR divergence, or a plain succession.
    fn alternatives(
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
                self.arc(step, std::slice::from_ref(step), vec![target], condition);
            }
            return;
        }
        let wait = self.wait(
            &format!("D{}", state.name),
            format!("{} has ended; waits for what follows", state.name),
        );
        self.arc(step, std::slice::from_ref(step), vec![wait.clone()], leave);
        for follower in followers {
            self.start_from(&wait, follower, state.atom, branch);
        }
    }

    /// A transition from a waiting step to a state that now starts.
    fn start_from(&mut self, wait: &Name, follower: &State, ended: AtomId, branch: BranchId) {
        let starts = follower
            .turns_on
            .restrict(follower.atom, false)
            .restrict(ended, false);
        let target = self.target(follower.atom, branch);
        self.arc(wait, std::slice::from_ref(wait), vec![target], starts);
    }

    fn handed_over(&self, from: &State, to: &State) -> Option<Function> {
        let (states, conditions) = (&self.analysis.states, &self.analysis.conditions);
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

    /// An AND divergence: the followers of `company` start together, each in
    /// a branch of its own; `others` start instead of one of them.
    fn divergence(
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
        self.arc(step, std::slice::from_ref(step), entries, leave);
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
                self.arc(&joining[0].clone(), &joining, vec![step], starts);
            }
        }
        if let Some(first) = left.first().cloned() {
            let condition = Function::constant(true);
            self.arc(&first, &left, vec![outer.end.clone()], condition);
        }
    }
}

#[derive(PartialEq)]
enum Activity {
    Initial,
    Inactive,
}
