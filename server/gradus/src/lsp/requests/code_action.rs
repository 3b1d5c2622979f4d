//! `textDocument/codeAction` and `codeAction/resolve`.
//!
//! What an action changes is worked out when it is taken, for clients that can
//! wait for it; for others at once.

use std::sync::Arc;

use ide::{
    About, Action, ActionKind, Asked, Change, Departing, Effect, Shows, actions_in_ladder,
    actions_in_scenario, actions_in_spec,
};
use serde::{Deserialize, Serialize};
use serde_json::json;
use source::Diagnostic;
use tower_lsp::ls_types::{
    CodeAction, CodeActionContext, CodeActionKind, CodeActionOrCommand, Command, NumberOrString,
    Range, Uri, WorkspaceEdit,
};

use super::command::EXPLAIN;
use super::on_verdict;
use super::simulate::{HIDE_SCAN, SHOW_SCAN};
use crate::lsp::edit::Changes;
use crate::lsp::publish;
use crate::lsp::query::{Pair, Query, Text};

/// What an action that was not worked out yet needs to be.
#[derive(Debug, Serialize, Deserialize)]
pub struct Pending {
    /// The document that it was offered in.
    pub uri: Uri,
    /// The state of that document.
    version: Option<i32>,
    work: Work,
}

/// What it does.
#[derive(Debug, Serialize, Deserialize)]
enum Work {
    /// Changes the spec beside the ladder.
    Spec {
        /// What is decided, as [`Change`] spells it.
        changes: Vec<String>,
        /// Whether rules that depart from the ladder are renewed.
        renew: bool,
    },
    /// Makes a scenario of the sequence that shows a difference.
    TraceOfOutputs,
    /// Makes one of the sequence that shows that a property is violated.
    TraceOfProperty(String),
}

/// The kinds of actions that are offered.
pub const KINDS: [&str; 12] = [
    "quickfix",
    "refactor.gradus.accept",
    "refactor.gradus.acceptTogether",
    "refactor.gradus.reject",
    "refactor.gradus.initial",
    "refactor.gradus.undo",
    "refactor.gradus.convert",
    "quickfix.gradus.explain",
    "refactor.gradus.expect",
    "quickfix.gradus.scan",
    "quickfix.gradus.trace",
    "quickfix.gradus.exclude",
];

fn kind(kind: ActionKind) -> &'static str {
    let at = match kind {
        ActionKind::Fix => 0,
        ActionKind::Accept => 1,
        ActionKind::AcceptTogether => 2,
        ActionKind::Reject => 3,
        ActionKind::Initial => 4,
        ActionKind::Undo => 5,
        ActionKind::Convert => 6,
        ActionKind::Explain => 7,
        ActionKind::Expect => 8,
        ActionKind::Scan => 9,
        ActionKind::Trace => 10,
        ActionKind::Exclude => 11,
    };
    KINDS[at]
}

/// What can be done in a range, best first.
pub fn answer(
    query: &Query,
    range: Range,
    context: &CodeActionContext,
) -> Option<Vec<CodeActionOrCommand>> {
    let span = query.encoding().span(&query.document.rope, range);
    let findings = publish::shown(&query.world, &query.document, &query.budget);
    let here = findings
        .into_iter()
        .filter(|finding| finding.span.start <= span.end && span.start <= finding.span.end);
    let here: Vec<Diagnostic> = here.collect();
    let pair = query.pair();
    let asked = Asked {
        span,
        findings: &here,
        weakest: query.weakest(),
        budget: &query.budget,
    };
    let both = pair.looked_at();
    let actions = match query.text()? {
        Text::Ladder(ladder) => actions_in_ladder(ladder, both.spec, asked),
        Text::Spec(spec) => {
            let mut all = on_verdict::actions(query, &pair, asked);
            all.extend(actions_in_spec(spec, both.ladder, asked));
            all
        }
        Text::Scenario(scenario) => {
            let (_, run) = query.run()?;
            actions_in_scenario(scenario, &run, query.chosen_step(&run), asked)
        }
    };
    let shows_pages = query.world.abilities.pages;
    let wanted = |action: &Action| match &context.only {
        _ if action.kind == ActionKind::Explain && !shows_pages => false,
        None => true,
        Some(only) => only.iter().any(|it| includes(it, kind(action.kind))),
    };
    let answered = actions
        .into_iter()
        .filter(wanted)
        .filter_map(|action| in_protocol(query, &pair, action, context));
    Some(answered.map(CodeActionOrCommand::CodeAction).collect())
}

/// Whether `wanted`, a kind with all below it, includes `kind`.
fn includes(wanted: &CodeActionKind, kind: &str) -> bool {
    let wanted = wanted.as_str();
    let rest = kind.strip_prefix(wanted);
    wanted.is_empty() || rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
}

