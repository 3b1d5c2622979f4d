//! Power through a rung, as signals.
//!
//! The law is that of `ladder::scan`: an element passes on what it gets, as its
//! kind says. What an element does besides is in [`super::boxes`] and here.

use ladder::scan::{memory_atom, own_atom, pin_atom};
use ladder::{
    Assignment, Coil, CoilKind, ContactKind, CounterKind, Edge, Element, ElementKind, Gate,
    Network, Port, Value as Written,
};
use petgraph::Direction;
use petgraph::graph::NodeIndex;
use petgraph::visit::EdgeRef;
use proof::{Gates, Signal};

use super::memory::{Memories, Memory};
use super::store::Store;
use crate::refusal::Refusal;
use crate::value::{Value, applied};

/// The power in a rung, as far as it has been solved.
#[derive(Clone, Debug)]
pub(super) struct Power {
    arriving: Vec<Signal>,
    passing: Vec<Signal>,
}

impl Power {
    /// Nothing solved yet; only the rail has power.
    pub(super) fn new(network: &Network) -> Self {
        let mut passing = vec![Signal::FALSE; network.len()];
        if let Some(rail) = passing.get_mut(Network::rail().index()) {
            *rail = Signal::TRUE;
        }
        Self {
            arriving: passing.clone(),
            passing,
        }
    }

    /// The power that arrives at an element.
    pub(super) fn at(&self, element: NodeIndex) -> Signal {
        let arriving = self.arriving.get(element.index()).copied();
        arriving.unwrap_or(Signal::FALSE)
    }
}

/// A visit of a rung: whether it is solved, and whether its zone has power.
#[derive(Clone, Copy, Debug)]
pub(super) struct Solved {
    pub(super) routine: usize,
    pub(super) rung: usize,
    pub(super) when: Signal,
    pub(super) is_off: Signal,
}

/// What arrives at an element: the port and signal of each wire.
pub(super) struct Arrived<'n>(Vec<(&'n Port, Signal)>);

impl Arrived<'_> {
    /// The signal at a named pin, if a wire arrives there.
    pub(super) fn pin(&self, name: &str, store: &mut Store<'_>) -> Option<Signal> {
        let is_pin = |port: &Port| matches!(port, Port::Pin(pin) if pin.eq_ignore_ascii_case(name));
        self.at(is_pin, store)
    }

    fn at(&self, is_wanted: impl Fn(&Port) -> bool, store: &mut Store<'_>) -> Option<Signal> {
        let signals = self.0.iter().filter(|(port, _)| is_wanted(port));
        let signals: Vec<Signal> = signals.map(|(_, signal)| *signal).collect();
        (!signals.is_empty()).then(|| store.net.any(&signals))
    }

    fn any(&self, store: &mut Store<'_>) -> Signal {
        let signals: Vec<Signal> = self.0.iter().map(|(_, signal)| *signal).collect();
        store.net.any(&signals)
    }
}

