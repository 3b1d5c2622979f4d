//! From a planned drawing to the power flow of a rung.
//!
//! Elements are taken in the order of solving, so what feeds an element has
//! its [`Signal`] already. Variables drawn as elements of their own
//! (`inVariable`) become contacts where a Boolean is wanted and operands where
//! a value is. Negated and edge pins become elements on the wire: the
//! complement of a parallel connection is not the parallel connection of the
//! complements.

use foldhash::{HashMap, HashSet};
use logic::Name;
use petgraph::graph::NodeIndex;
use source::{Diagnostic, Span, codes};

use super::diagram::{Diagram, Input, Node, NodeKind, Source};
use super::names::Names;
use super::rungs::Plan;
use super::signal::{Form, Signal, Tap, Term};
use super::xml::Text;
use crate::{
    Comparison, Contact, ContactKind, Declarations, Edge, ElementKind, Network, NetworkBuilder,
    OneShot, Operand, Placed, Port, Wire,
};

/// What the rungs of a body have in common.
pub(super) struct Body<'a> {
    pub(super) diagram: &'a Diagram<'a>,
    /// When each node is solved.
    pub(super) turns: &'a [usize],
    /// By node: the nodes that it feeds, in document order.
    pub(super) consumers: &'a [Vec<usize>],
    /// Paths that occur anywhere in the project, without case.
    pub(super) mentioned: &'a HashSet<String>,
    /// The unit that names are looked up in.
    pub(super) unit: usize,
    pub(super) names: &'a mut Names,
    pub(super) declarations: &'a Declarations,
    pub(super) diagnostics: &'a mut Vec<Diagnostic>,
    /// What the drawn conditions of transitions say, by the transition's place.
    pub(super) conditions: &'a mut HashMap<Span, Name>,
}

/// A rung while it is built.
pub(super) struct Lowering<'b, 'a> {
    pub(super) body: &'b mut Body<'a>,
    pub(super) diagram: &'a Diagram<'a>,
    pub(super) builder: NetworkBuilder,
    /// By node: its output pins, without case, and what leaves them.
    signals: HashMap<usize, Vec<(String, Signal)>>,
    /// Outputs that were built along with the block that feeds them.
    pub(super) done: HashSet<usize>,
    /// Whether anything in the rung has an effect.
    pub(super) writes: bool,
}

/// A name that is spelt out only where it is used.
pub(super) struct MadeUp<'w> {
    unit: Name,
    what: &'w str,
    at: usize,
    /// The id of the element that it is for.
    id: &'w str,
}

impl MadeUp<'_> {
    /// The name: `Main.power12`.
    pub(super) fn name(&self) -> Name {
        let Self { unit, what, at, id } = self;
        match *id {
            "" => format!("{unit}.{what}@{at}").into(),
            id => format!("{unit}.{what}{id}").into(),
        }
    }
}

/// The power that arrives at an input.
pub(super) struct Arrival {
    pub(super) taps: Vec<Tap>,
    pub(super) term: Term,
}

impl Arrival {
    /// No power, at the element at `span`.
    pub(super) fn nothing(span: Span) -> Self {
        Self {
            taps: Vec::new(),
            term: Term::truth(false, span),
        }
    }
}

/// Builds the network of a rung.
pub(super) fn lower(body: &mut Body<'_>, plan: &Plan, span: Span) -> Placed {
    let diagram = body.diagram;
    let mut lowering = Lowering {
        diagram,
        body,
        builder: NetworkBuilder::new(rail_span(diagram, plan)),
        signals: HashMap::default(),
        done: HashSet::default(),
        writes: false,
    };
    for &at in &plan.nodes {
        if let Some(node) = diagram.nodes.get(at) {
            lowering.element(at, node);
        }
    }
    if !lowering.writes {
        lowering.report(
            Diagnostic::new(codes::RUNG_WITHOUT_OUTPUT, span, "this rung writes nothing")
                .help("add a coil, or remove the rung"),
        );
    }
    lowering.builder.finish()
}

/// The place of the rung's first element. The left rail itself is drawn once
/// for all rungs of a body; counted from there, each would change with any
/// text between.
fn rail_span(diagram: &Diagram<'_>, plan: &Plan) -> Span {
    let nodes = plan.nodes.iter().filter_map(|&at| diagram.nodes.get(at));
    nodes
        .map(|node| node.span)
        .min()
        .map_or_else(Span::default, |span| Span::at(span.start as usize))
}

