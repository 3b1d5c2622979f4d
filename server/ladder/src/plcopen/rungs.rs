//! Which elements make a rung, and in which order all is solved.
//!
//! One body holds many rungs and nothing separates them: a rung is a connected
//! component of the drawing once both power rails are taken away. Document
//! order means nothing either, because exporters write elements in the order
//! in which somebody drew them. So:
//!
//! * outputs come in the order of their `executionOrderId` where it is set,
//!   else from top to bottom, then left to right, else (CODESYS writes 0,0
//!   everywhere) in document order; this is also the order of the rungs;
//! * what an output needs is solved just before it, its inputs in the order
//!   drawn. That solves a leg before the output at its end, and the top leg
//!   first, and is how the open compilers of this format order their code.
//!
//! A circle has no such order. If it leads through a block that remembers, the
//! block's output is read as the last scan left it; else the circle is cut.

use foldhash::HashMap;
use petgraph::algo::kosaraju_scc;
use petgraph::graph::{DiGraph, NodeIndex};
use petgraph::unionfind::UnionFind;
use source::{Diagnostic, Severity, codes};

use super::diagram::{Diagram, Node, NodeKind, Position};

/// The elements of a rung in the order of solving.
pub(super) struct Plan {
    pub(super) nodes: Vec<usize>,
    pub(super) comment: Option<String>,
}

/// How a body is solved.
pub(super) struct Plans {
    /// Rungs in the order of solving.
    pub(super) rungs: Vec<Plan>,
    /// By node: when it is solved.
    pub(super) turns: Vec<usize>,
}

/// When an output is solved: by order where it is set, else by place, else as
/// written.
type Key = (bool, u64, Position, usize);

