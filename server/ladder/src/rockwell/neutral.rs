//! The grammar of Rockwell's neutral text: `XIC(a)[XIC(b) ,XIO(c) ]OTE(d);`.
//!
//! ```text
//! statement   = series ";"
//! series      = { instruction | branch }
//! branch      = "[" series { "," series } "]"
//! instruction = MNEMONIC "(" [ operand { "," operand } ] ")"
//! ```
//!
//! Series is juxtaposition, a leg may be empty, and blanks and line ends may
//! stand anywhere between. An operand is any text in which parentheses,
//! brackets and quotes are balanced: `CPT(x,(a - b) * c)` has two.
//!
//! This file knows the shape only, not one mnemonic, and answers with places
//! in the text. It never gives up: what does not fit becomes
//! [`Item::Unreadable`], and the next `;` ends it.

use std::ops::Range;

/// Deepest nesting of branches that is read. Real rungs stay below 10.
const DEEPEST: usize = 64;

/// A rung's text, up to and with its `;`.
#[derive(Debug, Default)]
pub(super) struct Statement {
    /// What stands on the rung, from left to right.
    pub(super) items: Vec<Item>,
    /// The whole of it.
    pub(super) place: Range<usize>,
}

/// A thing on a rung.
#[derive(Debug)]
pub(super) enum Item {
    /// `XIC(a)`.
    Instruction(Instruction),
    /// `[...]`.
    Branch(Branch),
    /// Text that is neither.
    Unreadable(Range<usize>),
}

/// A mnemonic and its operands.
#[derive(Debug)]
pub(super) struct Instruction {
    pub(super) mnemonic: Range<usize>,
    /// Operands without the blanks around them; empty ones are kept.
    pub(super) operands: Vec<Range<usize>>,
    pub(super) place: Range<usize>,
}

/// Legs that are fed the same power.
#[derive(Debug)]
pub(super) struct Branch {
    pub(super) legs: Vec<Vec<Item>>,
}

/// Something that breaks the grammar.
#[derive(Debug)]
pub(super) struct Fault {
    pub(super) place: Range<usize>,
    /// What is wrong, in one sentence.
    pub(super) message: String,
    /// What to do.
    pub(super) help: &'static str,
}

/// The statements of `text`, and what is wrong with them.
pub(super) fn parse(text: &str) -> (Vec<Statement>, Vec<Fault>) {
    let mut statements = Vec::new();
    let mut faults = Vec::new();
    let mut at = 0;
    while let Some(statement) = statement(text, at, &mut faults) {
        at = statement.place.end;
        statements.push(statement);
    }
    (statements, faults)
}

/// The statement that begins at or after byte `from` of `text`, if anything is
/// left there. It ends after its `;`, or with the text.
pub(super) fn statement(text: &str, from: usize, faults: &mut Vec<Fault>) -> Option<Statement> {
    let start = skip_blanks(text, from);
    if start >= text.len() {
        return None;
    }
    let mut parser = Parser {
        text,
        at: start,
        series: Vec::new(),
        open: Vec::new(),
        faults,
        complained: false,
    };
    parser.run();
    let place = start..parser.at;
    Some(Statement {
        items: parser.series,
        place,
    })
}

struct Parser<'t, 'f> {
    text: &'t str,
    at: usize,
    /// The series being read: of the innermost open leg, else of the rung.
    series: Vec<Item>,
    open: Vec<OpenBranch>,
    faults: &'f mut Vec<Fault>,
    /// Whether unreadable text of this statement has been reported; once is
    /// enough to send the reader there.
    complained: bool,
}

struct OpenBranch {
    start: usize,
    legs: Vec<Vec<Item>>,
    /// The series that the branch stands in, up to the branch.
    outside: Vec<Item>,
}