impl<'a> Lowering<'_, 'a> {
    pub(super) fn report(&mut self, diagnostic: Diagnostic) {
        self.body.diagnostics.push(diagnostic);
    }

    /// A name for what has none, unlike any other of the project.
    pub(super) fn made_up<'w>(&self, at: usize, what: &'w str) -> MadeUp<'w>
    where
        'a: 'w,
    {
        MadeUp {
            unit: self.body.names.unit_name(self.body.unit),
            what,
            at,
            id: self.diagram.nodes.get(at).map_or("", |node| &*node.id),
        }
    }

    pub(super) fn folded(&mut self, text: &Text<'_>) -> Operand {
        let name = self.body.names.fold(self.body.unit, &text.value);
        Operand::new(name, text.span)
    }

    /// The variable at an element, or a made-up one.
    pub(super) fn operand(&mut self, at: usize, node: &Node<'_>, what: &str) -> Operand {
        if let Some(text) = &node.operand {
            return match node.kind {
                NodeKind::Label | NodeKind::Jump => Operand::new(text.value.trim(), text.span),
                _ => self.folded(text),
            };
        }
        self.report(
            Diagnostic::new(
                codes::NAMELESS,
                node.span,
                format!("this {what} has no variable"),
            )
            .help("assign one; until then it bears a made-up name"),
        );
        Operand::new(self.made_up(at, what).name(), node.span)
    }

    pub(super) fn set(&mut self, at: usize, pin: &str, signal: Signal) {
        let outputs = self.signals.entry(at).or_default();
        match outputs.iter_mut().find(|(own, _)| is_same(own, pin)) {
            Some((_, own)) => *own = signal,
            None => outputs.push((pin.to_uppercase(), signal)),
        }
    }

    /// The signal that leaves `node` at what `pin` means. Exporters leave the
    /// name out, or give one (`output`) to elements that have no pins.
    fn left_at(&self, node: usize, pin: &str) -> Option<(usize, &Signal)> {
        let outputs = self.signals.get(&node)?;
        let find = |pin: &str| outputs.iter().position(|(own, _)| is_same(own, pin));
        let place = find(pin).or_else(|| {
            let drawn = self.diagram.nodes.get(node)?.outputs.iter();
            let mut others = drawn.filter(|output| !is_same("ENO", &output.pin));
            find(others.next().map_or("", |output| &*output.pin))
        })?;
        Some((place, &outputs.get(place)?.1))
    }

    /// The signal of an output already set.
    pub(super) fn own_signal(&self, at: usize, pin: &str) -> Option<Signal> {
        let mut outputs = self.signals.get(&at)?.iter();
        let (_, signal) = outputs.find(|(own, _)| is_same(own, pin))?;
        Some(signal.clone())
    }

    /// Whether anything is fed by a node.
    pub(super) fn feeds(&self, at: usize) -> bool {
        self.body
            .consumers
            .get(at)
            .is_some_and(|list| !list.is_empty())
    }

    /// What a connection hands to the element at `at`.
    pub(super) fn signal(&mut self, at: usize, source: &Source<'_>) -> Signal {
        let Some(from) = self.diagram.nodes.get(source.node) else {
            return Signal::off(source.span);
        };
        match from.kind {
            NodeKind::LeftRail => return Signal::rail(from.span),
            NodeKind::RightRail => return Signal::off(source.span),
            _ => {}
        }
        let turn = |node: usize| self.body.turns.get(node).copied();
        if turn(source.node) >= turn(at) {
            return self.recalled(from, source);
        }
        match self.left_at(source.node, &source.pin) {
            Some((_, signal)) => signal.clone(),
            None => Signal::off(source.span),
        }
    }

    /// What comes from an element that is solved later: a variable or a block's
    /// output as the last scan left it; anything else is a circle, and off.
    fn recalled(&mut self, from: &'a Node<'a>, source: &Source<'_>) -> Signal {
        let path = match (&from.kind, &from.operand) {
            (NodeKind::InOutVariable { .. }, Some(text)) => text.value.to_string(),
            (NodeKind::Block(block), _) => {
                let pin = match &*source.pin {
                    "" => from.outputs.first().map_or("OUT", |output| &output.pin),
                    pin => pin,
                };
                let instance = block.instance.as_ref();
                instance.map_or_else(String::new, |text| format!("{}.{pin}", text.value))
            }
            _ => String::new(),
        };
        if path.is_empty() {
            return Signal::off(source.span);
        }
        let boolean = self.body.names.is_boolean(self.body.unit, &path);
        let name = self.body.names.fold(self.body.unit, &path);
        let term = Term::variable(Operand::new(name, source.span));
        Signal::value(term, boolean, source.span)
    }

    /// The power and the term of a connection; an element is made for the power
    /// where the signal is a value so far.
    fn power(&mut self, at: usize, source: &Source<'_>) -> (Vec<Tap>, Term) {
        let mut signal = self.signal(at, source);
        if let Some(taps) = signal.taps.take() {
            return (taps, signal.term);
        }
        let taps = vec![self.element_for(&signal)];
        let place = self.left_at(source.node, &source.pin);
        if let Some((place, left)) = place
            && left.term == signal.term
            && let Some(outputs) = self.signals.get_mut(&source.node)
            && let Some((_, left)) = outputs.get_mut(place)
        {
            left.taps = Some(taps.clone());
        }
        (taps, signal.term)
    }

    /// An element that is on while the signal's term is.
    pub(super) fn element_for(&mut self, signal: &Signal) -> Tap {
        let contact = |operand: Operand, kind| ElementKind::Contact(Contact { operand, kind });
        let kind = match &signal.term.form {
            Form::Truth(true) | Form::Integer(1) => return (Network::rail(), Port::Power),
            Form::Truth(false) | Form::Integer(0) => ElementKind::Open,
            Form::Not(operand) => contact(operand.clone(), ContactKind::Closed),
            Form::Relation(left, relation, right) => ElementKind::Comparison(Comparison {
                left: left.clone(),
                relation: *relation,
                right: right.clone(),
            }),
            _ => contact(signal.term.operand(), ContactKind::Open),
        };
        let rail = [Network::rail()];
        (
            self.builder.add_after(&rail, kind, signal.span),
            Port::Power,
        )
    }

    /// The power that arrives at an input, its marks applied.
    pub(super) fn arrival(&mut self, at: usize, input: &Input<'_>) -> Arrival {
        let made_up = self.made_up(at, "power");
        let mut taps = Vec::new();
        let mut terms = Vec::new();
        for source in &input.sources {
            let (power, term) = self.power(at, source);
            taps.extend(power);
            terms.push(term);
        }
        let on = |term: &Term| term.form == Form::Truth(true);
        terms.retain(|term| term.form != Form::Truth(false));
        let mut term = if terms.is_empty() {
            Term::truth(false, input.span)
        } else if terms.iter().any(on) {
            Term::truth(true, input.span)
        } else {
            Term::joined(terms, "OR", input.span, &made_up)
        };
        if input.negated {
            let element = self.after(&taps, ElementKind::Invert, input.span);
            taps = vec![(element, Port::Power)];
            term = term.complement(input.span, &made_up);
        }
        if let Some(edge) = input.edge {
            let kind = ElementKind::OneShot(OneShot { edge, memory: None });
            let element = self.after(&taps, kind, input.span);
            taps = vec![(element, Port::Power)];
            let text = format!("{}({})", edge_word(edge), term.text);
            term = Term::composed(text, &[term], input.span, &made_up);
        }
        Arrival { taps, term }
    }

    /// The power that arrives at an element without pins.
    pub(super) fn main_arrival(&mut self, at: usize, node: &'a Node<'a>, what: &str) -> Arrival {
        let input = node.inputs.first();
        let connected = input.is_some_and(|input| !input.sources.is_empty() || input.broken);
        if !connected {
            self.report(
                Diagnostic::new(
                    codes::DANGLING_CONNECTION,
                    node.span,
                    format!("nothing is connected to this {what}"),
                )
                .help("connect it on its left; until then it gets no power"),
            );
        }
        match input {
            Some(input) => self.arrival(at, input),
            None => Arrival::nothing(node.span),
        }
    }

    /// Adds an element after a parallel connection.
    pub(super) fn after(&mut self, taps: &[Tap], kind: ElementKind, span: Span) -> NodeIndex {
        let element = self.builder.add(kind, span);
        self.join(taps, element, Port::Power);
        element
    }

    /// Joins a parallel connection to a port of an element added later.
    pub(super) fn join(&mut self, taps: &[Tap], to: NodeIndex, port: Port) {
        for (from, leaves) in taps {
            let wire = Wire {
                from: leaves.clone(),
                to: port.clone(),
                ..Wire::default()
            };
            let drawn = self.builder.join(*from, to, wire);
            debug_assert!(drawn, "elements are added in the order of solving");
        }
    }
}

/// Power that is always on.
pub(super) fn rail() -> Vec<Tap> {
    vec![(Network::rail(), Port::Power)]
}

pub(super) fn edge_word(edge: Edge) -> &'static str {
    match edge {
        Edge::Rising => "R_EDGE",
        Edge::Falling => "F_EDGE",
    }
}

/// Whether `pin` is the pin called `upper`, a name in upper case.
fn is_same(upper: &str, pin: &str) -> bool {
    upper.eq_ignore_ascii_case(pin) || !pin.is_ascii() && upper == pin.to_uppercase()
}
