//! The table of a scenario's scans, as `gradus simulate` prints it.

use std::sync::Arc;

use ide::Run;
use source::{Diagnostic, LineIndex};
use tower_lsp::ls_types::Uri;

use super::document::Document;
use super::plant::Plant;
use super::virtual_document;
use super::world::World;
use crate::colour::Paint;
use crate::command::simulate::{summary, table};
use crate::report::{self, Findings};

/// The scheme of the addresses of tables.
pub const SCHEME: &str = "gradus-simulation";

/// The address of the table of the scenario at `uri`.
pub fn address(uri: &Uri) -> Option<Uri> {
    virtual_document::made_of(SCHEME, uri, "txt")
}

/// What came of a scenario, for people.
pub struct Simulated {
    /// The table of its scans; of a scenario that cannot be run, why.
    pub text: String,
    /// How it went, in a line.
    pub summary: String,
    /// Whether all is as expected.
    pub passed: bool,
}

/// What came of the scenario in `document`.
pub fn simulated(world: &World, document: &Arc<Document>) -> Option<Simulated> {
    let scenario = document.scenario()?;
    let plant = Plant::of(world, document)?;
    let run = world.runs.run(document, scenario, &plant);
    let text = document.rope.to_string();
    let lines = LineIndex::new(text.as_bytes());
    let line_of = |step: usize| {
        let span = scenario.steps().get(step)?.span;
        Some(lines.locate(text.as_bytes(), span.range().start).line)
    };
    let subject = ide::subject(plant.run_on());
    let Some(simulation) = &run.simulation else {
        return Some(not_run(document, &plant, &run, text));
    };
    let read = &scenario.reading.scenario;
    let summary = summary::summary(read, simulation, subject, line_of);
    let table = table::table(read, simulation, subject, line_of, Paint::PLAIN);
    Some(Simulated {
        text: format!("{table}\n{summary}"),
        summary: summary.trim_end().to_owned(),
        passed: simulation.failures().next().is_none() && simulation.agrees(),
    })
}

/// Why a scenario cannot be run.
fn not_run(document: &Document, plant: &Plant, run: &Run, text: String) -> Simulated {
    let scenario = document.scenario();
    let found = scenario.map_or(Vec::new(), |it| run.findings(it, plant.run_on()));
    let found = found.into_iter().map(|it| it.diagnostic);
    let found: Vec<Diagnostic> = plant.trouble.iter().cloned().chain(found).collect();
    let summary = match found.is_empty() {
        true => "there is neither a ladder nor a spec to run".to_owned(),
        false => "the scenario has mistakes and was not run".to_owned(),
    };
    let name = document.key.name();
    let findings = Findings::new(name.into(), text.into_bytes(), found);
    Simulated {
        text: format!("{}{summary}\n", report::text(&findings, Paint::PLAIN)),
        summary,
        passed: false,
    }
}
