//! Findings, told without being asked.

use std::collections::HashSet;
use std::sync::Arc;

use source::{Code, Severity, codes};
use tower_lsp::ls_types::{
    CodeDescription, Diagnostic, DiagnosticRelatedInformation, DiagnosticSeverity, DiagnosticTag,
    NumberOrString, Uri,
};

use super::document::Document;
use super::virtual_document;
use super::world::World;

/// Everything there is to say about a document, as the client shows it.
pub fn diagnostics(world: &World, document: &Arc<Document>) -> Vec<Diagnostic> {
    if !world.config.diagnostics.enable {
        return Vec::new();
    }
    let ignored: HashSet<Code> = world
        .config
        .diagnostics
        .ignore
        .iter()
        .filter_map(|code| Code::parse(code))
        .collect();
    let found = document.findings(world);
    found
        .iter()
        .filter(|finding| !ignored.contains(&finding.code))
        .map(|finding| diagnostic(world, document, finding))
        .collect()
}

/// A finding in the protocol's types.
pub fn diagnostic(world: &World, document: &Document, finding: &source::Diagnostic) -> Diagnostic {
    let encoding = world.encoding();
    let related = finding
        .related
        .iter()
        .map(|related| DiagnosticRelatedInformation {
            location: document.location(related.span, encoding),
            message: related.message.clone(),
        });
    let related: Vec<_> = related.collect();
    let message = match &finding.help {
        Some(help) => format!("{}\n{help}", finding.message),
        None => finding.message.clone(),
    };
    Diagnostic {
        range: encoding.range(&document.rope, finding.span),
        severity: Some(severity(finding.severity)),
        code: Some(NumberOrString::String(finding.code.to_string())),
        code_description: page(world, finding.code).map(|href| CodeDescription { href }),
        source: Some("gradus".to_owned()),
        message,
        related_information: (!related.is_empty()).then_some(related),
        tags: (finding.code == codes::UNREACHABLE_RUNG).then(|| vec![DiagnosticTag::UNNECESSARY]),
        data: None,
    }
}

/// The address of the page that explains a code, for clients that show
/// documents which the server makes.
fn page(world: &World, code: Code) -> Option<Uri> {
    let shown = world.abilities.virtual_documents;
    shown.then(|| virtual_document::page(code))?
}

fn severity(severity: Severity) -> DiagnosticSeverity {
    match severity {
        Severity::Error => DiagnosticSeverity::ERROR,
        Severity::Warning => DiagnosticSeverity::WARNING,
        Severity::Information => DiagnosticSeverity::INFORMATION,
        Severity::Hint => DiagnosticSeverity::HINT,
    }
}
