//! A reading as text, for comparing and for reading.
//!
//! A rung is a list of its elements in the order of solving. Behind the arrow
//! stand the elements that feed each: `2.Q` is pin `Q` of element 2, `IN:2`
//! says that the wire arrives at pin `IN`.

use std::fmt::Write;

use ladder::{Assignment, Chart, Declaration, ElementKind, Network, Operand, Port, Reading, Value};
use source::LineIndex;

/// All that a reading holds.
pub fn picture(reading: &Reading, text: &[u8]) -> String {
    let mut out = String::new();
    for declaration in reading.program.declarations.iter() {
        writeln!(out, "{}", declared(declaration)).unwrap();
    }
    for routine in &reading.program.routines {
        writeln!(out, "\n{} ({:?})", routine.scope, routine.role).unwrap();
        for rung in &routine.rungs {
            let comment = rung.comment.as_deref().map(|c| format!(" \"{c}\""));
            writeln!(out, "  rung {}{}", rung.number, comment.unwrap_or_default()).unwrap();
            out += &network(&rung.network);
        }
    }
    for found in &reading.program.charts {
        out += &chart(found);
    }
    if !reading.diagnostics.is_empty() {
        out.push('\n');
    }
    let lines = LineIndex::new(text);
    for diagnostic in &reading.diagnostics {
        let place = lines.locate(text, diagnostic.span.start as usize);
        let (line, column) = (place.line, place.column);
        let (code, word) = (diagnostic.code, diagnostic.severity.word());
        writeln!(out, "{line}:{column} {code} {word}: {}", diagnostic.message).unwrap();
    }
    out
}

fn declared(declaration: &Declaration) -> String {
    let part = |sign: &str, part: &Option<logic::Name>| {
        part.as_ref()
            .map_or(String::new(), |part| format!(" {sign}{part}"))
    };
    format!(
        "{:?} {}{}{}{}{}",
        declaration.class,
        declaration.name,
        part("at ", &declaration.address),
        part(": ", &declaration.data_type),
        part(":= ", &declaration.initial),
        part("-- ", &declaration.description),
    )
}

fn network(network: &Network) -> String {
    let mut out = String::new();
    for (at, found) in network.elements().skip(1) {
        let wires = network.arriving(at).into_iter().map(|(from, wire)| {
            let pin = |port: &Port| match port {
                Port::Power => None,
                Port::Pin(pin) => Some(pin.clone()),
            };
            let to = pin(&wire.to).map_or(String::new(), |pin| format!("{pin}:"));
            let leaves = pin(&wire.from).map_or(String::new(), |pin| format!(".{pin}"));
            format!(" {to}{}{leaves}", from.index())
        });
        let wires: String = wires.collect();
        writeln!(out, "    {} {} <-{wires}", at.index(), element(&found.kind)).unwrap();
    }
    out
}

/// An element in a few words.
pub fn element(kind: &ElementKind) -> String {
    let name = |operand: &Operand| operand.name.to_string();
    match kind {
        ElementKind::Contact(contact) => format!("{:?} {}", contact.kind, name(&contact.operand)),
        ElementKind::Coil(coil) => format!("{:?} coil {}", coil.kind, name(&coil.operand)),
        ElementKind::Comparison(found) => {
            let (left, right) = (name(&found.left), name(&found.right));
            format!("{left} {} {right}", found.relation.sign())
        }
        ElementKind::OneShot(shot) => {
            let memory = shot
                .memory
                .as_ref()
                .map(|memory| format!(" {}", memory.name));
            format!("{:?} edge{}", shot.edge, memory.unwrap_or_default())
        }
        ElementKind::Timer(timer) => format!(
            "{:?} timer {} {}ms",
            timer.kind,
            timer.instance.name,
            timer.preset_ms.map_or("?".into(), |ms| ms.to_string())
        ),
        ElementKind::Counter(counter) => format!(
            "{:?} counter {} {}",
            counter.kind,
            counter.instance.name,
            counter
                .preset
                .map_or("?".into(), |preset| preset.to_string())
        ),
        ElementKind::Assign(assignment) => assigned(assignment),
        ElementKind::Block(block) => {
            let instance = block.instance.as_ref().map(|i| format!(" {}", i.name));
            let pins = block.pins.iter().filter_map(|pin| {
                let operand = pin.operand.as_ref()?;
                let pin_name = pin.name.as_deref().unwrap_or("?");
                Some(format!(" {pin_name}={}", operand.name))
            });
            let pins: String = pins.collect();
            let instance = instance.unwrap_or_default();
            format!("{:?} {}{instance}{pins}", block.familiarity, block.name)
        }
        ElementKind::Jump(label) => format!("jump {}", label.name),
        ElementKind::Label(label) => format!("label {}", label.name),
        other => format!("{other:?}"),
    }
}

fn assigned(assignment: &Assignment) -> String {
    let target = &assignment.target.name;
    let value = match &assignment.value {
        Value::Constant(number) => number.to_string(),
        Value::Copy(operand) => operand.name.to_string(),
        Value::Increment(by) => format!("{target} + {by}"),
        Value::Term { text, .. } => format!("`{text}`"),
    };
    format!("{target} := {value} by {}", assignment.mnemonic)
}

fn chart(chart: &Chart) -> String {
    let mut out = format!("\nchart {}\n", chart.scope);
    for step in &chart.steps {
        let initial = if step.initial { " (initial)" } else { "" };
        let actions = step.actions.iter();
        let actions: String = actions
            .map(|action| format!(" {}[{}]", action.qualifier, action.body))
            .collect();
        writeln!(out, "  {}{initial}{actions}", step.name).unwrap();
    }
    for transition in &chart.transitions {
        let names = |steps: &[usize]| {
            let names: Vec<_> = steps.iter().map(|&at| &*chart.steps[at].name).collect();
            names.join(", ")
        };
        writeln!(
            out,
            "  {} -> {}: {}",
            names(&transition.from),
            names(&transition.to),
            transition.condition
        )
        .unwrap();
    }
    out
}
