//! The guards of real rungs, built by two libraries of decision diagrams.
//!
//! A [`Circuit`] is what a network asks of any such library: a list of
//! operations, the same for both. Doing them is what is measured; taking the
//! list off the network is not.

use std::collections::HashMap;

use ladder::{ContactKind, Element, ElementKind, Network, Program};
use logic::{AtomId, Budget, Function, Name};
use oxidd::bdd::{BDDFunction, BDDManagerRef};
use oxidd::{BooleanFunction, Manager, ManagerRef};

/// One operation. Numbers are places of earlier steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// 0 or 1
    Constant(bool),
    /// A variable, by its number in the program.
    Variable(u32),
    /// The complement.
    Not(usize),
    /// Both.
    And(usize, usize),
    /// Any of the two.
    Or(usize, usize),
}

/// The guards of all outputs of a rung.
#[derive(Clone, Debug, Default)]
pub struct Circuit {
    /// The operations, each after those that it needs.
    pub steps: Vec<Step>,
    /// The steps that are guards.
    pub guards: Vec<usize>,
}

/// The circuits of a program.
#[derive(Clone, Debug, Default)]
pub struct Circuits {
    /// One for each rung.
    pub rungs: Vec<Circuit>,
    /// Number of variables in the whole program.
    pub variables: u32,
}

/// The circuits of all rungs of `program`, variables numbered as they come.
///
/// Edges, comparisons and boxes that decide over power are variables of their
/// own: here it matters that both libraries build the same, not what it means.
pub fn circuits(program: &Program) -> Circuits {
    let mut numbers: HashMap<Name, u32> = HashMap::new();
    let rungs = program
        .rungs()
        .map(|(_, rung)| circuit(&rung.network, &mut numbers))
        .collect();
    Circuits {
        rungs,
        variables: numbers.len() as u32,
    }
}

fn circuit(network: &Network, numbers: &mut HashMap<Name, u32>) -> Circuit {
    let mut circuit = Circuit::default();
    let mut leaving: Vec<usize> = Vec::with_capacity(network.len());
    for (at, element) in network.elements() {
        let mut power = None;
        for (from, wire) in network.arriving(at) {
            let mut carried = leaving[from.index()];
            if wire.negated {
                carried = circuit.add(Step::Not(carried));
            }
            power = Some(match power {
                None => carried,
                Some(power) => circuit.add(Step::Or(power, carried)),
            });
        }
        let power = match power {
            Some(power) => power,
            None => circuit.add(Step::Constant(at == Network::rail())),
        };
        if is_output(element) {
            circuit.guards.push(power);
        }
        leaving.push(match test(element) {
            Some((name, positive)) => {
                let next = numbers.len() as u32;
                let variable = *numbers.entry(name).or_insert(next);
                let mut passes = circuit.add(Step::Variable(variable));
                if !positive {
                    passes = circuit.add(Step::Not(passes));
                }
                circuit.add(Step::And(power, passes))
            }
            None if element.kind == ElementKind::Invert => circuit.add(Step::Not(power)),
            None => power,
        });
    }
    circuit
}

fn is_output(element: &Element) -> bool {
    !matches!(
        element.kind,
        ElementKind::Rail
            | ElementKind::Contact(_)
            | ElementKind::Comparison(_)
            | ElementKind::Invert
            | ElementKind::Open
            | ElementKind::OneShot(_)
            | ElementKind::Gate(_)
            | ElementKind::Label(_)
    )
}

/// The variable that decides whether power passes, and by which value.
fn test(element: &Element) -> Option<(Name, bool)> {
    match &element.kind {
        ElementKind::Contact(contact) => {
            let name = &contact.operand.name;
            Some(match contact.kind {
                ContactKind::Open => (name.clone(), true),
                ContactKind::Closed => (name.clone(), false),
                kind => (format!("{kind:?} {name}").into(), true),
            })
        }
        ElementKind::Comparison(it) => {
            let text = format!("{} {} {}", it.left.name, it.relation.sign(), it.right.name);
            Some((text.into(), true))
        }
        ElementKind::OneShot(_) => Some((format!("edge at {}", element.span.start).into(), true)),
        ElementKind::Open => Some(("never".into(), true)),
        ElementKind::Block(block) if block.shapes_power => Some((
            format!("{} at {}", block.name, element.span.start).into(),
            true,
        )),
        _ => None,
    }
}

impl Circuit {
    fn add(&mut self, step: Step) -> usize {
        self.steps.push(step);
        self.steps.len() - 1
    }
}

/// A library that builds functions.
pub trait Library {
    /// A Boolean function, as this library holds it.
    type Function: Clone;
    /// What `step` makes of the functions of earlier steps; `None` if the
    /// library gives up.
    fn make(&mut self, step: Step, earlier: &[Self::Function]) -> Option<Self::Function>;
}

