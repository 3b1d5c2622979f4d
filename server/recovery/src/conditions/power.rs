//! From a network to the conditions under which each element gets power.

use std::collections::{HashMap, HashSet};

use ladder::{
    Block, ContactKind, Edge, ElementKind, Familiarity, Gate, Network, OneShot, Port, Wire,
};
use logic::{Atom, AtomId, Atoms, Budget, Expr, Function, Name, Stop};
use petgraph::graph::NodeIndex;

/// The conditions of one network, element by element.
#[derive(Clone, Debug)]
pub struct Powers {
    /// Power arriving at each element's power port, by the element's place.
    arriving: Vec<Result<Function, Stop>>,
    /// Power arriving at named pins.
    pins: HashMap<(NodeIndex, Name), Result<Function, Stop>>,
}

impl Powers {
    /// The condition under which power arrives at the element.
    pub fn at(&self, element: NodeIndex) -> Result<&Function, Stop> {
        match self.arriving.get(element.index()) {
            Some(Ok(function)) => Ok(function),
            Some(Err(stop)) => Err(*stop),
            None => Err(Stop::TooLarge),
        }
    }

    /// The condition under which power arrives at a named pin, if a wire
    /// leads there.
    pub fn at_pin(&self, element: NodeIndex, pin: &str) -> Option<Result<&Function, Stop>> {
        let power = self.pins.get(&(element, pin.into()))?;
        Some(power.as_ref().map_err(|stop| *stop))
    }
}

/// What the walk over networks collects for the whole program.
#[derive(Debug)]
pub struct Walk<'w> {
    /// All atoms so far.
    pub atoms: &'w mut Atoms,
    /// Atoms that stand for what an unknown box does.
    pub opaque: &'w mut HashSet<AtomId>,
    /// What each operation may cost.
    pub budget: &'w Budget,
}

/// The powers of `network`, in one pass over its elements: a port is on when
/// any of its wires is, an element hands on what its kind makes of that.
pub fn powers(network: &Network, walk: &mut Walk<'_>) -> Powers {
    let mut powers = Powers {
        arriving: Vec::with_capacity(network.len()),
        pins: HashMap::new(),
    };
    // What leaves each element by its power port.
    let mut leaving: Vec<Result<Function, Stop>> = Vec::with_capacity(network.len());
    for (at, element) in network.elements() {
        let mut ports: Vec<(&Port, Result<Function, Stop>)> = vec![];
        for (from, wire) in network.arriving(at) {
            let carried = carried(network, from, wire, &leaving, walk);
            match ports.iter_mut().find(|(port, _)| *port == &wire.to) {
                Some((_, sum)) => *sum = joined(sum, &carried, walk.budget),
                None => ports.push((&wire.to, carried)),
            }
        }
        let mut power = Ok(Function::constant(false));
        let mut inputs = Vec::new();
        for (port, carried) in ports {
            inputs.push(carried.clone());
            match port {
                Port::Power => power = carried,
                Port::Pin(pin) => {
                    powers.pins.insert((at, pin.clone()), carried);
                }
            }
        }
        leaving.push(passed(&element.kind, at, &power, &inputs, walk));
        powers.arriving.push(power);
    }
    powers
}

fn joined(
    a: &Result<Function, Stop>,
    b: &Result<Function, Stop>,
    budget: &Budget,
) -> Result<Function, Stop> {
    a.clone()?.or(&b.clone()?, budget)
}

/// What a wire carries from the element it leaves.
fn carried(
    network: &Network,
    from: NodeIndex,
    wire: &Wire,
    leaving: &[Result<Function, Stop>],
    walk: &mut Walk<'_>,
) -> Result<Function, Stop> {
    let power = match &wire.from {
        Port::Power => leaving
            .get(from.index())
            .cloned()
            .unwrap_or(Err(Stop::TooLarge)),
        Port::Pin(pin) => Ok(output_pin(&network.element(from).kind, from, pin, walk)),
    };
    let power = match wire.edge {
        None => power,
        Some(edge) => power.and_then(|power| edge_of(&power, edge, walk)),
    };
    if wire.negated {
        power.map(|power| power.not())
    } else {
        power
    }
}

