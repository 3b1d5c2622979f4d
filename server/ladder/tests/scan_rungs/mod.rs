//! Programs for tests, written in a few lines.
//!
//! A line without indentation begins a routine: `main Name`, `called Name` or
//! `definition Name`. An indented line is a rung: elements in series, a
//! parallel connection as `[leg, leg]`. Elements are `NAME(operands)`; the
//! names are Rockwell's where it has one. `TONQ` and its like feed the rung
//! with the timer's output, `TON` lets power pass.

use ladder::{
    Assignment, Block, Call, Coil, CoilKind, Comparison, Contact, ContactKind, Counter,
    CounterKind, Edge, ElementKind, Familiarity, Format, Gate, NetworkBuilder, OneShot, Operand,
    Pin, PinDirection, Port, Program, Role, Routine, Rung, Timer, TimerKind, Value, Wire,
};
use logic::Relation;
use petgraph::graph::NodeIndex;
use source::Span;

/// The program that `text` writes.
pub fn program(text: &str) -> Program {
    let mut program = Program::empty(Format::Unknown);
    let mut offset = 0;
    for line in text.split_inclusive('\n') {
        let content = line.trim();
        let indented = line.starts_with(' ');
        let start = offset + line.len() - line.trim_start().len();
        let span = Span::new(start, start + content.len());
        offset += line.len();
        if content.is_empty() {
            continue;
        }
        if indented {
            let routine = program.routines.last_mut().expect("a routine first");
            let number = routine.rungs.len() as u32;
            let drawn = network(content, start);
            routine.rungs.push(Rung::new(number, None, drawn, span));
        } else {
            program.routines.push(routine(content, span));
        }
    }
    program
}

/// A program of one main routine with these rungs, one a line.
pub fn rungs(text: &str) -> Program {
    let lines: Vec<String> = text.lines().map(|line| format!("  {line}\n")).collect();
    program(&format!("main Main\n{}", lines.concat()))
}

fn routine(header: &str, span: Span) -> Routine {
    let (role, name) = header.split_once(' ').expect("a role and a name");
    let (unit, name) = name.split_once('/').unwrap_or(("Unit", name));
    Routine {
        scope: format!("{unit}/{name}").into(),
        unit: unit.into(),
        name: name.into(),
        role: match role {
            "main" => Role::Main,
            "called" => Role::Called,
            "definition" => Role::Definition,
            other => panic!("no role {other}"),
        },
        rungs: Vec::new(),
        span,
    }
}

/// Ends that power leaves from.
type Ends = Vec<(NodeIndex, Port)>;

struct Reader<'t> {
    text: &'t str,
    at: usize,
    base: usize,
    builder: NetworkBuilder,
}

fn network(text: &str, base: usize) -> ladder::Placed {
    let mut reader = Reader {
        text,
        at: 0,
        base,
        builder: NetworkBuilder::new(Span::at(base)),
    };
    let rail = vec![(ladder::Network::rail(), Port::Power)];
    reader.series(rail);
    assert_eq!(reader.at, text.len(), "all of `{text}` is read");
    reader.builder.finish()
}

impl Reader<'_> {
    fn series(&mut self, mut ends: Ends) -> Ends {
        loop {
            self.blank();
            ends = match self.next() {
                Some('[') => self.branch(ends),
                Some(c) if c.is_alphabetic() => self.element(ends),
                _ => return ends,
            };
        }
    }

    fn branch(&mut self, ends: Ends) -> Ends {
        let mut joined = Vec::new();
        while matches!(self.next(), Some('[' | ',')) {
            self.at += 1;
            joined.extend(self.series(ends.clone()));
        }
        assert_eq!(self.next(), Some(']'), "a branch of `{}` ends", self.text);
        self.at += 1;
        joined
    }

    fn element(&mut self, ends: Ends) -> Ends {
        let start = self.at;
        let name = self.take_while(|c| c.is_alphanumeric());
        let mut operands = Vec::new();
        if self.next() == Some('(') {
            while self.next() != Some(')') {
                self.at += 1;
                self.blank();
                let from = self.base + self.at;
                let mut depth = 0;
                let text = self.take_while(|c| {
                    depth += i32::from(c == '(');
                    depth -= i32::from(c == ')');
                    depth > 0 || depth == 0 && !matches!(c, ',')
                });
                operands.push(Operand::new(text, Span::new(from, from + text.len())));
            }
            self.at += 1;
        }
        let span = Span::new(self.base + start, self.base + self.at);
        let element = self.builder.add(kind(name, &operands), span);
        for (number, (from, port)) in ends.into_iter().enumerate() {
            let to = if matches!(name, "AND" | "OR" | "XOR") {
                Port::Pin(format!("IN{number}").into())
            } else {
                Port::Power
            };
            let wire = Wire {
                from: port,
                to,
                ..Wire::default()
            };
            assert!(self.builder.join(from, element, wire));
        }
        let port = if matches!(name, "TONQ" | "TOFQ" | "TPQ" | "CTUQ" | "CTDQ") {
            Port::Pin("Q".into())
        } else {
            Port::Power
        };
        vec![(element, port)]
    }

    fn take_while(&mut self, mut wanted: impl FnMut(char) -> bool) -> &'static str {
        let rest = &self.text[self.at..];
        let end = rest.find(|c| !wanted(c)).unwrap_or(rest.len());
        self.at += end;
        // Test programs are few and small; their names may live on.
        Box::leak(rest[..end].to_owned().into_boxed_str())
    }

    fn blank(&mut self) {
        self.take_while(|c| c == ' ');
    }

    fn next(&self) -> Option<char> {
        self.text[self.at..].chars().next()
    }
}

