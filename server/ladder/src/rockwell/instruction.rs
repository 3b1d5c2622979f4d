//! From one instruction of a rung to the elements that it is in the model.
//!
//! Most become one element. `LIM` with constant limits becomes two comparisons,
//! `OSR` a one-shot with a coil on a leg of its own, `JSR` with return
//! parameters a call and the writes that it does.

use std::ops::Range;

use logic::{Name, Relation};
use petgraph::graph::NodeIndex;
use source::{Diagnostic, codes};

use super::catalogue::{self, Meaning, Power, Slot, SlotKind};
use super::neutral::Instruction;
use super::operand::{self, Token};
use super::rung::{Definition, Drawing};
use crate::{
    Assignment, Block, Call, Coil, CoilKind, Comparison, Contact, Counter, CounterKind, Edge,
    ElementKind, Familiarity, OneShot, Operand, Pin, PinDirection, Timer, TimerKind, Value,
};

type Sources = Vec<NodeIndex>;

impl Drawing<'_, '_, '_> {
    /// Adds an instruction in series after `sources`; the answer is where power
    /// comes from after it.
    pub(super) fn instruction(&mut self, it: &Instruction, sources: Sources) -> Sources {
        let mnemonic = self.text(&it.mnemonic).to_owned();
        let surroundings = self.surroundings;
        if let Some(definition) = surroundings.definitions.get(&mnemonic.to_lowercase()) {
            let block = self.defined_block(it, mnemonic.into(), definition);
            return self.add(&sources, block, it.place.clone());
        }
        let Some(meaning) = catalogue::meaning(&mnemonic) else {
            let block = self.unknown_block(it, mnemonic);
            return self.add(&sources, block, it.place.clone());
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
        self.add(&sources, kind, it.place.clone())
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
            instance,
        })
    }

    fn counter(&mut self, it: &Instruction, kind: CounterKind) -> ElementKind {
        let instance = self.operand(it, 0);
        ElementKind::Counter(Counter {
            kind,
            output: self.done_bit(it, &instance),
            preset: self.preset(it),
            instance,
        })
    }

    /// The name of `T.DN`, the same that a contact on it gets.
    fn done_bit(&mut self, it: &Instruction, instance: &Operand) -> Name {
        let written = it.operands.first().map(|range| self.text(range));
        match written.filter(|text| operand::path(text).is_some()) {
            Some(text) => {
                let done = format!("{text}.DN");
                self.names.canonical(self.place.scope, &done, instance.span)
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
    fn limit(&mut self, it: &Instruction, mnemonic: String, sources: Sources) -> Sources {
        let limits = [0, 2].map(|place| {
            let range = it.operands.get(place)?;
            operand::integer(self.text(range))
        });
        let [Some(low), Some(high)] = limits else {
            let slots = &[input("Low Limit"), input("Test"), input("High Limit")];
            let block = self.known_block(it, mnemonic, slots, Power::Shapes);
            return self.add(&sources, block, it.place.clone());
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
            let after_low = self.add(&sources, above, it.place.clone());
            return self.add(&after_low, below, it.place.clone());
        }
        let mut ends = self.add(&sources, above, it.place.clone());
        ends.extend(self.add(&sources, below, it.place.clone()));
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
        let after_shot = self.add(&sources, shot, it.place.clone());
        self.add(&after_shot, coil, it.place.clone());
        sources
    }

    /// `JSR(routine,n,n inputs,returns)`.
    fn call(&mut self, it: &Instruction, mnemonic: String, sources: Sources) -> Sources {
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
        let mut sources = self.add(&sources, call, it.place.clone());
        let text: Name = self.text(&it.place).into();
        for target in returns {
            let write = ElementKind::Assign(Assignment {
                target,
                value: Value::Term {
                    text: text.clone(),
                    reads: Vec::new(),
                },
                mnemonic: mnemonic.as_str().into(),
            });
            sources = self.add(&sources, write, it.place.clone());
        }
        sources
    }

    /// `FOR(routine,index,from,to,step)`.
    fn repeated_call(&mut self, it: &Instruction, mnemonic: String, sources: Sources) -> Sources {
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
        let sources = self.add(&sources, block, it.place.clone());
        let call = ElementKind::Call(Call {
            routine: self.routine(it),
            arguments: Vec::new(),
        });
        self.add(&sources, call, it.place.clone())
    }

    /// The routine that a call names; one that the file lacks is reported.
    fn routine(&mut self, it: &Instruction) -> Operand {
        let mut routine = self.word(it, 0);
        let known = self.place.routines.iter();
        let found = known
            .clone()
            .find(|known| known.to_lowercase() == routine.name.to_lowercase());
        match found {
            Some(name) => routine.name = name.as_str().into(),
            None => {
                let message = format!("the routine `{}` is not in the file", routine.name);
                self.diagnostics.push(
                    Diagnostic::new(codes::MISSING_ROUTINE, routine.span, message)
                        .help("export the whole program; what the routine writes is unknown"),
                );
            }
        }
        routine
    }

    /// `RET(values)` and `TND()`. Both leave the routine that they stand in: the
    /// reference says so of `TND` too, which ends a program's scan only where it
    /// stands in a main routine.
    fn leave(&mut self, it: &Instruction, mnemonic: String, sources: Sources) -> Sources {
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
            sources = self.add(&sources, values, it.place.clone());
        }
        let leave = ElementKind::Return { program: false };
        self.add(&sources, leave, it.place.clone())
    }

    fn operands_at(&mut self, ranges: Option<&[Range<usize>]>) -> Vec<Operand> {
        let ranges = ranges.unwrap_or_default();
        ranges
            .iter()
            .filter_map(|range| self.operand_at(range.clone()))
            .collect()
    }

    /// `CMP(expression)`: a comparison where it compares two plain values, else
    /// a box that decides by what it reads.
    fn compare_expression(&mut self, it: &Instruction, mnemonic: String) -> ElementKind {
        let range = whole(&it.operands, 0);
        let tokens = operand::tokens(self.place.text.text(), range);
        if let Some((left, relation, right)) = self.plain_comparison(&tokens)
            && let (Some(left), Some(right)) = (self.operand_at(left), self.operand_at(right))
        {
            return ElementKind::Comparison(Comparison {
                left,
                relation,
                right,
            });
        }
        let reads = self.tags(&tokens);
        let pins = reads
            .into_iter()
            .map(|operand| pin(None, PinDirection::Input, Some(operand)))
            .collect();
        ElementKind::Block(Block {
            name: mnemonic.into(),
            instance: None,
            pins,
            familiarity: Familiarity::Known,
            shapes_power: true,
        })
    }

    fn plain_comparison(&self, tokens: &[Token]) -> Option<(Range<usize>, Relation, Range<usize>)> {
        let sign_at = tokens
            .iter()
            .position(|token| relation(self.text(&token.place())).is_some())?;
        let (left, rest) = tokens.split_at(sign_at);
        let (sign, right) = rest.split_first()?;
        let relation = relation(self.text(&sign.place()))?;
        Some((self.plain_value(left)?, relation, self.plain_value(right)?))
    }

    /// The place of a tag or constant that is all of `tokens`.
    fn plain_value(&self, tokens: &[Token]) -> Option<Range<usize>> {
        match tokens {
            [Token::Tag(place) | Token::Constant(place)] => Some(place.clone()),
            [Token::Sign(sign), Token::Constant(number)] if self.text(sign) == "-" => {
                Some(sign.start..number.end)
            }
            _ => None,
        }
    }

    /// The tags among the pieces of an expression.
    fn tags(&mut self, tokens: &[Token]) -> Vec<Operand> {
        tokens
            .iter()
            .filter_map(|token| match token {
                Token::Tag(place) => self.operand_at(place.clone()),
                _ => None,
            })
            .collect()
    }

    fn assignment(&mut self, it: &Instruction, meaning: Meaning, mnemonic: String) -> ElementKind {
        let (target, value) = match meaning {
            Meaning::Clear => (self.operand(it, 0), Value::Constant(0)),
            Meaning::Compute => {
                let target = self.operand(it, 0);
                let value = self.computed(whole(&it.operands, 1), &target);
                (target, value)
            }
            Meaning::Binary(sign) => {
                let target = self.operand(it, 2);
                let left = it.operands.first().cloned().unwrap_or_default();
                let right = it.operands.get(1).cloned().unwrap_or_default();
                let value = self.sum_or_term(left, sign, right, &target);
                (target, value)
            }
            Meaning::Unary(function) => {
                let target = self.operand(it, 1);
                let value = self.function(function, it.operands.first().cloned());
                (target, value)
            }
            _ => {
                let target = self.operand(it, 1);
                let value =
                    self.computed(it.operands.first().cloned().unwrap_or_default(), &target);
                (target, value)
            }
        };
        ElementKind::Assign(Assignment {
            target,
            value,
            mnemonic: mnemonic.into(),
        })
    }

    /// The value of the expression at `range`, written to `target`.
    fn computed(&mut self, range: Range<usize>, target: &Operand) -> Value {
        let tokens = operand::tokens(self.place.text.text(), range.clone());
        if let Some(place) = self.plain_value(&tokens) {
            if let Some(number) = operand::integer(self.text(&place)) {
                return Value::Constant(number);
            }
            if let ([Token::Tag(_)], Some(operand)) = (&tokens[..], self.operand_at(place)) {
                return Value::Copy(operand);
            }
        }
        if let [left, Token::Sign(sign), right] = &tokens[..]
            && !matches!(left, Token::Sign(_))
        {
            let sign = self.text(sign).to_owned();
            return self.sum_or_term(left.place(), &sign, right.place(), target);
        }
        self.term(range, &tokens)
    }

    fn sum_or_term(
        &mut self,
        left: Range<usize>,
        sign: &str,
        right: Range<usize>,
        target: &Operand,
    ) -> Value {
        let numbers = [&left, &right].map(|side| operand::integer(self.text(side)));
        let mut is_target = |side: &Range<usize>| {
            self.operand_at(side.clone())
                .is_some_and(|operand| operand.name == target.name)
        };
        match (sign, numbers) {
            ("+", [_, Some(number)]) if is_target(&left) => return Value::Increment(number),
            ("+", [Some(number), _]) if is_target(&right) => return Value::Increment(number),
            ("-", [_, Some(number)]) if is_target(&left) => {
                return Value::Increment(number.saturating_neg());
            }
            _ => {}
        }
        let mut tokens = operand::tokens(self.place.text.text(), left.clone());
        tokens.extend(operand::tokens(self.place.text.text(), right.clone()));
        let [left, right] = [left, right].map(|side| self.expression(&side));
        Value::Term {
            text: format!("{left} {sign} {right}").into(),
            reads: self.tags(&tokens),
        }
    }

    fn function(&mut self, function: &str, argument: Option<Range<usize>>) -> Value {
        let range = argument.unwrap_or_default();
        let tokens = operand::tokens(self.place.text.text(), range.clone());
        Value::Term {
            text: format!("{function}({})", self.expression(&range)).into(),
            reads: self.tags(&tokens),
        }
    }

    fn term(&mut self, range: Range<usize>, tokens: &[Token]) -> Value {
        Value::Term {
            text: self.expression(&range).into(),
            reads: self.tags(tokens),
        }
    }

    fn expression(&mut self, range: &Range<usize>) -> String {
        let place = self.place;
        let text = place.text.text().get(range.clone()).unwrap_or_default();
        let span = place.text.span(range.clone());
        self.names.canonical_expression(place.scope, text, span)
    }

    fn known_block(
        &mut self,
        it: &Instruction,
        mnemonic: String,
        slots: &[Slot],
        power: Power,
    ) -> ElementKind {
        let mut pins = Vec::new();
        let several = self.counts_several(it, slots);
        for (place, range) in it.operands.iter().enumerate() {
            let Some(slot) = slots.get(place) else {
                let operand = self.operand_at(range.clone());
                pins.push(pin(None, PinDirection::InOut, operand));
                continue;
            };
            match slot.kind {
                SlotKind::Value(direction) => {
                    self.value_pins(slot.name, direction, range, &mut pins)
                }
                SlotKind::Length => {
                    self.value_pins(slot.name, PinDirection::Input, range, &mut pins)
                }
                SlotKind::Array(direction) => {
                    self.value_pins(slot.name, direction, range, &mut pins);
                    if several && let Some(whole) = self.whole_array(range) {
                        let name = format!("{}, further elements", slot.name);
                        pins.push(pin(Some(name.into()), direction, Some(whole)));
                    }
                }
                SlotKind::Word => {
                    let name = format!("{}={}", slot.name, self.text(range));
                    pins.push(pin(Some(name.into()), PinDirection::Input, None));
                }
            }
        }
        ElementKind::Block(Block {
            name: mnemonic.into(),
            instance: None,
            pins,
            familiarity: Familiarity::Known,
            shapes_power: power == Power::Shapes,
        })
    }

    /// The pin for a value; an expression gets a further pin for every tag that
    /// it reads.
    fn value_pins(
        &mut self,
        name: &'static str,
        direction: PinDirection,
        range: &Range<usize>,
        pins: &mut Vec<Pin>,
    ) {
        let operand = self.operand_at(range.clone());
        let text = self.text(range);
        let is_expression =
            operand.is_some() && !operand::is_constant(text) && operand::path(text).is_none();
        pins.push(pin(Some(name.into()), direction, operand));
        if is_expression {
            let tokens = operand::tokens(self.place.text.text(), range.clone());
            for tag in self.tags(&tokens) {
                pins.push(pin(Some(name.into()), direction, Some(tag)));
            }
        }
    }

    /// Whether the length operand of a box is other than 1.
    fn counts_several(&self, it: &Instruction, slots: &[Slot]) -> bool {
        let length = slots.iter().position(|slot| slot.kind == SlotKind::Length);
        let Some(range) = length.and_then(|place| it.operands.get(place)) else {
            return false;
        };
        operand::integer(self.text(range)) != Some(1)
    }

    /// The array whose element `range` names.
    fn whole_array(&mut self, range: &Range<usize>) -> Option<Operand> {
        let text = self.text(range);
        let array = text.strip_suffix(']')?.rfind('[')?;
        self.operand_at(range.start..range.start + array)
    }

    fn defined_block(
        &mut self,
        it: &Instruction,
        mnemonic: Name,
        definition: &Definition,
    ) -> ElementKind {
        let instance = self.operand(it, 0);
        let passed = it.operands.iter().skip(1).enumerate();
        let pins = passed
            .map(|(place, range)| {
                let operand = self.operand_at(range.clone());
                match definition.passed.get(place) {
                    Some((name, direction)) => pin(Some(name.as_str().into()), *direction, operand),
                    None => pin(None, PinDirection::InOut, operand),
                }
            })
            .collect();
        ElementKind::Block(Block {
            name: mnemonic,
            instance: Some(instance),
            pins,
            familiarity: Familiarity::Defined,
            shapes_power: definition.shapes_power,
        })
    }

    fn unknown_block(&mut self, it: &Instruction, mnemonic: String) -> ElementKind {
        if self.unknown.insert(mnemonic.to_lowercase()) {
            let message = format!(
                "`{mnemonic}` is no instruction that is known, and the file does not define it"
            );
            let span = self.place.text.span(it.mnemonic.clone());
            self.diagnostics.push(
                Diagnostic::new(codes::UNKNOWN_BOX, span, message)
                    .help("export its Add-On Instruction along; until then its effect is unknown"),
            );
        }
        let pins = self
            .operands_at(it.operands.get(..))
            .into_iter()
            .map(|operand| pin(None, PinDirection::InOut, Some(operand)))
            .collect();
        ElementKind::Block(Block {
            name: mnemonic.into(),
            instance: None,
            pins,
            familiarity: Familiarity::Unknown,
            shapes_power: true,
        })
    }
}

fn input(name: &'static str) -> Slot {
    Slot {
        name,
        kind: SlotKind::Value(PinDirection::Input),
    }
}

fn pin(name: Option<Name>, direction: PinDirection, operand: Option<Operand>) -> Pin {
    Pin {
        name,
        direction,
        operand,
    }
}

/// All operands from `first` on as one place: an expression is the last
/// operand, and commas in it that stand in no parentheses are its own.
fn whole(operands: &[Range<usize>], first: usize) -> Range<usize> {
    match (operands.get(first), operands.last()) {
        (Some(begin), Some(end)) => begin.start..end.end,
        _ => 0..0,
    }
}

fn relation(sign: &str) -> Option<Relation> {
    Some(match sign {
        "=" => Relation::Equal,
        "<>" => Relation::NotEqual,
        "<" => Relation::Less,
        "<=" => Relation::LessOrEqual,
        ">" => Relation::Greater,
        ">=" => Relation::GreaterOrEqual,
        _ => return None,
    })
}
