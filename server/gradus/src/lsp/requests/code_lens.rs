//! `textDocument/codeLens`.

use serde_json::json;
use tower_lsp::ls_types::{CodeLens, Command};

use super::command::OPEN_SPEC;
use crate::lsp::query::Query;

/// The lenses of a document.
pub fn answer(query: &Query) -> Option<Vec<CodeLens>> {
    if !query.config().code_lens.enable {
        return None;
    }
    let pair = query.pair();
    let weakest = query.weakest();
    let ladder = pair.ladder()?;
    let lenses = match query.spec() {
        Some(spec) => ide::lenses_in_spec(spec, ladder, weakest),
        None => ide::lenses_in_ladder(ladder, pair.spec().map(|it| &**it), weakest),
    };
    let argument = json!({ "uri": pair.ladder.as_ref()?.uri });
    let lenses = lenses.into_iter().map(|lens| {
        let start = query.range(lens.span).start;
        CodeLens {
            range: tower_lsp::ls_types::Range::new(start, start),
            command: Some(Command {
                title: lens.title,
                command: OPEN_SPEC.to_owned(),
                arguments: Some(vec![argument.clone()]),
            }),
            data: None,
        }
    });
    Some(lenses.collect())
}
