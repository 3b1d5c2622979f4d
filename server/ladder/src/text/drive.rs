//! Draws what a leg drives behind the condition of the leg.

use logic::Name;
use logic::notation::{Token, TokenKind};
use petgraph::graph::NodeIndex;
use source::{Diagnostic, Span, codes};

use super::boxes::{integer, is_name};
use super::network::Drawing;
use super::spacing::term_text;
use super::syntax::{
    Argument, Condition, Leg, OutputKind, OutputText, Pin as PinText, Preset, Term,
};
use crate::{
    Assignment, Block, Call, Coil, Counter, ElementKind, Familiarity, Operand, Pin, PinDirection,
    Timer, Value,
};

/// Draws a leg that `from` feeds: its condition, then its outputs side by
/// side.
pub(super) fn drive(drawing: &mut Drawing<'_, '_>, leg: &Leg, from: &[NodeIndex]) {
    let (power, span) = match &leg.condition {
        Condition::Missing => (None, Span::default()),
        Condition::Read(node) => (drawing.condition(node, from), node.span),
        Condition::NotRead(span) => (Some(drawing.opaque(*span, true, from)), *span),
    };
    let power = power.unwrap_or_else(|| from.to_vec());
    let power = match leg.outputs.len() {
        0 | 1 => power,
        _ => drawing.joined(&power, span),
    };
    for output in &leg.outputs {
        match &output.kind {
            OutputKind::Leg(inner) => drive(drawing, inner, &power),
            OutputKind::NotRead if output.span.is_empty() => {}
            OutputKind::NotRead => {
                drawing.opaque(output.span, false, &power);
            }
            _ => {
                if let Some(kind) = element(drawing, output) {
                    drawing.after(&power, kind, output.span);
                }
            }
        }
    }
}

/// The element that an output is, unless it is a leg or could not be read.
fn element(drawing: &mut Drawing<'_, '_>, output: &OutputText) -> Option<ElementKind> {
    Some(match &output.kind {
        OutputKind::Coil(kind, name) => ElementKind::Coil(Coil {
            operand: drawing.operand(*name),
            kind: *kind,
        }),
        OutputKind::Assign(target, term) => {
            let target = drawing.operand(*target);
            ElementKind::Assign(Assignment {
                value: value(drawing, &target.name, term),
                target,
                mnemonic: ":=".into(),
            })
        }
        OutputKind::Jump(label) => ElementKind::Jump(drawing.operand(*label)),
        OutputKind::Call(routine, arguments) => {
            let values = arguments.iter().filter_map(|handed| handed.value.as_ref());
            ElementKind::Call(Call {
                arguments: values.map(|term| whole_operand(drawing, term)).collect(),
                routine: drawing.operand(*routine),
            })
        }
        OutputKind::Return { program } => ElementKind::Return { program: *program },
        OutputKind::Timer(kind, instance, preset) => {
            let (instance, output) = instance_and_output(drawing, *instance);
            let (preset_ms, preset_from) = preset_of(drawing, *preset);
            ElementKind::Timer(Timer {
                kind: *kind,
                instance,
                output,
                preset_ms,
                preset_from,
            })
        }
        OutputKind::Counter(kind, instance, preset) => {
            let (instance, output) = instance_and_output(drawing, *instance);
            let (preset, preset_from) = preset_of(drawing, *preset);
            ElementKind::Counter(Counter {
                kind: *kind,
                instance,
                output,
                preset,
                preset_from,
            })
        }
        OutputKind::Reset(instance) => ElementKind::ResetBox(drawing.operand(*instance)),
        OutputKind::Zone => ElementKind::Zone,
        OutputKind::Box(name, arguments) => unknown_box(drawing, *name, arguments),
        OutputKind::Leg(_) | OutputKind::NotRead => return None,
    })
}

fn instance_and_output(drawing: &mut Drawing<'_, '_>, instance: Token) -> (Operand, Name) {
    let spelled = instance.name(drawing.source.text);
    let operand = drawing.operand(instance);
    let output = drawing.names.output_of(&operand.name, spelled);
    (operand, output)
}