/// The guards of `circuit`, in its order; `None` if the library gave up on one
/// of its steps.
pub fn build<L: Library>(circuit: &Circuit, library: &mut L) -> Option<Vec<L::Function>> {
    let mut functions = Vec::with_capacity(circuit.steps.len());
    for step in &circuit.steps {
        functions.push(library.make(*step, &functions)?);
    }
    let guards = circuit.guards.iter().map(|&guard| functions[guard].clone());
    Some(guards.collect())
}

/// The diagrams of Gradus: each over its own few atoms.
#[derive(Clone, Debug, Default)]
pub struct Own {
    /// What an operation may cost.
    pub budget: Budget,
}

impl Library for Own {
    type Function = Function;

    fn make(&mut self, step: Step, earlier: &[Function]) -> Option<Function> {
        match step {
            Step::Constant(value) => Some(Function::constant(value)),
            Step::Variable(number) => Some(Function::atom(AtomId(number))),
            Step::Not(a) => Some(earlier[a].not()),
            Step::And(a, b) => earlier[a].and(&earlier[b], &self.budget).ok(),
            Step::Or(a, b) => earlier[a].or(&earlier[b], &self.budget).ok(),
        }
    }
}

/// The diagrams of OxiDD: all in one manager, nodes shared between them, no
/// complement edges, one thread.
pub struct Peer {
    manager: BDDManagerRef,
    constants: [BDDFunction; 2],
    variables: Vec<BDDFunction>,
}

impl Peer {
    /// A manager of this many variables, with room for every guard of the
    /// corpus. `None` if there is not enough memory.
    pub fn new(variables: u32) -> Option<Self> {
        let manager = oxidd::bdd::new_manager(1 << 20, 1 << 16, 1);
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

    /// Forgets all results, so that the next round begins as the first did.
    pub fn forget(&self) {
        self.manager.with_manager_shared(|manager| manager.gc());
    }
}

impl Library for Peer {
    type Function = BDDFunction;

    fn make(&mut self, step: Step, earlier: &[BDDFunction]) -> Option<BDDFunction> {
        match step {
            Step::Constant(value) => Some(self.constants[usize::from(value)].clone()),
            Step::Variable(number) => self.variables.get(number as usize).cloned(),
            Step::Not(a) => earlier[a].not().ok(),
            Step::And(a, b) => earlier[a].and(&earlier[b]).ok(),
            Step::Or(a, b) => earlier[a].or(&earlier[b]).ok(),
        }
    }
}

/// Whether both libraries hold the same function: equally many nodes, as two
/// canonical diagrams in one order have, and the same value under each of
/// `valuations`, where the value of variable `n` is the bit `n` of a word
/// repeated without end.
pub fn agree(own: &Function, peer: &BDDFunction, valuations: &[u64]) -> bool {
    use oxidd::Function as _;
    // A constant of biodivine's has one terminal, or the terminal zero and one.
    let nodes = match own.is_true() || own.is_false() {
        true => 1,
        false => own.nodes(),
    };
    nodes == peer.node_count()
        && valuations.iter().all(|valuation| {
            let value = |number: u32| valuation.rotate_right(number) & 1 == 1;
            let support = own.support().iter().map(|atom| (atom.0, value(atom.0)));
            own.evaluate(|atom| value(atom.0)) == peer.eval(support)
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn guards(text: &str) -> (Circuits, Vec<Function>) {
        let reading = ladder::read(text.as_bytes());
        let circuits = circuits(&reading.program);
        let built = circuits
            .rungs
            .iter()
            .flat_map(|circuit| build(circuit, &mut Own::default()).expect("small"));
        let built = built.collect();
        (circuits, built)
    }

    #[test]
    fn a_circuit_computes_the_guard_of_each_output() {
        let (_, found) = guards("rung: (a + /b) * c -> x, set y");
        let [a, b, c] = [0, 1, 2].map(|number| Function::atom(AtomId(number)));
        let budget = Budget::default();
        let wanted = a.or(&b.not(), &budget).and_then(|f| f.and(&c, &budget));
        assert_eq!(found, vec![wanted.expect("small"); 2]);
    }

    #[test]
    fn both_libraries_build_the_same() {
        let text = crate::pair::pair(12) + "rung: a */a -> never\nrung: 1 -> always\n";
        let (circuits, own) = guards(&text);
        let mut peer = Peer::new(circuits.variables).expect("memory");
        let theirs: Vec<BDDFunction> = circuits
            .rungs
            .iter()
            .flat_map(|circuit| build(circuit, &mut peer).expect("memory"))
            .collect();
        assert_eq!(own.len(), theirs.len());
        for (own, theirs) in own.iter().zip(&theirs) {
            assert!(agree(own, theirs, &[0, u64::MAX, 0x9E37_79B9_7F4A_7C15]));
        }
        assert!(!agree(&own[0], &theirs[2], &[]));
    }
}
