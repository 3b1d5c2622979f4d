//! Findings, told without being asked.

use std::sync::Arc;

use logic::Budget;
use source::{Code, Severity, codes};
use tower_lsp::ls_types::{
    CodeDescription, Diagnostic, DiagnosticRelatedInformation, DiagnosticSeverity, DiagnosticTag,
    NumberOrString, Uri,
};

use super::document::Document;
use super::fault;
use super::virtual_document::{self, Page};
use super::world::World;

/// Everything there is to say about a document, as the client shows it.
pub fn diagnostics(world: &World, document: &Arc<Document>, budget: &Budget) -> Vec<Diagnostic> {
    fault::forced(fault::DIAGNOSTICS);
    let found = shown(world, document, budget);
    let found = found.iter();
    found.map(|it| diagnostic(world, document, it)).collect()
}

/// The findings in a document that the user wants to see.
pub fn shown(world: &World, document: &Document, budget: &Budget) -> Vec<source::Diagnostic> {
    let wanted = world.config(&document.key).diagnostics;
    if !wanted.enable {
        return Vec::new();
    }
    let ignored = wanted.ignored();
    let mut found = document.findings(world, budget);
    found.retain(|it| !ignored.contains(&it.code));
    found
}

/// A finding in the protocol's types. To a client that does not show other
/// places, the message tells of them.
pub fn diagnostic(world: &World, document: &Document, finding: &source::Diagnostic) -> Diagnostic {
    let (encoding, abilities) = (world.encoding(), &world.abilities);
    let related = finding
        .related
        .iter()
        .map(|related| DiagnosticRelatedInformation {
            location: document.location(related.span, encoding),
            message: related.message.clone(),
        });
    let related: Vec<_> = related.collect();
    let mut message = finding.message.clone();
    if !abilities.related_places {
        message.extend(related.iter().map(line));
    }
    if let Some(help) = &finding.help {
        message += &format!("\n{help}");
    }
    let shows_places = abilities.related_places && !related.is_empty();
    let could_go = abilities.unnecessary && finding.code == codes::UNREACHABLE_RUNG;
    Diagnostic {
        range: encoding.range(&document.rope, finding.span),
        severity: Some(severity(finding.severity)),
        code: Some(NumberOrString::String(finding.code.to_string())),
        code_description: page(world, finding.code).map(|href| CodeDescription { href }),
        source: Some("gradus".to_owned()),
        message,
        related_information: shows_places.then_some(related),
        tags: could_go.then(|| vec![DiagnosticTag::UNNECESSARY]),
        data: None,
    }
}

/// Another place that belongs to a finding, as a line of its message.
fn line(related: &DiagnosticRelatedInformation) -> String {
    let line = related.location.range.start.line + 1;
    format!("\nline {line}: {}", related.message)
}

/// The address of the page that explains a code, for clients that show
/// documents which the server makes.
fn page(world: &World, code: Code) -> Option<Uri> {
    let shown = world.abilities.code_pages && world.abilities.virtual_documents;
    shown.then(|| virtual_document::page(Page::Code(code)))?
}

fn severity(severity: Severity) -> DiagnosticSeverity {
    match severity {
        Severity::Error => DiagnosticSeverity::ERROR,
        Severity::Warning => DiagnosticSeverity::WARNING,
        Severity::Information => DiagnosticSeverity::INFORMATION,
        Severity::Hint => DiagnosticSeverity::HINT,
    }
}
