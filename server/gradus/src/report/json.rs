//! Findings as JSON for scripts. The keys are part of the command line's
//! promise: see the help of `gradus check`.

use serde_json::{Value, json as value};
use source::{Diagnostic, Fix, Related, Span};

use super::Findings;
use crate::input;

/// The findings of all files, in one document.
pub fn json(all: &[Findings]) -> Value {
    let diagnostics: Vec<_> = all.iter().flat_map(of_file).collect();
    value!({ "diagnostics": diagnostics })
}

fn of_file(findings: &Findings) -> impl Iterator<Item = Value> {
    findings
        .diagnostics
        .iter()
        .map(move |diagnostic| finding(findings, diagnostic))
}

fn finding(findings: &Findings, diagnostic: &Diagnostic) -> Value {
    let start = findings.start(diagnostic.span);
    let related: Vec<_> = diagnostic
        .related
        .iter()
        .map(|related| place(findings, related))
        .collect();
    value!({
        "file": input::name(&findings.path),
        "code": diagnostic.code.to_string(),
        "severity": diagnostic.severity.word(),
        "message": diagnostic.message,
        "help": diagnostic.help,
        "span": bytes(diagnostic.span),
        "line": start.line,
        "column": start.column,
        "related": related,
        "fix": diagnostic.fix.as_ref().map(change),
    })
}

fn place(findings: &Findings, related: &Related) -> Value {
    let start = findings.start(related.span);
    value!({
        "message": related.message,
        "span": bytes(related.span),
        "line": start.line,
        "column": start.column,
    })
}

fn change(fix: &Fix) -> Value {
    let edits: Vec<_> = fix
        .edits
        .iter()
        .map(|edit| value!({ "span": bytes(edit.span), "text": edit.text }))
        .collect();
    value!({ "title": fix.title, "edits": edits })
}

fn bytes(span: Span) -> Value {
    value!({ "start": span.start, "end": span.end })
}