/// Solves one element of a visit.
pub(super) fn solve(
    network: &Network,
    at: NodeIndex,
    solved: Solved,
    power: &mut Power,
    store: &mut Store<'_>,
    memories: &mut Memories,
) -> Result<(), Refusal> {
    let element = network.element(at);
    let is_live = store.net.and(solved.when, !solved.is_off);
    if let ElementKind::Rail = element.kind {
        // A rail is on, but in a zone that is switched off.
        let off = store.net.and(solved.when, solved.is_off);
        power.arriving[at.index()] = !off;
        power.passing[at.index()] = !off;
        return Ok(());
    }
    let inputs = arrived(network, at, solved, is_live, power, store, memories)?;
    let arriving = arriving(&element.kind, &inputs, store);
    let arriving = store.net.and(arriving, is_live);
    power.arriving[at.index()] = arriving;
    act(at, element, solved, arriving, &inputs, store, memories)?;
    let passing = match &element.kind {
        ElementKind::Open => Signal::FALSE,
        ElementKind::Invert => !arriving,
        ElementKind::Contact(contact) => {
            let on = store.is_on(&contact.operand.name)?;
            let mut edge = |kind: Edge| {
                let memory = Memory::Element(solved.routine, solved.rung, at);
                let before = memories.remember(memory, on, solved.when, store);
                edge_of(kind, before, on, store)
            };
            let conducts = match contact.kind {
                ContactKind::Open => on,
                ContactKind::Closed => !on,
                ContactKind::Rising => edge(Edge::Rising),
                ContactKind::Falling => edge(Edge::Falling),
            };
            store.net.and(conducts, arriving)
        }
        ElementKind::Comparison(comparison) => {
            let (left, right) = (&comparison.left.name, &comparison.right.name);
            let holds = store.compares(left, comparison.relation, right)?;
            store.net.and(holds, arriving)
        }
        ElementKind::OneShot(shot) => {
            let before = match &shot.memory {
                None => {
                    let memory = Memory::Element(solved.routine, solved.rung, at);
                    memories.remember(memory, arriving, solved.when, store)
                }
                Some(_) => {
                    let memory = memory_atom(network, at);
                    let before = store.is_on(&memory)?;
                    store.note_by_hand(&memory);
                    store.write(&memory, &Value::bit(arriving), solved.when)?;
                    before
                }
            };
            edge_of(shot.edge, before, arriving, store)
        }
        ElementKind::Gate(gate) => joined(*gate, &inputs, store),
        ElementKind::Block(block) if block.shapes_power => {
            let own = store.is_on(&own_atom(network, at))?;
            store.net.and(own, arriving)
        }
        _ => arriving,
    };
    power.passing[at.index()] = store.net.and(passing, is_live);
    Ok(())
}

fn arrived<'n>(
    network: &'n Network,
    at: NodeIndex,
    solved: Solved,
    is_live: Signal,
    power: &Power,
    store: &mut Store<'_>,
    memories: &mut Memories,
) -> Result<Arrived<'n>, Refusal> {
    let mut inputs = Vec::new();
    for edge in network.graph().edges_directed(at, Direction::Incoming) {
        let wire = edge.weight();
        let source = match &wire.from {
            Port::Power => power.passing[edge.source().index()],
            Port::Pin(pin) => store.is_on(&pin_atom(network, edge.source(), pin))?,
        };
        let signal = if wire.negated { !source } else { source };
        let signal = match wire.edge {
            None => signal,
            Some(kind) => {
                let memory = Memory::Wire(solved.routine, solved.rung, edge.id());
                let before = memories.remember(memory, signal, is_live, store);
                edge_of(kind, before, signal, store)
            }
        };
        // No power goes through a zone that is switched off.
        inputs.push((&wire.to, store.net.and(signal, is_live)));
    }
    Ok(Arrived(inputs))
}

/// The power that arrives at an element. A timer or counter may be wired at
/// its own input pin; then `EN`, where wired, enables it.
fn arriving(kind: &ElementKind, inputs: &Arrived<'_>, store: &mut Store<'_>) -> Signal {
    let own_pin = match kind {
        ElementKind::Timer(_) => "IN",
        ElementKind::Counter(counter) if counter.kind == CounterKind::Down => "CD",
        ElementKind::Counter(_) => "CU",
        ElementKind::Block(_) => "EN",
        _ => return inputs.any(store),
    };
    let power = inputs.at(|port| *port == Port::Power, store);
    match inputs.pin(own_pin, store) {
        Some(signal) => store.net.and(signal, power.unwrap_or(Signal::TRUE)),
        None => power.unwrap_or(Signal::FALSE),
    }
}

