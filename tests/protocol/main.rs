//! The language server through its streams: each request in a file of its own.
//!
//! A test opens documents in a folder of its own, asks as an editor asks, and
//! compares what it is shown. [`Client`](end_to_end::lsp::Client) fails on
//! every message that the protocol does not know or nobody expected.

mod code_action;
mod commands;
mod completion;
mod documents;
mod folding;
mod formatting;
mod hierarchy;
mod hover;
mod inline_completion;
mod lenses;
mod lifecycle;
mod links;
mod misbehaving;
mod navigation;
mod profiles;
mod progress;
mod raw;
mod rename;
mod scenarios;
mod search;
mod selection;
mod settings;
mod signature_help;
mod symbols;
mod tokens;
mod verdicts;
mod workspace_diagnostic;

use end_to_end::lsp::{Client, Profile};
use tower_lsp::ls_types::request::HoverRequest;
use tower_lsp::ls_types::{HoverContents, HoverParams, MarkupContent, Position, Range};

/// A client of the kind that most people have.
fn client() -> Client {
    client_like(Profile::VsCode)
}

/// A client of this kind.
fn client_like(profile: Profile) -> Client {
    Client::start(env!("CARGO_BIN_EXE_gradus"), profile)
}

/// What is shown at a place of a document, and where the thing there begins and
/// ends.
#[track_caller]
fn hover_at(client: &mut Client, name: &str, at: Position) -> Option<(MarkupContent, Range)> {
    let params = HoverParams {
        text_document_position_params: client.at(name, at),
        work_done_progress_params: Default::default(),
    };
    let hover = client.request::<HoverRequest>(params)?;
    match hover.contents {
        HoverContents::Markup(markup) => Some((markup, hover.range.expect("a range"))),
        other => panic!("no markup: {other:?}"),
    }
}
