//! Turns statements into a program.

use std::collections::HashMap;

use logic::Name;
use logic::notation::{Lexer, Token};
use source::{Diagnostic, Span, codes};

use super::declaration::{self, DeclarationText};
use super::declare::{Declared, declare};
use super::findings::expected;
use super::names::{Names, Spellings};
use super::network::{network, place};
use super::reread::Traces;
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

/// Reads a whole text, and takes down what reading the next edition needs.
pub(crate) fn read(source: Source<'_>) -> (Reading, Traces) {
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
                if let (Meaning::Rung(rung), true) = (&meaning, problems.is_empty()) {
                    findings.extend(without_output(rung, statement.span()));
                }
                others.push((at, statement, meaning));
            }
            None => {}
        }
        findings.extend(problems);
    }

    // Rungs may use what is declared below them: they are drawn last.
    let pins = pins(text, items.iter().filter_map(Item::statement));
    let mut names = Names::new(&declared.all, Spellings::new(&declared.all, pins));
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
                let routine = sections.routine_of_rung(place(source, span));
                routine.span = routine.span.cover(place(source, span));
                let number = u32::try_from(routine.rungs.len()).unwrap_or(u32::MAX);
                let rung = Written {
                    rung,
                    statement,
                    before: items.get(..at).unwrap_or_default(),
                };
                routine
                    .rungs
                    .push(rung.drawn(number, source, &mut names, &mut findings));
            }
        }
    }
    let traces = Traces::new(&items, names.spellings);
    let mut program = Program::empty(Format::Ladder);
    program.name = sections.program;
    program.routines = sections.routines;
    program.declarations = declared.all;
    findings
        .iter_mut()
        .for_each(|finding| move_to_file(finding, source));
    let reading = Reading {
        program: program.into(),
        diagnostics: findings,
    };
    (reading, traces)
}

/// How often the statements spell each name that ends in the pin of a timer or
/// counter.
pub(super) fn pins<'s>(
    text: &str,
    statements: impl Iterator<Item = &'s Statement>,
) -> HashMap<String, usize> {
    let mut pins = HashMap::new();
    for token in statements.flat_map(|statement| &statement.tokens) {
        let name = token.name(text);
        if is_code(token) && (name.ends_with(".Q") || name.ends_with(".DN")) {
            *pins.entry(name.to_owned()).or_default() += 1;
        }
    }
    pins
}

/// A rung as it is written, among the pieces of its text.
pub(super) struct Written<'i> {
    pub(super) rung: RungText,
    pub(super) statement: &'i Statement,
    /// All pieces before it.
    pub(super) before: &'i [Item],
}

impl Written<'_> {
    /// The rung, drawn.
    pub(super) fn drawn(
        &self,
        number: u32,
        source: Source<'_>,
        names: &mut Names<'_>,
        findings: &mut Vec<Diagnostic>,
    ) -> Rung {
        let Self {
            rung,
            statement,
            before,
        } = self;
        let span = statement.span();
        Rung::new(
            number,
            comment(source.text, rung, before, statement),
            network(rung, span, source, names, findings),
            place(source, span),
        )
    }
}

/// The comment lines that end the pieces, from the last to the first.
pub(super) fn comments_at_end<'t>(text: &'t str, items: &[Item]) -> Vec<&'t str> {
    let comments = items.iter().rev().map_while(|item| match item {
        Item::Comment(comment) => Some(comment_text(text, *comment)),
        _ => None,
    });
    comments.collect()
}

/// The title, then the comment lines right above, then the comment behind.
fn comment(text: &str, rung: &RungText, before: &[Item], statement: &Statement) -> Option<Name> {
    let above = comments_at_end(text, before);
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
pub(super) fn without_output(rung: &RungText, span: Span) -> Option<Diagnostic> {
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
pub(super) fn move_to_file(finding: &mut Diagnostic, source: Source<'_>) {
    finding.span = place(source, finding.span);
    for related in &mut finding.related {
        related.span = place(source, related.span);
    }
}
