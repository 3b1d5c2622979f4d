//! From a drawn symbol to an element: its kind, its operands, its ports.

use logic::{Name, Relation, duration};
use source::{Diagnostic, Span, codes};

use super::boxes::DrawnBox;
use super::grid::Grid;
use super::symbols::{Drawing, Symbol, SymbolKind};
use crate::{
    Block, Coil, CoilKind, Comparison, Contact, ContactKind, Counter, CounterKind, Edge,
    ElementKind, Familiarity, Gate, OneShot, Operand, Pin, PinDirection, Port, Timer, TimerKind,
};

/// Where the symbol is drawn.
pub(super) fn place(grid: &Grid, symbol: &Symbol) -> Span {
    match &symbol.kind {
        SymbolKind::Box(found) => {
            let last = found.rows.end.saturating_sub(1);
            grid.span(found.rows.start, found.columns.clone())
                .cover(grid.span(last, found.columns.clone()))
        }
        _ => grid.span(symbol.row, symbol.columns.clone()),
    }
}

/// What the symbol at `at` of the drawing is. Takes the words beside it.
pub(super) fn kind(
    grid: &Grid,
    drawing: &mut Drawing,
    at: usize,
    diagnostics: &mut Vec<Diagnostic>,
) -> ElementKind {
    let symbol = drawing.symbols[at].clone();
    let mut words = Beside {
        place: place(grid, &symbol),
        symbol: &symbol,
        drawing,
        diagnostics,
    };
    match &symbol.kind {
        SymbolKind::Contact(sign) => contact(sign, &mut words),
        SymbolKind::Coil(sign) => coil(sign, &mut words),
        SymbolKind::Jump(label) => jump(label, words),
        SymbolKind::Return(word) if word.to_uppercase().starts_with("RET") => {
            ElementKind::Return { program: false }
        }
        SymbolKind::Return(word) => words.opaque(&format!("<{word}>"), Vec::new(), false),
        SymbolKind::Box(found) => boxed(found, &mut words),
    }
}

/// The port that a wire at a pin of this element means. A box with one
/// Boolean input has it in the power flow.
pub(super) fn port(kind: &ElementKind, pin: Option<&str>, incoming: bool) -> Port {
    let Some(pin) = pin else { return Port::Power };
    let flows = match (kind, &*pin.to_ascii_uppercase()) {
        (_, "EN" | "ENO") => true,
        (ElementKind::Timer(_), "IN") => incoming,
        (ElementKind::Counter(counter), "CD") => incoming && counter.kind == CounterKind::Down,
        (ElementKind::Counter(_), "CU") => incoming,
        (ElementKind::OneShot(_), _) => true,
        (ElementKind::Gate(_), _) => !incoming,
        _ => false,
    };
    if flows {
        Port::Power
    } else {
        Port::Pin(pin.into())
    }
}

/// The words beside a symbol, and where to complain about them.
struct Beside<'d> {
    place: Span,
    symbol: &'d Symbol,
    drawing: &'d mut Drawing,
    diagnostics: &'d mut Vec<Diagnostic>,
}