fn in_protocol(
    query: &Query,
    pair: &Pair,
    action: Action,
    context: &CodeActionContext,
) -> Option<CodeAction> {
    let mut answered = CodeAction {
        title: action.title.clone(),
        kind: Some(CodeActionKind::from(kind(action.kind))),
        is_preferred: action.preferred.then_some(true),
        ..CodeAction::default()
    };
    if [ActionKind::Fix, ActionKind::Trace, ActionKind::Exclude].contains(&action.kind) {
        answered.diagnostics = Some(context.diagnostics.clone());
    }
    match action.effect {
        Effect::Show(code) => {
            answered.command = Some(Command {
                title: action.title,
                command: EXPLAIN.to_owned(),
                arguments: Some(vec![code.to_string().into()]),
            });
            let about = context
                .diagnostics
                .iter()
                .filter(|it| it.code == Some(NumberOrString::String(code.to_string())));
            answered.diagnostics = Some(about.cloned().collect());
        }
        Effect::Look(shows) => {
            let uri = &query.document.uri;
            let (command, argument) = match shows {
                Shows::Scan(step) => {
                    let span = query.scenario()?.steps().get(step)?.span;
                    let line = query.range(span).start.line;
                    (SHOW_SCAN, json!({ "uri": uri, "line": line }))
                }
                Shows::NoScan | Shows::Table => (HIDE_SCAN, json!({ "uri": uri })),
            };
            answered.command = Some(Command {
                title: action.title,
                command: command.to_owned(),
                arguments: Some(vec![argument]),
            });
        }
        Effect::Here(fix) => {
            let mut changes = Changes::new(fix.title);
            changes.edit(&query.document, fix.edits);
            answered.edit = Some(changes.workspace_edit(&query.world));
        }
        Effect::Spec(changes, departing) if query.world.abilities.resolves_edits => {
            answered.data = pending(
                query,
                Work::Spec {
                    changes: changes.iter().map(Change::to_string).collect(),
                    renew: departing == Departing::Renewed,
                },
            );
        }
        Effect::Spec(changes, departing) => {
            answered.edit = Some(spec_edit(query, pair, &action.title, &changes, departing)?);
        }
        Effect::Scenario(about) if query.world.abilities.resolves_edits => {
            let work = match about {
                About::Outputs => Work::TraceOfOutputs,
                About::Property(label) => Work::TraceOfProperty(label.to_string()),
            };
            answered.data = pending(query, work);
        }
        Effect::Scenario(about) => {
            answered.edit = Some(on_verdict::trace_edit(query, pair, &action.title, &about)?);
        }
    }
    Some(answered)
}

/// What an action has to be told when it is taken.
fn pending(query: &Query, work: Work) -> Option<serde_json::Value> {
    let pending = Pending {
        uri: query.document.uri.clone(),
        version: query.document.version,
        work,
    };
    serde_json::to_value(pending).ok()
}

/// The action with what it changes. `None` if the document has moved on.
pub fn resolve(query: &Query, pending: &Pending, mut action: CodeAction) -> Option<CodeAction> {
    if query.document.version != pending.version {
        return None;
    }
    let pair = query.pair();
    action.edit = match &pending.work {
        Work::Spec { changes, renew } => {
            let changes = changes.iter().map(|text| Change::parse(text));
            let changes: Option<Vec<Change>> = changes.collect();
            let departing = match renew {
                true => Departing::Renewed,
                false => Departing::Stay,
            };
            spec_edit(query, &pair, &action.title, &changes?, departing)
        }
        // The ladder may have changed since, and its difference with it.
        Work::TraceOfOutputs => Some(on_verdict::trace_edit(
            query,
            &pair,
            &action.title,
            &About::Outputs,
        )?),
        Work::TraceOfProperty(label) => {
            let about = About::Property(label.as_str().into());
            Some(on_verdict::trace_edit(query, &pair, &action.title, &about)?)
        }
    };
    Some(action)
}

/// The edit of the spec that `changes` are; it makes the spec if there is none.
pub fn spec_edit(
    query: &Query,
    pair: &Pair,
    title: &str,
    changes: &[Change],
    departing: Departing,
) -> Option<WorkspaceEdit> {
    let ladder = pair.ladder()?;
    let spec = pair.spec().map(Arc::as_ref);
    let new = ide::changed_spec(ladder, spec, changes, departing, &query.budget);
    if query.budget.cancel.is_cancelled() {
        return None;
    }
    let mut edit = Changes::new(title);
    put(query, pair, &mut edit, &new)?;
    Some(edit.workspace_edit(&query.world))
}

/// Lets the spec of the pair say `new`.
pub fn put(query: &Query, pair: &Pair, edit: &mut Changes, new: &str) -> Option<()> {
    match &pair.spec {
        Some(spec) => edit.rewrite(spec, new),
        None => {
            let place = query.world.spec_place(&pair.ladder.as_ref()?.uri)?;
            match query.world.document(&place) {
                // It is there, but empty or no spec yet: what is no spec stays.
                Some(there) if there.rope.len_bytes() == 0 => edit.rewrite(&there, new),
                Some(_) => return None,
                None => edit.create(place, new),
            }
        }
    }
    Some(())
}
