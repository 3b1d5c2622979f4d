//! Blocks whose inside is not modelled: the project's own, those of libraries,
//! and the few of the standard that only a simulation could follow.
//!
//! Such a block stands in the rung with its pins. Values stand at pins as
//! operands, power arrives by wire, and a Boolean output leaves by wire as the
//! atom `instance.PIN`.

use source::{Diagnostic, codes};

use super::boxes::is;
use super::diagram::{BlockType, Input, Node};
use super::interface::UnitKind;
use super::network::{Arrival, Lowering};
use super::signal::Signal;
use crate::{Block, ElementKind, Familiarity, Operand, Pin, PinDirection, Port};

impl<'a> Lowering<'_, 'a> {
    /// A block whose inside is not modelled.
    pub(super) fn opaque(
        &mut self,
        at: usize,
        node: &'a Node<'a>,
        block: &'a BlockType<'a>,
        familiarity: Familiarity,
        enable: &Option<Arrival>,
    ) {
        let name = &*block.name.value;
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
            None => Operand::new(self.made_up(at, name).name(), node.span),
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
        input: &'a Input<'a>,
        wired: &mut Vec<(&'a Input<'a>, Arrival)>,
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
            name: Some((&*input.pin).into()),
            direction: input.direction,
            operand,
        }
    }

    /// An output pin, once for every variable that takes its value; a Boolean
    /// one leaves power instead, and is written by a coil.
    fn output_pins(
        &mut self,
        at: usize,
        node: &Node<'_>,
        block: &str,
        pin: &str,
        pins: &mut Vec<Pin>,
    ) {
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
}