impl Parser<'_, '_> {
    fn run(&mut self) {
        loop {
            self.at = skip_blanks(self.text, self.at);
            let Some(character) = self.peek() else {
                return self.end_without_semicolon();
            };
            match character {
                ';' => {
                    self.close_open_branches();
                    self.at += 1;
                    return;
                }
                '[' if self.open.len() >= DEEPEST => self.skip_branch(),
                '[' => self.open_branch(),
                ',' if !self.open.is_empty() => {
                    self.at += 1;
                    self.end_leg();
                }
                ']' if !self.open.is_empty() => {
                    self.at += 1;
                    self.close_branch();
                }
                c if starts_name(c) => self.instruction(),
                _ => self.unreadable(),
            }
        }
    }

    fn peek(&self) -> Option<char> {
        self.text.get(self.at..)?.chars().next()
    }

    fn open_branch(&mut self) {
        self.open.push(OpenBranch {
            start: self.at,
            legs: Vec::new(),
            outside: std::mem::take(&mut self.series),
        });
        self.at += 1;
    }

    fn end_leg(&mut self) {
        let leg = std::mem::take(&mut self.series);
        if let Some(branch) = self.open.last_mut() {
            branch.legs.push(leg);
        }
    }

    fn close_branch(&mut self) {
        self.end_leg();
        if let Some(branch) = self.open.pop() {
            self.series = branch.outside;
            self.series.push(Item::Branch(Branch { legs: branch.legs }));
        }
    }

    fn close_open_branches(&mut self) {
        while let Some(branch) = self.open.last() {
            self.faults.push(Fault {
                place: branch.start..branch.start + 1,
                message: "this branch is not closed before the rung ends".to_owned(),
                help: "add the missing `]`; a branch is written `[leg ,leg ]`",
            });
            self.close_branch();
        }
    }

    fn end_without_semicolon(&mut self) {
        self.close_open_branches();
        let end = self.text.len();
        self.faults.push(Fault {
            place: end..end,
            message: "the rung does not end with `;`".to_owned(),
            help: "add the `;`; what stands before it is read",
        });
        self.at = end;
    }

    /// Keeps a branch that is nested too deep as one unreadable piece.
    fn skip_branch(&mut self) {
        let start = self.at;
        let mut depth = 0_usize;
        while let Some(character) = self.peek() {
            match character {
                '[' => depth += 1,
                ']' => depth = depth.saturating_sub(1),
                ';' => break,
                _ => {}
            }
            self.at += character.len_utf8();
            if depth == 0 {
                break;
            }
        }
        self.series.push(Item::Unreadable(start..self.at));
        self.faults.push(Fault {
            place: start..self.at,
            message: format!("branches are nested deeper than {DEEPEST}"),
            help: "this branch is taken as one unknown box; split the rung",
        });
    }

    fn instruction(&mut self) {
        let start = self.at;
        self.at = name_end(self.text, start);
        let mnemonic = start..self.at;
        let after = skip_blanks(self.text, self.at);
        if !self.text[after..].starts_with('(') {
            let name = &self.text[mnemonic.clone()];
            self.faults.push(Fault {
                place: mnemonic.clone(),
                message: format!("`{name}` has no parentheses"),
                help: "an instruction is written `NAME(operand,operand)`, or `NAME()` without operands",
            });
            self.series.push(Item::Instruction(Instruction {
                place: mnemonic.clone(),
                mnemonic,
                operands: Vec::new(),
            }));
            return;
        }
        let (operands, end) = operands(self.text, after + 1);
        self.at = end.unwrap_or_else(|stop| stop);
        let place = start..self.at;
        if end.is_err() {
            self.faults.push(Fault {
                place: start..after + 1,
                message: format!(
                    "the operands of `{}` are not closed before the rung ends",
                    &self.text[mnemonic]
                ),
                help: "add the missing `)`; the instruction is taken as an unknown box",
            });
            self.series.push(Item::Unreadable(place));
            return;
        }
        self.series.push(Item::Instruction(Instruction {
            mnemonic,
            operands,
            place,
        }));
    }

    fn unreadable(&mut self) {
        let start = self.at;
        while let Some(character) = self.peek() {
            let ends = character.is_whitespace() || matches!(character, ';' | '[' | ']' | ',');
            if ends && self.at > start {
                break;
            }
            self.at += character.len_utf8();
        }
        let place = start..self.at;
        if !self.complained {
            self.complained = true;
            self.faults.push(Fault {
                place: place.clone(),
                message: format!("`{}` is no instruction", &self.text[place.clone()]),
                help: "an instruction is written `NAME(operand,operand)`, a branch `[leg ,leg ]`; reading goes on after it",
            });
        }
        self.series.push(Item::Unreadable(place));
    }
}

