//! Rungs written one after the other: bare neutral text, and the body of a
//! routine in L5K.
//!
//! Each rung ends with `;`. Before it may stand what people and L5K put there:
//!
//! ```text
//! RC: "comment of the next rung$N"
//!     "and its second line";
//! N: XIC(a)OTE(b);          an edit mark, as in L5K
//! 12: XIC(c)OTE(d);         a rung number
//! XIC(e)OTE(f);             nothing
//! ```

use std::ops::Range;

use logic::Name;
use source::{Diagnostic, Span, codes};

use super::catalogue;
use super::neutral::{self, Item, name_end, skip_blanks};
use super::passage::Passage;
use super::program;
use super::project::{Extent, Project, RoutineSource, RungSource, Unit, UnitKind};
use crate::Format;
use crate::reading::{Reading, Source};

/// Statements at the beginning of a text that are tried when guessing its form.
const TRIED: usize = 8;

/// Whether `text` is bare neutral text: one of its first statements reads
/// without a fault and has an instruction that is known.
pub(super) fn looks_like_it(text: &str) -> bool {
    // What stands behind the last `;` is no whole statement.
    let Some(last) = memchr::memrchr(b';', text.as_bytes()) else {
        return false;
    };
    let text = &text[..=last];
    let mut at = 0;
    for _ in 0..TRIED {
        let label = label(text, at);
        at = label.end;
        if label.kind == LabelKind::Comment {
            at = strings(text, at).1;
            continue;
        }
        let mut faults = Vec::new();
        let Some(statement) = neutral::statement(text, at, &mut faults) else {
            return false;
        };
        if faults.is_empty() && names_known_instruction(&statement.items, text) {
            return true;
        }
        at = statement.place.end;
    }
    false
}

fn names_known_instruction(items: &[Item], text: &str) -> bool {
    items.iter().any(|item| match item {
        Item::Instruction(instruction) => text
            .get(instruction.mnemonic.clone())
            .is_some_and(|mnemonic| catalogue::meaning(mnemonic).is_some()),
        Item::Branch(branch) => branch
            .legs
            .iter()
            .any(|leg| names_known_instruction(leg, text)),
        Item::Unreadable(_) => false,
    })
}

/// Reads bare neutral text: one routine, solved every scan.
pub(super) fn read(source: Source<'_>) -> Reading {
    let mut project = Project::empty(Format::NeutralText);
    project.extent = Extent::Routine;
    let whole = 0..source.text.len();
    let mut unit = Unit::empty(UnitKind::Program { main: None }, String::new());
    unit.routines.push(RoutineSource {
        name: String::new(),
        rungs: rungs(source, whole.clone(), &mut project.diagnostics),
        span: source.span(whole.start, whole.end),
    });
    project.units.push(unit);
    program::program(project)
}

/// The rungs listed in `range` of the text.
pub(super) fn rungs<'t>(
    source: Source<'t>,
    range: Range<usize>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Vec<RungSource<'t>> {
    let Some(text) = source.text.get(..range.end) else {
        return Vec::new();
    };
    let mut rungs: Vec<RungSource<'t>> = Vec::new();
    let mut comment: Option<(Name, Span)> = None;
    let mut at = skip_blanks(text, range.start);
    while at < text.len() {
        let start = at;
        let label = label(text, at);
        if label.kind == LabelKind::Comment {
            let (found, end) = strings(text, label.end);
            let span = source.span(start, end);
            if found.is_empty() {
                diagnostics.push(
                    Diagnostic::new(
                        codes::NEUTRAL_TEXT_SYNTAX,
                        span,
                        "the rung comment holds no quoted text",
                    )
                    .help("write it as `RC: \"text\";`"),
                );
            }
            let found = found.trim();
            comment = (!found.is_empty()).then(|| (found.into(), span));
            at = skip_blanks(text, end);
            continue;
        }
        // Faults are reported when the rung is read for good.
        let statement = neutral::statement(text, label.end, &mut Vec::new());
        let end = statement.map_or(text.len(), |statement| statement.place.end);
        let body = text.get(label.end..end).unwrap_or_default();
        let place = source.base + label.end;
        let comment = comment.take();
        let next = u32::try_from(rungs.len()).unwrap_or(u32::MAX);
        rungs.push(RungSource {
            number: label.number.unwrap_or(next),
            edit: label.edit(text),
            text: Passage::copied(body, place),
            span: match &comment {
                Some((_, span)) => span.cover(source.span(start, end)),
                None => source.span(start, end),
            },
            comment: comment.map(|(text, _)| text),
        });
        at = skip_blanks(text, end);
    }
    if let Some((_, span)) = comment {
        diagnostics.push(
            Diagnostic::new(
                codes::NEUTRAL_TEXT_SYNTAX,
                span,
                "no rung follows this comment",
            )
            .help("a comment belongs to the rung after it; remove it or add the rung"),
        );
    }
    rungs
}

