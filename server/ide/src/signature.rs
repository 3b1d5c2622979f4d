//! What the operands of a box are, while they are typed.

use ::ladder::{Format, instruction};
use logic::notation::{Token, TokenKind};

use crate::Ladder;
use crate::completion::{BOXES, open_call};
use crate::statement::{boundary, code, in_ladder};

/// A box whose operands are being typed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Signature {
    /// The box with its operands: `TON(timer, 5s)`.
    pub label: String,
    /// The bytes of each operand in the label.
    pub operands: Vec<std::ops::Range<usize>>,
    /// Which of them is being typed.
    pub active: usize,
    /// What the box does.
    pub summary: String,
}

/// The box between whose parentheses the byte `offset` of a ladder text stands.
pub fn signature(ladder: &Ladder, offset: usize) -> Option<Signature> {
    let text = &*ladder.text;
    let offset = boundary(text, offset);
    match ladder.program().format {
        Format::NeutralText => {
            let (mnemonic, active) = open_call(text.get(..offset)?)?;
            let it = instruction(mnemonic)?;
            Some(described(it.mnemonic, &it.operands, it.summary, active))
        }
        Format::Ladder | Format::Unknown => {
            let statement = in_ladder(text, offset);
            let before = code(text, statement.start..offset.max(statement.start));
            let (name, active) = open_box(text, &before)?;
            let known = |(it, ..): &&(&str, &[&str], &str)| it.eq_ignore_ascii_case(name);
            let (name, operands, summary) = BOXES.iter().find(known)?;
            Some(described(name, operands, (*summary).to_owned(), active))
        }
        _ => None,
    }
}

/// The innermost name before an open parenthesis, and the commas behind it.
fn open_box<'t>(text: &'t str, before: &[Token]) -> Option<(&'t str, usize)> {
    let (mut depth, mut commas) = (0_usize, 0);
    for (at, token) in before.iter().enumerate().rev() {
        match token.kind {
            TokenKind::Close => depth += 1,
            TokenKind::Open if depth > 0 => depth -= 1,
            TokenKind::Open => {
                let name = before[..at].last()?;
                return (name.kind == TokenKind::Name).then(|| (name.text(text), commas));
            }
            TokenKind::Comma if depth == 0 => commas += 1,
            _ => {}
        }
    }
    None
}

fn described(name: &str, operands: &[&str], summary: String, active: usize) -> Signature {
    let mut label = format!("{name}(");
    let mut ranges = Vec::new();
    for operand in operands {
        if !ranges.is_empty() {
            label += ", ";
        }
        ranges.push(label.len()..label.len() + operand.len());
        label += operand;
    }
    label.push(')');
    Signature {
        label,
        operands: ranges,
        active,
        summary,
    }
}

#[cfg(test)]
mod tests {
    use logic::Budget;

    use super::*;

    /// The box at `$0`, the operand that is typed in brackets.
    #[track_caller]
    fn check(text: &str, expected: Option<&str>) {
        let offset = text.find("$0").expect("a cursor");
        let ladder = Ladder::read(text.replace("$0", "").into(), &Budget::default());
        let found = signature(&ladder, offset).map(|it| {
            let mut label = it.label;
            if let Some(range) = it.operands.get(it.active) {
                label.insert(range.end, ']');
                label.insert(range.start, '[');
            }
            label
        });
        assert_eq!(found.as_deref(), expected);
    }

    #[test]
    fn boxes_of_rung_notation_have_operands() {
        check("rung: a -> TON($0", Some("TON([timer], 5s)"));
        check("rung: a -> v, ton(t1, $05s)", Some("TON(timer, [5s])"));
        check("rung: a * ($0b) -> c", None);
        check("rung: a -> MCR()$0", None);
        check("rung: a -> Unknown($0)", None);
    }

    #[test]
    fn instructions_of_neutral_text_have_operands() {
        check("XIC($0a)OTE(b);", Some("XIC([Data Bit])"));
        check("XIC(a)MOV(x[1,2],$0y);", Some("MOV(Source, [Dest])"));
        check("XIC(a)[XIC(b),$0XIC(c)]OTE(b);", None);
    }
}