/// The operands of an instruction from byte `from`, just after `(`, on. The
/// end is after `)`; where none comes it is the error, before the `;`.
fn operands(text: &str, from: usize) -> (Vec<Range<usize>>, Result<usize, usize>) {
    let mut operands = Vec::new();
    let mut start = from;
    let mut parentheses = 0_usize;
    let mut brackets = 0_usize;
    let mut quoted_to = from;
    let mut quotes = Quotes::default();
    for (offset, character) in text[from..].char_indices() {
        let at = from + offset;
        if at < quoted_to {
            continue;
        }
        match character {
            '\'' => quoted_to = quotes.end(text, at),
            '(' => parentheses += 1,
            ')' if parentheses > 0 => parentheses -= 1,
            ')' => {
                let last = trimmed(text, start..at);
                if !(operands.is_empty() && last.is_empty()) {
                    operands.push(last);
                }
                return (operands, Ok(at + 1));
            }
            '[' => brackets += 1,
            ']' => brackets = brackets.saturating_sub(1),
            ',' if parentheses == 0 && brackets == 0 => {
                operands.push(trimmed(text, start..at));
                start = at + 1;
            }
            ';' => return (operands, Err(at)),
            _ => {}
        }
    }
    (operands, Err(text.len()))
}

/// The end of the string literal that begins at byte `start`, after its closing
/// `'`; `$'` inside is a quote. A quote that nothing closes on its line stands
/// for itself.
pub(super) fn quote_end(text: &str, start: usize) -> usize {
    let mut escaped = false;
    for (offset, character) in text[start..].char_indices().skip(1) {
        match character {
            '\n' | '\r' => break,
            _ if escaped => escaped = false,
            '$' => escaped = true,
            '\'' => return start + offset + 1,
            _ => {}
        }
    }
    start + 1
}

/// The string literals of a text that is walked from left to right. A line is
/// searched once for the end of one, however many quotes stand on it.
#[derive(Debug, Default)]
pub(super) struct Quotes {
    /// Up to here quotes stand for themselves.
    plain_to: usize,
}

impl Quotes {
    /// As [`quote_end`].
    pub(super) fn end(&mut self, text: &str, start: usize) -> usize {
        if start < self.plain_to {
            return start + 1;
        }
        let end = quote_end(text, start);
        if end == start + 1 {
            // Nothing closes it, so no quote of this line closes one.
            let rest = text.get(start..).unwrap_or_default();
            self.plain_to = start + rest.find(['\n', '\r']).unwrap_or(rest.len());
        }
        end
    }
}

/// `range` of `text` without the blanks at its ends.
pub(super) fn trimmed(text: &str, range: Range<usize>) -> Range<usize> {
    let inside = &text[range.clone()];
    let start = range.start + (inside.len() - inside.trim_start().len());
    let end = start + inside.trim().len();
    start..end
}

pub(super) fn skip_blanks(text: &str, from: usize) -> usize {
    let rest = text.get(from..).unwrap_or_default();
    // Nearly always there is no blank, or it is ASCII.
    from + (rest.len() - rest.trim_ascii_start().trim_start().len())
}

/// Whether a name may begin with this character.
pub(super) fn starts_name(character: char) -> bool {
    character.is_alphabetic() || character == '_'
}

