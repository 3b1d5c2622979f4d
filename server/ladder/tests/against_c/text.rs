//! A program in rung notation.

use crate::program::{Coil, Condition, INPUTS, Output, Program, Rung, RungKind, Term};

pub fn text(program: &Program) -> String {
    let mut out = String::from("program Random\n\n");
    for input in INPUTS {
        out += &format!("input {input}\n");
    }
    for number in 0..3 {
        out += &format!("internal n{number} : DINT\n");
    }
    out.push('\n');
    for it in &program.main {
        out += &rung(program, it);
    }
    out += "\nroutine Sub\n\n";
    for it in &program.sub {
        out += &rung(program, it);
    }
    out
}

fn rung(program: &Program, rung: &Rung) -> String {
    let label = rung
        .label
        .map(|at| format!(" label l{at}"))
        .unwrap_or_default();
    match &rung.kind {
        RungKind::Plain(on, outputs) => {
            let outputs = list(program, outputs);
            format!("rung{label}: {} -> {outputs}\n", condition(on))
        }
        RungKind::ZoneBegin(on) => format!("rung{label}: {} -> MCR()\n", condition(on)),
        RungKind::ZoneEnd => format!("rung{label}: 1 -> MCR()\n"),
    }
}

fn condition(it: &Condition) -> String {
    let edge = |is_rising: bool| if is_rising { "rise" } else { "fall" };
    let joined = |parts: &[Condition], sign: &str| {
        let parts: Vec<String> = parts.iter().map(condition).collect();
        format!("({})", parts.join(sign))
    };
    match it {
        Condition::Constant(value) => u8::from(*value).to_string(),
        Condition::Open(name) => name.clone(),
        Condition::Closed(name) => format!("/{name}"),
        Condition::Edge { is_rising, of } => format!("{}({of})", edge(*is_rising)),
        Condition::OneShot { is_rising, of } => {
            format!("{}({})", edge(*is_rising), condition(of))
        }
        Condition::Compare(left, relation, right) => format!("{left} {relation} {right}"),
        Condition::All(parts) => joined(parts, " * "),
        Condition::Any(parts) => joined(parts, " + "),
    }
}

fn list(program: &Program, outputs: &[Output]) -> String {
    let all: Vec<String> = outputs.iter().map(|it| output(program, it)).collect();
    all.join(", ")
}

fn output(program: &Program, it: &Output) -> String {
    match it {
        Output::Coil(kind, name) => match kind {
            Coil::Plain => (*name).to_owned(),
            Coil::Negated => format!("/{name}"),
            Coil::Set => format!("set {name}"),
            Coil::Reset => format!("reset {name}"),
            Coil::Rising => format!("rising {name}"),
            Coil::Falling => format!("falling {name}"),
        },
        Output::Move(target, term) => format!("{target} := {}", spelled(term)),
        Output::Box(at) => {
            let of = &program.boxes[*at];
            let unit = if of.is_timer() { "ms" } else { "" };
            format!("{}({}, {}{unit})", of.kind, of.name, of.preset)
        }
        Output::Reset(at) => format!("RES({})", program.boxes[*at].name),
        Output::Jump(label) => format!("jump l{label}"),
        Output::Call => "call Sub".to_owned(),
        Output::Return => "return".to_owned(),
        Output::Leg(on, outputs) => {
            format!("({} -> {})", condition(on), list(program, outputs))
        }
    }
}

fn spelled(term: &Term) -> String {
    match term {
        Term::Value(value) => value.clone(),
        Term::Sum(name, sign, number) => format!("{name} {sign} {number}"),
        Term::Product(name, minus, times) => format!("({name} - {minus}) * {times}"),
    }
}
