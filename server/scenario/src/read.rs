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

/// Whether `text` looks like a scenario: it begins with lines that could begin
/// nothing else, or some line expects something of a step.
pub fn is_scenario(text: &str) -> bool {
    let body = text.trim_start_matches('\u{feff}');
    let mut raw_lines = body.lines().filter(|raw| {
        let raw = raw.trim_start();
        !raw.is_empty() && !raw.starts_with("//")
    });
    let first_sign = raw_lines.by_ref().map(sign).find(|it| *it != Sign::Open);
    match first_sign {
        Some(Sign::Scenario) => true,
        Some(_) => raw_lines.any(|raw| raw.contains("=>") && sign(raw) == Sign::Scenario),
        None => false,
    }
}

/// What a line says about the text that it stands in.
#[derive(PartialEq)]
enum Sign {
    Scenario,
    /// It could stand in a scenario, and elsewhere.
    Open,
    Other,
}

fn sign(raw: &str) -> Sign {
    let Some(line) = lines(raw).into_iter().find(|it| !it.tokens.is_empty()) else {
        return Sign::Open;
    };
    let is_quoted = |at: usize| {
        let token = line.tokens.get(at);
        token.is_some_and(|token| token.kind == TokenKind::Quoted)
    };
    match statement(raw, &line) {
        Ok(Statement::Timing(_) | Statement::Cycle(_)) => Sign::Scenario,
        Ok(Statement::Title(_)) if is_quoted(1) => Sign::Scenario,
        Ok(Statement::Title(_)) | Err(_) => Sign::Other,
        Ok(Statement::Files(_)) => Sign::Open,
        Ok(Statement::Step(step)) => {
            let is_bit = |change: &Change| matches!(change.value, Datum::Bool(_));
            let is_sign = step.only
                || !step.expected.is_empty()
                || step.changes.iter().any(is_bit)
                || matches!(step.passing, Passing::Wait(_));
            if is_sign { Sign::Scenario } else { Sign::Open }
        }
    }
}
