//! Instructions that stay boxes: known ones with their pins, Add-On Instructions
//! of the file, and those that nobody knows.

use std::ops::Range;

use logic::Name;
use source::{Diagnostic, codes};

use super::catalogue::{Power, Slot, SlotKind};
use super::neutral::Instruction;
use super::operand;
use super::rung::{Definition, Drawing};
use crate::{Block, ElementKind, Familiarity, Operand, Pin, PinDirection};

impl Drawing<'_, '_, '_> {
    pub(super) fn known_block(
        &mut self,
        it: &Instruction,
        mnemonic: &str,
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
            let tokens = self.tokens(range);
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

    pub(super) fn defined_block(
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

    pub(super) fn unknown_block(&mut self, it: &Instruction, mnemonic: &str) -> ElementKind {
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

/// A pin with what stands at it.
pub(super) fn pin(name: Option<Name>, direction: PinDirection, operand: Option<Operand>) -> Pin {
    Pin {
        name,
        direction,
        operand,
    }
}
