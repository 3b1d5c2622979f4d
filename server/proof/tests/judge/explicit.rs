//! Two systems side by side, state by state: the judge that knows no gates.

use std::collections::HashSet;

use super::plan::Plan;

/// Number of scans of the shortest sequence of inputs, allowed by the
/// constraints of both, after which an output differs.
pub fn shortest_difference(left: &Plan, right: &Plan) -> Option<usize> {
    let mut front: Vec<(u32, u32)> = Vec::new();
    for left in left.initial() {
        front.extend(right.initial().into_iter().map(|right| (left, right)));
    }
    let mut seen: HashSet<(u32, u32)> = front.iter().copied().collect();
    let mut scans = 0;
    while !front.is_empty() {
        scans += 1;
        let mut next = Vec::new();
        for (a, b) in front {
            for inputs in 0..1 << left.inputs {
                let ours = left.run(inputs, a);
                let theirs = right.run(inputs, b);
                let allows = |plan: &Plan, values: &[bool]| {
                    plan.constraints.iter().all(|it| plan.value(*it, values))
                };
                if !allows(left, &ours) || !allows(right, &theirs) {
                    continue;
                }
                let mut outputs = left.outputs.iter().zip(&right.outputs);
                if outputs.any(|(x, y)| left.value(*x, &ours) != right.value(*y, &theirs)) {
                    return Some(scans);
                }
                let after = (left.next(&ours), right.next(&theirs));
                if seen.insert(after) {
                    next.push(after);
                }
            }
        }
        front = next;
    }
    None
}