impl Beside<'_> {
    fn word(&mut self, row: Option<usize>, columns: std::ops::Range<usize>) -> Option<Operand> {
        let (text, span) = self.drawing.take_word(row?, columns)?;
        Some(Operand::new(text, span))
    }

    /// The name above, or a made-up one.
    fn above(&mut self) -> Operand {
        let row = match &self.symbol.kind {
            SymbolKind::Box(found) => found.rows.start.checked_sub(1),
            _ => self.symbol.row.checked_sub(1),
        };
        self.word(row, self.symbol.columns.clone())
            .unwrap_or_else(|| self.nameless("write the variable above it"))
    }

    fn below(&mut self) -> Operand {
        self.word(Some(self.symbol.row + 1), self.symbol.columns.clone())
            .unwrap_or_else(|| self.nameless("write the value to compare with below it"))
    }

    fn nameless(&mut self, help: &str) -> Operand {
        let name: Name = format!(
            "unnamed_{}_{}",
            self.symbol.row + 1,
            self.symbol.columns.start + 1
        )
        .into();
        self.diagnostics.push(
            Diagnostic::new(
                codes::NAMELESS,
                self.place,
                format!("the element has no variable; it is called `{name}`"),
            )
            .help(help),
        );
        Operand::new(name, self.place)
    }

    fn opaque(&mut self, name: &str, pins: Vec<Pin>, shapes_power: bool) -> ElementKind {
        let meaning = if shapes_power {
            "what power it passes on is unknown"
        } else {
            "what it does is unknown"
        };
        self.diagnostics.push(
            Diagnostic::new(
                codes::UNKNOWN_BOX,
                self.place,
                format!("`{name}` is not known; {meaning}"),
            )
            .help("it is kept as it stands, and conditions name it"),
        );
        ElementKind::Block(Block {
            name: name.into(),
            instance: None,
            pins,
            familiarity: Familiarity::Unknown,
            shapes_power,
        })
    }
}

fn contact(sign: &str, words: &mut Beside<'_>) -> ElementKind {
    let kind = match sign {
        "" => ContactKind::Open,
        "/" => ContactKind::Closed,
        "P" | "p" => ContactKind::Rising,
        "N" | "n" => ContactKind::Falling,
        _ => {
            let Some(relation) = relation(sign) else {
                let pins = vec![pin(None, PinDirection::Input, words.above())];
                return words.opaque(&format!("[{sign}]"), pins, true);
            };
            return ElementKind::Comparison(Comparison {
                left: words.above(),
                relation,
                right: words.below(),
            });
        }
    };
    ElementKind::Contact(Contact {
        operand: words.above(),
        kind,
    })
}

fn relation(sign: &str) -> Option<Relation> {
    Some(match sign {
        "=" | "==" => Relation::Equal,
        "<>" | "!=" => Relation::NotEqual,
        "<" => Relation::Less,
        "<=" => Relation::LessOrEqual,
        ">" => Relation::Greater,
        ">=" => Relation::GreaterOrEqual,
        _ => return None,
    })
}

fn coil(sign: &str, words: &mut Beside<'_>) -> ElementKind {
    let kind = match sign {
        "" => CoilKind::Plain,
        "/" => CoilKind::Negated,
        "S" | "s" | "L" => CoilKind::Set,
        "R" | "r" | "U" => CoilKind::Reset,
        "P" | "p" => CoilKind::Rising,
        "N" | "n" => CoilKind::Falling,
        _ => {
            let pins = vec![pin(None, PinDirection::Output, words.above())];
            return words.opaque(&format!("({sign})"), pins, false);
        }
    };
    ElementKind::Coil(Coil {
        operand: words.above(),
        kind,
    })
}

fn jump(label: &str, mut words: Beside<'_>) -> ElementKind {
    let operand = if label.is_empty() {
        words.nameless("write the label behind `>>`")
    } else {
        let end = words.place.end as usize;
        Operand::new(label, Span::new(end - label.len(), end))
    };
    ElementKind::Jump(operand)
}

fn boxed(found: &DrawnBox, words: &mut Beside<'_>) -> ElementKind {
    let pins = box_pins(found, words);
    match &*found.name.to_ascii_uppercase() {
        "TON" => timer(TimerKind::OnDelay, found, &pins, words),
        "TOF" => timer(TimerKind::OffDelay, found, &pins, words),
        "TP" => timer(TimerKind::Pulse, found, &pins, words),
        "RTO" | "TONR" => timer(TimerKind::Retentive, found, &pins, words),
        "CTU" => counter(CounterKind::Up, found, &pins, words),
        "CTD" => counter(CounterKind::Down, found, &pins, words),
        "CTUD" => counter(CounterKind::UpDown, found, &pins, words),
        "R_TRIG" => one_shot(Edge::Rising, &pins, words),
        "F_TRIG" => one_shot(Edge::Falling, &pins, words),
        "AND" | "&" if pins.is_empty() => ElementKind::Gate(Gate::And),
        "OR" | ">=1" if pins.is_empty() => ElementKind::Gate(Gate::Or),
        "XOR" | "=1" if pins.is_empty() => ElementKind::Gate(Gate::Xor),
        _ => {
            let row = found.rows.start.checked_sub(1);
            let instance = words.word(row, found.columns.clone());
            let mut kind = words.opaque(&found.name, pins, false);
            if let ElementKind::Block(block) = &mut kind {
                block.instance = instance;
            }
            kind
        }
    }
}

