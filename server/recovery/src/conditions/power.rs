//! From a network to the conditions under which each element gets power.

use std::collections::{HashMap, HashSet};

use ladder::scan::{own_atom, pin_atom};
use ladder::{
    ContactKind, CounterKind, Edge, ElementKind, Familiarity, Gate, Network, OneShot, Port, Wire,
};
use logic::{Atom, AtomId, Atoms, Budget, Expr, Function, Name, Stop};
use petgraph::graph::NodeIndex;

/// The conditions of one network, element by element.
#[derive(Clone, Debug)]
pub struct Powers {
    /// Power arriving at each element, by the element's place.
    arriving: Vec<Result<Function, Stop>>,
    /// Power passed on by each element, by the element's place.
    passing: Vec<Result<Function, Stop>>,
}

impl Powers {
    /// The condition under which power arrives at the element: at a contact's
    /// left end, at a box's `EN`, at a timer's `IN`, at a counter's counting
    /// input.
    pub fn at(&self, element: NodeIndex) -> Result<&Function, Stop> {
        condition(&self.arriving, element)
    }

    /// The condition under which the element passes power on, not at a named
    /// pin.
    pub fn after(&self, element: NodeIndex) -> Result<&Function, Stop> {
        condition(&self.passing, element)
    }
}

fn condition(conditions: &[Result<Function, Stop>], element: NodeIndex) -> Result<&Function, Stop> {
    match conditions.get(element.index()) {
        Some(Ok(function)) => Ok(function),
        Some(Err(stop)) => Err(*stop),
        None => Err(Stop::TooLarge),
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

/// Power at one port of an element.
type Input<'n> = (&'n Port, Result<Function, Stop>);

/// The powers of `network`, in one pass over its elements: a port is on when
/// any of its wires is, an element hands on what its kind makes of that.
pub fn powers(network: &Network, walk: &mut Walk<'_>) -> Powers {
    powers_seeing(&Seen::new(), network, walk)
}

/// What contacts see, by their places in the network, where that is not the
/// value of their variable before the rung: an earlier leg has written it.
pub(super) type Seen = HashMap<NodeIndex, Result<Function, Stop>>;

/// The same where some contacts see what the rung itself has written.
pub(super) fn powers_seeing(seen: &Seen, network: &Network, walk: &mut Walk<'_>) -> Powers {
    let mut powers = Powers {
        arriving: Vec::with_capacity(network.len()),
        passing: Vec::with_capacity(network.len()),
    };
    for (at, element) in network.elements() {
        let mut inputs: Vec<Input<'_>> = vec![];
        for (from, wire) in network.arriving(at) {
            let carried = carried(network, from, wire, &powers, walk);
            match inputs.iter_mut().find(|(port, _)| *port == &wire.to) {
                Some((_, sum)) => *sum = joined(sum, &carried, walk.budget),
                None => inputs.push((&wire.to, carried)),
            }
        }
        let power = arriving(&element.kind, &inputs, walk.budget);
        let passing = match seen.get(&at) {
            Some(value) => contact(&element.kind, value, &power, walk.budget),
            None => passed(network, at, &power, &inputs, walk),
        };
        powers.arriving.push(power);
        powers.passing.push(passing);
    }
    powers
}

/// The power that arrives at an element, of all that does at its ports. A
/// timer or counter may be wired at its own input pin; then `EN`, where wired,
/// enables it.
fn arriving(kind: &ElementKind, inputs: &[Input<'_>], budget: &Budget) -> Result<Function, Stop> {
    let own_pin = match kind {
        ElementKind::Rail => return Ok(Function::constant(true)),
        ElementKind::Timer(_) => "IN",
        ElementKind::Counter(counter) if counter.kind == CounterKind::Down => "CD",
        ElementKind::Counter(_) => "CU",
        ElementKind::Block(_) => "EN",
        _ => return at_ports(inputs, |_| true, budget).unwrap_or(Ok(Function::constant(false))),
    };
    let is_own = |port: &Port| match port {
        Port::Power => false,
        Port::Pin(pin) => pin.eq_ignore_ascii_case(own_pin),
    };
    let power = at_ports(inputs, |port| *port == Port::Power, budget);
    match (at_ports(inputs, is_own, budget), power) {
        (Some(signal), Some(power)) => signal?.and(&power?, budget),
        (Some(signal), None) => signal,
        (None, Some(power)) => power,
        (None, None) => Ok(Function::constant(false)),
    }
}

/// The power at any of the wanted ports, if wires lead there.
fn at_ports(
    inputs: &[Input<'_>],
    is_wanted: impl Fn(&Port) -> bool,
    budget: &Budget,
) -> Option<Result<Function, Stop>> {
    inputs
        .iter()
        .filter(|(port, _)| is_wanted(port))
        .map(|(_, input)| input.clone())
        .reduce(|any, input| joined(&any, &input, budget))
}

fn joined(
    a: &Result<Function, Stop>,
    b: &Result<Function, Stop>,
    budget: &Budget,
) -> Result<Function, Stop> {
    a.clone()?.or(&b.clone()?, budget)
}

/// What a wire carries from the element it leaves: the complement first, then
/// the edge of that.
fn carried(
    network: &Network,
    from: NodeIndex,
    wire: &Wire,
    powers: &Powers,
    walk: &mut Walk<'_>,
) -> Result<Function, Stop> {
    let power = match &wire.from {
        Port::Power => powers.after(from)?.clone(),
        Port::Pin(pin) => output(network, from, &pin_atom(network, from, pin), walk),
    };
    let power = if wire.negated { power.not() } else { power };
    match wire.edge {
        None => Ok(power),
        Some(edge) => edge_of(&power, edge, walk),
    }
}

/// What leaves a contact whose variable has a value of its own there.
fn contact(
    kind: &ElementKind,
    value: &Result<Function, Stop>,
    power: &Result<Function, Stop>,
    budget: &Budget,
) -> Result<Function, Stop> {
    let (power, value) = (power.clone()?, value.clone()?);
    match kind {
        ElementKind::Contact(contact) if contact.kind == ContactKind::Closed => {
            power.and_not(&value, budget)
        }
        _ => power.and(&value, budget),
    }
}

/// What leaves an element by its power port.
fn passed(
    network: &Network,
    at: NodeIndex,
    power: &Result<Function, Stop>,
    inputs: &[Input<'_>],
    walk: &mut Walk<'_>,
) -> Result<Function, Stop> {
    let through =
        |condition: Function, walk: &Walk<'_>| power.clone()?.and(&condition, walk.budget);
    match &network.element(at).kind {
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
            let condition = output(network, at, &own_atom(network, at), walk);
            through(condition, walk)
        }
        _ => power.clone(),
    }
}

/// What a gate makes of its ports; without any it gives nothing.
fn gate_of(gate: Gate, inputs: &[Input<'_>], budget: &Budget) -> Result<Function, Stop> {
    let start = Function::constant(gate == Gate::And && !inputs.is_empty());
    inputs.iter().try_fold(start, |sum, (_, input)| {
        let input = input.as_ref().map_err(|stop| *stop)?;
        match gate {
            Gate::And => sum.and(input, budget),
            Gate::Or => sum.or(input, budget),
            Gate::Xor => sum.xor(input, budget),
        }
    })
}

/// What a box says at an output: an atom, opaque if nobody knows the box.
fn output(network: &Network, at: NodeIndex, name: &Name, walk: &mut Walk<'_>) -> Function {
    let id = walk.atoms.add_variable(name);
    if let ElementKind::Block(block) = &network.element(at).kind
        && block.familiarity == Familiarity::Unknown
    {
        walk.opaque.insert(id);
    }
    Function::atom(id)
}

/// Power for the one scan in which `power` rises or falls. The edge is an
/// atom of its own, named for the expression it is the edge of; a rise also
/// says that there is power now, a fall that there is none.
pub(super) fn edge_of(power: &Function, edge: Edge, walk: &mut Walk<'_>) -> Result<Function, Stop> {
    let inner = Box::new(power.to_expr(walk.atoms, walk.budget)?);
    if size(&inner) > LARGEST_EDGE {
        return Err(Stop::TooLarge);
    }
    match edge {
        Edge::Rising => atom(Atom::Rise(inner), walk).and(power, walk.budget),
        Edge::Falling => atom(Atom::Fall(inner), walk).and_not(power, walk.budget),
    }
}

/// Most atoms in the expression that names an edge. An edge of an edge of an
/// edge says each of them twice, so that twenty of them would fill a memory.
const LARGEST_EDGE: usize = 1_000;

/// Number of atoms in an expression, those inside its edges counted.
fn size(expr: &Expr) -> usize {
    let mut count = 0;
    expr.each_atom(&mut |atom| {
        count += match atom {
            Atom::Rise(inner) | Atom::Fall(inner) => 1 + size(inner),
            _ => 1,
        };
    });
    count
}

fn variable_of(name: &Name, walk: &mut Walk<'_>) -> Function {
    // Constants stand at contacts of some exporters.
    match &*name.to_ascii_lowercase() {
        "1" | "true" => Function::constant(true),
        "0" | "false" => Function::constant(false),
        _ => Function::atom(walk.atoms.add_variable(name)),
    }
}

fn atom(atom: Atom, walk: &mut Walk<'_>) -> Function {
    Function::atom(walk.atoms.add(atom))
}
