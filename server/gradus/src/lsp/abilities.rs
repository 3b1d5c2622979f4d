//! What the client can do, as far as the server behaves differently for it.

use tower_lsp::ls_types::{
    ClientCapabilities, DiagnosticTag, InitializeParams, MarkupKind, ResourceOperationKind,
};

use super::position::Encoding;

/// What the client can do.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Abilities {
    /// What columns count.
    pub encoding: Encoding,
    /// It shows Markdown in hovers.
    pub markdown: bool,
    /// It shows other places that belong to a finding.
    pub related_places: bool,
    /// It shows that what a finding is about could go.
    pub unnecessary: bool,
    /// It shows the page of a finding's code.
    pub code_pages: bool,
    /// It asks for findings itself.
    pub pulls_diagnostics: bool,
    /// It asks for settings to be told.
    pub configuration: bool,
    /// It shows progress that the server begins.
    pub progress: bool,
    /// It watches files when it is asked to.
    pub watches_files: bool,
    /// Edits may name versions of documents.
    pub document_changes: bool,
    /// Edits may make files.
    pub creates_files: bool,
    /// Edits may say what they are for.
    pub change_annotations: bool,
    /// The edit of a code action may come later.
    pub resolves_edits: bool,
    /// It shows a document when it is asked to.
    pub shows_documents: bool,
    /// It takes symbols in a tree.
    pub symbol_trees: bool,
    /// It takes links with the place that they come from.
    pub location_links: bool,
    /// It asks again for lenses, hints and tokens when it is told to.
    pub refreshes_lenses: bool,
    /// The same for hints.
    pub refreshes_hints: bool,
    /// The same for findings.
    pub refreshes_diagnostics: bool,
    /// The same for tokens.
    pub refreshes_tokens: bool,
    /// Snippets in completions.
    pub snippets: bool,
    /// It shows Markdown beside completions.
    pub markdown_in_completions: bool,
    /// It shows what a completion is beside its name.
    pub label_details: bool,
    /// It takes the operands of a signature by their places in its label.
    pub label_offsets: bool,
    /// It shows ghost text.
    pub inline_completions: bool,
    /// It asks whether something can be renamed before it asks for a name.
    pub prepares_renames: bool,
    /// It understands `gradus/status`.
    pub status: bool,
    /// It shows documents that the server makes.
    pub virtual_documents: bool,
    /// It shows the page that `gradus.explain` answers.
    pub pages: bool,
}

impl Abilities {
    /// Reads them from the first message of a client.
    pub fn of(params: &InitializeParams) -> Self {
        let client = &params.capabilities;
        let document = client.text_document.as_ref();
        let workspace = client.workspace.as_ref();
        let window = client.window.as_ref();
        let general = client.general.as_ref();
        let edit = workspace.and_then(|it| it.workspace_edit.as_ref());
        let operations = edit.and_then(|it| it.resource_operations.as_deref());
        let refreshes_diagnostics = workspace
            .and_then(|it| it.diagnostics.as_ref())
            .is_some_and(|it| it.refresh_support == Some(true));
        let experimental = |name: &str| {
            let all = client.experimental.as_ref();
            all.is_some_and(|it| it[name] == true)
        };
        let completion_item =
            document.and_then(|it| it.completion.as_ref()?.completion_item.as_ref());
        let findings = document.and_then(|it| it.publish_diagnostics.as_ref());
        let pulls = document.is_some_and(|it| it.diagnostic.is_some());
        Self {
            encoding: Encoding::choose(general.and_then(|it| it.position_encodings.as_deref())),
            markdown: document
                .and_then(|it| it.hover.as_ref()?.content_format.as_ref())
                .is_some_and(|kinds| kinds.contains(&MarkupKind::Markdown)),
            related_places: findings.is_some_and(|it| it.related_information == Some(true)),
            unnecessary: findings
                .and_then(|it| it.tag_support.as_ref())
                .is_some_and(|it| it.value_set.contains(&DiagnosticTag::UNNECESSARY)),
            code_pages: findings.is_some_and(|it| it.code_description_support == Some(true)),
            pulls_diagnostics: pulls && refreshes_diagnostics,
            refreshes_diagnostics,
            configuration: workspace.is_some_and(|it| it.configuration == Some(true)),
            progress: window.is_some_and(|it| it.work_done_progress == Some(true)),
            watches_files: workspace
                .and_then(|it| it.did_change_watched_files.as_ref())
                .is_some_and(|it| it.dynamic_registration == Some(true)),
            document_changes: edit.is_some_and(|it| it.document_changes == Some(true)),
            creates_files: operations
                .is_some_and(|kinds| kinds.contains(&ResourceOperationKind::Create)),
            change_annotations: edit.is_some_and(|it| it.change_annotation_support.is_some()),
            resolves_edits: resolves_edits(client),
            shows_documents: window
                .and_then(|it| it.show_document.as_ref())
                .is_some_and(|it| it.support),
            symbol_trees: document
                .and_then(|it| it.document_symbol.as_ref())
                .is_some_and(|it| it.hierarchical_document_symbol_support == Some(true)),
            location_links: document
                .and_then(|it| it.definition.as_ref())
                .is_some_and(|it| it.link_support == Some(true)),
            refreshes_lenses: workspace
                .and_then(|it| it.code_lens.as_ref())
                .is_some_and(|it| it.refresh_support == Some(true)),
            refreshes_hints: workspace
                .and_then(|it| it.inlay_hint.as_ref())
                .is_some_and(|it| it.refresh_support == Some(true)),
            refreshes_tokens: workspace
                .and_then(|it| it.semantic_tokens.as_ref())
                .is_some_and(|it| it.refresh_support == Some(true)),
            snippets: document
                .and_then(|it| it.completion.as_ref()?.completion_item.as_ref())
                .is_some_and(|it| it.snippet_support == Some(true)),
            markdown_in_completions: completion_item
                .and_then(|it| it.documentation_format.as_ref())
                .is_some_and(|kinds| kinds.contains(&MarkupKind::Markdown)),
            label_details: completion_item.is_some_and(|it| it.label_details_support == Some(true)),
            label_offsets: document
                .and_then(|it| it.signature_help.as_ref()?.signature_information.as_ref())
                .and_then(|it| it.parameter_information.as_ref())
                .is_some_and(|it| it.label_offset_support == Some(true)),
            inline_completions: document.is_some_and(|it| it.inline_completion.is_some()),
            prepares_renames: document
                .and_then(|it| it.rename.as_ref())
                .is_some_and(|it| it.prepare_support == Some(true)),
            status: experimental("gradusStatus"),
            virtual_documents: experimental("gradusVirtualDocuments"),
            pages: experimental("gradusPages"),
        }
    }
}

fn resolves_edits(client: &ClientCapabilities) -> bool {
    let action = client
        .text_document
        .as_ref()
        .and_then(|it| it.code_action.as_ref());
    let resolve = action.and_then(|it| it.resolve_support.as_ref());
    let keeps_data = action.is_some_and(|it| it.data_support == Some(true));
    keeps_data && resolve.is_some_and(|it| it.properties.iter().any(|name| name == "edit"))
}
