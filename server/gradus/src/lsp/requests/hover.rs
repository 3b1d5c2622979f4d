//! `textDocument/hover`.

use ide::Target;
use tower_lsp::ls_types::{Hover, HoverContents, MarkupContent, MarkupKind, Position};

use crate::lsp::query::{Pair, Query, Text};
use crate::lsp::virtual_document::{self, Page};

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
            hover.markdown(&|target| link(query, &pair, target)),
        ),
        false => (MarkupKind::PlainText, hover.plain()),
    };
    Some(Hover {
        contents: HoverContents::Markup(MarkupContent { kind, value }),
        range: Some(query.range(hover.span)),
    })
}

/// The address of a place in the ladder, with its line, or of a page, for
/// clients that lead there. Others would show all of it.
fn link(query: &Query, pair: &Pair, target: Target) -> Option<String> {
    if !query.world.abilities.virtual_documents {
        return None;
    }
    match target {
        Target::Rung(span) => {
            let ladder = pair.ladder.as_ref()?;
            ladder.key.path()?;
            let line = query.encoding().range(&ladder.rope, span).start.line + 1;
            Some(format!("{}#L{line}", ladder.uri.as_str()))
        }
        Target::Page(term) => {
            let page = virtual_document::page(Page::Term(term))?;
            Some(page.as_str().to_owned())
        }
    }
}
