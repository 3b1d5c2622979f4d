//! Two libraries of decision diagrams behind one face.
//!
//! [`Own`] is the one that Gradus computes with, [`Peer`] is OxiDD. Each does
//! the steps of a [`Circuit`] and may refuse one for which it has no room.

use logic::{AtomId, Budget, Function};
use oxidd::bdd::{BDDFunction, BDDManagerRef};
use oxidd::{BooleanFunction, Manager, ManagerRef};

use crate::circuit::{Circuit, Step};

/// A library that builds functions.
pub trait Library {
    /// A Boolean function, as this library holds it.
    type Function: Clone;
    /// The function that is always this value.
    fn constant(&self, value: bool) -> Option<Self::Function>;
    /// The function that is this variable.
    fn variable(&self, number: u32) -> Option<Self::Function>;
    /// The complement; `None` if the library refuses.
    fn not(&self, a: &Self::Function) -> Option<Self::Function>;
    /// Both; `None` if the library refuses.
    fn and(&self, a: &Self::Function, b: &Self::Function) -> Option<Self::Function>;
    /// Any of the two; `None` if the library refuses.
    fn or(&self, a: &Self::Function, b: &Self::Function) -> Option<Self::Function>;
}

/// The guards of `circuit`, in its order. One is `None` if the library refused
/// a step that it needs.
pub fn build<L: Library>(circuit: &Circuit, library: &L) -> Vec<Option<L::Function>> {
    let mut made: Vec<Option<L::Function>> = Vec::with_capacity(circuit.steps.len());
    for step in &circuit.steps {
        let both = |a: usize, b: usize| made[a].as_ref().zip(made[b].as_ref());
        let function = match *step {
            Step::Constant(value) => library.constant(value),
            Step::Variable(number) => library.variable(number),
            Step::Not(a) => made[a].as_ref().and_then(|a| library.not(a)),
            Step::And(a, b) => both(a, b).and_then(|(a, b)| library.and(a, b)),
            Step::Or(a, b) => both(a, b).and_then(|(a, b)| library.or(a, b)),
        };
        made.push(function);
    }
    let guards = circuit.guards.iter();
    guards.map(|&guard| made[guard].clone()).collect()
}

/// The diagrams of Gradus: each over its own few atoms.
#[derive(Clone, Debug, Default)]
pub struct Own {
    /// What an operation may cost.
    pub budget: Budget,
}

impl Library for Own {
    type Function = Function;

    fn constant(&self, value: bool) -> Option<Function> {
        Some(Function::constant(value))
    }

    fn variable(&self, number: u32) -> Option<Function> {
        Some(Function::atom(AtomId(number.into())))
    }

    fn not(&self, a: &Function) -> Option<Function> {
        Some(a.not())
    }

    fn and(&self, a: &Function, b: &Function) -> Option<Function> {
        a.and(b, &self.budget).ok()
    }

    fn or(&self, a: &Function, b: &Function) -> Option<Function> {
        a.or(b, &self.budget).ok()
    }
}

/// The diagrams of OxiDD: all in one manager, nodes shared between them, no
/// complement edges, one thread.
pub struct Peer {
    manager: BDDManagerRef,
    constants: [BDDFunction; 2],
    variables: Vec<BDDFunction>,
}

/// Most nodes that the peer may hold at once: fifty times what one operation
/// of Gradus may make, and room for the guards of the whole corpus together.
const ROOM: usize = 1 << 20;

/// Results of operations that the peer remembers.
const REMEMBERED: usize = 1 << 16;

impl Peer {
    /// A manager of this many variables. `None` if there is not enough memory.
    pub fn new(variables: u32) -> Option<Self> {
        let manager = oxidd::bdd::new_manager(ROOM, REMEMBERED, 1);
        manager.clone().with_manager_exclusive(|inside| {
            inside.add_vars(variables);
            let all = (0..variables).map(|number| BDDFunction::var(inside, number).ok());
            Some(Self {
                manager,
                constants: [BDDFunction::f(inside), BDDFunction::t(inside)],
                variables: all.collect::<Option<_>>()?,
            })
        })
    }

    /// Number of nodes, forgotten ones included until [`Self::forget`].
    pub fn nodes(&self) -> usize {
        self.manager
            .with_manager_shared(|manager| manager.num_inner_nodes())
    }

    /// Forgets all results that nobody holds, so that the next round begins as
    /// the first did.
    pub fn forget(&self) {
        self.manager.with_manager_shared(|manager| manager.gc());
    }
}

impl Library for Peer {
    type Function = BDDFunction;

    fn constant(&self, value: bool) -> Option<BDDFunction> {
        Some(self.constants[usize::from(value)].clone())
    }

    fn variable(&self, number: u32) -> Option<BDDFunction> {
        self.variables.get(number as usize).cloned()
    }

    fn not(&self, a: &BDDFunction) -> Option<BDDFunction> {
        a.not().ok()
    }

    fn and(&self, a: &BDDFunction, b: &BDDFunction) -> Option<BDDFunction> {
        a.and(b).ok()
    }

    fn or(&self, a: &BDDFunction, b: &BDDFunction) -> Option<BDDFunction> {
        a.or(b).ok()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::circuit::circuits;

    #[test]
    fn a_guard_is_refused_alone() {
        let text = b"rung: a -> x\nrung: (a + b)*(c + d)*(e + f) -> y";
        let circuits = circuits(&ladder::read(text).program);
        let mut small = Own::default();
        small.budget.nodes = 4;
        let built = circuits.rungs.iter().flat_map(|it| build(it, &small));
        let is_built: Vec<bool> = built.map(|guard| guard.is_some()).collect();
        assert_eq!(is_built, [true, false]);
    }

    #[test]
    fn the_peer_has_its_room_back_after_forgetting() {
        let peer = Peer::new(2).expect("memory");
        let before = peer.nodes();
        let circuits = circuits(&ladder::read(b"rung: a * b -> x").program);
        drop(build(&circuits.rungs[0], &peer));
        assert!(peer.nodes() > before);
        peer.forget();
        assert_eq!(peer.nodes(), before);
    }
}
