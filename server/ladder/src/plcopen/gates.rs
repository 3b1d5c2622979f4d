//! Blocks that are part of the power flow: gates, `NOT`, comparisons.

use logic::Relation;

use super::boxes::{is, main_output};
use super::diagram::{BlockType, Input, Node};
use super::network::{Arrival, Lowering, rail};
use super::signal::{Form, Term};
use crate::{Comparison, ElementKind, Gate, Operand, Port};

impl<'a> Lowering<'_, 'a> {
    /// Whether a gate works on words, bit by bit, rather than on Booleans.
    pub(super) fn over_words(&mut self, at: usize, node: &'a Node<'a>) -> bool {
        let inputs = node.inputs.iter().filter(|input| !is(&input.pin, "EN"));
        inputs
            .flat_map(|input| &input.sources)
            .any(|source| self.signal(at, source).boolean == Some(false))
    }

    pub(super) fn gate(
        &mut self,
        at: usize,
        node: &'a Node<'a>,
        gate: Gate,
        enable: &Option<Arrival>,
    ) {
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

    pub(super) fn not(&mut self, at: usize, node: &'a Node<'a>, enable: &Option<Arrival>) {
        let arrival = self.only_arrival(at, node);
        let made_up = self.made_up(at, "NOT");
        let term = arrival.term.complement(node.span, &made_up);
        let element = self.after(&arrival.taps, ElementKind::Invert, node.span);
        let taps = self.enabled(vec![(element, Port::Power)], node, enable);
        self.set_flow(at, node, taps, term, enable);
    }

    pub(super) fn compare(
        &mut self,
        at: usize,
        node: &'a Node<'a>,
        block: &'a BlockType<'a>,
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
            let (first, second) = (left.enclosed(), right.enclosed());
            let text = format!("{first} {} {second}", relation.sign());
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

    fn over_booleans(&mut self, at: usize, inputs: &[&'a Input<'a>]) -> bool {
        inputs.len() == 2
            && inputs
                .iter()
                .flat_map(|input| &input.sources)
                .any(|source| self.signal(at, source).boolean == Some(true))
    }

    /// Equality of two Booleans is the complement of their exclusive or.
    fn same(
        &mut self,
        at: usize,
        node: &'a Node<'a>,
        relation: Relation,
        enable: &Option<Arrival>,
    ) {
        self.gate(at, node, Gate::Xor, enable);
        if relation == Relation::NotEqual {
            return;
        }
        let pin = main_output(node);
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
}
