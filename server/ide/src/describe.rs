//! What an element is, in a line.

use ::ladder::{CounterKind, ElementKind, Familiarity, Gate, OneShot, TimerKind, Value};
use logic::notation::time;

/// What the element is called: its instance, or what the source writes.
pub(crate) fn name(kind: &ElementKind, text: &str) -> String {
    match kind {
        ElementKind::Timer(timer) => timer.instance.name.to_string(),
        ElementKind::Counter(counter) => counter.instance.name.to_string(),
        ElementKind::Block(block) => match &block.instance {
            Some(instance) => format!("{} {}", block.name, instance.name),
            None => block.name.to_string(),
        },
        ElementKind::Assign(assignment) => assignment.target.name.to_string(),
        ElementKind::Call(call) => call.routine.name.to_string(),
        ElementKind::Jump(label) | ElementKind::Label(label) => label.name.to_string(),
        ElementKind::ResetBox(operand) => operand.name.to_string(),
        _ => text.lines().next().unwrap_or_default().trim().to_owned(),
    }
}

/// What the element does.
pub(crate) fn summary(kind: &ElementKind) -> String {
    match kind {
        ElementKind::Rail => "the left power rail: always on".to_owned(),
        ElementKind::Contact(_) => "contact".to_owned(),
        ElementKind::Coil(_) => "coil".to_owned(),
        ElementKind::Comparison(_) => "passes power while the comparison holds".to_owned(),
        ElementKind::Invert => "passes power while it gets none".to_owned(),
        ElementKind::Open => "never passes power".to_owned(),
        ElementKind::OneShot(OneShot { edge, .. }) => match edge {
            ::ladder::Edge::Rising => "passes power for one scan when it rises".to_owned(),
            ::ladder::Edge::Falling => "passes power for one scan when it falls".to_owned(),
        },
        ElementKind::Gate(gate) => match gate {
            Gate::And => "on while all its inputs are".to_owned(),
            Gate::Or => "on while any of its inputs is".to_owned(),
            Gate::Xor => "on while an odd number of its inputs is".to_owned(),
        },
        ElementKind::Timer(timer) => {
            let kind = match timer.kind {
                TimerKind::OnDelay => "on-delay timer",
                TimerKind::OffDelay => "off-delay timer",
                TimerKind::Pulse => "pulse timer",
                TimerKind::Retentive => "retentive timer",
            };
            let preset = match (timer.preset_ms, &timer.preset_from) {
                (Some(preset), _) => format!(", {}", time(preset)),
                (None, Some(from)) => format!(", as long as {} says", from.name),
                (None, None) => String::new(),
            };
            format!("{kind}{preset}; its output is `{}`", timer.output)
        }
        ElementKind::Counter(counter) => {
            let kind = match counter.kind {
                CounterKind::Up => "counts up",
                CounterKind::Down => "counts down",
                CounterKind::UpDown => "counts up and down",
                CounterKind::Circular => "counts round and round",
            };
            let preset = match (counter.preset, &counter.preset_from) {
                (Some(preset), _) => format!(", to {preset}"),
                (None, Some(from)) => format!(", to what {} says", from.name),
                (None, None) => String::new(),
            };
            format!("{kind}{preset}; its output is `{}`", counter.output)
        }
        ElementKind::Assign(assignment) => match &assignment.value {
            Value::Constant(value) => format!("{}: becomes {value}", assignment.mnemonic),
            Value::Copy(from) => format!("{}: becomes what {} is", assignment.mnemonic, from.name),
            Value::Increment(by) => format!("{}: changes by {by}", assignment.mnemonic),
            Value::Term { text, .. } => format!("{}: becomes {text}", assignment.mnemonic),
        },
        ElementKind::ResetBox(_) => "resets the timer or counter".to_owned(),
        ElementKind::Call(_) => "runs the routine while powered".to_owned(),
        ElementKind::Jump(_) => "goes on at the label while powered".to_owned(),
        ElementKind::Label(_) => "where jumps to it arrive".to_owned(),
        ElementKind::Return { program: false } => "leaves the routine while powered".to_owned(),
        ElementKind::Return { program: true } => {
            "ends the program for this scan while powered".to_owned()
        }
        ElementKind::Zone => "begins or ends a zone under master control".to_owned(),
        ElementKind::Block(block) => match block.familiarity {
            Familiarity::Known => "instruction whose effect on sequences is known".to_owned(),
            Familiarity::Defined => {
                "block that the file defines; what it writes is opaque here".to_owned()
            }
            Familiarity::Unknown => "unknown box: what it writes is opaque".to_owned(),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(output: &str, wanted: &str) {
        let program = ::ladder::read(format!("rung: go -> {output}").as_bytes()).program;
        let network = &program.routines[0].rungs[0].network;
        let (_, last) = network.elements().last().expect("an element");
        assert_eq!(summary(&last.kind), wanted);
    }

    #[test]
    fn a_preset_is_a_number_or_what_a_variable_holds() {
        check("TON(t1, 5s)", "on-delay timer, 5s; its output is `t1.Q`");
        check(
            "TON(t1, wait)",
            "on-delay timer, as long as wait says; its output is `t1.Q`",
        );
        check(
            "CTU(c1, most)",
            "counts up, to what most says; its output is `c1.Q`",
        );
    }
}
