//! Power through one network.
//!
//! [`Flow`] is the law that all solving shares: how power reaches an element
//! and what the element passes on. A [`Circuit`] answers what the law leaves
//! open: whether a contact conducts now, what an edge remembers, what a write
//! does. The machine is one circuit; [`power`] uses another that only asks.

use logic::{Atom, Expr, Name};
use petgraph::Direction;
use petgraph::graph::{EdgeIndex, NodeIndex};
use petgraph::visit::EdgeRef;

use super::atom::{memory_atom, own_atom, pin_atom, wire_memory_atom};
use crate::{
    Contact, ContactKind, CounterKind, Edge, Element, ElementKind, Gate, Network, OneShot, Port,
};

/// What a network asks of its surroundings while it is solved, element by
/// element.
pub(super) trait Circuit {
    /// Whether a contact or comparison conducts. Asked with or without power,
    /// since an edge contact compares with its last evaluation.
    fn conducts(&mut self, at: NodeIndex, element: &Element) -> bool;
    /// Whether a one shot passes power on, given the power that it gets.
    fn fires(&mut self, at: NodeIndex, shot: &OneShot, power: bool) -> bool;
    /// Whether an edge pin at the end of a wire sees its edge.
    fn sees_edge(&mut self, wire: EdgeIndex, edge: Edge, signal: bool) -> bool;
    /// The value at an output pin of a box that has been solved.
    fn at_pin(&mut self, at: NodeIndex, pin: &str) -> bool;
    /// Whether a box that decides so itself passes on the power that it gets.
    fn shapes(&mut self, at: NodeIndex) -> bool;
    /// Lets the element do what it does besides passing power.
    fn act(&mut self, at: NodeIndex, element: &Element, power: bool, inputs: &Inputs<'_>);
}

/// What arrives at an element: the port and signal of each wire.
#[derive(Clone, Debug, Default)]
pub(super) struct Inputs<'n>(Vec<(&'n Port, bool)>);

impl Inputs<'_> {
    /// The signal at a named pin, if a wire arrives there.
    pub(super) fn pin(&self, name: &str) -> Option<bool> {
        let is_pin = |port: &Port| matches!(port, Port::Pin(pin) if pin.eq_ignore_ascii_case(name));
        self.at(is_pin)
    }

    fn at(&self, is_wanted: impl Fn(&Port) -> bool) -> Option<bool> {
        let signals = self.0.iter().filter(|(port, _)| is_wanted(port));
        signals.fold(None, |any, (_, on)| Some(any.unwrap_or(false) | on))
    }

    fn any(&self) -> bool {
        self.0.iter().any(|(_, on)| *on)
    }
}

/// The power in a network as far as it has been solved.
#[derive(Clone, Debug)]
pub struct Power {
    arriving: Vec<bool>,
    passing: Vec<bool>,
}

impl Power {
    /// The power that arrives at an element: at a contact's left end, at a
    /// box's `EN`, at a timer's `IN`, at a counter's counting input. Off for
    /// an element that is not of the network.
    pub fn at(&self, element: NodeIndex) -> bool {
        self.arriving.get(element.index()).copied().unwrap_or(false)
    }

    /// The power that an element passes on, not at a named pin.
    pub fn after(&self, element: NodeIndex) -> bool {
        self.passing.get(element.index()).copied().unwrap_or(false)
    }
}

/// A network being solved.
pub(super) struct Flow<'n> {
    network: &'n Network,
    power: Power,
    inputs: Inputs<'n>,
}

impl<'n> Flow<'n> {
    /// Nothing solved yet; only the rail has power.
    pub(super) fn new(network: &'n Network) -> Self {
        let mut passing = vec![false; network.len()];
        passing[Network::rail().index()] = true;
        Self {
            network,
            power: Power {
                arriving: passing.clone(),
                passing,
            },
            inputs: Inputs::default(),
        }
    }

    pub(super) fn power(&self) -> &Power {
        &self.power
    }

    /// Solves one element; those before it in the order are solved already.
    pub(super) fn solve(&mut self, at: NodeIndex, circuit: &mut impl Circuit) {
        let element = self.network.element(at);
        self.collect_inputs(at, circuit);
        let arriving = arriving(&element.kind, &self.inputs);
        self.power.arriving[at.index()] = arriving;
        circuit.act(at, element, arriving, &self.inputs);
        self.power.passing[at.index()] = match &element.kind {
            ElementKind::Rail => true,
            ElementKind::Open => false,
            ElementKind::Invert => !arriving,
            ElementKind::Contact(_) | ElementKind::Comparison(_) => {
                circuit.conducts(at, element) && arriving
            }
            ElementKind::OneShot(shot) => circuit.fires(at, shot, arriving),
            ElementKind::Gate(gate) => joined(*gate, &self.inputs),
            ElementKind::Block(block) if block.shapes_power => circuit.shapes(at) && arriving,
            _ => arriving,
        };
    }

    /// Solves one element of a zone that is switched off: contacts are looked
    /// at and outputs solved, but no power arrives and none goes on.
    pub(super) fn solve_switched_off(&mut self, at: NodeIndex, circuit: &mut impl Circuit) {
        let element = self.network.element(at);
        self.inputs.0.clear();
        circuit.act(at, element, false, &self.inputs);
        match &element.kind {
            ElementKind::Contact(_) | ElementKind::Comparison(_) => {
                circuit.conducts(at, element);
            }
            ElementKind::OneShot(shot) => {
                circuit.fires(at, shot, false);
            }
            _ => {}
        }
        self.power.arriving[at.index()] = false;
        self.power.passing[at.index()] = false;
    }

