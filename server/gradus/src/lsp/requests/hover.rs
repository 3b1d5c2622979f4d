//! `textDocument/hover`.

use source::Span;
use tower_lsp::ls_types::{Hover, HoverContents, MarkupContent, MarkupKind, Position};

use crate::lsp::query::{Pair, Query, Text};

/// What is known of the thing at a position.
pub fn answer(query: &Query, at: Position) -> Option<Hover> {
    let offset = query.offset(at);
    let pair = query.pair();
    let both = pair.looked_at();
    let hover = match query.text()? {
        Text::Ladder(ladder) => ide::hover_in_ladder(ladder, both.spec, offset, &query.budget),
        Text::Spec(spec) => ide::hover_in_spec(spec, both.ladder, offset, &query.budget),
        Text::Scenario(scenario) => {
            let (plant, run) = query.run()?;
            let own = ide::RunOn {
                run_on: plant.run_on(),
                run: &run,
            };
            ide::hover_in_scenario(scenario, both, own, offset, &query.budget)
        }
    }?;
    let (kind, value) = match query.world.abilities.markdown {
        true => (
            MarkupKind::Markdown,
            hover.markdown(&|span| link(query, &pair, span)),
        ),
        false => (MarkupKind::PlainText, hover.plain()),
    };
    Some(Hover {
        contents: HoverContents::Markup(MarkupContent { kind, value }),
        range: Some(query.range(hover.span)),
    })
}

/// The address of a place in the ladder, with its line, for clients that lead
/// there. Others would show all of it.
fn link(query: &Query, pair: &Pair, span: Span) -> Option<String> {
    let ladder = pair.ladder.as_ref()?;
    let leads = query.world.abilities.virtual_documents && ladder.key.path().is_some();
    let line = query.encoding().range(&ladder.rope, span).start.line + 1;
    leads.then(|| format!("{}#L{line}", ladder.uri.as_str()))
}
