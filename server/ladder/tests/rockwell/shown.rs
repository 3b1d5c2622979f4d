//! Programs as text, so that a test is two strings.
//!
//! A rung is shown as one line for each of its outputs, `guard -> OUTPUT`, with
//! the guard in the project's notation: `*` and, `+` or, `/` not.

use ladder::{
    CoilKind, ContactKind, Edge, Element, ElementKind, Network, Operand, Pin, PinDirection,
    Program, Reading, Rung, Value,
};
use petgraph::graph::NodeIndex;

/// The outputs of a rung with what leads to them.
pub fn rung(rung: &Rung) -> Vec<String> {
    let network = &rung.network;
    network
        .elements()
        .filter_map(|(at, element)| {
            let output = output(&element.kind)?;
            Some(format!("{} -> {output}", arriving(network, at)))
        })
        .collect()
}

fn arriving(network: &Network, at: NodeIndex) -> String {
    let mut terms: Vec<String> = Vec::new();
    for (from, _) in network.arriving(at) {
        let term = passed(network, from);
        if !terms.contains(&term) {
            terms.push(term);
        }
    }
    terms.join(" + ")
}

fn passed(network: &Network, at: NodeIndex) -> String {
    let power = || arriving(network, at);
    let and = |condition: String| match power().as_str() {
        "1" => condition,
        sum if is_sum(sum) => format!("({sum})*{condition}"),
        product => format!("{product}*{condition}"),
    };
    match &network.element(at).kind {
        ElementKind::Rail => "1".to_owned(),
        ElementKind::Contact(contact) => and(match contact.kind {
            ContactKind::Open => contact.operand.name.to_string(),
            ContactKind::Closed => format!("/{}", contact.operand.name),
            kind => format!("{kind:?}({})", contact.operand.name),
        }),
        ElementKind::Comparison(it) => and(format!(
            "[{} {} {}]",
            it.left.name,
            it.relation.sign(),
            it.right.name
        )),
        ElementKind::Open => and("0".to_owned()),
        ElementKind::OneShot(shot) => {
            let edge = match shot.edge {
                Edge::Rising => "rise",
                Edge::Falling => "fall",
            };
            let memory = shot.memory.as_ref().map_or("", |memory| &memory.name);
            format!("{edge}({}; {memory})", power())
        }
        ElementKind::Block(block) if block.shapes_power => and(format!("{}?", block.name)),
        _ => power(),
    }
}

/// Whether a `+` stands outside all parentheses and brackets.
fn is_sum(expression: &str) -> bool {
    let mut depth = 0;
    expression.chars().any(|character| {
        match character {
            '(' | '[' => depth += 1,
            ')' | ']' => depth -= 1,
            _ => {}
        }
        depth == 0 && character == '+'
    })
}

fn output(kind: &ElementKind) -> Option<String> {
    let name = |operand: &Operand| operand.name.to_string();
    Some(match kind {
        ElementKind::Coil(coil) => {
            let mnemonic = match coil.kind {
                CoilKind::Plain => "OTE",
                CoilKind::Set => "OTL",
                CoilKind::Reset => "OTU",
                _ => "coil",
            };
            format!("{mnemonic} {}", coil.operand.name)
        }
        ElementKind::Timer(timer) => format!(
            "{:?} {} {} {:?}",
            timer.kind, timer.instance.name, timer.output, timer.preset_ms
        ),
        ElementKind::Counter(counter) => format!(
            "{:?} {} {} {:?}",
            counter.kind, counter.instance.name, counter.output, counter.preset
        ),
        ElementKind::Assign(it) => {
            format!("{} {} := {}", it.mnemonic, it.target.name, value(&it.value))
        }
        ElementKind::ResetBox(operand) => format!("RES {}", operand.name),
        ElementKind::Call(call) => {
            let arguments: Vec<String> = call.arguments.iter().map(name).collect();
            format!("call {}({})", call.routine.name, arguments.join(","))
        }
        ElementKind::Jump(label) => format!("jump {}", label.name),
        ElementKind::Label(label) => format!("label {}", label.name),
        ElementKind::Return { .. } => "return".to_owned(),
        ElementKind::Zone => "zone".to_owned(),
        ElementKind::Block(block) => {
            let pins: Vec<String> = block.pins.iter().map(pin).collect();
            let instance = block.instance.as_ref().map(name).unwrap_or_default();
            let familiarity = format!("{:?}", block.familiarity).to_lowercase();
            format!(
                "{familiarity} {}({instance}|{})",
                block.name,
                pins.join(" ")
            )
        }
        _ => return None,
    })
}