    fn collect_inputs(&mut self, at: NodeIndex, circuit: &mut impl Circuit) {
        self.inputs.0.clear();
        let arriving = self.network.graph().edges_directed(at, Direction::Incoming);
        for edge in arriving {
            let wire = edge.weight();
            let source = match &wire.from {
                Port::Power => self.power.after(edge.source()),
                Port::Pin(pin) => circuit.at_pin(edge.source(), pin),
            };
            let signal = source != wire.negated;
            let signal = match wire.edge {
                None => signal,
                Some(kind) => circuit.sees_edge(edge.id(), kind, signal),
            };
            self.inputs.0.push((&wire.to, signal));
        }
    }
}

/// The power that arrives at an element. A timer or counter may be wired at
/// its own input pin; then `EN`, where wired, enables it.
fn arriving(kind: &ElementKind, inputs: &Inputs<'_>) -> bool {
    let own_pin = match kind {
        ElementKind::Rail => return true,
        ElementKind::Timer(_) => "IN",
        ElementKind::Counter(counter) if counter.kind == CounterKind::Down => "CD",
        ElementKind::Counter(_) => "CU",
        ElementKind::Block(_) => "EN",
        _ => return inputs.any(),
    };
    let power = inputs.at(|port| *port == Port::Power);
    match inputs.pin(own_pin) {
        Some(signal) => signal && power.unwrap_or(true),
        None => power.unwrap_or(false),
    }
}

/// What a gate makes of its ports. Wires that arrive at one port are joined
/// first; a gate without a wire gives nothing.
fn joined(gate: Gate, inputs: &Inputs<'_>) -> bool {
    let mut ports: Vec<(&Port, bool)> = Vec::new();
    for (port, on) in &inputs.0 {
        match ports.iter_mut().find(|(known, _)| known == port) {
            Some((_, known)) => *known |= on,
            None => ports.push((port, *on)),
        }
    }
    let on = ports.iter().filter(|(_, on)| *on).count();
    match gate {
        Gate::And => on > 0 && on == ports.len(),
        Gate::Or => on > 0,
        Gate::Xor => on % 2 == 1,
    }
}

/// Solves one network with the value of every atom given by `value`, and
/// writes nothing: power at one instant.
///
/// Atoms are those of conditions: variables for contacts, `rise(a)` and
/// `fall(a)` for edge contacts, comparisons in their canonical form, timers'
/// and counters' outputs by name. Things without a name of their own are
/// variables too, called as [`pin_atom`], [`own_atom`], [`memory_atom`] and
/// [`wire_memory_atom`] say. A rising one shot passes power on while it has
/// power and its memory is off; a falling one while it has none and its memory
/// is on.
pub fn power(network: &Network, value: impl FnMut(&Atom) -> bool) -> Power {
    let mut flow = Flow::new(network);
    let mut asked = Asked { network, value };
    for at in network.graph().node_indices() {
        flow.solve(at, &mut asked);
    }
    flow.power
}

/// A circuit whose every value is asked for.
struct Asked<'n, F> {
    network: &'n Network,
    value: F,
}

impl<F: FnMut(&Atom) -> bool> Asked<'_, F> {
    fn variable(&mut self, name: Name) -> bool {
        (self.value)(&Atom::Variable(name))
    }

    fn holds(&mut self, expr: &Expr) -> bool {
        match expr {
            Expr::Constant(value) => *value,
            Expr::Atom(atom) => (self.value)(atom),
            Expr::Not(inner) => !self.holds(inner),
            Expr::And(parts) => parts.iter().all(|part| self.holds(part)),
            Expr::Or(parts) => parts.iter().any(|part| self.holds(part)),
        }
    }

    fn contact(&mut self, contact: &Contact) -> bool {
        let variable = Expr::variable(contact.operand.name.clone());
        let expr = match contact.kind {
            ContactKind::Open => variable,
            ContactKind::Closed => variable.complement(),
            ContactKind::Rising => Expr::Atom(Atom::Rise(Box::new(variable))),
            ContactKind::Falling => Expr::Atom(Atom::Fall(Box::new(variable))),
        };
        self.holds(&expr)
    }
}

impl<F: FnMut(&Atom) -> bool> Circuit for Asked<'_, F> {
    fn conducts(&mut self, _at: NodeIndex, element: &Element) -> bool {
        match &element.kind {
            ElementKind::Contact(contact) => self.contact(contact),
            ElementKind::Comparison(comparison) => self.holds(&Expr::comparison(
                &comparison.left.name,
                comparison.relation,
                &comparison.right.name,
            )),
            _ => true,
        }
    }

    fn fires(&mut self, at: NodeIndex, shot: &OneShot, power: bool) -> bool {
        let memory = memory_atom(self.network, at);
        edge_of(shot.edge, self.variable(memory), power)
    }

    fn sees_edge(&mut self, wire: EdgeIndex, edge: Edge, signal: bool) -> bool {
        let memory = wire_memory_atom(self.network, wire);
        edge_of(edge, self.variable(memory), signal)
    }

    fn at_pin(&mut self, at: NodeIndex, pin: &str) -> bool {
        let atom = pin_atom(self.network, at, pin);
        self.variable(atom)
    }

    fn shapes(&mut self, at: NodeIndex) -> bool {
        let atom = own_atom(self.network, at);
        self.variable(atom)
    }

    fn act(&mut self, _at: NodeIndex, _element: &Element, _power: bool, _inputs: &Inputs<'_>) {}
}

/// Whether going from `before` to `now` is the edge.
pub(super) fn edge_of(edge: Edge, before: bool, now: bool) -> bool {
    match edge {
        Edge::Rising => now && !before,
        Edge::Falling => before && !now,
    }
}