/// What leaves an element by its power port.
fn passed(
    kind: &ElementKind,
    at: NodeIndex,
    power: &Result<Function, Stop>,
    inputs: &[Result<Function, Stop>],
    walk: &mut Walk<'_>,
) -> Result<Function, Stop> {
    let through =
        |condition: Function, walk: &Walk<'_>| power.clone()?.and(&condition, walk.budget);
    match kind {
        ElementKind::Rail => Ok(Function::constant(true)),
        ElementKind::Contact(contact) => {
            let variable = Expr::variable(contact.operand.name.clone());
            let condition = match contact.kind {
                ContactKind::Open => variable_of(&contact.operand.name, walk),
                ContactKind::Closed => variable_of(&contact.operand.name, walk).not(),
                ContactKind::Rising => atom(Atom::Rise(variable.into()), walk),
                ContactKind::Falling => atom(Atom::Fall(variable.into()), walk),
            };
            through(condition, walk)
        }
        ElementKind::Comparison(comparison) => {
            let expr = Expr::comparison(
                &comparison.left.name,
                comparison.relation,
                &comparison.right.name,
            );
            let condition = Function::of(&expr, walk.atoms, walk.budget)?;
            through(condition, walk)
        }
        ElementKind::Invert => power.clone().map(|power| power.not()),
        ElementKind::Open => Ok(Function::constant(false)),
        ElementKind::OneShot(OneShot { edge, .. }) => edge_of(&power.clone()?, *edge, walk),
        ElementKind::Gate(gate) => gate_of(*gate, inputs, walk.budget),
        ElementKind::Block(block) if block.shapes_power => {
            let condition = output_pin(kind, at, "ENO", walk);
            through(condition, walk)
        }
        _ => power.clone(),
    }
}

fn gate_of(
    gate: Gate,
    inputs: &[Result<Function, Stop>],
    budget: &Budget,
) -> Result<Function, Stop> {
    let start = Function::constant(gate == Gate::And);
    inputs.iter().try_fold(start, |sum, input| {
        let input = input.clone()?;
        match gate {
            Gate::And => sum.and(&input, budget),
            Gate::Or => sum.or(&input, budget),
            Gate::Xor => sum.xor(&input, budget),
        }
    })
}

/// The condition of a Boolean output pin: the atom `instance.pin`.
fn output_pin(kind: &ElementKind, at: NodeIndex, pin: &str, walk: &mut Walk<'_>) -> Function {
    match kind {
        ElementKind::Timer(timer) if matches!(pin, "Q" | "DN") => variable_of(&timer.output, walk),
        ElementKind::Counter(counter) if matches!(pin, "Q" | "DN") => {
            variable_of(&counter.output, walk)
        }
        ElementKind::Timer(timer) => {
            variable_of(&format!("{}.{pin}", timer.instance.name).into(), walk)
        }
        ElementKind::Counter(counter) => {
            variable_of(&format!("{}.{pin}", counter.instance.name).into(), walk)
        }
        ElementKind::Block(block) => {
            let name = block_atom(block, at, pin);
            let id = walk.atoms.add_variable(&name);
            if block.familiarity == Familiarity::Unknown {
                walk.opaque.insert(id);
            }
            Function::atom(id)
        }
        _ => Function::constant(false),
    }
}

/// The name of the atom that a block's output pin is: of its instance, or,
/// for a block without one, its text, which is the same for the same operands.
fn block_atom(block: &Block, at: NodeIndex, pin: &str) -> Name {
    if let Some(instance) = &block.instance {
        return format!("{}.{pin}", instance.name).into();
    }
    let operands: Vec<&str> = block
        .pins
        .iter()
        .filter_map(|pin| pin.operand.as_ref())
        .map(|operand| &*operand.name)
        .collect();
    if operands.is_empty() {
        return format!("{}#{}.{pin}", block.name, at.index()).into();
    }
    format!("{}({})", block.name, operands.join(",")).into()
}

/// Power for the one scan in which `power` rises or falls. The edge is an
/// atom of its own, named for the expression it is the edge of; a rise also
/// says that there is power now, a fall that there is none.
pub(super) fn edge_of(power: &Function, edge: Edge, walk: &mut Walk<'_>) -> Result<Function, Stop> {
    let inner = Box::new(power.to_expr(walk.atoms, walk.budget)?);
    match edge {
        Edge::Rising => atom(Atom::Rise(inner), walk).and(power, walk.budget),
        Edge::Falling => atom(Atom::Fall(inner), walk).and_not(power, walk.budget),
    }
}

fn variable_of(name: &Name, walk: &mut Walk<'_>) -> Function {
    // `0`, `1`, TRUE and FALSE stand at contacts of some exporters.
    match &**name {
        "1" | "TRUE" | "true" => Function::constant(true),
        "0" | "FALSE" | "false" => Function::constant(false),
        _ => Function::atom(walk.atoms.add_variable(name)),
    }
}

fn atom(atom: Atom, walk: &mut Walk<'_>) -> Function {
    Function::atom(walk.atoms.add(atom))
}
