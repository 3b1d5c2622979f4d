//! Turns statements into a program.

use std::collections::HashSet;

use logic::Name;
use logic::notation::{Lexer, Token};
use source::{Diagnostic, Span, codes};

use super::declaration::{self, DeclarationText};
use super::declare::{Declared, declare};
use super::findings::expected;
use super::names::Names;
use super::network::{network, place};
use super::rung;
use super::sections::Sections;
use super::statement::{Item, Keyword, Statement, WORDS, comment_text, cut, is_code};
use super::syntax::{Condition, RungText};
use crate::reading::{Reading, Source};
use crate::{Class, Format, Program, Role, Rung};

/// What a statement says.
pub(super) enum Meaning {
    Program(Token),
    Routine(Token, Role),
    Declaration(Class, DeclarationText),
    Rung(RungText),
}

/// Reads one statement: what it says, as far as it can be understood, and
/// where it breaks the grammar.
pub(super) fn understand(text: &str, statement: &Statement) -> (Option<Meaning>, Vec<Diagnostic>) {
    let mut lexer = statement.lexer(text);
    let mut findings = Vec::new();
    let meaning = match statement.keyword {
        Some(Keyword::Rung) => Ok(Meaning::Rung(rung::rung(&mut lexer, &mut findings))),
        Some(Keyword::Program) => declaration::program(&mut lexer).map(Meaning::Program),
        Some(Keyword::Routine) => {
            declaration::routine(&mut lexer).map(|(name, role)| Meaning::Routine(name, role))
        }
        Some(Keyword::Declaration(class)) => {
            declaration::declaration(&mut lexer).map(|found| Meaning::Declaration(class, found))
        }
        None => Err(no_statement(&lexer).into()),
    };
    match meaning {
        Ok(meaning) => (Some(meaning), findings),
        Err(finding) => {
            findings.push(*finding);
            (None, findings)
        }
    }
}

fn no_statement(lexer: &Lexer<'_>) -> Diagnostic {
    let words: Vec<_> = WORDS.iter().map(|(word, _)| format!("`{word}`")).collect();
    expected(lexer, "a statement").help(format!("a statement begins with {}", words.join(", ")))
}

/// Reads a whole text.
pub(crate) fn read(source: Source<'_>) -> Reading {
    let text = source.text;
    let items = cut(text);
    let mut findings = Vec::new();
    let mut declared = Declared::default();
    let mut others = Vec::new();
    for (at, item) in items.iter().enumerate() {
        let Item::Statement(statement) = item else {
            continue;
        };
        let (meaning, problems) = understand(text, statement);
        match meaning {
            Some(Meaning::Declaration(class, written)) => {
                declare(
                    &mut declared,
                    source,
                    statement,
                    class,
                    &written,
                    &mut findings,
                );
            }
            Some(meaning) => {
                if problems.is_empty() {
                    findings.extend(without_output(&meaning, statement.span()));
                }
                others.push((at, statement, meaning));
            }
            None => {}
        }
        findings.extend(problems);
    }

    // Rungs may use what is declared below them: they are drawn last.
    let mut names = Names::new(&declared.all, pins(text, &items));
    let mut sections = Sections::new();
    for (at, statement, meaning) in others {
        let span = statement.span();
        match meaning {
            Meaning::Declaration(..) => {}
            Meaning::Program(name) => sections.begin_program(source, name, &mut findings),
            Meaning::Routine(name, role) => {
                sections.begin_routine(source, name, role, span, &mut findings);
            }
            Meaning::Rung(rung) => {
                let place = place(source, span);
                let routine = sections.routine_of_rung(place);
                routine.span = routine.span.cover(place);
                routine.rungs.push(Rung::new(
                    u32::try_from(routine.rungs.len()).unwrap_or(u32::MAX),
                    comment(text, &rung, items.get(..at).unwrap_or_default(), statement),
                    network(&rung, span, source, &mut names, &mut findings),
                    place,
                ));
            }
        }
    }
    let mut program = Program::empty(Format::Ladder);
    program.name = sections.program;
    program.routines = sections.routines;
    program.declarations = declared.all;
    findings
        .iter_mut()
        .for_each(|finding| move_to_file(finding, source));
    Reading {
        program: program.into(),
        diagnostics: findings,
    }
}

/// Those spellings in the text that end in the pin of a timer or counter.
fn pins(text: &str, items: &[Item]) -> HashSet<String> {
    let statements = items.iter().filter_map(|item| match item {
        Item::Statement(statement) => Some(statement),
        _ => None,
    });
    statements
        .flat_map(|statement| statement.tokens.iter())
        .filter(|token| is_code(token))
        .map(|token| token.name(text))
        .filter(|name| name.ends_with(".Q") || name.ends_with(".DN"))
        .map(str::to_owned)
        .collect()
}

/// The title, then the comment lines right above, then the comment behind.
fn comment(text: &str, rung: &RungText, before: &[Item], statement: &Statement) -> Option<Name> {
    let above = before
        .iter()
        .rev()
        .map_while(|item| match item {
            Item::Comment(comment) => Some(comment_text(text, *comment)),
            _ => None,
        })
        .collect::<Vec<_>>();
    let title = rung.title.map(|title| title.name(text));
    let behind = statement.behind.map(|comment| comment_text(text, comment));
    let lines: Vec<_> = title
        .into_iter()
        .chain(above.into_iter().rev())
        .chain(behind)
        .collect();
    let all = lines.join("\n");
    (!all.trim().is_empty()).then(|| all.into())
}

/// A rung that drives nothing, unless it is there to be jumped to.
fn without_output(meaning: &Meaning, span: Span) -> Option<Diagnostic> {
    let Meaning::Rung(rung) = meaning else {
        return None;
    };
    let is_empty = matches!(rung.leg.condition, Condition::Missing);
    if !rung.leg.outputs.is_empty() || is_empty && rung.label.is_some() {
        return None;
    }
    let message = if is_empty {
        "the rung is empty"
    } else {
        "the rung has contacts and drives nothing"
    };
    let finding = Diagnostic::new(codes::RUNG_WITHOUT_OUTPUT, span, message);
    Some(finding.help("say what it drives: `rung: a * /b -> c`"))
}

/// Findings are made in places of the text and shown in places of the file.
fn move_to_file(finding: &mut Diagnostic, source: Source<'_>) {
    finding.span = place(source, finding.span);
    for related in &mut finding.related {
        related.span = place(source, related.span);
    }
}
