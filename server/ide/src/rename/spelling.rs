//! What names a format can spell.

use ::ladder::Format;
use logic::notation::is_literal;

use super::Refusal;

/// Refuses a name that cannot be written in a format.
pub(super) fn check(format: Format, name: &str) -> Result<(), Refusal> {
    let refuse = |why: &str| Err(Refusal(format!("`{name}` cannot be a name: {why}")));
    if name.trim().is_empty() {
        return Err(Refusal("a name holds at least one character".to_owned()));
    }
    if name.trim() != name || name.contains(['"', '\r', '\n']) {
        return refuse("names hold no quotes or line ends, and no blanks around them");
    }
    if name.starts_with('%') {
        return refuse("what begins with `%` is an address");
    }
    if is_literal(name) {
        return refuse("it reads as a number or a time");
    }
    match format {
        Format::Ladder => Ok(()),
        Format::Ascii => Err(Refusal(
            "in a drawn ladder a name holds its columns; write the ladder in rung notation first"
                .to_owned(),
        )),
        _ if !is_identifier(name) => refuse(
            "in this format names are letters, digits and single underscores, and begin with no digit",
        ),
        Format::L5x | Format::L5k | Format::NeutralText if name.len() > LONGEST_TAG => {
            refuse("tags have no more than 40 characters")
        }
        _ if WORDS.iter().any(|word| word.eq_ignore_ascii_case(name)) => {
            refuse("it is a word of the language")
        }
        _ => Ok(()),
    }
}

/// Characters of the longest tag of a Logix controller.
const LONGEST_TAG: usize = 40;

/// An identifier of IEC 61131-3 (6.1.2), which the names of Logix tags are too.
fn is_identifier(name: &str) -> bool {
    let begins = name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_');
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
    begins && name.chars().all(is_part) && !name.contains("__") && !name.ends_with('_')
}

/// Words of expressions, statements and types (IEC 61131-3, 6.1.3). Words that
/// mean something at the beginning of a declaration only are left out: programs
/// have variables called `step` or `action`.
const WORDS: [&str; 39] = [
    "AND", "ARRAY", "BOOL", "BYTE", "CASE", "CONSTANT", "DINT", "DO", "DWORD", "ELSE", "ELSIF",
    "EXIT", "FALSE", "FOR", "FUNCTION", "IF", "INT", "LREAL", "MOD", "NOT", "OF", "OR", "PROGRAM",
    "REAL", "REPEAT", "RETURN", "SINT", "STRING", "STRUCT", "THEN", "TIME", "TRUE", "TYPE", "UINT",
    "UNTIL", "VAR", "WHILE", "WORD", "XOR",
];
