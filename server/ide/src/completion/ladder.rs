//! What can be typed in a ladder text: rung notation, and neutral text.

use std::collections::BTreeSet;

use ::ladder::{ElementKind, Format};
use logic::notation::{Token, TokenKind, quoted};
use source::Span;

use super::boxes::boxes;
use super::neutral;
use super::variables::{Wanted, addresses, variables};
use super::{Completion, CompletionKind, Completions};
use crate::Ladder;
use crate::statement::{self, LADDER_WORDS, Typed, boundary, code};

/// What can be typed at the byte `offset` of a ladder text, best first. In XML
/// nothing can: there a rung is more than its text.
pub fn complete_in_ladder(ladder: &Ladder, offset: usize) -> Option<Completions> {
    let offset = boundary(&ladder.text, offset);
    match ladder.program().format {
        Format::NeutralText => return neutral::complete(ladder, offset),
        Format::Ladder | Format::Unknown => {}
        _ => return None,
    }
    let text = &*ladder.text;
    let typed = Typed::at(text, offset);
    if typed.in_comment {
        return None;
    }
    let statement = statement::in_ladder(text, offset);
    let before = code(
        text,
        statement.start..typed.span.range().start.max(statement.start),
    );
    let is_at_line_begin = {
        let line = statement::line(text, offset);
        text[line.start..typed.span.range().start]
            .trim_start_matches('\u{feff}')
            .trim()
            .is_empty()
    };
    let mut items = Vec::new();
    if text[typed.span.range()].starts_with('%') {
        items.extend(addresses(ladder));
    } else {
        if !typed.quoted && is_at_line_begin {
            items.extend(statements());
        }
        // What is typed now, and a word before it such as `set`, are no
        // variables of the program.
        let now = before
            .last()
            .map_or(typed.span, |it| it.span.cover(typed.span));
        let here = Here {
            ladder,
            quoted: typed.quoted,
            now,
        };
        items.extend(here.in_statement(&before));
    }
    Some(Completions {
        span: typed.span,
        items,
    })
}

/// Statements to begin with.
fn statements() -> Vec<Completion> {
    let word = |word: &str, form: &str, detail: &str| {
        Completion::word(word, detail).snippet(format!("{word}{form}"))
    };
    vec![
        word(
            "rung",
            " \"${1:title}\": ${2:condition} -> ${3:coil}",
            "a condition and what it drives",
        ),
        word(
            "input",
            " ${1:name} ${2:%I0} // ${3:what it is}",
            "comes from the plant",
        ),
        word(
            "output",
            " ${1:name} ${2:%Q0} // ${3:what it is}",
            "goes to the plant",
        ),
        word(
            "internal",
            " ${1:name} // ${2:what it is}",
            "is kept inside",
        ),
        word("inout", " ${1:name}", "comes from the plant and goes to it"),
        word("constant", " ${1:name} = ${2:100}", "never changes"),
        word("variable", " ${1:name}", "has no purpose that is said"),
        word("program", " ${1:Name}", "begins a program"),
        word(
            "routine",
            " ${1:Name}",
            "rungs that are solved where they are called",
        ),
    ]
}

/// Types that declarations commonly have.
const TYPES: [&str; 14] = [
    "BOOL", "INT", "DINT", "UINT", "WORD", "REAL", "TIME", "STRING", "TON", "TOF", "TP", "CTU",
    "CTD", "CTUD",
];

/// Where a caret stands in a rung.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Part {
    /// Before the colon.
    Head,
    /// In a condition.
    Condition,
    /// In a list of outputs.
    Outputs,
    /// Between the parentheses of a box.
    Arguments,
}

/// A place in a text, with what is known of it.
struct Here<'l> {
    ladder: &'l Ladder,
    /// Whether a quote is open.
    quoted: bool,
    /// What is being typed.
    now: Span,
}

