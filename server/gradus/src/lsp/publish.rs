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
use super::plant::Plant;
use super::query::Pair;
use super::verdicts::verdict;
use super::virtual_document::{self, Page};
use super::world::World;

/// Everything there is to say about a document, as the client shows it.
pub fn diagnostics(world: &World, document: &Arc<Document>, budget: &Budget) -> Vec<Diagnostic> {
    fault::forced(fault::DIAGNOSTICS);
    let found = findings(world, document, budget).into_iter();
    found
        .map(|(finding, elsewhere)| diagnostic(world, document, &finding, elsewhere))
        .collect()
}

/// The findings in a document that the user wants to see.
pub fn shown(world: &World, document: &Arc<Document>, budget: &Budget) -> Vec<source::Diagnostic> {
    let found = findings(world, document, budget).into_iter();
    found.map(|(finding, _)| finding).collect()
}

/// The same, each with the places in other documents that belong to it.
fn findings(
    world: &World,
    document: &Arc<Document>,
    budget: &Budget,
) -> Vec<(source::Diagnostic, Vec<DiagnosticRelatedInformation>)> {
    let wanted = world.config(&document.key).diagnostics;
    if !wanted.enable {
        return Vec::new();
    }
    let ignored = wanted.ignored();
    let mut found = match Plant::of(world, document) {
        Some(plant) => in_scenario(world, document, &plant),
        None => {
            let found = document.findings(world, budget).into_iter();
            let own = found.map(|finding| (finding, Vec::new()));
            let mut all: Vec<_> = own.chain(of_verdict(world, document)).collect();
            all.sort_by_key(|(finding, _)| (finding.span, finding.code));
            all
        }
    };
    found.retain(|(finding, _)| !ignored.contains(&finding.code));
    found
}

/// What there is to say about a spec since it is known whether it does what its
/// ladder does.
fn of_verdict(
    world: &World,
    document: &Arc<Document>,
) -> Vec<(source::Diagnostic, Vec<DiagnosticRelatedInformation>)> {
    if document.spec().is_none() {
        return Vec::new();
    }
    let pair = Pair::of(world, document);
    let Some(verdict) = verdict(world, &pair) else {
        return Vec::new();
    };
    let Some(judged) = pair.judged(&verdict) else {
        return Vec::new();
    };
    let found = ide::verdict_findings(judged).into_iter();
    found
        .map(|it| it.finding)
        .map(|it| in_protocol(world, &pair, it))
        .collect()
}

/// A finding, its places in other documents as the protocol has them.
fn in_protocol(
    world: &World,
    pair: &Pair,
    finding: ide::Finding,
) -> (source::Diagnostic, Vec<DiagnosticRelatedInformation>) {
    let elsewhere = |(target, message): (ide::navigate::Target, String)| {
        let other = pair.document(target.side)?;
        Some(DiagnosticRelatedInformation {
            location: other.location(target.name, world.encoding()),
            message,
        })
    };
    let related = finding.related.into_iter().filter_map(elsewhere);
    (finding.diagnostic, related.collect())
}

/// What there is to say about a scenario.
fn in_scenario(
    world: &World,
    document: &Arc<Document>,
    plant: &Plant,
) -> Vec<(source::Diagnostic, Vec<DiagnosticRelatedInformation>)> {
    let Some(scenario) = document.scenario() else {
        return Vec::new();
    };
    let run = world.runs.run(document, scenario, plant);
    let found = run.findings(scenario, plant.run_on()).into_iter();
    let trouble = plant.trouble.iter().cloned();
    let trouble = trouble.map(|finding| (finding, Vec::new()));
    trouble
        .chain(found.map(|it| in_protocol(world, &plant.pair, it)))
        .collect()
}

/// A finding in the protocol's types, with the places in other documents that
/// belong to it. To a client that does not show other places, the message tells
/// of them.
pub fn diagnostic(
    world: &World,
    document: &Document,
    finding: &source::Diagnostic,
    elsewhere: Vec<DiagnosticRelatedInformation>,
) -> Diagnostic {
    let (encoding, abilities) = (world.encoding(), &world.abilities);
    let mut message = finding.message.clone();
    if !abilities.related_places {
        message.extend(elsewhere.iter().map(line_elsewhere));
    }
    let related = finding
        .related
        .iter()
        .map(|related| DiagnosticRelatedInformation {
            location: document.location(related.span, encoding),
            message: related.message.clone(),
        });
    let mut related: Vec<_> = related.collect();
    if !abilities.related_places {
        message.extend(related.iter().map(line));
    }
    related.extend(elsewhere);
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

/// The same of a place in another document.
fn line_elsewhere(related: &DiagnosticRelatedInformation) -> String {
    let file = super::key::FileKey::of(&related.location.uri).name();
    let line = related.location.range.start.line + 1;
    format!("\n{file}, line {line}: {}", related.message)
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
