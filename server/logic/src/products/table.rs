use biodivine_lib_bdd::BddPointer;
use rustc_hash::FxHashMap;

use crate::{AtomId, Budget, Function, Stop};

/// Many diagrams in one table, which share all their parts.
///
/// A [`Function`] owns its diagram, so that to take one apart copies what is
/// left of it each time. That is right for the conditions of a program, which
/// are many and small, and wrong for a recursion that meets the parts of one
/// large diagram again and again. Here a function is a number, equal functions
/// are equal numbers, and what was worked out once is known.
pub(super) struct Table<'b> {
    budget: &'b Budget,
    nodes: Vec<Node>,
    places: FxHashMap<Node, Part>,
    /// What operations have given, for each of them.
    known: [FxHashMap<(Part, Part), Part>; 3],
    /// Nodes that operations may still add.
    room: usize,
}

/// A function in a [`Table`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(super) struct Part(u32);

impl Part {
    pub(super) const FALSE: Self = Self(0);
    pub(super) const TRUE: Self = Self(1);
}

/// `/atom*low + atom*high`
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
struct Node {
    atom: AtomId,
    low: Part,
    high: Part,
}

/// What two functions can become.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Operation {
    And,
    Or,
    AndNot,
}

/// The table may grow by so many nodes for each that the budget allows in one
/// diagram.
const NODES_PER_NODE: usize = 16;

/// Comes after every atom of a program: there is none at a constant.
const NO_ATOM: AtomId = AtomId(u64::MAX);

impl<'b> Table<'b> {
    /// A table of the two constants.
    pub(super) fn new(budget: &'b Budget) -> Self {
        let constant = |value| Node {
            atom: NO_ATOM,
            low: value,
            high: value,
        };
        Self {
            budget,
            nodes: vec![constant(Part::FALSE), constant(Part::TRUE)],
            places: FxHashMap::default(),
            known: Default::default(),
            room: budget.nodes.saturating_mul(NODES_PER_NODE),
        }
    }