/// The rungs of a drawing. `remembers` tells the blocks whose outputs may be
/// read before they are solved.
pub(super) fn plan(
    diagram: &Diagram<'_>,
    remembers: &dyn Fn(&Node<'_>) -> bool,
    diagnostics: &mut Vec<Diagnostic>,
) -> Plans {
    let circles = circles(diagram);
    let roots = roots(diagram);
    let mut turns = vec![usize::MAX; diagram.nodes.len()];
    let mut solved = Vec::new();
    for &(_, root) in &roots {
        visit(root, diagram, &circles, remembers, &mut turns, &mut solved);
    }
    report_circles(diagram, &turns, remembers, diagnostics);
    let rungs = components(diagram, &roots, &solved);
    Plans { rungs, turns }
}

fn is_rail(node: &Node<'_>) -> bool {
    matches!(node.kind, NodeKind::LeftRail | NodeKind::RightRail)
}

/// Whether solving the element does something besides passing power.
pub(super) fn is_output(node: &Node<'_>) -> bool {
    match node.kind {
        NodeKind::Coil(_)
        | NodeKind::OutVariable { .. }
        | NodeKind::Label
        | NodeKind::Jump
        | NodeKind::Return
        | NodeKind::Condition => true,
        NodeKind::InOutVariable { .. } => node.inputs.iter().any(|i| !i.sources.is_empty()),
        _ => false,
    }
}

/// The elements that a node is fed by, rails left out.
fn fed_by<'d>(diagram: &'d Diagram<'_>, at: usize) -> impl Iterator<Item = usize> + 'd {
    let inputs = diagram.nodes.get(at).map_or(&[][..], |node| &node.inputs);
    let sources = inputs.iter().flat_map(|input| &input.sources);
    sources.map(|source| source.node).filter(|&node| {
        let found = diagram.nodes.get(node);
        found.is_some_and(|node| !is_rail(node))
    })
}

/// By node: the number of the circle it lies in; nodes in none have a number
/// of their own.
fn circles(diagram: &Diagram<'_>) -> Vec<usize> {
    let mut graph: DiGraph<(), ()> = DiGraph::new();
    for _ in &diagram.nodes {
        graph.add_node(());
    }
    for at in 0..diagram.nodes.len() {
        for source in fed_by(diagram, at) {
            graph.add_edge(NodeIndex::new(source), NodeIndex::new(at), ());
        }
    }
    let mut numbers = vec![0; diagram.nodes.len()];
    for (number, circle) in kosaraju_scc(&graph).into_iter().enumerate() {
        for node in circle {
            numbers[node.index()] = number;
        }
    }
    numbers
}

/// Where solving begins, in order: outputs, and blocks that feed nothing,
/// then all else that may be left.
fn roots(diagram: &Diagram<'_>) -> Vec<(Key, usize)> {
    let mut feeds = vec![false; diagram.nodes.len()];
    for at in 0..diagram.nodes.len() {
        if !diagram.nodes.get(at).is_some_and(is_rail) {
            for source in fed_by(diagram, at) {
                feeds[source] = true;
            }
        }
    }
    let mut first = Vec::new();
    let mut rest = Vec::new();
    for (at, node) in diagram.nodes.iter().enumerate() {
        let key = (node.order == 0, node.order, node.position, at);
        if is_rail(node) {
            continue;
        }
        let last_block = matches!(node.kind, NodeKind::Block(_)) && !feeds[at];
        if is_output(node) || node.order > 0 || last_block {
            first.push((key, at));
        } else {
            rest.push((key, at));
        }
    }
    first.sort_unstable();
    rest.sort_unstable();
    first.extend(rest);
    first
}

/// Puts what `root` needs, then `root`, at the end of `solved`.
fn visit(
    root: usize,
    diagram: &Diagram<'_>,
    circles: &[usize],
    remembers: &dyn Fn(&Node<'_>) -> bool,
    turns: &mut [usize],
    solved: &mut Vec<usize>,
) {
    const OPEN: usize = usize::MAX - 1;
    let needs = |at: usize| {
        fed_by(diagram, at)
            .filter(|&source| {
                let recalled = diagram.nodes.get(source).is_some_and(remembers);
                !(recalled && circles.get(source) == circles.get(at))
            })
            .collect::<Vec<_>>()
            .into_iter()
    };
    if turns[root] != usize::MAX {
        return;
    }
    turns[root] = OPEN;
    let mut path = vec![(root, needs(root))];
    while let Some((at, waiting)) = path.last_mut() {
        match waiting.find(|&source| turns[source] == usize::MAX) {
            Some(source) => {
                turns[source] = OPEN;
                path.push((source, needs(source)));
            }
            None => {
                turns[*at] = solved.len();
                solved.push(*at);
                path.pop();
            }
        }
    }
}

fn report_circles(
    diagram: &Diagram<'_>,
    turns: &[usize],
    remembers: &dyn Fn(&Node<'_>) -> bool,
    diagnostics: &mut Vec<Diagnostic>,
) {
    for (at, node) in diagram.nodes.iter().enumerate() {
        for source in node.inputs.iter().flat_map(|input| &input.sources) {
            let Some(from) = diagram.nodes.get(source.node) else {
                continue;
            };
            if is_rail(from) || is_rail(node) || turns[source.node] < turns[at] {
                continue;
            }
            if matches!(from.kind, NodeKind::InOutVariable { .. }) {
                // Drawn so on purpose: the feedback has a name.
                continue;
            }
            let diagnostic = if remembers(from) {
                let message = "this value comes from a block that is solved later";
                let mut note = Diagnostic::new(codes::NETWORK_LOOP, source.span, message)
                    .help("it is read as the scan before left it");
                note.severity = Severity::Information;
                note
            } else {
                let message = "power flows in a circle through this connection";
                Diagnostic::new(codes::NETWORK_LOOP, source.span, message)
                    .help("write the feedback with a coil and read it with a contact; it is cut")
            };
            diagnostics.push(diagnostic.related(from.span, "it comes from here"));
        }
    }
}

/// The connected components in the order of their first output.
fn components(diagram: &Diagram<'_>, roots: &[(Key, usize)], solved: &[usize]) -> Vec<Plan> {
    let mut joined = UnionFind::<usize>::new(diagram.nodes.len());
    for (at, node) in diagram.nodes.iter().enumerate() {
        if !is_rail(node) {
            for source in fed_by(diagram, at) {
                joined.union(at, source);
            }
        }
    }
    let mut plans: Vec<(Key, Plan)> = Vec::new();
    let mut numbers: HashMap<usize, usize> = HashMap::default();
    for &(key, root) in roots {
        numbers.entry(joined.find(root)).or_insert_with(|| {
            let plan = Plan {
                nodes: Vec::new(),
                comment: None,
            };
            plans.push((key, plan));
            plans.len() - 1
        });
    }
    for &at in solved {
        let number = numbers.get(&joined.find(at));
        if let Some((_, plan)) = number.and_then(|&number| plans.get_mut(number)) {
            plan.nodes.push(at);
        }
    }
    plans.sort_by_key(|(key, _)| *key);
    let mut plans: Vec<Plan> = plans.into_iter().map(|(_, plan)| plan).collect();
    place_comments(diagram, &mut plans);
    plans
}

/// A comment belongs to the rung that ends first below its upper edge; where
/// nothing is placed, to the rung that begins first after it.
fn place_comments(diagram: &Diagram<'_>, plans: &mut [Plan]) {
    let placed = diagram
        .nodes
        .iter()
        .any(|node| node.position != Position::default());
    let mut ends: Vec<(i64, usize)> = plans
        .iter()
        .enumerate()
        .filter_map(|(number, plan)| {
            let nodes = plan.nodes.iter();
            let end = if placed {
                nodes
                    .filter_map(|&at| Some(diagram.nodes.get(at)?.position.y))
                    .max()
            } else {
                nodes.filter_map(|&at| i64::try_from(at).ok()).min()
            };
            Some((end?, number))
        })
        .collect();
    ends.sort_unstable();
    for comment in &diagram.comments {
        let wanted = if placed {
            comment.position.y
        } else {
            i64::try_from(comment.before).unwrap_or(i64::MAX)
        };
        let at = ends.partition_point(|(end, _)| *end < wanted);
        let Some((_, number)) = ends.get(at).or(ends.last()) else {
            return;
        };
        if let Some(plan) = plans.get_mut(*number) {
            let text = plan.comment.get_or_insert_default();
            if !text.is_empty() {
                text.push('\n');
            }
            text.push_str(&comment.text);
        }
    }
}