fn value(value: &Value) -> String {
    match value {
        Value::Constant(number) => number.to_string(),
        Value::Copy(operand) => operand.name.to_string(),
        Value::Increment(step) => format!("itself + {step}"),
        Value::Term { text, reads } => {
            let reads: Vec<&str> = reads.iter().map(|read| &*read.name).collect();
            format!("{text} {{{}}}", reads.join(","))
        }
    }
}

fn pin(pin: &Pin) -> String {
    let name = pin.name.as_deref().unwrap_or_default();
    let sign = match pin.direction {
        PinDirection::Input => "<",
        PinDirection::Output => ">",
        PinDirection::InOut => "<>",
    };
    let operand = pin.operand.as_ref().map_or("", |operand| &operand.name);
    format!("{name}{sign}{operand}")
}

/// A whole reading: routines, charts, declarations, findings.
pub fn reading(reading: &Reading, bytes: &[u8]) -> String {
    let program = &reading.program;
    let mut lines = vec![format!("{} {}", program.format.word(), program.name)];
    for routine in &program.routines {
        lines.push(format!("\n{} {:?}", routine.scope, routine.role));
        for it in &routine.rungs {
            let comment = it.comment.as_deref().unwrap_or_default();
            lines.push(
                format!("  {} {}", it.number, comment.replace('\n', " / "))
                    .trim_end()
                    .to_owned(),
            );
            lines.extend(rung(it).into_iter().map(|output| format!("    {output}")));
        }
    }
    charts(program, &mut lines);
    lines.push("\ndeclared".to_owned());
    for it in program.declarations.iter() {
        let parts = [&it.data_type, &it.address, &it.initial, &it.description];
        let parts: Vec<&str> = parts
            .iter()
            .map(|part| part.as_deref().unwrap_or("-"))
            .collect();
        lines.push(format!(
            "  {} {:?} {}",
            it.name,
            it.class,
            parts.join(" | ")
        ));
    }
    lines.push("\nfindings".to_owned());
    for it in &reading.diagnostics {
        let place = String::from_utf8_lossy(&bytes[it.span.range()]);
        let first_line = place.lines().next().unwrap_or_default();
        lines.push(format!("  {} at `{first_line}`: {}", it.code, it.message));
    }
    lines.join("\n") + "\n"
}

fn charts(program: &Program, lines: &mut Vec<String>) {
    for chart in &program.charts {
        lines.push(format!("\nchart {}", chart.scope));
        let names = |places: &[usize]| {
            let names: Vec<&str> = places
                .iter()
                .map(|&place| &*chart.steps[place].name)
                .collect();
            names.join(",")
        };
        for step in &chart.steps {
            let initial = if step.initial { " initial" } else { "" };
            lines.push(format!("  step {}{initial}", step.name));
            for action in &step.actions {
                lines.push(format!(
                    "    {} {}",
                    action.qualifier,
                    action.body.replace('\n', " / ")
                ));
            }
        }
        for it in &chart.transitions {
            lines.push(format!(
                "  {}: {} -> {} when {}",
                it.name,
                names(&it.from),
                names(&it.to),
                it.condition
            ));
        }
    }
}

/// Everything of an element that has a place in the text.
pub fn operands(element: &Element) -> Vec<&Operand> {
    let mut operands = element.kind.reads();
    operands.extend(element.kind.writes());
    operands
}
