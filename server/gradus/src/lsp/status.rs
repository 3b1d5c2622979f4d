//! `gradus/status`: how a ladder and its spec stand, in a line of an editor.

use std::sync::Arc;

use serde::{Deserialize, Serialize};
use source::codes;
use tower_lsp::ls_types::Uri;
use tower_lsp::ls_types::notification::Notification;

use super::document::Document;
use super::query::Pair;
use super::requests::verify;
use super::world::World;

/// The notification, for clients that announce `gradusStatus`.
#[derive(Debug)]
pub enum StatusNotification {}

impl Notification for StatusNotification {
    type Params = Status;
    const METHOD: &'static str = "gradus/status";
}

/// How a ladder and its spec stand.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Status {
    /// The ladder.
    uri: Uri,
    /// States, values of registers included.
    states: usize,
    /// Pairs of states that are accepted, or read off a write.
    accepted: usize,
    /// Suggestions about which nothing is decided.
    open: usize,
    /// Transitions of the spec.
    rules: usize,
    /// Rules and states of the spec that the ladder does not support.
    stale: usize,
    /// How the two stand, in a word.
    verdict: Verdict,
    /// The same in a line for people.
    message: String,
    /// Whether the spec does what the ladder does; left out where there is no spec.
    #[serde(skip_serializing_if = "Option::is_none")]
    proof: Option<Proof>,
}

/// Whether a spec does what its ladder does, as far as that is known.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Proof {
    /// `equivalent`, `different`, `unknown` and so on.
    verdict: String,
    /// The same in a line for people.
    message: String,
}

/// How a ladder and its spec stand, in a word.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Verdict {
    /// The ladder holds no sequence.
    NoSequence,
    /// There is no spec.
    NoSpec,
    /// The ladder supports every rule of the spec.
    InStep,
    /// It does not support some.
    Behind,
}

/// The status of the ladder that `document` holds or belongs to.
pub fn of(world: World, document: Arc<Document>) -> Option<Status> {
    if document.scenario().is_some() {
        return None;
    }
    let pair = Pair::of(&world, &document);
    let ladder = pair.ladder()?;
    let weakest = world.config(&document.key).suggestions.evidence.into();
    let count = ide::count(ladder, pair.spec().map(|it| &**it), weakest);
    let states = ladder
        .analysis
        .groups()
        .iter()
        .map(|it| it.states.len())
        .sum();
    let (rules, stale) = match &pair.spec {
        None => (0, 0),
        Some(spec) => {
            let rules = pair
                .spec()
                .map_or(0, |it| it.reading.spec.grafcet.transitions().count());
            let found = spec.findings(&world, &spec.budget()).into_iter();
            let stale = found.filter(|it| {
                [
                    codes::RULE_NOT_SUPPORTED,
                    codes::STATE_GONE,
                    codes::DECISION_UNKNOWN,
                ]
                .contains(&it.code)
            });
            (rules, stale.count())
        }
    };
    let verdict = match (&pair.spec, stale) {
        _ if states == 0 => Verdict::NoSequence,
        (None, _) => Verdict::NoSpec,
        (Some(_), 0) => Verdict::InStep,
        (Some(_), _) => Verdict::Behind,
    };
    let message = match verdict {
        Verdict::NoSequence => "no sequence here".to_owned(),
        Verdict::NoSpec => format!("{states} states, {} suggestions, no spec yet", count.open),
        Verdict::InStep => format!("in step with the spec; {} suggestions open", count.open),
        Verdict::Behind => format!("the ladder does not support {stale} parts of the spec"),
    };
    let proof = pair.spec.as_ref().map(|spec| {
        let settings = world.config(&spec.key).verify;
        let standing = world.verdicts.standing(&pair, &settings);
        Proof {
            verdict: verify::word(&standing).to_owned(),
            message: verify::line(&standing),
        }
    });
    Some(Status {
        proof,
        uri: pair.ladder.as_ref()?.uri.clone(),
        states,
        accepted: count.accepted,
        open: count.open,
        rules,
        stale,
        verdict,
        message,
    })
}