/// The end of the name that begins at byte `start`.
pub(super) fn name_end(text: &str, start: usize) -> usize {
    let rest = text.get(start..).unwrap_or_default();
    let is_plain = |byte: u8| byte.is_ascii_alphanumeric() || byte == b'_';
    let plain = rest.bytes().position(|byte| !is_plain(byte));
    let plain = plain.unwrap_or(rest.len());
    // Most names end here. Those with letters beyond ASCII go on.
    let rest = rest.get(plain..).unwrap_or_default();
    if rest.as_bytes().first().is_none_or(u8::is_ascii) {
        return start + plain;
    }
    let length = rest.find(|c: char| !(c.is_alphanumeric() || c == '_'));
    start + plain + length.unwrap_or(rest.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The tree as text: instructions as they are, branches in brackets,
    /// unreadable pieces between `!`, faults after ` ?`.
    fn check(text: &str, expected: &str) {
        let (statements, faults) = parse(text);
        let mut shown: Vec<String> = statements.iter().map(|s| show(text, &s.items)).collect();
        shown.extend(faults.iter().map(|f| format!("? {}", f.message)));
        assert_eq!(shown.join("\n"), expected, "{text}");
    }

    fn show(text: &str, items: &[Item]) -> String {
        let show_item = |item: &Item| match item {
            Item::Instruction(found) => {
                let operands: Vec<&str> = found.operands.iter().map(|o| &text[o.clone()]).collect();
                format!("{}({})", &text[found.mnemonic.clone()], operands.join("|"))
            }
            Item::Branch(branch) => {
                let legs: Vec<String> = branch.legs.iter().map(|leg| show(text, leg)).collect();
                format!("[{}]", legs.join(","))
            }
            Item::Unreadable(place) => format!("!{}!", &text[place.clone()]),
        };
        items.iter().map(show_item).collect()
    }

    #[test]
    fn series_and_branches() {
        check("XIC(a)OTE(b);", "XIC(a)OTE(b)");
        check("[XIC(a) ,XIC(b) ]OTE(c);", "[XIC(a),XIC(b)]OTE(c)");
        check("[,XIO(C)][,]OTE(d);", "[,XIO(C)][,]OTE(d)");
        check(
            "XIC(a)[OTE(b) XIC(c) ,[XIC(d),XIC(e)]OTE(f) ];",
            "XIC(a)[OTE(b)XIC(c),[XIC(d),XIC(e)]OTE(f)]",
        );
        check("XIC(a)\r\n\t\tOTE(b)\n;\nNOP();", "XIC(a)OTE(b)\nNOP()");
    }

    #[test]
    fn operands_hold_parentheses_commas_and_strings() {
        check("CPT(x,(a - b)*c)OTE( d );", "CPT(x|(a - b)*c)OTE(d)");
        check("GSV(WALLCLOCKTIME,,X,t[0]);", "GSV(WALLCLOCKTIME||X|t[0])");
        check("MOV(a[1,2],b);", "MOV(a[1,2]|b)");
        check("CONCAT('a;,)$'',b,c);", "CONCAT('a;,)$''|b|c)");
        check("TON(T,?,?);", "TON(T|?|?)");
    }

    #[test]
    fn what_does_not_fit_is_kept_and_the_next_rung_is_read() {
        check(
            "NOP;XIC(a)OTE(b);",
            "NOP()\nXIC(a)OTE(b)\n? `NOP` has no parentheses",
        );
        check(
            "XIC(a OTE(b);NOP();",
            "!XIC(a OTE(b)!\nNOP()\n? the operands of `XIC` are not closed before the rung ends",
        );
        check(
            "[XIC(a) ,XIC(b) OTE(c);NOP();",
            "[XIC(a),XIC(b)OTE(c)]\nNOP()\n? this branch is not closed before the rung ends",
        );
        check(
            "XIC(a)] ) OTE(b);",
            "XIC(a)!]!!)!OTE(b)\n? `]` is no instruction",
        );
        check(
            "XIC(a)OTE(b)",
            "XIC(a)OTE(b)\n? the rung does not end with `;`",
        );
        check("MOV('a,b);", "MOV('a|b)");
        check("MOV('a$',b$');", "MOV('a$'|b$')");
    }

    #[test]
    fn nesting_is_bounded() {
        let text = format!("{}XIC(a){};", "[".repeat(70), "]".repeat(70));
        let (statements, faults) = parse(&text);
        assert_eq!(statements.len(), 1);
        assert_eq!(faults.len(), 1);
        assert!(faults[0].message.contains("deeper than 64"));
    }
}
