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

use logic::Relation;
use petgraph::graph::NodeIndex;
use source::{Diagnostic, codes};

use super::diagram::{BlockType, Input, Node, NodeKind};
use super::expression;
use super::interface::UnitKind;
use super::network::{Arrival, Lowering, rail};
use super::signal::{Form, Signal, Tap, Term};
use super::standard::{self, Dominance, Standard, standard};
use crate::{
    Block, Class, Coil, CoilKind, Comparison, Counter, CounterKind, Edge, ElementKind, Familiarity,
    Gate, OneShot, Operand, Pin, PinDirection, Port, Timer, TimerKind,
};

impl<'a> Lowering<'_, 'a> {
    pub(super) fn block(&mut self, at: usize, node: &'a Node, block: &'a BlockType) {
        let name = block.name.value.as_str();
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
    fn enable(&mut self, at: usize, node: &'a Node) -> Option<Arrival> {
        let input = node.inputs.iter().find(|input| is(&input.pin, "EN"))?;
        let connected = !input.sources.is_empty() || input.broken;
        connected.then(|| self.arrival(at, input))
    }

    /// Sets the signal of `ENO`.
    fn pass_enable(&mut self, at: usize, node: &Node, taps: Vec<Tap>, enable: &Option<Arrival>) {
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
    fn mark_outputs(&mut self, at: usize, node: &'a Node) {
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
    fn instance(&mut self, at: usize, node: &Node, block: &BlockType) -> Operand {
        if let Some(text) = &block.instance {
            let name = self.body.names.fold(self.body.unit, &text.value);
            return Operand::new(name, text.span);
        }
        let message = format!("this `{}` has no instance", block.name.value);
        self.report(
            Diagnostic::new(codes::NAMELESS, node.span, message)
                .help("give it an instance; until then it bears a made-up name"),
        );
        Operand::new(self.made_up(at, &block.name.value), node.span)
    }

    /// `instance.pin` as an operand written where the block is.
    fn member(&mut self, instance: &Operand, pin: &str) -> Operand {
        let name = format!("{}.{pin}", instance.name);
        Operand::new(self.body.names.spell(&name), instance.span)
    }

    /// Joins every connected Boolean input but `EN` to its pin.
    fn join_pins(&mut self, arrivals: Vec<(&'a Input, Arrival)>, element: NodeIndex) {
        for (input, arrival) in arrivals {
            let pin = Port::Pin(input.pin.to_uppercase().as_str().into());
            self.join(&arrival.taps, element, pin);
        }
    }

    fn arrivals(
        &mut self,
        at: usize,
        node: &'a Node,
        wanted: impl Fn(&Input) -> bool,
    ) -> Vec<(&'a Input, Arrival)> {
        let inputs = node.inputs.iter();
        inputs
            .filter(|input| !is(&input.pin, "EN") && !input.sources.is_empty() && wanted(input))
            .map(|input| (input, self.arrival(at, input)))
            .collect()
    }

    /// The term at the input called `pin`.
    fn term_at(&mut self, at: usize, node: &'a Node, pin: &str) -> Option<Term> {
        let input = node.inputs.iter().find(|input| is(&input.pin, pin))?;
        self.term_of(at, input)
    }

    fn term_of(&mut self, at: usize, input: &'a Input) -> Option<Term> {
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
    fn set_pins(
        &mut self,
        at: usize,
        node: &Node,
        element: NodeIndex,
        instance: &Operand,
        of: &str,
    ) {
        for output in node.outputs.iter().filter(|o| !is(&o.pin, "ENO")) {
            let data_type = self.body.names.member(of, &output.pin);
            let boolean = data_type.map(|found| found.eq_ignore_ascii_case("BOOL"));
            let operand = self.member(instance, &output.pin);
            let leaves = Port::Pin(output.pin.as_str().into());
            let signal = Signal {
                taps: (boolean != Some(false)).then(|| vec![(element, leaves)]),
                boolean,
                term: Term::variable(operand),
                span: node.span,
            };
            self.set(at, &output.pin, signal);
        }
    }

    fn enable_taps(&mut self, element: NodeIndex, enable: &Option<Arrival>) -> Vec<Tap> {
        match enable {
            Some(enable) => {
                self.join(&enable.taps, element, Port::Power);
                vec![(element, Port::Power)]
            }
            None => rail(),
        }
    }

    // ---- blocks that remember -------------------------------------------------

    fn timer(
        &mut self,
        at: usize,
        node: &'a Node,
        block: &'a BlockType,
        kind: TimerKind,
        enable: &Option<Arrival>,
    ) {
        self.writes = true;
        let instance = self.instance(at, node, block);
        let preset = self.term_at(at, node, "PT");
        let preset_ms = preset.and_then(|term| {
            let constant = self.constant(&term);
            expression::milliseconds(constant.as_deref().unwrap_or(&term.text))
        });
        let boolean = |input: &Input| !is(&input.pin, "PT");
        let arrivals = self.arrivals(at, node, boolean);
        let kind = ElementKind::Timer(Timer {
            kind,
            output: self.member(&instance, "Q").name,
            instance: instance.clone(),
            preset_ms,
        });
        let element = self.builder.add(kind, node.span);
        self.join_pins(arrivals, element);
        self.set_pins(at, node, element, &instance, "TON");
        let taps = self.enable_taps(element, enable);
        self.pass_enable(at, node, taps, enable);
    }

    /// The initial value of a variable that never changes.
    fn constant(&self, term: &Term) -> Option<logic::Name> {
        let declaration = self.body.declarations.find(&term.text)?;
        let fixed = term.form == Form::Variable && declaration.class == Class::Constant;
        declaration.initial.clone().filter(|_| fixed)
    }

    fn counter(
        &mut self,
        at: usize,
        node: &'a Node,
        block: &'a BlockType,
        kind: CounterKind,
        enable: &Option<Arrival>,
    ) {
        self.writes = true;
        let instance = self.instance(at, node, block);
        let preset = self.term_at(at, node, "PV").and_then(|term| {
            let constant = self.constant(&term);
            expression::integer(constant.as_deref().unwrap_or(&term.text))
        });
        let arrivals = self.arrivals(at, node, |input| !is(&input.pin, "PV"));
        let output = if kind == CounterKind::UpDown {
            "QU"
        } else {
            "Q"
        };
        let counter = ElementKind::Counter(Counter {
            kind,
            output: self.member(&instance, output).name,
            instance: instance.clone(),
            preset,
        });
        let element = self.builder.add(counter, node.span);
        self.join_pins(arrivals, element);
        self.set_pins(at, node, element, &instance, "CTUD");
        let taps = self.enable_taps(element, enable);
        self.pass_enable(at, node, taps, enable);
    }

    /// An edge of the power flow. Where the instance's `Q` is read by name, a
    /// coil writes it.
    fn trigger(
        &mut self,
        at: usize,
        node: &'a Node,
        block: &'a BlockType,
        edge: Edge,
        enable: &Option<Arrival>,
    ) {
        self.writes = true;
        let instance = self.instance(at, node, block);
        let mut arrivals = self.arrivals(at, node, |_| true);
        let arrival = match arrivals.pop() {
            Some((_, arrival)) => arrival,
            None => Arrival {
                taps: Vec::new(),
                term: Term::truth(false, node.span),
            },
        };
        let taps = self.enabled(arrival.taps, node, enable);
        let shot = ElementKind::OneShot(OneShot {
            edge,
            memory: Some(instance.clone()),
        });
        let element = self.after(&taps, shot, node.span);
        let output = self.member(&instance, "Q");
        let spelt = block.instance.as_ref();
        let path = spelt.map(|text| format!("{}.Q", text.value.to_uppercase()));
        let named = path.is_some_and(|path| self.body.mentioned.contains(&path));
        if named || !self.feeds(at) {
            let coil = ElementKind::Coil(Coil {
                operand: output.clone(),
                kind: CoilKind::Plain,
            });
            self.after(&[(element, Port::Power)], coil, node.span);
        }
        let term = Term::variable(output);
        self.set(
            at,
            "Q",
            Signal::power(element, Port::Power, term, node.span),
        );
        let passed = enable.as_ref().map_or_else(rail, |e| e.taps.clone());
        self.pass_enable(at, node, passed, enable);
    }

    /// A set and a reset coil on `instance.Q1`, the winner last.
    fn bistable(
        &mut self,
        at: usize,
        node: &'a Node,
        block: &'a BlockType,
        wins: Dominance,
        enable: &Option<Arrival>,
    ) {
        self.writes = true;
        let instance = self.instance(at, node, block);
        let output = self.member(&instance, "Q1");
        let arrivals = self.arrivals(at, node, |_| true);
        let order = match wins {
            Dominance::Set => [('R', CoilKind::Reset), ('S', CoilKind::Set)],
            Dominance::Reset => [('S', CoilKind::Set), ('R', CoilKind::Reset)],
        };
        for (letter, kind) in order {
            let found = arrivals
                .iter()
                .find(|(input, _)| input.pin.to_uppercase().starts_with(letter));
            let Some((_, arrival)) = found else {
                continue;
            };
            let taps = self.enabled(arrival.taps.clone(), node, enable);
            let operand = output.clone();
            let coil = ElementKind::Coil(Coil { operand, kind });
            self.after(&taps, coil, node.span);
        }
        let signal = Signal::value(Term::variable(output), Some(true), node.span);
        self.set(at, "Q1", signal);
        let passed = enable.as_ref().map_or_else(rail, |e| e.taps.clone());
        self.pass_enable(at, node, passed, enable);
    }

    /// A block whose inside is not modelled.
    fn opaque(
        &mut self,
        at: usize,
        node: &'a Node,
        block: &'a BlockType,
        familiarity: Familiarity,
        enable: &Option<Arrival>,
    ) {
        let name = block.name.value.as_str();
        if familiarity == Familiarity::Unknown {
            let message = format!("`{name}` is neither of the standard nor defined in this file");
            self.report(
                Diagnostic::new(codes::UNKNOWN_BOX, block.name.span, message)
                    .help("export its definition too; until then its outputs are opaque"),
            );
        }
        let remembers = self.body.names.unit_kind(name) != Some(UnitKind::Function)
            && (familiarity != Familiarity::Unknown || block.instance.is_some());
        let instance = remembers.then(|| self.instance(at, node, block));
        let key = match &instance {
            Some(instance) => instance.clone(),
            None => Operand::new(self.made_up(at, name), node.span),
        };
        self.writes = true;
        let mut pins = Vec::new();
        let mut wired = Vec::new();
        for input in node.inputs.iter().filter(|input| !is(&input.pin, "EN")) {
            pins.push(self.input_pin(at, name, input, &mut wired));
        }
        let outputs = node.outputs.iter();
        for output in outputs.filter(|o| o.direction == PinDirection::Output) {
            if !is(&output.pin, "ENO") {
                self.output_pins(at, node, name, &output.pin, &mut pins);
            }
        }
        let kind = ElementKind::Block(Block {
            name: name.into(),
            instance,
            pins,
            familiarity,
            shapes_power: familiarity == Familiarity::Unknown && enable.is_some(),
        });
        let element = self.builder.add(kind, node.span);
        self.join_pins(wired, element);
        self.set_pins(at, node, element, &key, name);
        let taps = self.enable_taps(element, enable);
        if enable.is_none() {
            self.join(&taps, element, Port::Power);
        }
        self.pass_enable(at, node, taps, enable);
    }

    /// An input pin: a variable or value stands at it, a wire arrives at it.
    fn input_pin(
        &mut self,
        at: usize,
        block: &str,
        input: &'a Input,
        wired: &mut Vec<(&'a Input, Arrival)>,
    ) -> Pin {
        let data_type = self.body.names.member(block, &input.pin);
        let boolean = data_type.map(|found| found.eq_ignore_ascii_case("BOOL"));
        let signals: Vec<_> = input.sources.iter().map(|s| self.signal(at, s)).collect();
        let power = |signal: &Signal| signal.taps.is_some() && signal.boolean != Some(false);
        let written = matches!(signals.as_slice(), [only] if !power(only));
        let wire = !written && boolean != Some(false) && !signals.is_empty();
        let operand = if wire || input.edge.is_some() && !signals.is_empty() {
            let arrival = self.arrival(at, input);
            wired.push((input, arrival));
            None
        } else {
            self.term_of(at, input).map(|term| term.operand())
        };
        Pin {
            name: Some(input.pin.as_str().into()),
            direction: input.direction,
            operand,
        }
    }

    /// An output pin, once for every variable that takes its value; a Boolean
    /// one leaves power instead, and is written by a coil.
    fn output_pins(&mut self, at: usize, node: &Node, block: &str, pin: &str, pins: &mut Vec<Pin>) {
        let data_type = self.body.names.member(block, pin);
        let boolean = data_type.map(|found| found.eq_ignore_ascii_case("BOOL"));
        let before = pins.len();
        for (target, text) in self.targets_of(at, node, pin) {
            let declared = self.body.names.is_boolean(self.body.unit, &text.value);
            if boolean.or(declared) == Some(true) {
                continue;
            }
            let name = self.body.names.fold(self.body.unit, &text.value);
            self.done.insert(target);
            pins.push(Pin {
                name: Some(pin.into()),
                direction: PinDirection::Output,
                operand: Some(Operand::new(name, text.span)),
            });
        }
        if pins.len() == before {
            pins.push(Pin {
                name: Some(pin.into()),
                direction: PinDirection::Output,
                operand: None,
            });
        }
    }

    /// The `outVariable`s that take an output's value and nothing else's.
    fn targets_of(&self, at: usize, node: &Node, pin: &str) -> Vec<(usize, &'a super::xml::Text)> {
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

    // ---- part of the power flow -----------------------------------------------

    /// Whether a gate works on words, bit by bit, rather than on Booleans.
    fn over_words(&mut self, at: usize, node: &'a Node) -> bool {
        let inputs = node.inputs.iter().filter(|input| !is(&input.pin, "EN"));
        inputs
            .flat_map(|input| &input.sources)
            .any(|source| self.signal(at, source).boolean == Some(false))
    }

    /// Power that is on while `taps` and the enabling input are.
    fn enabled(&mut self, taps: Vec<Tap>, node: &Node, enable: &Option<Arrival>) -> Vec<Tap> {
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

    fn set_flow(
        &mut self,
        at: usize,
        node: &'a Node,
        taps: Vec<Tap>,
        term: Term,
        enable: &Option<Arrival>,
    ) {
        let pin = node.outputs.iter().find(|output| !is(&output.pin, "ENO"));
        let pin = pin.map_or("OUT", |output| output.pin.as_str());
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

    fn gate(&mut self, at: usize, node: &'a Node, gate: Gate, enable: &Option<Arrival>) {
        let word = match gate {
            Gate::And => "AND",
            Gate::Or => "OR",
            Gate::Xor => "XOR",
        };
        let mut arrivals = Vec::new();
        for input in node.inputs.iter().filter(|input| !is(&input.pin, "EN")) {
            let mut arrival = self.arrival(at, input);
            if input.sources.is_empty() {
                self.unconnected(node, input);
            }
            if arrival.taps.is_empty() {
                let element = self.after(&rail(), ElementKind::Open, input.span);
                arrival.taps = vec![(element, Port::Power)];
            }
            arrivals.push((input, arrival));
        }
        let made_up = self.made_up(at, word);
        let terms = arrivals.iter().map(|(_, arrival)| arrival.term.clone());
        let term = Term::joined(terms.collect(), word, node.span, &made_up);
        let element = self.builder.add(ElementKind::Gate(gate), node.span);
        for (place, (_, arrival)) in arrivals.iter().enumerate() {
            // Names may be missing or alike; places are not.
            let port = Port::Pin(format!("IN{}", place + 1).into());
            self.join(&arrival.taps, element, port);
        }
        let taps = self.enabled(vec![(element, Port::Power)], node, enable);
        self.set_flow(at, node, taps, term, enable);
    }

    fn unconnected(&mut self, node: &Node, input: &Input) {
        if input.broken {
            return;
        }
        let name = match &node.kind {
            NodeKind::Block(block) => block.name.value.as_str(),
            _ => "block",
        };
        let message = format!("nothing is connected to `{}` of this `{name}`", input.pin);
        self.report(
            Diagnostic::new(codes::DANGLING_CONNECTION, input.span, message)
                .help("connect it; until then it is taken as off"),
        );
    }

    fn not(&mut self, at: usize, node: &'a Node, enable: &Option<Arrival>) {
        let mut arrivals = self.arrivals(at, node, |_| true);
        let arrival = match arrivals.pop() {
            Some((_, arrival)) => arrival,
            None => Arrival {
                taps: Vec::new(),
                term: Term::truth(false, node.span),
            },
        };
        let made_up = self.made_up(at, "NOT");
        let term = arrival.term.complement(node.span, &made_up);
        let element = self.after(&arrival.taps, ElementKind::Invert, node.span);
        let taps = self.enabled(vec![(element, Port::Power)], node, enable);
        self.set_flow(at, node, taps, term, enable);
    }

    fn compare(
        &mut self,
        at: usize,
        node: &'a Node,
        block: &'a BlockType,
        relation: Relation,
        enable: &Option<Arrival>,
    ) {
        let inputs: Vec<_> = node
            .inputs
            .iter()
            .filter(|input| !is(&input.pin, "EN"))
            .collect();
        if self.over_booleans(at, &inputs)
            && matches!(relation, Relation::Equal | Relation::NotEqual)
        {
            return self.same(at, node, relation, enable);
        }
        let mut sides = Vec::new();
        for (place, input) in inputs.iter().enumerate() {
            let term = self.term_of(at, input);
            sides.push(term.unwrap_or_else(|| {
                self.unconnected(node, input);
                let what = format!("{}{}.IN{}", block.name.value, node.id, place + 1);
                let name = format!("{}.{what}", self.body.names.unit_name(self.body.unit));
                Term::variable(Operand::new(name, input.span))
            }));
        }
        let made_up = self.made_up(at, &block.name.value);
        let mut taps = enable.as_ref().map_or_else(rail, |e| e.taps.clone());
        let mut terms = Vec::new();
        for pair in sides.windows(2) {
            let [left, right] = pair else { continue };
            let text = format!("{} {} {}", left.text, relation.sign(), right.text);
            terms.push(Term {
                form: Form::Relation(left.operand(), relation, right.operand()),
                ..Term::composed(text, pair, node.span, &made_up)
            });
            let kind = ElementKind::Comparison(Comparison {
                left: left.operand(),
                relation,
                right: right.operand(),
            });
            taps = vec![(self.after(&taps, kind, node.span), Port::Power)];
        }
        let term = Term::joined(terms, "AND", node.span, &made_up);
        self.set_flow(at, node, taps, term, enable);
    }

    fn over_booleans(&mut self, at: usize, inputs: &[&'a Input]) -> bool {
        inputs.len() == 2
            && inputs
                .iter()
                .flat_map(|input| &input.sources)
                .any(|source| self.signal(at, source).boolean == Some(true))
    }

    /// Equality of two Booleans is the complement of their exclusive or.
    fn same(&mut self, at: usize, node: &'a Node, relation: Relation, enable: &Option<Arrival>) {
        self.gate(at, node, Gate::Xor, enable);
        if relation == Relation::NotEqual {
            return;
        }
        let pin = node.outputs.iter().find(|output| !is(&output.pin, "ENO"));
        let pin = pin.map_or("OUT", |output| output.pin.as_str());
        let Some(signal) = self.own_signal(at, pin) else {
            return;
        };
        let made_up = self.made_up(at, "EQ");
        let taps = signal.taps.unwrap_or_default();
        let element = self.after(&taps, ElementKind::Invert, node.span);
        let taps = self.enabled(vec![(element, Port::Power)], node, enable);
        let term = signal.term.complement(node.span, &made_up);
        self.set_flow(at, node, taps, term, enable);
    }

    // ---- functions over values --------------------------------------------------

    /// `MOVE` without `EN` hands its input on.
    fn pass_value(&mut self, at: usize, node: &'a Node) {
        let source = node
            .inputs
            .iter()
            .filter(|input| !is(&input.pin, "EN"))
            .find_map(|input| input.sources.first());
        let signal = match source {
            Some(source) => self.signal(at, source),
            None => Signal::value(Term::truth(false, node.span), None, node.span),
        };
        let pin = node.outputs.iter().find(|output| !is(&output.pin, "ENO"));
        let pin = pin.map_or("OUT", |output| output.pin.as_str());
        self.set(at, pin, signal);
        self.pass_enable(at, node, rail(), &None);
        if !self.feeds(at) {
            self.idle(node);
        }
    }

    fn function(
        &mut self,
        at: usize,
        node: &'a Node,
        block: &'a BlockType,
        enable: &Option<Arrival>,
    ) {
        let name = block.name.value.as_str();
        let term = self.function_term(at, node, name);
        let pin = node.outputs.iter().find(|output| !is(&output.pin, "ENO"));
        let pin = pin.map_or("OUT", |output| output.pin.as_str());
        let of = standard::pin_type(name, pin);
        let boolean = of.map(|found| found == "BOOL").or(match standard(name) {
            Some(Standard::Infix(_) | Standard::Gate(_) | Standard::Not) => Some(false),
            _ => None,
        });
        let mut signal = Signal::value(term.clone(), boolean, node.span);
        let mut passed = enable.as_ref().map_or_else(rail, |e| e.taps.clone());
        if let Some(enable) = enable {
            for (target, text) in self.targets_of(at, node, pin) {
                let operand =
                    Operand::new(self.body.names.fold(self.body.unit, &text.value), text.span);
                // A disabled function leaves its target alone, so what reads
                // its output reads the target.
                signal.term = Term::variable(operand.clone());
                signal.boolean = self.body.names.is_boolean(self.body.unit, &text.value);
                let element = self.assign(operand, &term, &enable.taps, node.span);
                passed = vec![(element, Port::Power)];
                self.done.insert(target);
            }
        }
        self.set(at, pin, signal);
        self.pass_enable(at, node, passed, enable);
        if !self.feeds(at) {
            self.idle(node);
        }
    }

    fn function_term(&mut self, at: usize, node: &'a Node, name: &str) -> Term {
        let mut parts = Vec::new();
        for input in node.inputs.iter().filter(|input| !is(&input.pin, "EN")) {
            parts.extend(self.term_of(at, input));
        }
        let made_up = self.made_up(at, name);
        let upper = name.to_uppercase();
        let texts: Vec<_> = parts.iter().map(|part| &*part.text).collect();
        let (text, sign) = match standard(name) {
            Some(Standard::Move) => match parts.pop() {
                Some(part) => return part,
                None => ("?".to_owned(), ""),
            },
            Some(Standard::Infix(sign)) if texts.len() > 1 => {
                (format!("({})", texts.join(&format!(" {sign} "))), sign)
            }
            Some(Standard::Gate(_)) if texts.len() > 1 => {
                (format!("({})", texts.join(&format!(" {upper} "))), "")
            }
            _ => (format!("{upper}({})", texts.join(", ")), ""),
        };
        let mut term = Term::composed(text, &parts, node.span, &made_up);
        if let Some(sum) = sum(sign, &parts) {
            term.form = sum;
        }
        term.mnemonic = upper.into();
        term
    }

    /// A block whose result nobody takes stays in the rung as it is.
    fn idle(&mut self, node: &'a Node) {
        let NodeKind::Block(block) = &node.kind else {
            return;
        };
        let kind = ElementKind::Block(Block {
            name: block.name.value.as_str().into(),
            instance: None,
            pins: Vec::new(),
            familiarity: Familiarity::Known,
            shapes_power: false,
        });
        self.after(&rail(), kind, node.span);
    }
}

/// A variable plus or minus a constant.
fn sum(sign: &str, parts: &[Term]) -> Option<Form> {
    let [left, right] = parts else {
        return None;
    };
    match (sign, &left.form, &right.form) {
        ("+", Form::Variable, Form::Integer(by)) => Some(Form::Sum(left.text.clone(), *by)),
        ("+", Form::Integer(by), Form::Variable) => Some(Form::Sum(right.text.clone(), *by)),
        ("-", Form::Variable, Form::Integer(by)) => {
            Some(Form::Sum(left.text.clone(), by.checked_neg()?))
        }
        _ => None,
    }
}

/// Whether a pin is called `name`: case does not matter.
fn is(pin: &str, name: &str) -> bool {
    pin.eq_ignore_ascii_case(name)
}
