//! What people are told of an instruction: its operands by the names of the
//! editor, and in a line what it does.

use crate::{CoilKind, ContactKind, CounterKind, Edge, TimerKind};

use super::catalogue::{self, Meaning, Power};

/// An instruction of neutral text, as people are told of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Instruction {
    /// Its mnemonic in capital letters: `TON`.
    pub mnemonic: &'static str,
    /// The names of its operands, in their order.
    pub operands: Vec<&'static str>,
    /// What it does, in a line.
    pub summary: String,
}

/// All instructions that are known, in alphabetical order.
pub fn instructions() -> impl Iterator<Item = Instruction> {
    catalogue::all().map(|(mnemonic, meaning)| Instruction {
        mnemonic,
        operands: operands(meaning),
        summary: summary(meaning),
    })
}

/// The instruction that `mnemonic` names, in either case.
pub fn instruction(mnemonic: &str) -> Option<Instruction> {
    instructions().find(|it| it.mnemonic.eq_ignore_ascii_case(mnemonic))
}

fn operands(meaning: Meaning) -> Vec<&'static str> {
    let names: &[&str] = match meaning {
        Meaning::Contact(_) | Meaning::Coil(_) => &["Data Bit"],
        Meaning::Compare(_) => &["Source A", "Source B"],
        Meaning::Limit => &["Low Limit", "Test", "High Limit"],
        Meaning::CompareExpression => &["Expression"],
        Meaning::OneShot => &["Storage Bit"],
        Meaning::EdgeOutput(_) => &["Storage Bit", "Output Bit"],
        Meaning::Timer(_) => &["Timer", "Preset", "Accum"],
        Meaning::Counter(_) => &["Counter", "Preset", "Accum"],
        Meaning::Reset => &["Structure"],
        Meaning::Move | Meaning::Unary(_) => &["Source", "Dest"],
        Meaning::Clear => &["Dest"],
        Meaning::Binary(_) => &["Source A", "Source B", "Dest"],
        Meaning::Compute => &["Dest", "Expression"],
        Meaning::Call => &["Routine Name", "Number Of Inputs"],
        Meaning::Loop => &[
            "Routine Name",
            "Index",
            "Initial Value",
            "Terminal Value",
            "Step Size",
        ],
        Meaning::Jump | Meaning::Label => &["Label Name"],
        Meaning::Return | Meaning::Zone | Meaning::Open => &[],
        Meaning::Box(slots, _) => return slots.iter().map(|slot| slot.name).collect(),
    };
    names.to_vec()
}

fn summary(meaning: Meaning) -> String {
    let summary = match meaning {
        Meaning::Contact(kind) => match kind {
            ContactKind::Open => "passes power while the bit is on",
            ContactKind::Closed => "passes power while the bit is off",
            ContactKind::Rising => "passes power in the scan in which the bit rises",
            ContactKind::Falling => "passes power in the scan in which the bit falls",
        },
        Meaning::Coil(kind) => match kind {
            CoilKind::Plain => "writes the power to the bit",
            CoilKind::Negated => "writes the complement of the power to the bit",
            CoilKind::Set => "writes 1 to the bit while powered, else nothing",
            CoilKind::Reset => "writes 0 to the bit while powered, else nothing",
            CoilKind::Rising => "writes 1 in the scan in which power rises, else 0",
            CoilKind::Falling => "writes 1 in the scan in which power falls, else 0",
        },
        Meaning::Compare(relation) => {
            return format!("passes power while Source A {} Source B", relation.sign());
        }
        Meaning::Limit => "passes power while the test lies between the limits",
        Meaning::CompareExpression => "passes power while the expression holds",
        Meaning::OneShot => "passes power in the scan in which it rises",
        Meaning::EdgeOutput(Edge::Rising) => "writes 1 in the scan in which power rises, else 0",
        Meaning::EdgeOutput(Edge::Falling) => "writes 1 in the scan in which power falls, else 0",
        Meaning::Timer(kind) => match kind {
            TimerKind::OnDelay => "on-delay timer: DN is on once power has lasted for the preset",
            TimerKind::OffDelay => "off-delay timer: DN stays on for the preset after power",
            TimerKind::Pulse => "pulse timer: a rise of power starts the output for the preset",
            TimerKind::Retentive => "retentive timer: adds up the time under power until reset",
        },
        Meaning::Counter(kind) => match kind {
            CounterKind::Up => "counts rises of power upwards",
            CounterKind::Down => "counts rises of power downwards",
            CounterKind::UpDown => "counts upwards and downwards",
            CounterKind::Circular => "counts rises of power round and round",
        },
        Meaning::Reset => "resets a timer, a counter or a control structure",
        Meaning::Move => "copies the source to the destination",
        Meaning::Clear => "writes 0",
        Meaning::Binary(operator) => return format!("writes Source A {operator} Source B"),
        Meaning::Unary("-") => "writes the negative of the source",
        Meaning::Unary(function) => return format!("writes {function} of the source"),
        Meaning::Compute => "writes the value of the expression",
        Meaning::Call => "calls a routine; inputs and what it returns follow",
        Meaning::Loop => "calls a routine again and again while the index runs",
        Meaning::Return => "leaves the routine",
        Meaning::Jump => "goes on at the label",
        Meaning::Label => "where jumps arrive",
        Meaning::Zone => "begins or ends a zone under master control",
        Meaning::Open => "never passes power",
        Meaning::Box(_, Power::Passes) => "works on its operands and passes power on",
        Meaning::Box(_, Power::Shapes) => "works on its operands and decides whether power passes",
    };
    summary.to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(mnemonic: &str, expected: &str) {
        let it = instruction(mnemonic).expect("a known instruction");
        let operands = it.operands.join(", ");
        assert_eq!(
            format!("{}({operands}): {}", it.mnemonic, it.summary),
            expected
        );
    }

    #[test]
    fn an_instruction_is_told_with_its_operands() {
        check("xic", "XIC(Data Bit): passes power while the bit is on");
        check(
            "GEQ",
            "GEQ(Source A, Source B): passes power while Source A >= Source B",
        );
        check(
            "TON",
            "TON(Timer, Preset, Accum): on-delay timer: DN is on once power has lasted for the preset",
        );
        check(
            "COP",
            "COP(Source, Dest, Length): works on its operands and passes power on",
        );
        assert_eq!(instruction("Analog_Input"), None);
    }
}
