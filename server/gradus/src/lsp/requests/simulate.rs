//! The commands about scenarios: show the table of all scans, show one scan in
//! ladder and spec, show none any more.

use serde_json::{Value, json};
use tower_lsp::ls_types::Position;

use crate::lsp::query::Query;
use crate::lsp::simulation;
use crate::lsp::world::{Chosen, Scan};

/// Shows the scans of a scenario.
pub const SIMULATE: &str = "gradus.simulate";

/// Shows one scan in ladder and spec.
pub const SHOW_SCAN: &str = "gradus.showScan";

/// Shows no scan any more.
pub const HIDE_SCAN: &str = "gradus.hideScan";

/// The table of the scenario's scans, and how it went.
pub fn table(query: &Query) -> Option<Value> {
    let simulated = simulation::simulated(&query.world, &query.document)?;
    Some(json!({
        "title": format!("{}.txt", query.document.key.name()),
        "language": "plaintext",
        "text": simulated.text,
        "uri": simulation::address(&query.document.uri),
        "passed": simulated.passed,
        "summary": simulated.summary,
    }))
}

/// Which scan of a scenario is to be shown.
#[derive(Clone, Copy, Debug)]
pub enum Wanted {
    /// The one that ends the step in a line, from 0.
    EndOfLine(u32),
    /// The one of this number, from 1.
    Number(u64),
}

/// A scan, and what the client is told of it. `None` if there is no such scan, or
/// it was not run.
pub fn scan(query: &Query, wanted: Wanted) -> Option<(Chosen, Value)> {
    let scenario = query.scenario()?;
    let (_, run) = query.run()?;
    let scan = match wanted {
        Wanted::EndOfLine(line) => {
            Scan::EndOf(scenario.step_at(query.offset(Position::new(line, 0)))?)
        }
        Wanted::Number(number) => Scan::Number(number),
    };
    let (step, number) = scan.in_run(&run)?;
    let chosen = Chosen {
        scenario: query.document.key.clone(),
        scan,
    };
    let answer = json!({
        "scan": number,
        "step": step,
        "done": scenario::done(scenario.steps().get(step)?),
    });
    Some((chosen, answer))
}