impl Here<'_> {
    fn variables(&self, wanted: Wanted) -> Vec<Completion> {
        variables(self.ladder, wanted, self.now, spell)
    }

    /// What can stand after the tokens of a statement.
    fn in_statement(&self, before: &[Token]) -> Vec<Completion> {
        let text = &*self.ladder.text;
        let Some((first, rest)) = before.split_first() else {
            return Vec::new();
        };
        let word = first.text(text).to_ascii_lowercase();
        match word.as_str() {
            "rung" => self.in_rung(rest),
            "routine" if rest.len() == 1 => vec![
                Completion::word("main", "solved every scan"),
                Completion::word("block", "the body of a block, solved for each instance"),
            ],
            word if LADDER_WORDS[3..].contains(&word) => self.in_declaration(rest),
            _ => Vec::new(),
        }
    }

    fn in_declaration(&self, rest: &[Token]) -> Vec<Completion> {
        match rest {
            [] => self.variables(Wanted::Undeclared),
            [_, .., last] if last.kind == TokenKind::Colon => {
                let used = self.ladder.program().declarations.iter();
                let used = used.filter_map(|it| it.data_type.as_deref());
                let mut types: Vec<&str> = TYPES.to_vec();
                let others: BTreeSet<&str> = used.filter(|it| !TYPES.contains(it)).collect();
                types.extend(others);
                let named =
                    |it: &str| Completion::new(it, CompletionKind::Type, "").insert(quoted(it));
                types.into_iter().map(named).collect()
            }
            [_] => vec![Completion::word("at", "an address in quotes follows").insert("at \"")],
            _ => Vec::new(),
        }
    }

    fn in_rung(&self, rest: &[Token]) -> Vec<Completion> {
        let text = &*self.ladder.text;
        let previous = rest.last();
        let kind = previous.map(|token| token.kind);
        let follows_name = statement::ends_operand(kind);
        let read = || self.variables(Wanted::Read);
        match part(rest) {
            Part::Head if self.quoted || previous.is_some_and(|it| it.text(text) == "label") => {
                Vec::new()
            }
            Part::Head => vec![Completion::word("label", "where jumps to this rung arrive")],
            Part::Condition if follows_name => Vec::new(),
            Part::Condition => {
                let mut items = read();
                if !self.quoted {
                    items.push(edge("rise", "on in the scan in which it rises"));
                    items.push(edge("fall", "on in the scan in which it falls"));
                }
                items
            }
            Part::Arguments if follows_name => Vec::new(),
            Part::Arguments => read(),
            Part::Outputs => match previous {
                Some(token) if token.kind == TokenKind::Name => match token.text(text) {
                    "set" | "reset" | "rising" | "falling" => self.variables(Wanted::Written),
                    "jump" => labels(self.ladder),
                    "call" => routines(self.ladder),
                    "return" => vec![Completion::word(
                        "program",
                        "ends the program for this scan",
                    )],
                    _ => Vec::new(),
                },
                Some(token) if token.kind == TokenKind::Slash => self.variables(Wanted::Written),
                Some(token) if matches!(token.kind, TokenKind::Arrow | TokenKind::Comma) => {
                    let mut items = self.variables(Wanted::Written);
                    if !self.quoted {
                        items.extend(output_words());
                        items.extend(boxes());
                    }
                    items
                }
                _ if follows_name => Vec::new(),
                // Behind `:=`, or an operator of its term.
                _ => read(),
            },
        }
    }
}

fn part(tokens: &[Token]) -> Part {
    let mut part = Part::Head;
    let mut around = Vec::new();
    let mut before: Option<TokenKind> = None;
    for token in tokens {
        match (part, token.kind) {
            (Part::Head, TokenKind::Colon) => part = Part::Condition,
            (Part::Condition, TokenKind::Arrow) => part = Part::Outputs,
            (Part::Condition, TokenKind::Open) => around.push(part),
            (Part::Outputs, TokenKind::Open) => {
                around.push(part);
                part = match before {
                    Some(TokenKind::Arrow | TokenKind::Comma) => Part::Condition,
                    _ => Part::Arguments,
                };
            }
            (Part::Arguments, TokenKind::Open) => around.push(part),
            (Part::Head, _) => {}
            (_, TokenKind::Close) => part = around.pop().unwrap_or(part),
            _ => {}
        }
        before = Some(token.kind);
    }
    part
}

fn edge(word: &str, detail: &str) -> Completion {
    Completion::word(word, detail)
        .insert(format!("{word}("))
        .snippet(format!("{word}(${{1:condition}})"))
}

fn output_words() -> [Completion; 7] {
    let followed = |word: &str, what: &str, detail: &str| {
        Completion::word(word, detail)
            .insert(format!("{word} "))
            .snippet(format!("{word} ${{1:{what}}}"))
    };
    [
        followed("set", "coil", "writes 1 while there is power, else nothing"),
        followed(
            "reset",
            "coil",
            "writes 0 while there is power, else nothing",
        ),
        followed("rising", "coil", "1 for the scan in which power rises"),
        followed("falling", "coil", "1 for the scan in which power falls"),
        followed("jump", "label", "goes on at the rung with the label"),
        followed("call", "routine", "runs a routine"),
        Completion::word("return", "leaves the routine"),
    ]
}

