//! `textDocument/inlayHint`.

use std::sync::Arc;

use ide::Hint;
use source::Span;
use tower_lsp::ls_types::{InlayHint, InlayHintLabel, InlayHintTooltip, Range};

use crate::lsp::document::Document;
use crate::lsp::plant::Plant;
use crate::lsp::query::{Query, Text};

/// The hints in a ladder or a spec while a scan is shown that it has run in:
/// where power went, which steps are active. They take the place of all others.
fn of_chosen_scan(query: &Query, span: Span) -> Option<Vec<Hint>> {
    let chosen = query.world.chosen.as_ref()?;
    let open = query.world.open.get(&chosen.scenario).cloned();
    let limit = query.world.config(&chosen.scenario).max_file_size.bytes();
    let document = open.or_else(|| query.world.disk.read(&chosen.scenario, limit))?;
    let scenario = document.scenario()?;
    let plant = Plant::of(&query.world, &document)?;
    let own = &query.document.key;
    let is_here = |it: &Option<Arc<Document>>| it.as_ref().is_some_and(|it| it.key == *own);
    let (in_ladder, in_spec) = (is_here(&plant.pair.ladder), is_here(&plant.pair.spec));
    if !in_ladder && !in_spec {
        return None;
    }
    let run = query.world.runs.run(&document, scenario, &plant);
    let wanted = || !query.budget.cancel.is_cancelled() && !query.document.is_outdated();
    let pair = plant.run_on();
    let (_, scan) = chosen.scan.in_run(&run)?;
    let moment = run.moment(scenario, pair, scan, &wanted)?;
    match in_ladder {
        true => Some(ide::powered_in_ladder(pair.ladder?, &moment, span)),
        false => Some(ide::situation_in_spec(pair.spec?, &moment, span)),
    }
}

/// The hints in a range.
pub fn answer(query: &Query, range: Range) -> Option<Vec<InlayHint>> {
    if !query.config().inlay_hints.enable {
        return None;
    }
    let span = query.encoding().span(&query.document.rope, range);
    let hints = match (of_chosen_scan(query, span), query.text()?) {
        (Some(hints), _) => hints,
        (None, Text::Ladder(ladder)) => ide::hints_in_ladder(ladder, span, &query.budget),
        (None, Text::Spec(spec)) => ide::hints_in_spec(spec, query.pair().ladder()?, span),
        (None, Text::Scenario(scenario)) => {
            let (plant, run) = query.run()?;
            ide::hints_in_scenario(scenario, plant.run_on(), &run, span)
        }
    };
    let hints = hints.into_iter().map(|hint| InlayHint {
        position: query.encoding().position(&query.document.rope, hint.offset),
        label: InlayHintLabel::String(hint.text),
        kind: None,
        text_edits: None,
        tooltip: Some(InlayHintTooltip::String(hint.detail)),
        padding_left: Some(true),
        padding_right: None,
        data: None,
    });
    Some(hints.collect())
}
