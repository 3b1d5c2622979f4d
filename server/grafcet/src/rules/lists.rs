//! Declarations and marks: `Step p1, p2`, `Input s %I0`, `Marking p1`, and the
//! lines that begin a part.

use logic::Name;
use logic::notation::{Problem, TokenKind};

use super::parse::{Parsed, Parser};
use super::syntax::{Entry, Item, Kind, Line, Usage, comment_text};
use super::words::{PartWord, Word, is_leading};
use crate::{Instance, PartKind, Step, StepKind, Variable};

/// Reads the names after `word`, up to the first that cannot be understood.
pub(crate) fn read(parser: &mut Parser<'_>, word: Word, lines: &[Line]) -> Parsed {
    let mut entries = Vec::new();
    let problem = loop {
        let mark = parser.lexer.mark();
        let start = parser.lexer.here().range().start;
        let marks = parser.marks.len();
        match item(parser, word) {
            Ok(item) => entries.push(Entry {
                item,
                span: parser.lexer.since(start),
                comma: None,
                line: 0,
                alone: false,
            }),
            Err(problem) => {
                parser.lexer.rewind(mark);
                parser.marks.truncate(marks);
                break Some(problem);
            }
        }
        match parser.lexer.take_if(TokenKind::Comma) {
            Some(comma) => {
                if let Some(entry) = entries.last_mut() {
                    entry.comma = Some(comma.span);
                }
            }
            None => break parser.end(after(word)).err(),
        }
    };
    place(parser.lexer.text(), lines, problem.is_some(), &mut entries);
    Parsed {
        kind: Kind::List(word, entries),
        problem,
    }
}

/// Gives each entry its line, and the line's comment where it is alone there:
/// nothing else is declared, and nothing stands there that was not understood.
fn place(text: &str, lines: &[Line], broken: bool, entries: &mut [Entry]) {
    let mut at = 0;
    for entry in entries.iter_mut() {
        let start = entry.span.range().start;
        while lines.get(at).is_some_and(|line| line.end < start) {
            at += 1;
        }
        entry.line = at;
    }
    let line_of: Vec<usize> = entries.iter().map(|entry| entry.line).collect();
    for (at, entry) in entries.iter_mut().enumerate() {
        let before = at.checked_sub(1).and_then(|before| line_of.get(before));
        let Some(line) = lines.get(entry.line) else {
            continue;
        };
        let within = entry.span.range().end <= line.end;
        let next = line_of.get(at + 1);
        let shared = before == Some(&entry.line) || next == Some(&entry.line);
        entry.alone = within && !shared && !(broken && next.is_none());
        if entry.alone {
            let comment = line.comment.and_then(|comment| comment_text(text, comment));
            entry.item.set_comment(comment);
        }
    }
}

fn after(word: Word) -> &'static str {
    match word {
        Word::Input | Word::Output | Word::Internal => {
            "`,`, the end of the line, or an address: `%I0`, or any other in quotes"
        }
        Word::Step | Word::Macro | Word::Enclosing => {
            "`,`, `for` and a state, or the end of the line"
        }
        _ => "`,` or the end of the line",
    }
}

fn item(parser: &mut Parser<'_>, word: Word) -> Result<Item, Problem> {
    // A forgotten line end is likelier than such a name.
    let text = parser.lexer.text();
    let next = parser.lexer.peek();
    if next.is_some_and(|next| next.kind == TokenKind::Name && is_leading(next.text(text))) {
        return Err(parser.expected("a name, in quotes if it is a word such as `Step`"));
    }
    let (name, _) = match word {
        Word::Marking | Word::Activation => parser.name(Usage::Step, "the name of a step")?,
        _ => parser.name(Usage::Declares(word), "a name")?,
    };
    Ok(match word {
        Word::Step => Item::Step(step(parser, name, StepKind::Plain)?),
        Word::Macro => {
            parser.token(TokenKind::Open)?;
            let (expansion, _) = parser.name(Usage::Part, "the name of its expansion")?;
            parser.token(TokenKind::Close)?;
            Item::Step(step(parser, name, StepKind::Macro(expansion))?)
        }
        Word::Enclosing => {
            let parts = names(parser, Usage::Part, "the name of a partial grafcet")?;
            Item::Step(step(parser, name, StepKind::Enclosing(parts))?)
        }
        Word::Input | Word::Output | Word::Internal => Item::Variable(Variable {
            name,
            address: address(parser),
            comment: None,
        }),
        Word::Instance => {
            if !parser.word("of") {
                return Err(parser.expected("`of` and the name of a reusable grafcet"));
            }
            let (of, _) = parser.name(Usage::Part, "the name of a reusable grafcet")?;
            let arguments = optional_names(parser, Usage::Value, "the name of a variable")?;
            Item::Instance(Instance {
                name,
                of,
                arguments,
                comment: None,
            })
        }
        Word::Transition | Word::Marking | Word::Activation => Item::Name(name),
    })
}