fn labels(ladder: &Ladder) -> Vec<Completion> {
    let rungs = ladder.program().rungs();
    let labels = rungs.flat_map(|(_, rung)| {
        rung.network
            .elements()
            .filter_map(|(_, element)| match &element.kind {
                ElementKind::Label(label) => Some(&*label.name),
                _ => None,
            })
    });
    let named = |it: &str| Completion::new(it, CompletionKind::Label, "").insert(spell(it));
    labels.map(named).collect()
}

fn routines(ladder: &Ladder) -> Vec<Completion> {
    let routines = ladder.program().routines.iter();
    let called = routines.filter(|it| it.role == ::ladder::Role::Called);
    let named =
        |it: &str| Completion::new(it, CompletionKind::Routine, "routine").insert(spell(it));
    called.map(|it| named(&it.name)).collect()
}

/// A name as rung notation writes it wherever it stands: in quotes where it is
/// a word of it, too.
pub(crate) fn spell(name: &str) -> String {
    let is_word = LADDER_WORDS
        .iter()
        .any(|word| word.eq_ignore_ascii_case(name));
    match is_word || OUTPUT_WORDS.contains(&name) {
        true => format!("\"{name}\""),
        false => quoted(name),
    }
}

/// Words that name something else where a name follows them.
const OUTPUT_WORDS: [&str; 9] = [
    "set", "reset", "rising", "falling", "jump", "call", "return", "label", "at",
];

#[cfg(test)]
mod tests {
    use crate::completion::tests::in_ladder;

    const DECLARED: &str = "\
input s %I0 // Start
input \"Local:1:I\"
output v1 %Q0 // Fill
output v2
internal t1 : TON
rung: s -> v1, TON(t1, 5s)
";

    #[track_caller]
    fn check(line: &str, replaced: &str, expected: &[&str]) {
        let (found, typed) = in_ladder(&format!("{DECLARED}{line}"));
        let found: Vec<&str> = found.iter().map(String::as_str).collect();
        assert_eq!((found.as_slice(), &*typed), (expected, replaced), "{line}");
    }

    #[test]
    fn a_condition_reads_inputs_first_then_states() {
        let names = ["s", "\"Local:1:I\"", "v1", "t1", "t1.Q", "v2"];
        let all: Vec<&str> = names.into_iter().chain(["rise(", "fall("]).collect();
        check("rung: s * $0", "", &all);
        check("rung: s * v$01", "v1", &all);
        check("rung: s -> v1, (/$0", "", &all);
        check("rung: s -> v1, (\"Loc$0", "\"Loc", &names);
        check("rung: s $0", "", &[]);
    }

    #[test]
    fn an_output_is_one_that_nothing_writes_or_a_box() {
        let (found, _) = in_ladder(&format!("{DECLARED}rung: s -> $0"));
        assert_eq!(found[..4], ["v2", "v1", "t1", "t1.Q"]);
        assert!(found.contains(&"set ".to_owned()) && found.contains(&"TON(".to_owned()));
        check(
            "rung: s -> set $0",
            "",
            &["v2", "v1", "t1", "t1.Q", "s", "\"Local:1:I\""],
        );
        check(
            "rung: s -> TON($0",
            "",
            &["s", "\"Local:1:I\"", "v1", "t1", "t1.Q", "v2"],
        );
    }

    #[test]
    fn a_line_begins_with_a_word() {
        let (found, typed) = in_ladder(&format!("{DECLARED}\nru$0"));
        assert_eq!((found[0].as_str(), &*typed), ("rung", "ru"));
        assert_eq!(found.len(), 9);
    }

    #[test]
    fn a_declaration_names_what_is_used_and_not_declared() {
        check("rung: a -> b\ninput $0", "", &["a", "b"]);
        let (found, _) = in_ladder("input s : $0");
        assert_eq!(found[0], "BOOL");
    }

    #[test]
    fn an_address_is_known_by_its_sign() {
        check("rung: %$0", "%", &["%I0", "%Q0"]);
    }

    #[test]
    fn comments_and_titles_are_peoples_own_words() {
        check("rung: s // $0", "", &[]);
        check("rung \"$0", "\"", &[]);
    }
}