/// What a gate makes of its ports: wires that arrive at one port are joined
/// first, and a gate without a wire gives nothing.
fn joined(gate: Gate, inputs: &Arrived<'_>, store: &mut Store<'_>) -> Signal {
    let mut ports: Vec<(&Port, Signal)> = Vec::new();
    for (port, on) in &inputs.0 {
        match ports.iter_mut().find(|(known, _)| known == port) {
            Some((_, known)) => *known = store.net.or(*known, *on),
            None => ports.push((port, *on)),
        }
    }
    let signals: Vec<Signal> = ports.into_iter().map(|(_, on)| on).collect();
    match gate {
        Gate::And if signals.is_empty() => Signal::FALSE,
        Gate::And => store.net.all(&signals),
        Gate::Or => store.net.any(&signals),
        Gate::Xor => {
            let all = signals.into_iter();
            all.fold(Signal::FALSE, |odd, on| store.net.xor(odd, on))
        }
    }
}

/// Whether going from `before` to `now` is the edge.
pub(super) fn edge_of(edge: Edge, before: Signal, now: Signal, store: &mut Store<'_>) -> Signal {
    match edge {
        Edge::Rising => store.net.and(now, !before),
        Edge::Falling => store.net.and(before, !now),
    }
}

/// What the element does besides passing power.
#[allow(clippy::too_many_arguments)]
fn act(
    at: NodeIndex,
    element: &Element,
    solved: Solved,
    power: Signal,
    inputs: &Arrived<'_>,
    store: &mut Store<'_>,
    memories: &mut Memories,
) -> Result<(), Refusal> {
    match &element.kind {
        ElementKind::Coil(coil) => {
            let memory = Memory::Element(solved.routine, solved.rung, at);
            drive(coil, memory, power, solved.when, store, memories)
        }
        ElementKind::Assign(assignment) => assign(assignment, power, store),
        ElementKind::ResetBox(operand) => super::boxes::reset(&operand.name, power, store),
        ElementKind::Timer(timer) => {
            let reset = inputs.pin("R", store);
            let reset = reset.or_else(|| inputs.pin("RESET", store));
            let reset = reset.unwrap_or(Signal::FALSE);
            super::boxes::timer(timer, power, reset, solved.when, store)
        }
        ElementKind::Counter(counter) => {
            super::boxes::counter(counter, power, inputs, solved.when, store)
        }
        _ => Ok(()),
    }
}

fn drive(
    coil: &Coil,
    memory: Memory,
    power: Signal,
    when: Signal,
    store: &mut Store<'_>,
    memories: &mut Memories,
) -> Result<(), Refusal> {
    let mut edge = |kind: Edge, store: &mut Store<'_>| {
        let before = memories.remember(memory, power, when, store);
        edge_of(kind, before, power, store)
    };
    let (value, when) = match coil.kind {
        CoilKind::Plain => (power, when),
        CoilKind::Negated => (!power, when),
        CoilKind::Set => (Signal::TRUE, store.net.and(power, when)),
        CoilKind::Reset => (Signal::FALSE, store.net.and(power, when)),
        CoilKind::Rising => (edge(Edge::Rising, store), when),
        CoilKind::Falling => (edge(Edge::Falling, store), when),
    };
    store.note_by_hand(&coil.operand.name);
    store.write(&coil.operand.name, &Value::bit(value), when)
}

/// `power` is off where the visit is not solved.
fn assign(assignment: &Assignment, power: Signal, store: &mut Store<'_>) -> Result<(), Refusal> {
    let target = &assignment.target.name;
    let value = match &assignment.value {
        Written::Constant(number) => Value::constant((*number).into()),
        Written::Copy(operand) => store.value_of(&operand.name)?,
        Written::Term { text, .. } => store.value_of(text)?,
        Written::Increment(by) => {
            let own = store.value_of(target)?;
            let sum = applied(&mut store.net, &[&own], |own| {
                let by = (*by).into();
                own[0].combine(by, i64::wrapping_add, |own, by| own + by)
            });
            sum.unwrap_or_else(|| store.unknown())
        }
    };
    store.note_by_hand(target);
    store.write(target, &value, power)
}
