//! The branches of a rung, for formats whose text has no signs for them.

use petgraph::graph::NodeIndex;

use super::legs::legs;
use super::part::{Kind, Part};
use crate::Network;

/// What stands together in a rung, each as its elements: every condition, every
/// parallel connection in it, every series of contacts in that. Groups lie in
/// each other or apart. None for a rung that is too tangled to be written.
///
/// ```text
/// (s + /v1*a) * /ls2    ->    /v1*a,  s + /v1*a,  all
/// ```
pub fn branches(network: &Network) -> Vec<Vec<NodeIndex>> {
    let mut groups = Vec::new();
    for leg in legs(network).unwrap_or_default() {
        elements(&leg.condition, &mut groups);
    }
    groups
}

/// The elements of a part, which are one group more if they are several. Nests
/// as deep as the part does, which the writer bounds.
fn elements(part: &Part, groups: &mut Vec<Vec<NodeIndex>>) -> Vec<NodeIndex> {
    let parts: Vec<&Part> = match &part.kind {
        Kind::Element(at) => return vec![*at],
        Kind::Variable(_) => return Vec::new(),
        Kind::Not(inner) | Kind::Edge(_, inner) => return elements(inner, groups),
        Kind::And(parts) => parts.iter().collect(),
        Kind::Or(parts) => parts.iter().collect(),
    };
    let mut group = Vec::new();
    for part in parts {
        group.extend(elements(part, groups));
    }
    if group.len() > 1 {
        groups.push(group.clone());
    }
    group
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn branches_lie_in_each_other() {
        let text = "rung: (s + /v1*a) * /ls2 -> x, (b * c -> y)";
        let program = crate::read(text.as_bytes()).program;
        let rung = &program.routines[0].rungs[0];
        let shown = branches(&rung.network).into_iter().map(|group| {
            let spelled = group.into_iter().map(|at| {
                let span = rung.place(rung.network.element(at).within);
                &text[span.range()]
            });
            spelled.collect::<Vec<_>>().join(" ")
        });
        assert_eq!(
            shown.collect::<Vec<_>>(),
            ["/v1 a", "s /v1 a", "s /v1 a /ls2", "b c"]
        );
    }
}