fn kind(name: &str, operands: &[Operand]) -> ElementKind {
    let operand = |at: usize| operands.get(at).expect(name).clone();
    let contact = |kind| {
        ElementKind::Contact(Contact {
            operand: operand(0),
            kind,
        })
    };
    let coil = |kind| {
        ElementKind::Coil(Coil {
            operand: operand(0),
            kind,
        })
    };
    let one_shot = |edge| {
        ElementKind::OneShot(OneShot {
            edge,
            memory: operands.first().cloned(),
        })
    };
    let compare = |relation| {
        ElementKind::Comparison(Comparison {
            left: operand(0),
            relation,
            right: operand(1),
        })
    };
    let variable = |at: usize| {
        let operand = operands.get(at).cloned();
        operand.filter(|operand| operand.name.parse::<i64>().is_err())
    };
    let timer = |kind| {
        let iec = name.ends_with('Q');
        ElementKind::Timer(Timer {
            kind,
            instance: operand(0),
            output: format!("{}.{}", operand(0).name, if iec { "Q" } else { "DN" }).into(),
            preset_ms: operands.get(1).and_then(|preset| preset.name.parse().ok()),
            preset_from: variable(1),
        })
    };
    let counter = |kind| {
        let iec = name.ends_with('Q');
        ElementKind::Counter(Counter {
            kind,
            instance: operand(0),
            output: format!("{}.{}", operand(0).name, if iec { "Q" } else { "DN" }).into(),
            preset: operands.get(1).and_then(|preset| preset.name.parse().ok()),
            preset_from: variable(1),
        })
    };
    let assign = |target: Operand, value: Value| {
        ElementKind::Assign(Assignment {
            target,
            value,
            mnemonic: name.into(),
        })
    };
    match name {
        "XIC" => contact(ContactKind::Open),
        "XIO" => contact(ContactKind::Closed),
        "RISE" => contact(ContactKind::Rising),
        "FALL" => contact(ContactKind::Falling),
        "OTE" => coil(CoilKind::Plain),
        "OTN" => coil(CoilKind::Negated),
        "OTL" => coil(CoilKind::Set),
        "OTU" => coil(CoilKind::Reset),
        "OTR" => coil(CoilKind::Rising),
        "OTF" => coil(CoilKind::Falling),
        "ONS" => one_shot(Edge::Rising),
        "OSF" => one_shot(Edge::Falling),
        "NOT" => ElementKind::Invert,
        "AFI" => ElementKind::Open,
        "AND" => ElementKind::Gate(Gate::And),
        "OR" => ElementKind::Gate(Gate::Or),
        "XOR" => ElementKind::Gate(Gate::Xor),
        "TON" | "TONQ" => timer(TimerKind::OnDelay),
        "TOF" | "TOFQ" => timer(TimerKind::OffDelay),
        "TP" | "TPQ" => timer(TimerKind::Pulse),
        "RTO" => timer(TimerKind::Retentive),
        "CTU" | "CTUQ" => counter(CounterKind::Up),
        "CTD" | "CTDQ" => counter(CounterKind::Down),
        "CTC" => counter(CounterKind::Circular),
        "RES" => ElementKind::ResetBox(operand(0)),
        "JSR" => ElementKind::Call(Call {
            routine: operand(0),
            arguments: Vec::new(),
        }),
        "JMP" => ElementKind::Jump(operand(0)),
        "LBL" => ElementKind::Label(operand(0)),
        "RET" => ElementKind::Return { program: false },
        "TND" => ElementKind::Return { program: false },
        "END" => ElementKind::Return { program: true },
        "MCR" => ElementKind::Zone,
        "EQU" => compare(Relation::Equal),
        "GRT" => compare(Relation::Greater),
        "LES" => compare(Relation::Less),
        "MOV" => match operand(0).name.parse() {
            Ok(constant) => assign(operand(1), Value::Constant(constant)),
            Err(_) => assign(operand(1), Value::Copy(operand(0))),
        },
        "INC" => assign(
            operand(1),
            Value::Increment(operand(0).name.parse().unwrap()),
        ),
        "CPT" => assign(
            operand(0),
            Value::Term {
                text: operand(1).name,
                reads: Vec::new(),
            },
        ),
        _ => ElementKind::Block(Block {
            name: name.into(),
            instance: None,
            pins: operands
                .iter()
                .map(|operand| Pin {
                    name: None,
                    direction: PinDirection::Input,
                    operand: Some(operand.clone()),
                })
                .collect(),
            familiarity: Familiarity::Unknown,
            shapes_power: true,
        }),
    }
}
