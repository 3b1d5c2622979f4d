//! From one instruction of a rung to the elements that it is in the model.
//!
//! Most become one element. `LIM` with constant limits becomes two comparisons,
//! `OSR` a one-shot with a coil on a leg of its own, `JSR` with return
//! parameters a call and the writes that it does.

use std::ops::Range;

use logic::{Name, Relation};
use petgraph::graph::NodeIndex;
use source::{Diagnostic, codes};

use super::boxes::pin;
use super::catalogue::{self, Meaning, Power, Slot, SlotKind};
use super::names::lower;
use super::neutral::Instruction;
use super::operand;
use super::rung::Drawing;
use crate::{
    Assignment, Block, Call, Coil, CoilKind, Comparison, Contact, Counter, CounterKind, Edge,
    ElementKind, Familiarity, OneShot, Operand, PinDirection, Timer, TimerKind, Value,
};

type Sources = Vec<NodeIndex>;

impl Drawing<'_, '_, '_> {
    /// Adds an instruction in series after `sources`; the answer is where power
    /// comes from after it.
    pub(super) fn instruction(&mut self, it: &Instruction, sources: Sources) -> Sources {
        let mnemonic = self.text(&it.mnemonic);
        let surroundings = self.surroundings;
        if let Some(definition) = surroundings.definitions.get(&*lower(mnemonic)) {
            let block = self.defined_block(it, mnemonic.into(), definition);
            return self.add(sources, block, it.place.clone());
        }
        let Some(meaning) = catalogue::meaning(mnemonic) else {
            let block = self.unknown_block(it, mnemonic);
            return self.add(sources, block, it.place.clone());
        };
        let kind = match meaning {
            Meaning::Contact(kind) => ElementKind::Contact(Contact {
                operand: self.operand(it, 0),
                kind,
            }),
            Meaning::Coil(kind) => ElementKind::Coil(Coil {
                operand: self.operand(it, 0),
                kind,
            }),
            Meaning::Compare(relation) => ElementKind::Comparison(Comparison {
                left: self.operand(it, 0),
                relation,
                right: self.operand(it, 1),
            }),
            Meaning::CompareExpression => self.compare_expression(it, mnemonic),
            Meaning::OneShot => ElementKind::OneShot(OneShot {
                edge: Edge::Rising,
                memory: Some(self.operand(it, 0)),
            }),
            Meaning::Timer(kind) => self.timer(it, kind),
            Meaning::Counter(kind) => self.counter(it, kind),
            Meaning::Reset => ElementKind::ResetBox(self.operand(it, 0)),
            Meaning::Move
            | Meaning::Clear
            | Meaning::Binary(_)
            | Meaning::Unary(_)
            | Meaning::Compute => self.assignment(it, meaning, mnemonic),
            Meaning::Jump => ElementKind::Jump(self.word(it, 0)),
            Meaning::Label => ElementKind::Label(self.word(it, 0)),
            Meaning::Zone => ElementKind::Zone,
            Meaning::Open => ElementKind::Open,
            Meaning::Box(slots, power) => self.known_block(it, mnemonic, slots, power),
            Meaning::Limit => return self.limit(it, mnemonic, sources),
            Meaning::EdgeOutput(edge) => return self.edge_output(it, edge, sources),
            Meaning::Call => return self.call(it, mnemonic, sources),
            Meaning::Loop => return self.repeated_call(it, mnemonic, sources),
            Meaning::Return => return self.leave(it, mnemonic, sources),
        };
        self.add(sources, kind, it.place.clone())
    }

    /// An operand that is a word, not a variable: a label or a routine.
    fn word(&mut self, it: &Instruction, place: usize) -> Operand {
        match it.operands.get(place).filter(|range| !range.is_empty()) {
            Some(range) => {
                let span = self.place.text.span(range.clone());
                Operand::new(self.text(range), span)
            }
            None => self.operand(it, place),
        }
    }

    fn timer(&mut self, it: &Instruction, kind: TimerKind) -> ElementKind {
        let instance = self.operand(it, 0);
        ElementKind::Timer(Timer {
            kind,
            output: self.done_bit(it, &instance),
            preset_ms: self.preset(it).and_then(|ms| u64::try_from(ms).ok()),
            preset_from: None,
            instance,
        })
    }

    fn counter(&mut self, it: &Instruction, kind: CounterKind) -> ElementKind {
        let instance = self.operand(it, 0);
        ElementKind::Counter(Counter {
            kind,
            output: self.done_bit(it, &instance),
            preset: self.preset(it),
            preset_from: None,
            instance,
        })
    }

    /// The name of `T.DN`, the same that a contact on it gets.
    fn done_bit(&mut self, it: &Instruction, instance: &Operand) -> Name {
        let written = it.operands.first().map(|range| self.text(range));
        match written.filter(|text| operand::path(text).is_some()) {
            Some(text) => {
                let done = format!("{text}.DN");
                let place = instance.within.while_building();
                self.names.canonical(self.place.scope, &done, place)
            }
            None => format!("{}.DN", instance.name).into(),
        }
    }

    /// The preset: written in the instruction, else in the tag's data, unless
    /// some rung writes it.
    fn preset(&mut self, it: &Instruction) -> Option<i64> {
        let written = it.operands.get(1).map(|range| self.text(range));
        if let Some(value) = written.and_then(operand::integer) {
            return Some(value);
        }
        let instance = self.text(it.operands.first()?);
        let (scope, tag, path) = self.names.place_of(self.place.scope, instance)?;
        let preset = (scope, tag.clone(), format!("{path}.pre"));
        if self.surroundings.written_presets.contains(&preset) {
            return None;
        }
        let presets = self.surroundings.presets.get(&(scope, tag))?;
        presets.get(&path).copied()
    }

    /// `LIM(low,test,high)`. Limits in order mean between them, limits the other
    /// way round mean outside, both included.
    fn limit(&mut self, it: &Instruction, mnemonic: &str, sources: Sources) -> Sources {
        let limits = [0, 2].map(|place| {
            let range = it.operands.get(place)?;
            operand::integer(self.text(range))
        });
        let [Some(low), Some(high)] = limits else {
            let slots = &[input("Low Limit"), input("Test"), input("High Limit")];
            let block = self.known_block(it, mnemonic, slots, Power::Shapes);
            return self.add(sources, block, it.place.clone());
        };
        let test = self.operand(it, 1);
        let above = ElementKind::Comparison(Comparison {
            left: test.clone(),
            relation: Relation::GreaterOrEqual,
            right: self.operand(it, 0),
        });
        let below = ElementKind::Comparison(Comparison {
            left: test,
            relation: Relation::LessOrEqual,
            right: self.operand(it, 2),
        });
        if low <= high {
            let after_low = self.add(sources, above, it.place.clone());
            return self.add(after_low, below, it.place.clone());
        }
        let mut ends = self.add(sources.clone(), above, it.place.clone());
        ends.extend(self.add(sources, below, it.place.clone()));
        ends
    }

    /// `OSR(storage,output)` and `OSF`: outputs that pass power on unchanged.
    fn edge_output(&mut self, it: &Instruction, edge: Edge, sources: Sources) -> Sources {
        let memory = Some(self.operand(it, 0));
        let shot = ElementKind::OneShot(OneShot { edge, memory });
        let coil = ElementKind::Coil(Coil {
            operand: self.operand(it, 1),
            kind: CoilKind::Plain,
        });
        let after_shot = self.add(sources.clone(), shot, it.place.clone());
        self.add(after_shot, coil, it.place.clone());
        sources
    }

    /// `JSR(routine,n,n inputs,returns)`.
    fn call(&mut self, it: &Instruction, mnemonic: &str, sources: Sources) -> Sources {
        let routine = self.routine(it);
        let inputs = it
            .operands
            .get(1)
            .and_then(|range| operand::integer(self.text(range)))
            .and_then(|count| usize::try_from(count).ok())
            .unwrap_or(0);
        let after_inputs = it.operands.len().min(inputs.saturating_add(2));
        let arguments = self.operands_at(it.operands.get(2..after_inputs));
        let returns = self.operands_at(it.operands.get(after_inputs..));
        let call = ElementKind::Call(Call { routine, arguments });
        let mut sources = self.add(sources, call, it.place.clone());
        let text: Name = self.text(&it.place).into();
        for target in returns {
            let write = ElementKind::Assign(Assignment {
                target,
                value: Value::Term {
                    text: text.clone(),
                    reads: Vec::new(),
                },
                mnemonic: mnemonic.into(),
            });
            sources = self.add(sources, write, it.place.clone());
        }
        sources
    }

    /// `FOR(routine,index,from,to,step)`.
    fn repeated_call(&mut self, it: &Instruction, mnemonic: &str, sources: Sources) -> Sources {
        let slots = &[
            Slot {
                name: "Routine Name",
                kind: SlotKind::Word,
            },
            Slot {
                name: "Index",
                kind: SlotKind::Value(PinDirection::Output),
            },
            input("Initial Value"),
            input("Terminal Value"),
            input("Step Size"),
        ];
        let block = self.known_block(it, mnemonic, slots, Power::Passes);
        let sources = self.add(sources, block, it.place.clone());
        let call = ElementKind::Call(Call {
            routine: self.routine(it),
            arguments: Vec::new(),
        });
        self.add(sources, call, it.place.clone())
    }

    /// The routine that a call names; one that the file lacks is reported.
    fn routine(&mut self, it: &Instruction) -> Operand {
        let mut routine = self.word(it, 0);
        match self.place.routines.get(&lower(&routine.name)) {
            Some(&name) => routine.name = name.into(),
            None => {
                let message = format!("the routine `{}` is not in the file", routine.name);
                let place = routine.within.while_building();
                self.diagnostics.push(
                    Diagnostic::new(codes::MISSING_ROUTINE, place, message)
                        .help("export the whole program; what the routine writes is unknown"),
                );
            }
        }
        routine
    }

    /// `RET(values)` and `TND()`. Both leave the routine that they stand in: the
    /// reference says so of `TND` too, which ends a program's scan only where it
    /// stands in a main routine.
    fn leave(&mut self, it: &Instruction, mnemonic: &str, sources: Sources) -> Sources {
        let mut sources = sources;
        if !it.operands.is_empty() {
            let pins = self
                .operands_at(it.operands.get(..))
                .into_iter()
                .map(|operand| pin(None, PinDirection::Input, Some(operand)))
                .collect();
            let values = ElementKind::Block(Block {
                name: mnemonic.into(),
                instance: None,
                pins,
                familiarity: Familiarity::Known,
                shapes_power: false,
            });
            sources = self.add(sources, values, it.place.clone());
        }
        let leave = ElementKind::Return { program: false };
        self.add(sources, leave, it.place.clone())
    }

    /// The operands at `ranges`, those left out that are empty.
    pub(super) fn operands_at(&mut self, ranges: Option<&[Range<usize>]>) -> Vec<Operand> {
        let ranges = ranges.unwrap_or_default();
        ranges
            .iter()
            .filter_map(|range| self.operand_at(range.clone()))
            .collect()
    }
}

fn input(name: &'static str) -> Slot {
    Slot {
        name,
        kind: SlotKind::Value(PinDirection::Input),
    }
}