    /// What the table may cost.
    pub(super) fn budget(&self) -> &'b Budget {
        self.budget
    }

    /// Puts a function into the table.
    pub(super) fn add(&mut self, function: &Function) -> Part {
        let diagram = function.diagram();
        let mut parts = vec![Part::FALSE, Part::TRUE];
        // Every diagram lists its nodes after those that they lead to.
        for at in 2..diagram.size() {
            let node = BddPointer::from_index(at);
            let part = |to: BddPointer| parts[to.to_index()];
            let node = Node {
                atom: function.support()[diagram.var_of(node).to_index()],
                low: part(diagram.low_link_of(node)),
                high: part(diagram.high_link_of(node)),
            };
            parts.push(self.place(node));
        }
        parts[diagram.root_pointer().to_index()]
    }

    /// The function that a part is.
    pub(super) fn function(&self, part: Part) -> Result<Function, Stop> {
        // After those that they lead to, the high ones first: the order of
        // every diagram.
        let mut order: Vec<(AtomId, usize, usize)> = Vec::new();
        let mut places: FxHashMap<Part, usize> =
            [(Part::FALSE, 0), (Part::TRUE, 1)].into_iter().collect();
        let mut open = vec![part];
        while let Some(&part) = open.last() {
            if places.contains_key(&part) {
                open.pop();
                continue;
            }
            let Node { atom, low, high } = self.node(part);
            match (places.get(&low), places.get(&high)) {
                (_, None) => open.push(high),
                (None, _) => open.push(low),
                (Some(&low), Some(&high)) => {
                    places.insert(part, order.len() + 2);
                    order.push((atom, low, high));
                    open.pop();
                }
            }
        }
        match order.is_empty() {
            true => Ok(Function::constant(part == Part::TRUE)),
            false => Function::of_nodes(&order),
        }
    }

    /// The first atom that any of two functions depends on.
    pub(super) fn first_atom(&self, a: Part, b: Part) -> AtomId {
        self.node(a).atom.min(self.node(b).atom)
    }

    /// A function with `atom` at 0 and at 1, where it depends on none before
    /// `atom`.
    pub(super) fn cofactors(&self, part: Part, atom: AtomId) -> (Part, Part) {
        let node = self.node(part);
        match node.atom == atom {
            true => (node.low, node.high),
            false => (part, part),
        }
    }

    /// `/atom*low + atom*high`, of functions that depend on later atoms only.
    pub(super) fn choice(&mut self, atom: AtomId, low: Part, high: Part) -> Result<Part, Stop> {
        if low == high {
            return Ok(low);
        }
        let before = self.nodes.len();
        let part = self.place(Node { atom, low, high });
        if self.nodes.len() > before {
            self.room = self.room.checked_sub(1).ok_or(Stop::TooLarge)?;
        }
        Ok(part)
    }

    /// What `operation` makes of two functions.
    ///
    /// Diagrams may be as deep as a program has atoms, so what is still to do
    /// is listed rather than left to calls within calls.
    pub(super) fn apply(&mut self, operation: Operation, a: Part, b: Part) -> Result<Part, Stop> {
        let mut open = vec![(a, b)];
        let mut last = Part::FALSE;
        while let Some(&(a, b)) = open.last() {
            if let Some(done) = self.at_once(operation, a, b) {
                last = done;
                open.pop();
                continue;
            }
            self.budget.check()?;
            let atom = self.first_atom(a, b);
            let (low_a, high_a) = self.cofactors(a, atom);
            let (low_b, high_b) = self.cofactors(b, atom);
            let low = self.at_once(operation, low_a, low_b);
            let high = self.at_once(operation, high_a, high_b);
            if let (Some(low), Some(high)) = (low, high) {
                let part = self.choice(atom, low, high)?;
                self.known[operation as usize].insert(ordered(operation, a, b), part);
                continue;
            }
            if low.is_none() {
                open.push((low_a, low_b));
            }
            if high.is_none() {
                open.push((high_a, high_b));
            }
        }
        Ok(last)
    }

    /// What needs no work, or was worked out before.
    fn at_once(&self, operation: Operation, a: Part, b: Part) -> Option<Part> {
        const FALSE: Part = Part::FALSE;
        const TRUE: Part = Part::TRUE;
        match (operation, a, b) {
            (Operation::And, FALSE, _) | (Operation::And, _, FALSE) => Some(FALSE),
            (Operation::And, TRUE, other) | (Operation::And, other, TRUE) => Some(other),
            (Operation::Or, TRUE, _) | (Operation::Or, _, TRUE) => Some(TRUE),
            (Operation::Or, FALSE, other) | (Operation::Or, other, FALSE) => Some(other),
            (Operation::AndNot, FALSE, _) | (Operation::AndNot, _, TRUE) => Some(FALSE),
            (Operation::AndNot, a, FALSE) => Some(a),
            (Operation::AndNot, a, b) if a == b => Some(FALSE),
            (_, a, b) if a == b => Some(a),
            _ => {
                let known = &self.known[operation as usize];
                known.get(&ordered(operation, a, b)).copied()
            }
        }
    }

    fn node(&self, part: Part) -> Node {
        self.nodes[part.0 as usize]
    }

    fn place(&mut self, node: Node) -> Part {
        debug_assert!(node.low != node.high, "a node decides something");
        let nodes = &mut self.nodes;
        *self.places.entry(node).or_insert_with(|| {
            nodes.push(node);
            Part(nodes.len() as u32 - 1)
        })
    }
}

/// The key of an operation: the same for `a*b` and `b*a`.
fn ordered(operation: Operation, a: Part, b: Part) -> (Part, Part) {
    match operation {
        Operation::And | Operation::Or => (a.min(b), a.max(b)),
        Operation::AndNot => (a, b),
    }
}