/// A preset as its constant and the variable that holds it: one of them.
fn preset_of<T>(
    drawing: &mut Drawing<'_, '_>,
    preset: Option<Preset<T>>,
) -> (Option<T>, Option<Operand>) {
    match preset {
        Some(Preset::Constant(value)) => (Some(value), None),
        Some(Preset::Variable(name)) => (None, Some(drawing.operand(name))),
        None => (None, None),
    }
}

/// What `target := term` writes.
fn value(drawing: &mut Drawing<'_, '_>, target: &Name, term: &Term) -> Value {
    let text = drawing.source.text;
    if let Some(number) = integer(text, &term.tokens) {
        return Value::Constant(number);
    }
    let mut is_target =
        |token: &Token| is_name(token) && drawing.names.fold(token.name(text)) == *target;
    match term.tokens.as_slice() {
        [name, plus, number @ ..] if plus.kind == TokenKind::Plus && is_target(name) => {
            if let Some(step) = integer(text, number) {
                return Value::Increment(step);
            }
        }
        [name, minus, number @ ..] if minus.kind == TokenKind::Minus && is_target(name) => {
            if let Some(step) = integer(text, number).and_then(i64::checked_neg) {
                return Value::Increment(step);
            }
        }
        [number, plus, name] if plus.kind == TokenKind::Plus && is_target(name) => {
            if let Some(step) = integer(text, &[*number]) {
                return Value::Increment(step);
            }
        }
        [name] if is_name(name) => return Value::Copy(drawing.operand(*name)),
        _ => {}
    }
    Value::Term {
        text: term_text(text, &term.tokens).into(),
        reads: variables(drawing, &term.tokens),
    }
}

/// The variables that occur in a term; names of functions are none.
fn variables(drawing: &mut Drawing<'_, '_>, tokens: &[Token]) -> Vec<Operand> {
    let mut all = Vec::new();
    for (at, token) in tokens.iter().enumerate() {
        let is_function = token.kind == TokenKind::Name
            && tokens.get(at + 1).map(|next| next.kind) == Some(TokenKind::Open);
        if is_name(token) && !is_function {
            all.push(drawing.operand(*token));
        }
    }
    all
}

/// A value handed over: a variable by its name, anything else as written.
fn whole_operand(drawing: &mut Drawing<'_, '_>, term: &Term) -> Operand {
    match term.tokens.as_slice() {
        [name] if is_name(name) => drawing.operand(*name),
        tokens => Operand::new(
            term_text(drawing.source.text, tokens),
            super::network::place(drawing.source, term.span),
        ),
    }
}

fn unknown_box(drawing: &mut Drawing<'_, '_>, name: Token, arguments: &[Argument]) -> ElementKind {
    let text = drawing.source.text;
    let mnemonic = name.name(text);
    drawing.findings.push(
        Diagnostic::new(
            codes::UNKNOWN_BOX,
            name.span,
            format!("the box `{mnemonic}` is not known, so what it writes is not either"),
        )
        .help("the condition that drives it is still exact; check the rest by hand"),
    );
    let mut pins: Vec<Pin> = arguments
        .iter()
        .map(|argument| pin(drawing, argument))
        .collect();
    let is_instance = pins.first().is_some_and(|first| {
        let operand = first.operand.as_ref();
        first.name.is_none()
            && operand.is_some_and(|operand| drawing.names.has_type(&operand.name, mnemonic))
    });
    let instance = is_instance.then(|| pins.remove(0).operand).flatten();
    ElementKind::Block(Block {
        name: mnemonic.into(),
        instance,
        pins,
        familiarity: Familiarity::Unknown,
        shapes_power: false,
    })
}

fn pin(drawing: &mut Drawing<'_, '_>, argument: &Argument) -> Pin {
    let text = drawing.source.text;
    let value = argument.value.as_ref();
    let is_variable =
        value.is_some_and(|term| matches!(term.tokens.as_slice(), [name] if is_name(name)));
    let (name, direction) = match argument.pin {
        Some(PinText::Input(name)) => (Some(name.name(text).into()), PinDirection::Input),
        Some(PinText::Output(name)) => (Some(name.name(text).into()), PinDirection::Output),
        // Nothing can be written to a number or a term.
        None if is_variable => (None, PinDirection::InOut),
        None => (None, PinDirection::Input),
    };
    Pin {
        name,
        direction,
        operand: value.map(|term| whole_operand(drawing, term)),
    }
}
