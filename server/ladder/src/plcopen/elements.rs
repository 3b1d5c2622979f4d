//! Elements without pins: contacts, coils, variables, jumps, and what leads from
//! one part of a drawing to another.

use petgraph::graph::NodeIndex;
use source::{Diagnostic, Span, codes};

use super::diagram::{Node, NodeKind, Storage, Style};
use super::network::{Arrival, Lowering, edge_word, rail};
use super::rungs;
use super::signal::{Form, Signal, Tap, Term};
use crate::{
    Assignment, Block, Coil, CoilKind, Contact, ContactKind, Edge, ElementKind, Familiarity,
    Network, OneShot, Operand, Port,
};

impl<'a> Lowering<'_, 'a> {
    pub(super) fn element(&mut self, at: usize, node: &'a Node<'a>) {
        self.writes |= rungs::is_output(node);
        match &node.kind {
            NodeKind::LeftRail | NodeKind::RightRail => {}
            NodeKind::Contact(style) => self.contact(at, node, *style),
            NodeKind::Coil(style) => self.coil(at, node, *style),
            NodeKind::Block(block) => self.block(at, node, block),
            NodeKind::InVariable { negated } => self.variable(at, node, *negated),
            NodeKind::OutVariable { negated } => self.target(at, node, *negated),
            NodeKind::InOutVariable {
                negated_in,
                negated_out,
            } => {
                if rungs::is_output(node) {
                    self.target(at, node, *negated_in);
                }
                self.variable(at, node, *negated_out);
            }
            NodeKind::Passage => self.passage(at, node),
            NodeKind::Label => {
                let label = self.operand(at, node, "label");
                let kind = ElementKind::Label(label);
                self.builder.add_after(&[Network::rail()], kind, node.span);
            }
            NodeKind::Jump => {
                let label = self.operand(at, node, "jump");
                self.end(at, node, ElementKind::Jump(label));
            }
            NodeKind::Return => self.end(at, node, ElementKind::Return { program: false }),
            NodeKind::Condition => self.condition(at, node),
            NodeKind::Foreign(name) => self.foreign(at, node, name),
        }
    }

    fn contact(&mut self, at: usize, node: &'a Node<'a>, style: Style) {
        let operand = self.operand(at, node, "contact");
        let arrival = self.main_arrival(at, node, "contact");
        let made_up = self.made_up(at, "power");
        let plain = Term::variable(operand.clone());
        let (kind, own) = match (style.edge, style.negated) {
            (None, false) => (ContactKind::Open, plain),
            (None, true) => (ContactKind::Closed, plain.complement(node.span, &made_up)),
            (Some(edge), negated) => {
                let rises = (edge == Edge::Rising) != negated;
                let (kind, word) = if rises {
                    (ContactKind::Rising, edge_word(Edge::Rising))
                } else {
                    (ContactKind::Falling, edge_word(Edge::Falling))
                };
                let text = format!("{word}({})", plain.text);
                (kind, Term::composed(text, &[plain], node.span, &made_up))
            }
        };
        let term = if arrival.term.form == Form::Truth(true) {
            own
        } else {
            Term::joined(vec![arrival.term, own], "AND", node.span, &made_up)
        };
        let kind = ElementKind::Contact(Contact { operand, kind });
        let element = self.after(&arrival.taps, kind, node.span);
        let signal = Signal::power(element, Port::Power, term, node.span);
        self.set(at, "", signal);
    }

    fn coil(&mut self, at: usize, node: &'a Node<'a>, style: Style) {
        let operand = self.operand(at, node, "coil");
        let arrival = self.main_arrival(at, node, "coil");
        let mut taps = arrival.taps.clone();
        let changes = style.storage.is_some() || style.edge.is_some();
        if style.negated && changes {
            let element = self.after(&taps, ElementKind::Invert, node.span);
            taps = vec![(element, Port::Power)];
        }
        let kind = match (style.storage, style.edge) {
            (Some(storage), edge) => {
                if let Some(edge) = edge {
                    let shot = ElementKind::OneShot(OneShot { edge, memory: None });
                    taps = vec![(self.after(&taps, shot, node.span), Port::Power)];
                }
                match storage {
                    Storage::Set => CoilKind::Set,
                    Storage::Reset => CoilKind::Reset,
                }
            }
            (None, Some(Edge::Rising)) => CoilKind::Rising,
            (None, Some(Edge::Falling)) => CoilKind::Falling,
            (None, None) if style.negated => CoilKind::Negated,
            (None, None) => CoilKind::Plain,
        };
        let kind = ElementKind::Coil(Coil { operand, kind });
        let element = self.after(&taps, kind, node.span);
        // A coil passes on what it gets; what was put before it is its own.
        let passed = if taps == arrival.taps {
            vec![(element, Port::Power)]
        } else {
            arrival.taps
        };
        let signal = Signal {
            taps: Some(passed),
            boolean: Some(true),
            term: arrival.term,
            span: node.span,
        };
        self.set(at, "", signal);
    }

    pub(super) fn end(&mut self, at: usize, node: &'a Node<'a>, kind: ElementKind) {
        let arrival = self.main_arrival(at, node, "element");
        self.after(&arrival.taps, kind, node.span);
    }

    pub(super) fn variable(&mut self, at: usize, node: &'a Node<'a>, negated: bool) {
        let text = match &node.operand {
            Some(text) => text.clone(),
            None => {
                let operand = self.operand(at, node, "variable");
                let term = Term::variable(operand);
                return self.set(at, "", Signal::value(term, None, node.span));
            }
        };
        let unit = self.body.unit;
        let mut term = Term::of(&text, unit, self.body.names);
        let boolean = match &term.form {
            Form::Variable => self.body.names.is_boolean(unit, &text.value),
            Form::Truth(_) | Form::Not(_) | Form::Relation(..) => Some(true),
            Form::Literal => Some(false),
            Form::Integer(0 | 1) | Form::Sum(..) | Form::Other => None,
            Form::Integer(_) => Some(false),
        };
        if negated {
            let made_up = self.made_up(at, "variable");
            term = term.complement(term.span, &made_up);
        }
        self.set(at, "", Signal::value(term, boolean, node.span));
    }

    /// An `outVariable`: a coil for a Boolean, an assignment for a value.
    fn target(&mut self, at: usize, node: &'a Node<'a>, negated: bool) {
        if self.done.contains(&at) {
            return;
        }
        let operand = self.operand(at, node, "variable");
        let declared = node
            .operand
            .as_ref()
            .and_then(|text| self.body.names.is_boolean(self.body.unit, &text.value));
        let Some(source) = node.inputs.first().and_then(|input| input.sources.first()) else {
            let arrival = self.main_arrival(at, node, "variable");
            let kind = CoilKind::Plain;
            self.after(
                &arrival.taps,
                ElementKind::Coil(Coil { operand, kind }),
                node.span,
            );
            return;
        };
        let signal = self.signal(at, source);
        let spelt = signal.taps.is_some() || signal.term.form != Form::Other;
        let boolean = match (declared, signal.boolean) {
            (Some(false), _) | (_, Some(false)) => false,
            (Some(true), Some(true)) => true,
            (Some(true), None) => spelt,
            (None, found) => found.unwrap_or(false),
        };
        if !boolean {
            let made_up = self.made_up(at, "value");
            let term = match negated {
                true => signal.term.complement(node.span, &made_up),
                false => signal.term,
            };
            self.one_source(node);
            self.assign(operand, &term, &rail(), node.span);
            return;
        }
        let arrival = self.main_arrival(at, node, "variable");
        let kind = if negated {
            CoilKind::Negated
        } else {
            CoilKind::Plain
        };
        self.after(
            &arrival.taps,
            ElementKind::Coil(Coil { operand, kind }),
            node.span,
        );
    }

    /// Power may come from several places, a value may not.
    fn one_source(&mut self, node: &'a Node<'a>) {
        let sources = node.inputs.iter().flat_map(|input| &input.sources);
        for source in sources.skip(1) {
            let message = "a value comes from one place only, and this is a second one";
            self.report(
                Diagnostic::new(codes::DANGLING_CONNECTION, source.span, message)
                    .help("remove one of the connections; the first is used"),
            );
        }
    }

    /// Writes a value while there is power.
    pub(super) fn assign(
        &mut self,
        target: Operand,
        term: &Term,
        power: &[Tap],
        span: Span,
    ) -> NodeIndex {
        self.writes = true;
        let kind = ElementKind::Assign(Assignment {
            value: term.written_to(&target),
            target,
            mnemonic: term.mnemonic.clone().unwrap_or_else(|| "MOVE".into()),
        });
        self.after(power, kind, span)
    }

    /// Hands on what arrives.
    fn passage(&mut self, at: usize, node: &'a Node<'a>) {
        let Some(input) = node.inputs.first() else {
            return;
        };
        let signal = match input.sources.as_slice() {
            [only] => self.signal(at, only),
            _ => {
                let arrival = self.arrival(at, input);
                Signal {
                    taps: Some(arrival.taps),
                    boolean: Some(true),
                    term: arrival.term,
                    span: node.span,
                }
            }
        };
        self.set(at, "", signal);
    }

    pub(super) fn condition(&mut self, at: usize, node: &'a Node<'a>) {
        let arrival = self.main_arrival(at, node, "transition");
        let said = arrival.term.text.clone();
        self.body.conditions.insert(node.span, said);
        let operand = match &node.operand {
            Some(text) => self.folded(text),
            None => Operand::new(self.made_up(at, "transition").name(), node.span),
        };
        let kind = CoilKind::Plain;
        let coil = ElementKind::Coil(Coil { operand, kind });
        self.after(&arrival.taps, coil, node.span);
    }

    /// An element of another format's: kept, and said to be unknown.
    fn foreign(&mut self, at: usize, node: &'a Node<'a>, name: &str) {
        self.report(
            Diagnostic::new(
                codes::UNKNOWN_BOX,
                node.span,
                format!("`<{name}>` is no element that Gradus knows"),
            )
            .help("it is kept as a box; what it does is not known"),
        );
        self.writes = true;
        let arrival = match node.inputs.first() {
            Some(input) => self.arrival(at, input),
            None => Arrival {
                taps: rail(),
                term: Term::truth(true, node.span),
            },
        };
        let made_up = self.made_up(at, name).name();
        let kind = ElementKind::Block(Block {
            name: name.into(),
            instance: Some(Operand::new(made_up.clone(), node.span)),
            pins: Vec::new(),
            familiarity: Familiarity::Unknown,
            shapes_power: true,
        });
        let element = self.after(&arrival.taps, kind, node.span);
        let term = Term::variable(Operand::new(made_up, node.span));
        let signal = Signal::power(element, Port::Power, term, node.span);
        self.set(at, "", signal);
    }
}
