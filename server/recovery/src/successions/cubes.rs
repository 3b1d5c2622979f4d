//! The paper's own rule: Algorithms 2 to 5, literally.
//!
//! Kept for comparison. It takes the paths of both diagrams (Algorithm 5),
//! the variables of both (Algorithm 4), and tries every assignment of the
//! shared ones (Algorithm 3): a pair is suggested if one assignment of *all*
//! shared variables is part of a path of each. The number of assignments is
//! exponential in the shared variables, and the answer depends on the order
//! of variables; see [`possible`](super::possible) for the rule without
//! either fault.

use logic::{AtomId, Budget, Function, Literal};

use super::{Evidence, Kind, Succession, coils, name};
use crate::conditions::Conditions;

/// The pairs of coils that the paper's algorithm suggests.
pub fn cubes(conditions: &Conditions, budget: &Budget) -> Vec<Succession> {
    let coils = coils(conditions);
    let mut found = Vec::new();
    for (from, _, deactivation) in &coils {
        for (to, activation, _) in &coils {
            if budget.cancel.is_cancelled() {
                return found;
            }
            if from != to && discover(deactivation, activation, budget) {
                found.push(Succession {
                    from: name(conditions, *from),
                    to: name(conditions, *to),
                    evidence: Evidence::Possible,
                    kind: Kind::Or,
                    condition: None,
                    witness: None,
                });
            }
        }
    }
    found
}

/// Algorithm 2: whether the deactivation of one and the activation of the
/// other have a common cube over their shared variables.
pub fn discover(deactivation: &Function, activation: &Function, budget: &Budget) -> bool {
    let shared: Vec<AtomId> = deactivation
        .support()
        .iter()
        .copied()
        .filter(|atom| activation.depends_on(*atom))
        .collect();
    if shared.is_empty() {
        return false;
    }
    let first: Vec<Vec<Literal>> = deactivation.paths().collect();
    let second: Vec<Vec<Literal>> = activation.paths().collect();
    common(&shared, &first, &second, &mut Vec::new(), budget)
}

/// Algorithm 3: tries both values of every shared variable in turn.
fn common(
    shared: &[AtomId],
    first: &[Vec<Literal>],
    second: &[Vec<Literal>],
    chosen: &mut Vec<Literal>,
    budget: &Budget,
) -> bool {
    if budget.cancel.is_cancelled() {
        return false;
    }
    let Some((&atom, rest)) = shared.split_first() else {
        return within_one(chosen, first) && within_one(chosen, second);
    };
    for positive in [true, false] {
        chosen.push(Literal { atom, positive });
        let found = common(rest, first, second, chosen, budget);
        chosen.pop();
        if found {
            return true;
        }
    }
    false
}

/// Whether some path holds every literal of `cube`.
fn within_one(cube: &[Literal], paths: &[Vec<Literal>]) -> bool {
    paths
        .iter()
        .any(|path| cube.iter().all(|literal| path.contains(literal)))
}
