//! What can be done about a difference between a spec and its ladder: keep the
//! sequence that shows it as a scenario, or say that the plant cannot do it.

use ide::{About, Action, Asked, Observed, actions_on_verdict};
use tower_lsp::ls_types::{Uri, WorkspaceEdit};

use crate::lsp::edit::Changes;
use crate::lsp::key::{FileKey, in_folder_of};
use crate::lsp::plant::Plant;
use crate::lsp::query::{Pair, Query};
use crate::lsp::verdicts::verdict;

/// Scenarios that are asked what was seen at the plant.
const MOST_OBSERVED: usize = 32;

/// Names that are tried for a new scenario.
const MOST_NAMES: u32 = 1_000;

/// What can be done about a difference between the spec and its ladder.
pub fn actions(query: &Query, pair: &Pair, asked: Asked<'_>) -> Vec<Action> {
    let verdict = verdict(&query.world, pair);
    let judged = verdict.as_deref().and_then(|it| pair.judged(it));
    let observed = || {
        let scenarios = query.world.scenarios_of(pair);
        let seen = scenarios.iter().take(MOST_OBSERVED).filter_map(|document| {
            let plant = Plant::of(&query.world, document)?;
            let run = query.world.runs.run(document, document.scenario()?, &plant);
            // Of the spec alone nobody knows what the plant's ladder did.
            plant.pair.ladder.as_ref()?;
            Some(Observed::of(run.simulation.as_ref()?))
        });
        seen.collect()
    };
    judged.map_or_else(Vec::new, |it| actions_on_verdict(it, &observed, asked))
}

/// The edit that makes a scenario of a sequence, beside the spec.
pub fn trace_edit(query: &Query, pair: &Pair, title: &str, about: &About) -> Option<WorkspaceEdit> {
    let verdict = verdict(&query.world, pair)?;
    let (ladder, spec) = (pair.ladder.as_ref()?, pair.spec.as_ref()?);
    let files = [ladder.key.name(), spec.key.name()];
    let text = ide::trace_scenario(pair.judged(&verdict)?, about, &files)?;
    let name = spec.key.name();
    let stem = name.rsplit_once('.').map_or(&*name, |(stem, _)| stem);
    let mut places = (1..MOST_NAMES)
        .filter_map(|number| in_folder_of(&spec.uri, &ide::trace_name(stem, number)));
    let is_free = |uri: &Uri| {
        let key = FileKey::of(uri);
        let on_disk = key.path().is_some_and(std::path::Path::exists);
        !on_disk && !query.world.open.contains_key(&key)
    };
    let mut edit = Changes::new(title);
    edit.create(places.find(is_free)?, text);
    Some(edit.workspace_edit(&query.world))
}
