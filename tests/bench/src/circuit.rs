//! What a rung asks of a library of decision diagrams.
//!
//! A [`Circuit`] is a list of operations, the same for every library. Doing
//! them is what is measured; taking the list off the network is not.

use std::collections::HashMap;

use ladder::{ContactKind, Element, ElementKind, Network, Program, Rung};
use logic::Name;

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
/// own: here it matters that all libraries build the same, not what it means.
pub fn circuits(program: &Program) -> Circuits {
    let mut numbers: HashMap<Name, u32> = HashMap::new();
    let rungs = program
        .rungs()
        .map(|(_, rung)| circuit(rung, &mut numbers))
        .collect();
    Circuits {
        rungs,
        variables: numbers.len() as u32,
    }
}

fn circuit(rung: &Rung, numbers: &mut HashMap<Name, u32>) -> Circuit {
    let network = &rung.network;
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
        leaving.push(match test(rung, element) {
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
fn test(rung: &Rung, element: &Element) -> Option<(Name, bool)> {
    let start = rung.place(element.within).start;
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
        ElementKind::OneShot(_) => Some((format!("edge at {start}").into(), true)),
        ElementKind::Open => Some(("never".into(), true)),
        ElementKind::Block(block) if block.shapes_power => {
            Some((format!("{} at {start}", block.name).into(), true))
        }
        _ => None,
    }
}

impl Circuit {
    fn add(&mut self, step: Step) -> usize {
        self.steps.push(step);
        self.steps.len() - 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_circuit_computes_the_power_at_each_output() {
        let reading = ladder::read(b"rung: (a + /b) * c -> x, set y");
        let circuits = circuits(&reading.program);
        assert_eq!(circuits.variables, 3);
        let [circuit] = &circuits.rungs[..] else {
            panic!("one rung");
        };
        assert_eq!(circuit.guards.len(), 2);
        for inputs in 0..8_u32 {
            let [a, b, c] = [0, 1, 2].map(|number| inputs >> number & 1 == 1);
            let mut values: Vec<bool> = Vec::new();
            for step in &circuit.steps {
                values.push(match *step {
                    Step::Constant(value) => value,
                    Step::Variable(number) => [a, b, c][number as usize],
                    Step::Not(x) => !values[x],
                    Step::And(x, y) => values[x] && values[y],
                    Step::Or(x, y) => values[x] || values[y],
                });
            }
            for &guard in &circuit.guards {
                assert_eq!(values[guard], (a || !b) && c, "a={a} b={b} c={c}");
            }
        }
    }
}
