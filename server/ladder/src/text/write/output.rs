//! Prints what a rung drives.

use logic::notation::{Lexer, Token, quoted, quoted_value, time};

use crate::text::spacing::term_text;
use crate::text::term::term;
use crate::{
    Assignment, Block, Coil, CoilKind, Counter, CounterKind, ElementKind, Operand, Pin,
    PinDirection, Timer, TimerKind, Value,
};

/// An output as the notation writes it, and what of it the notation cannot
/// say.
pub(super) fn output(kind: &ElementKind) -> (String, Vec<String>) {
    let mut lost = Vec::new();
    let text = match kind {
        ElementKind::Coil(coil) => written_coil(coil),
        ElementKind::Assign(assignment) => written_assignment(assignment, &mut lost),
        ElementKind::Timer(timer) => written_timer(timer),
        ElementKind::Counter(counter) => written_counter(counter, &mut lost),
        ElementKind::ResetBox(operand) => format!("RES({})", quoted(&operand.name)),
        ElementKind::Call(call) if call.arguments.is_empty() => {
            format!("call {}", quoted(&call.routine.name))
        }
        ElementKind::Call(call) => {
            let arguments = call.arguments.iter().map(|operand| value(&operand.name));
            let arguments: Vec<_> = arguments.collect();
            format!(
                "call {}({})",
                quoted(&call.routine.name),
                arguments.join(", ")
            )
        }
        ElementKind::Jump(label) => format!("jump {}", quoted(&label.name)),
        ElementKind::Return { program: false } => "return".to_owned(),
        ElementKind::Return { program: true } => "return program".to_owned(),
        ElementKind::Zone => "MCR()".to_owned(),
        ElementKind::Block(block) => written_block(block),
        _ => String::new(),
    };
    (text, lost)
}

fn written_coil(coil: &Coil) -> String {
    let name = quoted(&coil.operand.name);
    match coil.kind {
        CoilKind::Plain if name == "return" => "\"return\"".to_owned(),
        CoilKind::Plain => name,
        CoilKind::Negated => format!("/{name}"),
        CoilKind::Set => format!("set {name}"),
        CoilKind::Reset => format!("reset {name}"),
        CoilKind::Rising => format!("rising {name}"),
        CoilKind::Falling => format!("falling {name}"),
    }
}

fn written_assignment(assignment: &Assignment, lost: &mut Vec<String>) -> String {
    let target = quoted(&assignment.target.name);
    let value = match &assignment.value {
        Value::Constant(number) => number.to_string(),
        Value::Copy(operand) => quoted(&operand.name),
        Value::Increment(step) if *step < 0 => format!("{target} - {}", step.unsigned_abs()),
        Value::Increment(step) => format!("{target} + {step}"),
        Value::Term { text, .. } => arithmetic(text).unwrap_or_else(|| {
            lost.push(format!("what `{text}` reads"));
            quoted(text)
        }),
    };
    format!("{target} := {value}")
}

fn written_timer(timer: &Timer) -> String {
    let mnemonic = match timer.kind {
        TimerKind::OnDelay => "TON",
        TimerKind::OffDelay => "TOF",
        TimerKind::Pulse => "TP",
        TimerKind::Retentive => "RTO",
    };
    let preset = timer.preset_ms.map(time);
    with_preset(mnemonic, &timer.instance, preset, &timer.preset_from)
}

fn written_counter(counter: &Counter, lost: &mut Vec<String>) -> String {
    let mnemonic = match counter.kind {
        CounterKind::Up => "CTU",
        CounterKind::Down => "CTD",
        CounterKind::Circular => "CTC",
        CounterKind::UpDown => {
            lost.push("that the counter counts both ways".to_owned());
            "CTUD"
        }
    };
    let preset = counter.preset.map(|preset| preset.to_string());
    with_preset(mnemonic, &counter.instance, preset, &counter.preset_from)
}

fn with_preset(
    mnemonic: &str,
    instance: &Operand,
    constant: Option<String>,
    variable: &Option<Operand>,
) -> String {
    let instance = quoted(&instance.name);
    let variable = variable.as_ref().map(|variable| quoted(&variable.name));
    match constant.or(variable) {
        Some(preset) => format!("{mnemonic}({instance}, {preset})"),
        None => format!("{mnemonic}({instance})"),
    }
}

fn written_block(block: &Block) -> String {
    let instance = block.instance.iter().map(|operand| quoted(&operand.name));
    let arguments: Vec<_> = instance
        .chain(block.pins.iter().filter_map(written_pin))
        .collect();
    format!("{}({})", quoted(&block.name), arguments.join(", "))
}

/// A pin with what is at it. A named pin with nothing at it is left out. A pin
/// that is read and written goes without its name, since a name would say that
/// it is one of the two.
fn written_pin(pin: &Pin) -> Option<String> {
    let at_pin = pin.operand.as_ref().map(|operand| value(&operand.name));
    match (&pin.name, pin.direction) {
        (None, _) => Some(at_pin.unwrap_or_default()),
        (Some(_), PinDirection::InOut) => at_pin,
        (Some(name), PinDirection::Input) => Some(format!("{} := {}", quoted(name), at_pin?)),
        (Some(name), PinDirection::Output) => Some(format!("{} => {}", quoted(name), at_pin?)),
    }
}

/// A name, a number or a time, an arithmetic term if it is one, else quoted.
fn value(text: &str) -> String {
    let plain = quoted_value(text);
    match plain.starts_with('"') {
        true => arithmetic(text).unwrap_or(plain),
        false => plain,
    }
}

/// A term that reads back as it is, if the text is one.
fn arithmetic(text: &str) -> Option<String> {
    let mut lexer = Lexer::new(text);
    term(&mut lexer).ok()?;
    if lexer.peek().is_some() {
        return None;
    }
    let tokens: &[Token] = lexer.taken_since(0);
    // One name in a term would be read as a variable, not as a term.
    (tokens.len() > 1).then(|| term_text(text, tokens))
}
