//! Functions over values: they become terms, and assignments where `EN` decides
//! whether the term is written.

use super::boxes::{is, main_output};
use super::diagram::{BlockType, Node, NodeKind};
use super::network::{Arrival, Lowering, rail};
use super::signal::{Form, Signal, Term};
use super::standard::{self, Standard, standard};
use crate::{Block, ElementKind, Familiarity, Operand, Port};

impl<'a> Lowering<'_, 'a> {
    /// `MOVE` without `EN` hands its input on.
    pub(super) fn pass_value(&mut self, at: usize, node: &'a Node<'a>) {
        let source = node
            .inputs
            .iter()
            .filter(|input| !is(&input.pin, "EN"))
            .find_map(|input| input.sources.first());
        let signal = match source {
            Some(source) => self.signal(at, source),
            None => Signal::value(Term::truth(false, node.span), None, node.span),
        };
        let pin = main_output(node);
        self.set(at, pin, signal);
        self.pass_enable(at, node, rail(), &None);
        if !self.feeds(at) {
            self.idle(node);
        }
    }

    pub(super) fn function(
        &mut self,
        at: usize,
        node: &'a Node<'a>,
        block: &'a BlockType<'a>,
        enable: &Option<Arrival>,
    ) {
        let name = &*block.name.value;
        let term = self.function_term(at, node, name);
        let pin = main_output(node);
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

    fn function_term(&mut self, at: usize, node: &'a Node<'a>, name: &str) -> Term {
        let mut parts = Vec::new();
        for input in node.inputs.iter().filter(|input| !is(&input.pin, "EN")) {
            parts.extend(self.term_of(at, input));
        }
        let made_up = self.made_up(at, name);
        let upper = name.to_uppercase();
        let texts: Vec<_> = parts.iter().map(|part| &*part.text).collect();
        let enclosed: Vec<_> = parts.iter().map(Term::enclosed).collect();
        let (text, sign) = match standard(name) {
            Some(Standard::Move) => match parts.pop() {
                Some(part) => return part,
                None => ("?".to_owned(), ""),
            },
            Some(Standard::Infix(sign)) if texts.len() > 1 => {
                (format!("({})", enclosed.join(&format!(" {sign} "))), sign)
            }
            Some(Standard::Gate(_)) if texts.len() > 1 => {
                (format!("({})", enclosed.join(&format!(" {upper} "))), "")
            }
            _ => (format!("{upper}({})", texts.join(", ")), ""),
        };
        let mut term = Term::composed(text, &parts, node.span, &made_up);
        if let Some(sum) = sum(sign, &parts) {
            term.form = sum;
        }
        term.mnemonic = Some(upper.into());
        term
    }

    /// A block whose result nobody takes stays in the rung as it is.
    fn idle(&mut self, node: &'a Node<'a>) {
        let NodeKind::Block(block) = &node.kind else {
            return;
        };
        let kind = ElementKind::Block(Block {
            name: (&*block.name.value).into(),
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
