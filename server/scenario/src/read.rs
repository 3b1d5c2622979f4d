use logic::Datum;
use logic::notation::TokenKind;
use source::{Diagnostic, codes};

use crate::lines::{Line, lines};
use crate::parse::{Statement, statement};
use crate::{Change, Passing, Scenario};

/// A scenario, and what there is to say about its text.
#[derive(Clone, Debug, PartialEq)]
pub struct Reading {
    /// What was understood.
    pub scenario: Scenario,
    /// What was not, in the order of the text.
    pub diagnostics: Vec<Diagnostic>,
}

/// Reads a scenario. A line that is not understood is reported and spoils no
/// other.
pub fn read(text: &str) -> Reading {
    let mut scenario = Scenario::default();
    let mut diagnostics = Vec::new();
    let mut said: Vec<&'static str> = Vec::new();
    for line in lines(text) {
        if line.tokens.is_empty() {
            continue;
        }
        let statement = match statement(text, &line) {
            Ok(statement) => statement,
            Err(problem) => {
                let message = format!("line not understood: {}", problem.message);
                // An empty place cannot be seen: show the sign before it.
                let last = line.tokens.last().map_or(line.span, |token| token.span);
                let span = match problem.span.is_empty() {
                    true => last,
                    false => problem.span,
                };
                let help = "a step is written `on a, off b, wait 5s => on q`";
                diagnostics.push(Diagnostic::new(codes::SCENARIO_SYNTAX, span, message).help(help));
                continue;
            }
        };
        if let Some(word) = statement.word() {
            if let Some(message) = misplaced(word, &said, &scenario) {
                let span = line.statement_span();
                diagnostics.push(Diagnostic::new(codes::SCENARIO_SYNTAX, span, message));
                continue;
            }
            said.push(word);
        }
        apply(&mut scenario, statement, text, &line);
    }
    Reading {
        scenario,
        diagnostics,
    }
}

fn misplaced(word: &str, said: &[&str], scenario: &Scenario) -> Option<String> {
    if said.contains(&word) {
        return Some(format!("a second `{word}`; this one does not count"));
    }
    (!scenario.steps.is_empty())
        .then(|| format!("`{word}` after the first step does not count; it belongs to the head"))
}

fn apply(scenario: &mut Scenario, statement: Statement, text: &str, line: &Line) {
    match statement {
        Statement::Title(title) => scenario.title = Some(title),
        Statement::Files(files) => scenario.files = files,
        Statement::Timing(timing) => scenario.timing = timing,
        Statement::Cycle(time) => scenario.cycle_ms = time,
        Statement::Step(mut step) => {
            step.comment = line.said(text).map(Into::into);
            scenario.steps.push(step);
        }
    }
}

/// Whether `text` looks like a scenario: its first line that says anything
/// could begin nothing else, or some line expects something of a step.
pub fn is_scenario(text: &str) -> bool {
    let lines = lines(text);
    let mut lines = lines.iter().filter(|line| !line.tokens.is_empty());
    let says = |line: &Line| statement(text, line).ok();
    let expects = |line: &Line| {
        says(line).is_some_and(
            |said| matches!(said, Statement::Step(step) if step.only || !step.expected.is_empty()),
        )
    };
    let Some(first) = lines.next() else {
        return false;
    };
    let begins = match says(first) {
        Some(Statement::Title(_)) => {
            let title = first.tokens.get(1);
            title.is_some_and(|title| title.kind == TokenKind::Quoted)
        }
        Some(Statement::Timing(_) | Statement::Cycle(_)) => true,
        Some(Statement::Step(step)) => {
            let is_bit = |change: &Change| matches!(change.value, Datum::Bool(_));
            step.changes.iter().any(is_bit) || matches!(step.passing, Passing::Wait(_))
        }
        Some(Statement::Files(_)) | None => false,
    };
    begins || expects(first) || lines.any(expects)
}