fn pin(name: Option<&str>, direction: PinDirection, operand: Operand) -> Pin {
    Pin {
        name: name.map(Into::into),
        direction,
        operand: Some(operand),
    }
}

/// The words written at the walls of a box.
fn box_pins(found: &DrawnBox, words: &mut Beside<'_>) -> Vec<Pin> {
    let mut pins = Vec::new();
    for (row, name) in &found.left {
        let Some(column) = found.columns.start.checked_sub(1) else {
            continue;
        };
        let operand = words.word(Some(*row), column..column + 1);
        pins.extend(operand.map(|operand| pin(Some(name), PinDirection::Input, operand)));
    }
    for (row, name) in &found.right {
        let column = found.columns.end;
        let operand = words.word(Some(*row), column..column + 1);
        pins.extend(operand.map(|operand| pin(Some(name), PinDirection::Output, operand)));
    }
    pins
}

fn timer(kind: TimerKind, found: &DrawnBox, pins: &[Pin], words: &mut Beside<'_>) -> ElementKind {
    let instance = words.above();
    let preset = preset(pins, &["PT", "PRE"], words);
    let preset_ms = preset
        .as_ref()
        .and_then(|preset| duration(&preset.name))
        .and_then(|preset| u64::try_from(preset).ok());
    ElementKind::Timer(Timer {
        kind,
        output: output(&instance, found),
        preset_ms,
        preset_from: preset.filter(|_| preset_ms.is_none()),
        instance,
    })
}

fn counter(
    kind: CounterKind,
    found: &DrawnBox,
    pins: &[Pin],
    words: &mut Beside<'_>,
) -> ElementKind {
    let instance = words.above();
    let named = preset(pins, &["PV", "PRE"], words);
    let preset = named.as_ref().and_then(|preset| preset.name.parse().ok());
    ElementKind::Counter(Counter {
        kind,
        output: output(&instance, found),
        preset,
        preset_from: named.filter(|_| preset.is_none()),
        instance,
    })
}

/// `T1.Q`, by the name of the first output pin.
fn output(instance: &Operand, found: &DrawnBox) -> Name {
    let pin = found.right.first().map_or("Q", |(_, name)| name);
    format!("{}.{pin}", instance.name).into()
}

/// The preset among the words at a box. The others have no place in the model
/// and are reported.
fn preset(pins: &[Pin], names: &[&str], words: &mut Beside<'_>) -> Option<Operand> {
    let mut preset = None;
    for pin in pins {
        let (Some(name), Some(operand)) = (&pin.name, &pin.operand) else {
            continue;
        };
        if names.contains(&&*name.to_ascii_uppercase()) {
            preset = Some(operand.clone());
            continue;
        }
        let message = format!("`{}` at pin `{name}` is not read", operand.name);
        let place = operand.within.while_building();
        words.diagnostics.push(
            Diagnostic::new(codes::LADDER_SYNTAX, place, message)
                .help("give times as `500ms` or `T#5s`; read other outputs by name, `T1.ET`"),
        );
    }
    preset
}

fn one_shot(edge: Edge, pins: &[Pin], words: &mut Beside<'_>) -> ElementKind {
    preset(pins, &[], words);
    ElementKind::OneShot(OneShot {
        edge,
        memory: Some(words.above()),
    })
}
