//! `textDocument/completion` and `completionItem/resolve`.

use ide::CompletionKind;
use logic::Name;
use serde::{Deserialize, Serialize};
use tower_lsp::ls_types::{
    CompletionItem, CompletionItemKind, CompletionItemLabelDetails, CompletionList,
    CompletionResponse, CompletionTextEdit, Documentation, InsertTextFormat, MarkupContent,
    MarkupKind, Position, TextEdit, Uri,
};

use crate::input::LADDER_ENDINGS;
use crate::lsp::query::{Query, Text};

/// What an item remembers, so that its documentation can be made later: most
/// items are never looked at.
#[derive(Debug, Serialize, Deserialize)]
pub struct Remembered {
    /// The document that it was made for.
    pub uri: Uri,
    /// The variable that it names.
    variable: String,
}

/// Items that are sent at once. Of more, those that hold what is typed so far;
/// of fewer, all: clients sift by themselves.
const MOST: usize = 1000;

/// What can be typed at a position, best first.
pub fn answer(query: &Query, at: Position) -> Option<CompletionResponse> {
    let offset = query.offset(at);
    let pair = query.pair();
    let both = pair.looked_at();
    let completions = match query.text() {
        Some(Text::Spec(spec)) => {
            ide::complete_in_spec(spec, both.ladder, offset, query.weakest(), &query.budget)
        }
        Some(Text::Scenario(scenario)) => {
            let files = files(query);
            ide::complete_in_scenario(scenario, both, &files, offset)
        }
        _ => ide::complete_in_ladder(query.document.ladder()?, offset),
    }?;
    let span = completions.span;
    let text = query.document.rope.byte_slice(span.range()).to_string();
    let is_quoted = text.starts_with('"');
    let range = query.range(span);
    let mut found = completions.items;
    let is_incomplete = found.len() > MOST;
    if is_incomplete {
        let typed = text.get(..offset.saturating_sub(span.range().start));
        let typed = typed
            .unwrap_or(&text)
            .trim_start_matches('"')
            .to_lowercase();
        found.retain(|it| it.label.to_lowercase().contains(&typed));
        found.truncate(MOST);
    }
    let items = found.into_iter().enumerate();
    let item = |(at, it): (usize, ide::Completion)| {
        let abilities = &query.world.abilities;
        let snippet = it.snippet.filter(|_| abilities.snippets);
        let is_snippet = snippet.is_some();
        // Clients compare this with the text that is replaced.
        let filter = match is_quoted || it.kind == CompletionKind::Line {
            true => Some(it.insert.clone()),
            false => (it.insert != it.label).then(|| it.label.clone()),
        };
        let detail = Some(it.detail).filter(|detail| !detail.is_empty());
        let beside = detail.clone().filter(|_| abilities.label_details);
        let remembered = it.variable.map(|variable| Remembered {
            uri: query.document.uri.clone(),
            variable: variable.to_string(),
        });
        CompletionItem {
            label: it.label,
            label_details: beside.map(|description| CompletionItemLabelDetails {
                detail: None,
                description: Some(description),
            }),
            kind: Some(kind(it.kind)),
            detail,
            documentation: it.documentation.map(Documentation::String),
            sort_text: Some(format!("{at:05}")),
            filter_text: filter,
            insert_text_format: is_snippet.then_some(InsertTextFormat::SNIPPET),
            text_edit: Some(CompletionTextEdit::Edit(TextEdit {
                range,
                new_text: snippet.unwrap_or(it.insert),
            })),
            data: remembered.and_then(|it| serde_json::to_value(it).ok()),
            ..CompletionItem::default()
        }
    };
    Some(CompletionResponse::List(CompletionList {
        is_incomplete,
        items: items.map(item).collect(),
    }))
}

/// The files that a scenario may run on: ladders and specs in its folder.
fn files(query: &Query) -> Vec<String> {
    let endings = LADDER_ENDINGS.iter().chain(&["grafcet"]);
    let in_folder = endings.flat_map(|it| query.world.disk.in_folder(&query.document.key, it));
    let mut names: Vec<String> = in_folder.map(|key| key.name()).collect();
    names.extend(
        query
            .world
            .open_beside(&query.document.key)
            .map(|it| it.key.name()),
    );
    names.sort();
    names.dedup();
    names
}

/// What a variable is, for the item that remembers it.
pub fn documentation(query: &Query, remembered: &Remembered) -> Option<Documentation> {
    let pair = query.pair();
    let name: Name = remembered.variable.as_str().into();
    let spec = pair.spec().map(|it| &**it);
    let hover = ide::hover_of_variable(pair.ladder()?, spec, &name, &query.budget);
    let (kind, value) = match query.world.abilities.markdown_in_completions {
        true => (MarkupKind::Markdown, hover.markdown(&|_| None)),
        false => (MarkupKind::PlainText, hover.plain()),
    };
    Some(Documentation::MarkupContent(MarkupContent { kind, value }))
}

fn kind(kind: CompletionKind) -> CompletionItemKind {
    match kind {
        CompletionKind::Variable => CompletionItemKind::VARIABLE,
        CompletionKind::Constant => CompletionItemKind::CONSTANT,
        CompletionKind::Keyword => CompletionItemKind::KEYWORD,
        CompletionKind::Box => CompletionItemKind::FUNCTION,
        CompletionKind::Type => CompletionItemKind::CLASS,
        CompletionKind::Routine => CompletionItemKind::MODULE,
        CompletionKind::Label => CompletionItemKind::REFERENCE,
        CompletionKind::Step => CompletionItemKind::FIELD,
        CompletionKind::State => CompletionItemKind::ENUM_MEMBER,
        CompletionKind::Line => CompletionItemKind::EVENT,
        CompletionKind::File => CompletionItemKind::FILE,
    }
}
