//! The command that verifies, the text that shows what was found, and how that is
//! said above the spec.

use std::sync::Arc;

use ide::Verdict;
use serde_json::{Value, json};
use tower_lsp::ls_types::Uri;

use crate::colour::Paint;
use crate::command::verify::text;
use crate::lsp::query::Pair;
use crate::lsp::verdicts::{Known, Outcome, Standing};
use crate::lsp::virtual_document::made_of;
use crate::lsp::world::World;
use crate::report::printable;

/// Finds out whether a spec does what its ladder does.
pub const VERIFY: &str = "gradus.verify";

/// The scheme of the addresses of verdicts.
pub const SCHEME: &str = "gradus-verdict";

/// The address of the verdict about the spec at `uri`.
fn address(uri: &Uri) -> Option<Uri> {
    made_of(SCHEME, uri, "txt")
}

/// What the client is told of what was found.
pub fn answer(pair: &Pair, known: &Known) -> Option<Value> {
    let spec = pair.spec.as_ref()?;
    let standing = Standing::Known(known.outcome.clone());
    Some(json!({
        "title": format!("{}.txt", spec.key.name()),
        "language": "plaintext",
        "text": told(pair, &standing),
        "uri": address(&spec.uri),
        "verdict": word(&standing),
        "summary": line(&standing),
    }))
}

/// The text of the verdict about a spec, as it is known now.
pub fn shown(world: &World, pair: &Pair) -> Option<String> {
    let settings = world.config(&pair.spec.as_ref()?.key).verify;
    Some(told(pair, &world.verdicts.standing(pair, &settings)))
}

/// What was found, as `gradus verify` prints it.
fn told(pair: &Pair, standing: &Standing) -> String {
    let found = match standing {
        Standing::Known(Outcome::Found(verdict)) => Some(Arc::clone(verdict)),
        _ => None,
    };
    match (found.as_deref(), pair.ladder()) {
        (Some(Ok(found)), Some(ladder)) => text::text(found, ladder.program(), Paint::PLAIN),
        (Some(Err(refusal)), _) => {
            let name = pair.ladder.as_ref().map(|it| it.key.name());
            let name = printable(&name.unwrap_or_default());
            format!(
                "{name}: cannot be verified: {}\n",
                printable(&refusal.to_string())
            )
        }
        _ => format!("{}\n", line(standing)),
    }
}

/// How a pair stands, in a word for programs.
pub fn word(standing: &Standing) -> &'static str {
    match standing {
        Standing::Open => "proving",
        Standing::Unasked => "unasked",
        Standing::Known(Outcome::Found(verdict)) => ide::verdict_word(verdict),
        Standing::Known(Outcome::Stopped) => "stopped",
        Standing::Known(Outcome::Mistaken) => "mistaken",
    }
}

/// The same in a line for people.
pub fn line(standing: &Standing) -> String {
    match standing {
        Standing::Open => "proving …".to_owned(),
        Standing::Unasked => "not verified".to_owned(),
        Standing::Known(Outcome::Found(verdict)) => said(verdict),
        Standing::Known(Outcome::Stopped) => "proof stopped".to_owned(),
        Standing::Known(Outcome::Mistaken) => {
            "not verified: the ladder or the spec has errors".to_owned()
        }
    }
}

fn said(verdict: &Verdict) -> String {
    printable(&ide::verdict_line(verdict))
}
