//! Findings as SARIF 2.1.0 (OASIS), which code-review tools show beside the
//! lines of a change. Comments name the clause that a choice follows.
//!
//! Nothing in it depends on the day or the machine.

use std::path::Path;

use serde_json::{Map, Value, json as value};
use source::{Code, Diagnostic, Fix, Severity, Span, codes};

use super::{Findings, uri};
use crate::file::Unreadable;
use crate::io::is_standard_input;

const SCHEMA: &str =
    "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json";

/// One run over all files. `root` is the folder that paths are given from.
pub fn sarif(
    all: &[Findings],
    unreadable: &[(std::path::PathBuf, Unreadable)],
    root: &Path,
) -> Value {
    let results: Vec<_> = all
        .iter()
        .flat_map(|findings| {
            let result = move |diagnostic| result(findings, diagnostic, root);
            findings.diagnostics.iter().map(result)
        })
        .collect();
    let notifications: Vec<_> = unreadable
        .iter()
        .map(|(path, reason)| notification(path, &reason.diagnostic(), root))
        .collect();
    value!({
        "$schema": SCHEMA,
        "version": "2.1.0",
        "runs": [{
            "tool": { "driver": driver() },
            "invocations": [{
                "executionSuccessful": unreadable.is_empty(),
                "toolExecutionNotifications": notifications,
            }],
            // 3.14.17 and 3.14.23: how lines and columns were counted.
            "columnKind": "unicodeCodePoints",
            "newlineSequences": ["\r\n", "\n", "\r"],
            "results": results,
        }],
    })
}

/// 3.19: what found it, with a rule for every code.
fn driver() -> Value {
    let rules: Vec<_> = codes::ALL.iter().map(|code| rule(*code)).collect();
    value!({
        "name": "gradus",
        "semanticVersion": env!("CARGO_PKG_VERSION"),
        "rules": rules,
    })
}

fn rule(code: Code) -> Value {
    value!({
        "id": code.to_string(),
        "name": pascal_case(code.title()),
        "shortDescription": { "text": sentence(code.title()) },
        "help": { "text": code.page(), "markdown": code.page() },
        "defaultConfiguration": { "level": level(code.severity()) },
    })
}

fn result(findings: &Findings, diagnostic: &Diagnostic, root: &Path) -> Value {
    let mut result = Map::new();
    result.insert("ruleId".into(), diagnostic.code.to_string().into());
    result.insert("ruleIndex".into(), rule_index(diagnostic.code).into());
    result.insert("level".into(), level(diagnostic.severity).into());
    result.insert("message".into(), message(diagnostic));
    let here = value!([{ "physicalLocation": physical(findings, diagnostic.span, root) }]);
    result.insert("locations".into(), here);
    if !diagnostic.related.is_empty() {
        let related = diagnostic.related.iter().map(|related| {
            value!({
                "physicalLocation": physical(findings, related.span, root),
                "message": { "text": related.message },
            })
        });
        result.insert("relatedLocations".into(), related.collect());
    }
    if let Some(fix) = &diagnostic.fix {
        result.insert("fixes".into(), value!([change(findings, fix, root)]));
    }
    result.into()
}

/// 3.58: a condition met while running, here a file that could not be read.
fn notification(path: &Path, diagnostic: &Diagnostic, root: &Path) -> Value {
    value!({
        "level": level(diagnostic.severity),
        "message": message(diagnostic),
        "associatedRule": {
            "id": diagnostic.code.to_string(),
            "index": rule_index(diagnostic.code),
        },
        "locations": [{ "physicalLocation": { "artifactLocation": artifact(path, root) } }],
    })
}

fn message(diagnostic: &Diagnostic) -> Value {
    let text = match &diagnostic.help {
        Some(help) => format!("{}\nHelp: {help}", diagnostic.message),
        None => diagnostic.message.clone(),
    };
    value!({ "text": text })
}

fn physical(findings: &Findings, span: Span, root: &Path) -> Value {
    value!({
        "artifactLocation": artifact(&findings.path, root),
        "region": region(findings, span),
    })
}

/// 3.30: lines and columns count from 1, and the end column is one past the
/// last character.
fn region(findings: &Findings, span: Span) -> Value {
    let start = findings.start(span);
    let end = findings.end(span);
    value!({
        "startLine": start.line,
        "startColumn": start.column,
        "endLine": end.line,
        "endColumn": end.column,
        "byteOffset": span.start,
        "byteLength": span.len(),
    })
}

fn artifact(path: &Path, root: &Path) -> Value {
    if is_standard_input(path) {
        value!({ "uri": "stdin" })
    } else {
        value!({ "uri": uri::of(path, root) })
    }
}

fn change(findings: &Findings, fix: &Fix, root: &Path) -> Value {
    let replacements: Vec<_> = fix
        .edits
        .iter()
        .map(|edit| {
            value!({
                "deletedRegion": region(findings, edit.span),
                "insertedContent": { "text": edit.text },
            })
        })
        .collect();
    value!({
        "description": { "text": fix.title },
        "artifactChanges": [{
            "artifactLocation": artifact(&findings.path, root),
            "replacements": replacements,
        }],
    })
}

fn rule_index(code: Code) -> usize {
    codes::ALL.binary_search(&code).unwrap_or_default()
}

/// 3.27.10 knows no hints.
fn level(severity: Severity) -> &'static str {
    match severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
        Severity::Information | Severity::Hint => "note",
    }
}

/// `XML is not well formed` as `XmlIsNotWellFormed`.
fn pascal_case(title: &str) -> String {
    title
        .split(|character: char| !character.is_alphanumeric())
        .flat_map(|word| {
            let lower = word.to_lowercase();
            let mut rest = lower.chars();
            let first = rest.next().map(|first| first.to_ascii_uppercase());
            first.into_iter().chain(rest).collect::<Vec<_>>()
        })
        .collect()
}

fn sentence(title: &str) -> String {
    let mut characters = title.chars();
    let first = characters.next().map(|first| first.to_ascii_uppercase());
    first.into_iter().chain(characters).chain(['.']).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rule_has_a_name_a_sentence_and_a_page() {
        let rule = rule(codes::XML_SYNTAX);
        assert_eq!(rule["name"], "XmlIsNotWellFormed");
        assert_eq!(rule["shortDescription"]["text"], "XML is not well formed.");
        assert_eq!(rule["help"]["markdown"], codes::XML_SYNTAX.page());
    }

    #[test]
    fn every_code_finds_its_rule() {
        for (index, code) in codes::ALL.iter().enumerate() {
            assert_eq!(rule_index(*code), index);
        }
    }

    #[test]
    fn a_region_counts_bytes_and_characters() {
        let text = "ä\r\nöb".as_bytes().to_vec();
        let findings = Findings::new("tank.ladder".into(), text, Vec::new());
        let expected = value!({
            "startLine": 2, "startColumn": 2, "endLine": 2, "endColumn": 3,
            "byteOffset": 6, "byteLength": 1,
        });
        assert_eq!(region(&findings, Span::new(6, 7)), expected);
    }
}
