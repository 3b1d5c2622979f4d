//! The search for sequences of inputs that show which state follows which, for
//! who asks for it.
//!
//! What is seen is kept with the document: hovers, actions and lenses tell of it
//! until the ladder is edited. It holds for plants that obey the environment rules
//! that the spec has when the search begins.

use std::sync::Arc;

use logic::Cancel;
use proof::Limits;
use recovery::successions::Evidence;
use serde_json::{Value, json};
use tower_lsp::jsonrpc::{Error, Result};
use tower_lsp::ls_types::Uri;
use verification::witness::sights;

use super::document::Document;
use super::key::FileKey;
use super::progress::{self, Work};
use super::query::{Pair, elsewhere};
use super::server::Shared;
use super::shown;
use crate::input::numbered;

/// The command.
pub const SEARCH: &str = "gradus.search";

/// Millions of steps that are worth it for who asks and can stop it: some twenty
/// seconds.
const EFFORT: u64 = 2_000;

/// Searches for the ladder that the ladder or spec at an address belongs to.
pub async fn asked(shared: &Arc<Shared>, uri: Uri) -> Result<Value> {
    let world = shared.state.world();
    let stopped = Cancel::default();
    let name = FileKey::of(&uri).name();
    let work = Work::Sequences(name, stopped.clone());
    let under_way = progress::under_way(shared, work);
    let searched = elsewhere(move |dropped| {
        let nothing = || format!("{} belongs to no ladder that is open", uri.as_str());
        let document = world.document(&uri).ok_or_else(nothing)?;
        let pair = Pair::of(&world, &document);
        let document = pair.ladder.clone().ok_or_else(nothing)?;
        let open = world.open.get(&document.key);
        if !open.is_some_and(|open| Arc::ptr_eq(open, &document)) {
            return Err(nothing());
        }
        let of_document = Arc::clone(&document);
        let limits = Limits {
            steps: EFFORT.saturating_mul(1_000_000),
            cancel: Cancel::when(move || {
                let is_given_up = stopped.is_cancelled() || dropped.is_cancelled();
                is_given_up || of_document.is_outdated()
            }),
            ..Limits::default()
        };
        search(&document, &pair, &limits).map(|(seeing, answer)| (document, seeing, answer))
    });
    let searched = searched.await?;
    drop(under_way);
    let (document, seeing, answer) = searched.map_err(Error::invalid_params)?;
    let is_current = shared.state.change(|world| {
        let open = world.open.get_mut(&document.key);
        let current = open.filter(|open| Arc::ptr_eq(open, &document));
        let is_current = current.is_some();
        if let Some(current) = current {
            *current = Arc::new(seeing);
        }
        is_current
    });
    if !is_current {
        return Err(Error::content_modified());
    }
    shown::ask_again(shared);
    Ok(answer)
}

/// Searches as [`asked`] does, unless what is seen is known since an earlier search.
pub async fn once(shared: &Arc<Shared>, uri: Uri) -> Result<()> {
    let world = shared.state.world();
    let is_known = world.document(&uri).is_some_and(|document| {
        let pair = Pair::of(&world, &document);
        let ladder = pair.ladder();
        ladder.is_some_and(|ladder| ladder.analysis.sights().is_some())
    });
    match is_known {
        true => Ok(()),
        false => asked(shared, uri).await.map(drop),
    }
}

/// The document with what is seen, and what the client is told of it. The error
/// says why nothing is.
fn search(
    document: &Document,
    pair: &Pair,
    limits: &Limits,
) -> std::result::Result<(Document, Value), String> {
    let ladder = pair.ladder().ok_or("this is no ladder")?;
    let environment = pair.spec().map(|it| &it.reading.spec.environment[..]);
    let found = sights(&ladder.analysis, environment.unwrap_or_default(), limits);
    let found = found.map_err(|refusal| format!("no sequences can be searched: {refusal}"))?;
    let seeing = ladder.seeing(found);
    let of = |evidence: Evidence| {
        let all = seeing.analysis.successions().iter();
        all.filter(|it| it.evidence == evidence).count()
    };
    let seen = seeing.analysis.successions().iter();
    let seen = seen.filter(|it| it.witness.is_some()).count();
    let sights = seeing.analysis.sights();
    let rules = sights.map_or(0, |it| it.environment.len());
    let is_whole = sights.is_some_and(|it| it.is_whole);
    let mut summary = format!("{} seen", numbered(seen, "succession"));
    if rules > 0 {
        summary += &format!(
            " in plants that obey {}",
            numbered(rules, "environment rule")
        );
    }
    if !is_whole {
        summary += "; not all sequences were searched";
    }
    let answer = json!({
        "uri": document.uri,
        "seen": seen,
        "witnessed": of(Evidence::Witnessed),
        "delayed": of(Evidence::Delayed),
        "rules": rules,
        "searched": is_whole,
        "summary": summary,
    });
    Ok((document.holding(Arc::new(seeing)), answer))
}
