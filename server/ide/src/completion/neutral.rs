//! What can be typed in neutral text: mnemonics, and tags between parentheses.

use ::ladder::instructions;
use source::Span;

use super::variables::{Wanted, variables};
use super::{Completions, call};
use crate::Ladder;

pub(super) fn complete(ladder: &Ladder, offset: usize) -> Option<Completions> {
    let text = &*ladder.text;
    let span = word(text, offset);
    let before = text.get(..span.range().start)?;
    let items = match open_call(before) {
        Some(_) => variables(ladder, Wanted::Read, span, str::to_owned),
        None => instructions()
            .map(|it| match it.operands.is_empty() {
                true => call(it.mnemonic, &[], &it.summary).insert(format!("{}()", it.mnemonic)),
                false => call(it.mnemonic, &it.operands, &it.summary),
            })
            .collect(),
    };
    Some(Completions { span, items })
}

/// The word around a place.
fn word(text: &str, offset: usize) -> Span {
    let is_part = |c: &char| c.is_alphanumeric() || matches!(c, '_' | '.' | ':');
    let (before, after) = text.split_at_checked(offset).unwrap_or((text, ""));
    let length = |c: char| c.len_utf8();
    let back: usize = before.chars().rev().take_while(is_part).map(length).sum();
    let on: usize = after.chars().take_while(is_part).map(length).sum();
    Span::new(before.len() - back, before.len() + on)
}

/// The instruction between whose parentheses `before` ends, and the number of
/// commas since: the place of its mnemonic.
pub(crate) fn open_call(before: &str) -> Option<(&str, usize)> {
    let (mut depth, mut commas) = (0_usize, 0);
    for (at, c) in before.char_indices().rev() {
        match c {
            ';' => return None,
            ')' | ']' => depth += 1,
            '(' if depth == 0 => {
                let is_part = |c: char| c.is_alphanumeric() || c == '_';
                let head = &before[..at];
                let start = head.trim_end_matches(is_part).len();
                // A parenthesis inside an operand: the instruction is further out.
                if start == at {
                    commas = 0;
                    continue;
                }
                return Some((&head[start..], commas));
            }
            // A leg or an index that is open.
            '[' if depth == 0 => {
                let is_index = before[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_');
                if !is_index {
                    return None;
                }
                commas = 0;
            }
            '(' | '[' => depth -= 1,
            ',' if depth == 0 => commas += 1,
            _ => {}
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::open_call;
    use crate::completion::tests::in_ladder;

    #[test]
    fn operands_are_tags() {
        let (found, typed) =
            in_ladder("XIC(start)[XIC(run) ,XIC(b[2])]XIO(st$0)TON(T1,5,0)OTE(run);");
        assert_eq!(typed, "st");
        assert_eq!(found, ["run", "T1", "T1.DN", "start", "b[2]"]);
    }

    #[test]
    fn between_operands_stand_mnemonics() {
        let (found, typed) = in_ladder("XIC(start)OTE(run);\nX$0");
        assert_eq!(typed, "X");
        assert!(found.contains(&"XIC(".to_owned()) && found.contains(&"AFI()".to_owned()));
        let (found, _) = in_ladder("XIC(start)[$0,XIC(run)]OTE(run);");
        assert!(found.contains(&"XIC(".to_owned()));
    }

    #[test]
    fn the_open_instruction_is_found_past_legs_and_indices() {
        assert_eq!(open_call("XIC(a)TON(T1,"), Some(("TON", 1)));
        assert_eq!(open_call("CPT(x,(a - b) * (c"), Some(("CPT", 1)));
        assert_eq!(open_call("MOV(a[i],b["), Some(("MOV", 1)));
        assert_eq!(open_call("XIC(a)[XIC(b),"), None);
        assert_eq!(open_call("XIC(a);"), None);
    }
}
