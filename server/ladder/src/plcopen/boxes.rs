//! Blocks: what each kind of the catalogue becomes in a rung.
//!
//! * Comparisons and gates are part of the power flow.
//! * Timers, counters and other blocks that remember stand in the rung; their
//!   Boolean outputs leave from pins and are the atoms `instance.PIN`.
//! * `SR` and `RS` become a set and a reset coil on `instance.Q1`, the one that
//!   wins last: so their state is a variable like any other.
//! * Functions over values have no element of their own. What they compute is
//!   a term, written where an `outVariable` takes it.
//!
//! `EN` enables a block. Without a connection to it the block runs in every
//! scan. A disabled function writes nothing and passes no power; `ENO` follows
//! `EN`.

use petgraph::graph::NodeIndex;
use source::{Diagnostic, codes};

use super::diagram::{BlockType, Input, Node, NodeKind};
use super::network::{Arrival, Lowering, rail};
use super::signal::{Signal, Tap, Term};
use super::standard::{Standard, standard};
use super::xml::Text;
use crate::{ElementKind, Familiarity, Gate, OneShot, Operand, Port};

impl<'a> Lowering<'_, 'a> {
    pub(super) fn block(&mut self, at: usize, node: &'a Node<'a>, block: &'a BlockType<'a>) {
        let name = &*block.name.value;
        let own = self.body.names.unit_kind(name);
        let enable = self.enable(at, node);
        match standard(name).filter(|_| own.is_none()) {
            Some(Standard::Timer(kind)) => self.timer(at, node, block, kind, &enable),
            Some(Standard::Counter(kind)) => self.counter(at, node, block, kind, &enable),
            Some(Standard::Trigger(edge)) => self.trigger(at, node, block, edge, &enable),
            Some(Standard::Bistable(wins)) => self.bistable(at, node, block, wins, &enable),
            Some(Standard::Compare(relation)) => self.compare(at, node, block, relation, &enable),
            Some(Standard::Gate(gate)) if !self.over_words(at, node) => {
                self.gate(at, node, gate, &enable);
            }
            Some(Standard::Not) if !self.over_words(at, node) => self.not(at, node, &enable),
            Some(Standard::Move) if enable.is_none() => self.pass_value(at, node),
            Some(Standard::Remembering) => {
                self.opaque(at, node, block, Familiarity::Known, &enable);
            }
            Some(_) => self.function(at, node, block, &enable),
            None => {
                let familiarity = match own {
                    Some(_) => Familiarity::Defined,
                    None => Familiarity::Unknown,
                };
                self.opaque(at, node, block, familiarity, &enable);
            }
        }
        self.mark_outputs(at, node);
    }

    /// What arrives at `EN`, if anything is connected there.
    fn enable(&mut self, at: usize, node: &'a Node<'a>) -> Option<Arrival> {
        let input = node.inputs.iter().find(|input| is(&input.pin, "EN"))?;
        let connected = !input.sources.is_empty() || input.broken;
        connected.then(|| self.arrival(at, input))
    }

    /// Sets the signal of `ENO`.
    pub(super) fn pass_enable(
        &mut self,
        at: usize,
        node: &Node<'_>,
        taps: Vec<Tap>,
        enable: &Option<Arrival>,
    ) {
        let term = match enable {
            Some(enable) => enable.term.clone(),
            None => Term::truth(true, node.span),
        };
        let signal = Signal {
            taps: Some(taps),
            boolean: Some(true),
            term,
            span: node.span,
        };
        self.set(at, "ENO", signal);
    }

    /// Applies the marks that a block's outputs bear.
    fn mark_outputs(&mut self, at: usize, node: &'a Node<'a>) {
        for output in &node.outputs {
            if !output.negated && output.edge.is_none() {
                continue;
            }
            let made_up = self.made_up(at, "output");
            let Some(signal) = self.own_signal(at, &output.pin) else {
                continue;
            };
            let mut term = signal.term.clone();
            if signal.boolean == Some(false) {
                term = term.complement(output.span, &made_up);
                self.set(at, &output.pin, Signal::value(term, Some(false), node.span));
                continue;
            }
            let mut taps = match &signal.taps {
                Some(taps) => taps.clone(),
                None => vec![self.element_for(&signal)],
            };
            if output.negated {
                let element = self.after(&taps, ElementKind::Invert, output.span);
                taps = vec![(element, Port::Power)];
                term = term.complement(output.span, &made_up);
            }
            if let Some(edge) = output.edge {
                let kind = ElementKind::OneShot(OneShot { edge, memory: None });
                let element = self.after(&taps, kind, output.span);
                taps = vec![(element, Port::Power)];
                term = Term::composed(
                    format!("EDGE({})", term.text),
                    &[term],
                    output.span,
                    &made_up,
                );
            }
            let signal = Signal {
                taps: Some(taps),
                boolean: Some(true),
                term,
                span: node.span,
            };
            self.set(at, &output.pin, signal);
        }
    }

    /// The instance of a block that remembers, or a made-up one.
    pub(super) fn instance(
        &mut self,
        at: usize,
        node: &Node<'_>,
        block: &BlockType<'_>,
    ) -> Operand {
        if let Some(text) = &block.instance {
            let name = self.body.names.fold(self.body.unit, &text.value);
            return Operand::new(name, text.span);
        }
        let message = format!("this `{}` has no instance", block.name.value);
        self.report(
            Diagnostic::new(codes::NAMELESS, node.span, message)
                .help("give it an instance; until then it bears a made-up name"),
        );
        Operand::new(self.made_up(at, &block.name.value).name(), node.span)
    }

    /// `instance.pin` as an operand written where the block is.
    pub(super) fn member(&mut self, instance: &Operand, pin: &str) -> Operand {
        let name = format!("{}.{pin}", instance.name);
        instance.renamed(self.body.names.spell(&name))
    }

    /// Joins every connected Boolean input but `EN` to its pin.
    pub(super) fn join_pins(
        &mut self,
        arrivals: Vec<(&'a Input<'a>, Arrival)>,
        element: NodeIndex,
    ) {
        for (input, arrival) in arrivals {
            let pin = Port::Pin(input.pin.to_uppercase().as_str().into());
            self.join(&arrival.taps, element, pin);
        }
    }

    pub(super) fn arrivals(
        &mut self,
        at: usize,
        node: &'a Node<'a>,
        wanted: impl Fn(&Input<'_>) -> bool,
    ) -> Vec<(&'a Input<'a>, Arrival)> {
        let inputs = node.inputs.iter();
        inputs
            .filter(|input| !is(&input.pin, "EN") && !input.sources.is_empty() && wanted(input))
            .map(|input| (input, self.arrival(at, input)))
            .collect()
    }

    /// What arrives at the one input of a block; nothing where none is
    /// connected.
    pub(super) fn only_arrival(&mut self, at: usize, node: &'a Node<'a>) -> Arrival {
        let arrival = self.arrivals(at, node, |_| true).pop();
        arrival.map_or_else(|| Arrival::nothing(node.span), |(_, arrival)| arrival)
    }

    /// The term at the input called `pin`.
    pub(super) fn term_at(&mut self, at: usize, node: &'a Node<'a>, pin: &str) -> Option<Term> {
        let input = node.inputs.iter().find(|input| is(&input.pin, pin))?;
        self.term_of(at, input)
    }

    pub(super) fn term_of(&mut self, at: usize, input: &'a Input<'a>) -> Option<Term> {
        let term = match input.sources.as_slice() {
            [] => return None,
            [only] => self.signal(at, only).term,
            _ => self.arrival(at, input).term,
        };
        let made_up = self.made_up(at, "value");
        Some(if input.negated {
            term.complement(input.span, &made_up)
        } else {
            term
        })
    }

    /// Registers the outputs of a block that stands in the rung: each is the
    /// atom `instance.PIN`.
    pub(super) fn set_pins(
        &mut self,
        at: usize,
        node: &Node<'_>,
        element: NodeIndex,
        instance: &Operand,
        of: &str,
    ) {
        for output in node.outputs.iter().filter(|o| !is(&o.pin, "ENO")) {
            let data_type = self.body.names.member(of, &output.pin);
            let boolean = data_type.map(|found| found.eq_ignore_ascii_case("BOOL"));
            let operand = self.member(instance, &output.pin);
            let leaves = Port::Pin((&*output.pin).into());
            let signal = Signal {
                taps: (boolean != Some(false)).then(|| vec![(element, leaves)]),
                boolean,
                term: Term::variable(operand),
                span: node.span,
            };
            self.set(at, &output.pin, signal);
        }
    }

    pub(super) fn enable_taps(&mut self, element: NodeIndex, enable: &Option<Arrival>) -> Vec<Tap> {
        match enable {
            Some(enable) => {
                self.join(&enable.taps, element, Port::Power);
                vec![(element, Port::Power)]
            }
            None => rail(),
        }
    }

    /// The `outVariable`s that take an output's value and nothing else's.
    pub(super) fn targets_of(
        &self,
        at: usize,
        node: &Node<'_>,
        pin: &str,
    ) -> Vec<(usize, &'a Text<'a>)> {
        let only = node.outputs.iter().filter(|o| !is(&o.pin, "ENO")).count() == 1;
        let targets = self.body.consumers.get(at).map_or(&[][..], Vec::as_slice);
        targets
            .iter()
            .filter_map(|&target| {
                let node = self.diagram.nodes.get(target)?;
                let NodeKind::OutVariable { negated: false } = node.kind else {
                    return None;
                };
                let [source] = node.inputs.first()?.sources.as_slice() else {
                    return None;
                };
                let fits = is(&source.pin, pin) || only && !is(&source.pin, "ENO");
                let later = self.body.turns.get(target) > self.body.turns.get(at);
                (fits && later).then_some((target, node.operand.as_ref()?))
            })
            .collect()
    }

    /// Power that is on while `taps` and the enabling input are.
    pub(super) fn enabled(
        &mut self,
        taps: Vec<Tap>,
        node: &Node<'_>,
        enable: &Option<Arrival>,
    ) -> Vec<Tap> {
        let Some(enable) = enable else {
            return taps;
        };
        // A gate sees only the pins that wires arrive at.
        if taps.is_empty() || enable.taps.is_empty() {
            return Vec::new();
        }
        let element = self.builder.add(ElementKind::Gate(Gate::And), node.span);
        self.join(&enable.taps, element, Port::Pin("EN".into()));
        self.join(&taps, element, Port::Pin("IN".into()));
        vec![(element, Port::Power)]
    }

    pub(super) fn set_flow(
        &mut self,
        at: usize,
        node: &'a Node<'a>,
        taps: Vec<Tap>,
        term: Term,
        enable: &Option<Arrival>,
    ) {
        let pin = main_output(node);
        let signal = Signal {
            taps: Some(taps),
            boolean: Some(true),
            term,
            span: node.span,
        };
        self.set(at, pin, signal);
        let passed = enable.as_ref().map_or_else(rail, |e| e.taps.clone());
        self.pass_enable(at, node, passed, enable);
    }

    pub(super) fn unconnected(&mut self, node: &Node<'_>, input: &Input<'_>) {
        if input.broken {
            return;
        }
        let name = match &node.kind {
            NodeKind::Block(block) => &*block.name.value,
            _ => "block",
        };
        let message = format!("nothing is connected to `{}` of this `{name}`", input.pin);
        self.report(
            Diagnostic::new(codes::DANGLING_CONNECTION, input.span, message)
                .help("connect it; until then it is taken as off"),
        );
    }
}

/// The output of a block that has one besides `ENO`.
pub(super) fn main_output<'n>(node: &'n Node<'_>) -> &'n str {
    let output = node.outputs.iter().find(|output| !is(&output.pin, "ENO"));
    output.map_or("OUT", |output| &*output.pin)
}

/// Whether a pin is called `name`: case does not matter.
pub(super) fn is(pin: &str, name: &str) -> bool {
    pin.eq_ignore_ascii_case(name)
}