fn step(parser: &mut Parser<'_>, name: Name, kind: StepKind) -> Result<Step, Problem> {
    let state = match parser.word("for") {
        true => Some(state(parser)?),
        false => None,
    };
    Ok(Step {
        kind,
        state,
        ..Step::new(name)
    })
}

/// A state as the ladder spells it: a name, or a register and its value
/// `Seq=10`, which needs no quotes.
pub(crate) fn state(parser: &mut Parser<'_>) -> Result<Name, Problem> {
    let (name, span) = parser.any_name("the name of a state")?;
    let is_plain = !parser
        .lexer
        .previous()
        .is_some_and(|token| token.kind == TokenKind::Quoted);
    if !is_plain || parser.lexer.take_if(TokenKind::Equal).is_none() {
        parser.mark(&name, span, Usage::State);
        return Ok(name);
    }
    let sign = match parser.lexer.take_if(TokenKind::Minus) {
        Some(_) => "-",
        None => "",
    };
    let number = parser.token(TokenKind::Number)?;
    let state = format!("{name}={sign}{}", number.text(parser.lexer.text()));
    let state = Name::from(state);
    parser.mark(&state, span.cover(number.span), Usage::State);
    Ok(state)
}

/// An address without quotes begins with `%`, so that a forgotten comma is
/// not taken for one.
fn address(parser: &mut Parser<'_>) -> Option<Name> {
    let text = parser.lexer.text();
    let token = parser.lexer.peek()?;
    let is_address = match token.kind {
        TokenKind::Name => token.text(text).starts_with('%'),
        TokenKind::Quoted => !token.name(text).is_empty(),
        _ => false,
    };
    is_address.then(|| {
        parser.lexer.take();
        token.name(text).into()
    })
}

/// `(a, b)`, at least one.
fn names(parser: &mut Parser<'_>, usage: Usage, expected: &str) -> Result<Vec<Name>, Problem> {
    parser.token(TokenKind::Open)?;
    let mut names = Vec::new();
    loop {
        names.push(parser.name(usage, expected)?.0);
        if parser.lexer.take_if(TokenKind::Comma).is_none() {
            break;
        }
    }
    parser.token(TokenKind::Close)?;
    Ok(names)
}

/// `(a, b)`, or nothing.
fn optional_names(
    parser: &mut Parser<'_>,
    usage: Usage,
    expected: &str,
) -> Result<Vec<Name>, Problem> {
    match parser.lexer.peek_kind() {
        Some(TokenKind::Open) => names(parser, usage, expected),
        _ => Ok(Vec::new()),
    }
}

/// Reads what follows the word that begins a part.
pub(crate) fn part(parser: &mut Parser<'_>, word: PartWord) -> Result<Kind, Problem> {
    let (name, _) = parser.name(Usage::DeclaresPart, "the name of the part")?;
    let kind = match word {
        PartWord::Partial => PartKind::Partial,
        PartWord::Expansion => {
            parser.token(TokenKind::Open)?;
            let (entry, _) = parser.name(Usage::Step, "the name of its entry step")?;
            parser.token(TokenKind::Comma)?;
            let (exit, _) = parser.name(Usage::Step, "the name of its exit step")?;
            parser.token(TokenKind::Close)?;
            PartKind::Expansion { entry, exit }
        }
        PartWord::Reusable => PartKind::Reusable {
            parameters: optional_names(
                parser,
                Usage::DeclaresParameter,
                "the name of a parameter",
            )?,
        },
    };
    parser.end("the end of the line")?;
    Ok(Kind::Part(name, kind))
}

/// Whether `address` can be written without quotes.
pub(crate) fn is_plain_address(address: &str) -> bool {
    address.starts_with('%') && logic::notation::quoted(address) == address
}
