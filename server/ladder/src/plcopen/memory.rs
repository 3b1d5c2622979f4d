//! Blocks of the standard that remember: timers, counters, edges, bistables.

use super::boxes::is;
use super::diagram::{BlockType, Input, Node};
use super::expression;
use super::network::{Arrival, Lowering, rail};
use super::signal::{Form, Signal, Term};
use super::standard::Dominance;
use crate::{
    Class, Coil, CoilKind, Counter, CounterKind, Edge, ElementKind, OneShot, Operand, Port, Timer,
    TimerKind,
};

impl<'a> Lowering<'_, 'a> {
    pub(super) fn timer(
        &mut self,
        at: usize,
        node: &'a Node<'a>,
        block: &'a BlockType<'a>,
        kind: TimerKind,
        enable: &Option<Arrival>,
    ) {
        self.writes = true;
        let instance = self.instance(at, node, block);
        let preset_ms = self.preset(at, node, &instance, "PT", expression::milliseconds);
        let boolean = |input: &Input<'_>| !is(&input.pin, "PT");
        let arrivals = self.arrivals(at, node, boolean);
        let kind = ElementKind::Timer(Timer {
            kind,
            output: self.member(&instance, "Q").name,
            instance: instance.clone(),
            preset_ms,
            // A variable is written to the input before the block is solved.
            preset_from: None,
        });
        let element = self.builder.add(kind, node.span);
        self.join_pins(arrivals, element);
        self.set_pins(at, node, element, &instance, "TON");
        let taps = self.enable_taps(element, enable);
        self.pass_enable(at, node, taps, enable);
    }

    /// The preset at an input, where it is a constant. Another value is
    /// written to the input before the block is solved.
    fn preset<T>(
        &mut self,
        at: usize,
        node: &'a Node<'a>,
        instance: &Operand,
        pin: &str,
        parse: fn(&str) -> Option<T>,
    ) -> Option<T> {
        let term = self.term_at(at, node, pin)?;
        let constant = self.constant(&term);
        let preset = parse(constant.as_deref().unwrap_or(&term.text));
        if preset.is_none() {
            let target = self.member(instance, pin);
            let input = node.inputs.iter().find(|input| is(&input.pin, pin));
            let span = input.map_or(node.span, |input| input.span);
            self.assign(target, &term, &rail(), span);
        }
        preset
    }

    /// The initial value of a variable that never changes.
    fn constant(&self, term: &Term) -> Option<logic::Name> {
        let declaration = self.body.declarations.find(&term.text)?;
        let fixed = term.form == Form::Variable && declaration.class == Class::Constant;
        declaration.initial.clone().filter(|_| fixed)
    }

    pub(super) fn counter(
        &mut self,
        at: usize,
        node: &'a Node<'a>,
        block: &'a BlockType<'a>,
        kind: CounterKind,
        enable: &Option<Arrival>,
    ) {
        self.writes = true;
        let instance = self.instance(at, node, block);
        let preset = self.preset(at, node, &instance, "PV", expression::integer);
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
            preset_from: None,
        });
        let element = self.builder.add(counter, node.span);
        self.join_pins(arrivals, element);
        self.set_pins(at, node, element, &instance, "CTUD");
        let taps = self.enable_taps(element, enable);
        self.pass_enable(at, node, taps, enable);
    }

    /// An edge of the power flow. Where the instance's `Q` is read by name, a
    /// coil writes it.
    pub(super) fn trigger(
        &mut self,
        at: usize,
        node: &'a Node<'a>,
        block: &'a BlockType<'a>,
        edge: Edge,
        enable: &Option<Arrival>,
    ) {
        self.writes = true;
        let instance = self.instance(at, node, block);
        let arrival = self.only_arrival(at, node);
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
    pub(super) fn bistable(
        &mut self,
        at: usize,
        node: &'a Node<'a>,
        block: &'a BlockType<'a>,
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
}