/// What stands before a rung's text.
#[derive(Debug, PartialEq)]
struct Label {
    kind: LabelKind,
    number: Option<u32>,
    mark: Range<usize>,
    /// Where the rung's text begins.
    end: usize,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum LabelKind {
    None,
    Comment,
    Edit,
    Number,
}

impl Label {
    fn edit(&self, text: &str) -> String {
        let mark = match self.kind {
            LabelKind::Edit => text.get(self.mark.clone()),
            _ => None,
        };
        mark.unwrap_or_default().to_owned()
    }
}

/// The label at byte `from` of `text`: `RC:`, `IR:`, `12:`, `Rung 12:`.
fn label(text: &str, from: usize) -> Label {
    let start = skip_blanks(text, from);
    let none = Label {
        kind: LabelKind::None,
        number: None,
        mark: start..start,
        end: start,
    };
    let mut word = start..name_end(text, start);
    if text[word.clone()].eq_ignore_ascii_case("rung") {
        let number = skip_blanks(text, word.end);
        word = number..name_end(text, number);
    }
    let colon = skip_blanks(text, word.end);
    if word.is_empty() || !text[colon..].starts_with(':') {
        return none;
    }
    let end = skip_blanks(text, colon + 1);
    let written = &text[word.clone()];
    if written.eq_ignore_ascii_case("RC") {
        return Label {
            kind: LabelKind::Comment,
            end,
            ..none
        };
    }
    if let Ok(number) = written.parse() {
        return Label {
            kind: LabelKind::Number,
            number: Some(number),
            end,
            ..none
        };
    }
    let marks = ["N", "I", "D", "IR", "rR", "R", "rI", "rN", "e", "er", "d"];
    if marks.contains(&written) {
        return Label {
            kind: LabelKind::Edit,
            mark: word,
            end,
            ..none
        };
    }
    none
}

/// The text of the double-quoted strings from byte `from` to the `;` after them,
/// put together, and the place after that `;`.
fn strings(text: &str, from: usize) -> (String, usize) {
    let mut all = String::new();
    let mut at = skip_blanks(text, from);
    while text[at..].starts_with('"') {
        let (string, end) = quoted(text, at);
        all.push_str(&string);
        at = skip_blanks(text, end);
    }
    if text[at..].starts_with(';') {
        at += 1;
    }
    (all, at)
}

/// The text of the string in double quotes that begins at byte `start`, and its
/// end. `$N` is a line end, `$Q` a double quote, `$$` a dollar.
pub(super) fn quoted(text: &str, start: usize) -> (String, usize) {
    let mut string = String::new();
    let mut escaped = false;
    for (offset, character) in text[start..].char_indices().skip(1) {
        if escaped {
            escaped = false;
            match character {
                'N' | 'n' | 'L' | 'l' => string.push('\n'),
                'R' | 'r' => {}
                'T' | 't' => string.push('\t'),
                'Q' | 'q' => string.push('"'),
                other => string.push(other),
            }
            continue;
        }
        match character {
            '$' => escaped = true,
            '"' => return (string, start + offset + 1),
            other => string.push(other),
        }
    }
    (string, text.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bare_neutral_text_is_known_by_its_instructions() {
        assert!(looks_like_it("XIC(a)OTE(b);"));
        assert!(looks_like_it("0: [XIC(a) ,XIC(b) ]OTE(c);"));
        assert!(looks_like_it("RC: \"start\";\nN: XIC(a)OTE(b);"));
        assert!(looks_like_it("My_Block(x,y);\nXIC(a)OTE(b);"));
        assert!(!looks_like_it("printf(\"%d\");"));
        assert!(!looks_like_it("v1 = (s + v1) * /ls2"));
        assert!(!looks_like_it("--| |--( )--"));
        assert!(!looks_like_it(""));
    }

    #[test]
    fn labels() {
        let shown = |text| {
            let label = label(text, 0);
            (label.kind, label.number, label.edit(text), label.end)
        };
        assert_eq!(shown("N: X"), (LabelKind::Edit, None, "N".into(), 3));
        assert_eq!(shown("IR:X"), (LabelKind::Edit, None, "IR".into(), 3));
        assert_eq!(
            shown("Rung 7: X"),
            (LabelKind::Number, Some(7), "".into(), 8)
        );
        assert_eq!(shown("RC: \"x\""), (LabelKind::Comment, None, "".into(), 4));
        assert_eq!(shown("XIC(a)"), (LabelKind::None, None, "".into(), 0));
    }

    #[test]
    fn comments_are_put_together_from_their_strings() {
        let text = "\"one$N\"\n  \"$Qtwo$Q $$5\" ; N:";
        assert_eq!(strings(text, 0), ("one\n\"two\" $5".to_owned(), 25));
    }
}
