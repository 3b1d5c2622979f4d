use std::collections::{BTreeMap, BTreeSet, HashMap};

use logic::{Expr, Name};

use super::instance::renamed_expr;
use super::meaning::means_the_same;
use super::{Grafcet, Transition};

/// One way in which two grafcets differ as graphs. Steps are named as the
/// right one names them.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Difference {
    /// Only the left has the step.
    StepOnlyLeft(Name),
    /// Only the right has the step.
    StepOnlyRight(Name),
    /// The step is initial in one of them.
    Initial(Name),
    /// Only the left has a transition between these steps.
    TransitionOnlyLeft {
        /// The steps before it.
        from: Vec<Name>,
        /// The steps after it.
        to: Vec<Name>,
    },
    /// Only the right has a transition between these steps.
    TransitionOnlyRight {
        /// The steps before it.
        from: Vec<Name>,
        /// The steps after it.
        to: Vec<Name>,
    },
    /// Both have a transition between these steps, with receptivities that
    /// mean different things.
    Receptivity {
        /// The steps before it.
        from: Vec<Name>,
        /// The steps after it.
        to: Vec<Name>,
        /// The left one's, in the right one's names.
        left: Expr,
        /// The right one's.
        right: Expr,
    },
}

/// How two grafcets differ as graphs, where `steps` gives the right name of
/// each left step; a step it does not mention has the same name in both.
///
/// Names of transitions and the order of anything do not matter, nor do
/// actions. Two grafcets are the same chart when the answer is empty; to
/// compare with a chart whose conditions are in another notation, pass over
/// [`Difference::Receptivity`]. The answer is sorted.
pub fn differences(
    left: &Grafcet,
    right: &Grafcet,
    steps: &BTreeMap<Name, Name>,
) -> Vec<Difference> {
    let names: HashMap<Name, Name> = steps
        .iter()
        .map(|(left, right)| (left.clone(), right.clone()))
        .collect();
    let mapped = |name: &Name| names.get(name).unwrap_or(name).clone();
    let mut found = Vec::new();

    let of_left: BTreeMap<Name, bool> = left
        .steps()
        .map(|step| (mapped(&step.name), step.initial))
        .collect();
    let of_right: BTreeMap<Name, bool> = right
        .steps()
        .map(|step| (step.name.clone(), step.initial))
        .collect();
    for (name, initial) in &of_left {
        match of_right.get(name) {
            None => found.push(Difference::StepOnlyLeft(name.clone())),
            Some(other) if other != initial => found.push(Difference::Initial(name.clone())),
            Some(_) => {}
        }
    }
    for name in of_right.keys().filter(|name| !of_left.contains_key(*name)) {
        found.push(Difference::StepOnlyRight(name.clone()));
    }

    let mut arcs_left = Arcs::new();
    for transition in left.transitions() {
        let receptivity = renamed_expr(&transition.receptivity, &names);
        let arc = arc(transition, mapped);
        arcs_left.entry(arc).or_default().push(receptivity);
    }
    let mut arcs_right = Arcs::new();
    for transition in right.transitions() {
        let arc = arc(transition, Name::clone);
        let receptivity = transition.receptivity.clone();
        arcs_right.entry(arc).or_default().push(receptivity);
    }
    compare_arcs(arcs_left, arcs_right, &mut found);
    found.sort();
    found
}

type Arc = (BTreeSet<Name>, BTreeSet<Name>);
type Arcs = BTreeMap<Arc, Vec<Expr>>;

fn arc(transition: &Transition, mapped: impl Fn(&Name) -> Name) -> Arc {
    (
        transition.from.iter().map(&mapped).collect(),
        transition.to.iter().map(&mapped).collect(),
    )
}

fn compare_arcs(left: Arcs, mut right: Arcs, found: &mut Vec<Difference>) {
    for ((before, after), conditions) in left {
        let from: Vec<Name> = before.iter().cloned().collect();
        let to: Vec<Name> = after.iter().cloned().collect();
        let others = right.remove(&(before, after)).unwrap_or_default();
        let (only_left, only_right) = unmatched(conditions, others);
        let mut lefts = only_left.into_iter();
        let mut rights = only_right.into_iter();
        loop {
            let (from, to) = (from.clone(), to.clone());
            found.push(match (lefts.next(), rights.next()) {
                (Some(left), Some(right)) => Difference::Receptivity {
                    from,
                    to,
                    left,
                    right,
                },
                (Some(_), None) => Difference::TransitionOnlyLeft { from, to },
                (None, Some(_)) => Difference::TransitionOnlyRight { from, to },
                (None, None) => break,
            });
        }
    }
    for ((before, after), conditions) in right {
        for _ in conditions {
            found.push(Difference::TransitionOnlyRight {
                from: before.iter().cloned().collect(),
                to: after.iter().cloned().collect(),
            });
        }
    }
}

/// What is left of each side when those that mean the same are paired off.
fn unmatched(left: Vec<Expr>, mut right: Vec<Expr>) -> (Vec<Expr>, Vec<Expr>) {
    let only_left = left
        .into_iter()
        .filter(|expr| {
            let same = right.iter().position(|other| means_the_same(expr, other));
            same.map(|at| right.swap_remove(at)).is_none()
        })
        .collect();
    (only_left, right)
}
