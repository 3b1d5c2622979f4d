//! Edits that the client is asked to make.
//!
//! A request says what it wants changed in bytes, as [`Changes`]; here that
//! becomes a `WorkspaceEdit`, as rich as the client can take it: with versions,
//! so that a text which has changed meanwhile is left alone; with new files;
//! with a label that says what the edits are for.

use std::collections::HashMap;
use std::sync::Arc;

use ropey::Rope;
use source::{Edit, Span};
use tower_lsp::ls_types::{
    AnnotatedTextEdit, ChangeAnnotation, CreateFile, CreateFileOptions, DocumentChangeOperation,
    DocumentChanges, OneOf, OptionalVersionedTextDocumentIdentifier, Range, ResourceOp,
    TextDocumentEdit, TextEdit, Uri, WorkspaceEdit,
};

use super::document::Document;
use super::position::Encoding;
use super::world::World;

/// What is to change, in whatever documents.
#[derive(Clone, Debug)]
pub struct Changes {
    label: String,
    edited: Vec<(Arc<Document>, Vec<Edit>)>,
    created: Vec<(Uri, String)>,
}

impl Changes {
    /// No changes yet; `label` says in a few words what they will be for.
    pub fn new(label: impl Into<String>) -> Self {
        Self {
            label: label.into(),
            edited: Vec::new(),
            created: Vec::new(),
        }
    }

    /// Changes a document, open or not, by `edits` that do not overlap. The
    /// version that the edits count on is the document's.
    pub fn edit(&mut self, document: &Arc<Document>, edits: Vec<Edit>) {
        if !edits.is_empty() {
            self.edited.push((Arc::clone(document), edits));
        }
    }

    /// Makes a document say `new`, leaving alone what stays.
    pub fn rewrite(&mut self, document: &Arc<Document>, new: &str) {
        let old = document.rope.to_string();
        self.edit(document, ide::changed(&old, new));
    }

    /// Makes a file that is not there.
    pub fn create(&mut self, uri: Uri, text: impl Into<String>) {
        self.created.push((uri, text.into()));
    }

    /// Whether nothing changes.
    pub fn is_empty(&self) -> bool {
        self.edited.is_empty() && self.created.is_empty()
    }

    /// The changes as the client of `world` can take them.
    pub fn workspace_edit(self, world: &World) -> WorkspaceEdit {
        match world.abilities.document_changes {
            true => self.versioned(world),
            false => self.plain(world.encoding()),
        }
    }

    /// For clients that know texts only. They make a file when its first text
    /// is put in.
    fn plain(self, encoding: Encoding) -> WorkspaceEdit {
        let mut changes: HashMap<Uri, Vec<TextEdit>> = HashMap::new();
        for (document, edits) in &self.edited {
            let all = changes.entry(document.uri.clone()).or_default();
            all.extend(text_edits(&document.rope, edits, encoding));
        }
        for (uri, text) in self.created {
            changes.entry(uri).or_default().push(first_text(text));
        }
        WorkspaceEdit::new(changes)
    }

    fn versioned(self, world: &World) -> WorkspaceEdit {
        let annotated = world.abilities.change_annotations;
        let id = annotated.then(|| ANNOTATION.to_owned());
        let of_document = |uri, version, edits: Vec<TextEdit>| TextDocumentEdit {
            text_document: OptionalVersionedTextDocumentIdentifier { uri, version },
            edits: edits
                .into_iter()
                .map(|edit| annotate(edit, id.as_ref()))
                .collect(),
        };
        let mut files = Vec::new();
        let mut texts = Vec::new();
        for (document, edits) in &self.edited {
            let edits = text_edits(&document.rope, edits, world.encoding());
            texts.push(of_document(document.uri.clone(), document.version, edits));
        }
        for (uri, text) in self.created {
            if world.abilities.creates_files {
                files.push(CreateFile {
                    uri: uri.clone(),
                    // What somebody else has put there meanwhile stays.
                    options: Some(CreateFileOptions {
                        overwrite: Some(false),
                        ignore_if_exists: Some(false),
                    }),
                    annotation_id: id.clone(),
                });
            }
            texts.push(of_document(uri, None, vec![first_text(text)]));
        }
        let document_changes = match files.is_empty() {
            true => DocumentChanges::Edits(texts),
            false => {
                let files = files.into_iter().map(ResourceOp::Create);
                let files = files.map(DocumentChangeOperation::Op);
                let texts = texts.into_iter().map(DocumentChangeOperation::Edit);
                DocumentChanges::Operations(files.chain(texts).collect())
            }
        };
        let annotation = ChangeAnnotation {
            label: self.label,
            needs_confirmation: None,
            description: None,
        };
        WorkspaceEdit {
            changes: None,
            document_changes: Some(document_changes),
            change_annotations: id.map(|id| HashMap::from([(id, annotation)])),
        }
    }
}

/// The one annotation of an edit.
const ANNOTATION: &str = "gradus";

/// Edits in the protocol's types, in the order of the text.
pub fn text_edits(rope: &Rope, edits: &[Edit], encoding: Encoding) -> Vec<TextEdit> {
    let mut in_order = edits.to_vec();
    in_order.sort_by_key(|edit| edit.span);
    if let Some((last, before)) = in_order.split_last_mut() {
        let kept = before.last().map_or(0, |it| it.span.range().end);
        end_in_last_line(rope, last, kept);
    }
    let edit = |edit: Edit| TextEdit::new(encoding.range(rope, edit.span), edit.text);
    in_order.into_iter().map(edit).collect()
}

/// Has lines that are put behind the last line end begin before it, which makes
/// the same text, unless `kept`, where other edits end, is behind that. Neovim
/// has no line behind the last line end, and adds a blank one to lines that are
/// put there.
fn end_in_last_line(rope: &Rope, edit: &mut Edit, kept: usize) {
    let length = rope.len_bytes();
    let line_end = ["\r\n", "\n", "\r"].into_iter().find(|line_end| {
        let start = length.checked_sub(line_end.len());
        let behind = start.and_then(|start| rope.get_byte_slice(start..));
        behind.is_some_and(|behind| behind == *line_end)
    });
    let Some(line_end) = line_end else { return };
    let start = length - line_end.len();
    if edit.span.range() == (length..length)
        && kept <= start
        && let Some(lines) = edit.text.strip_suffix(line_end)
    {
        edit.text = format!("{line_end}{lines}");
        edit.span = Span::at(start);
    }
}

fn first_text(text: String) -> TextEdit {
    TextEdit::new(Range::default(), text)
}

fn annotate(edit: TextEdit, id: Option<&String>) -> OneOf<TextEdit, AnnotatedTextEdit> {
    match id {
        Some(id) => OneOf::Right(AnnotatedTextEdit {
            text_edit: edit,
            annotation_id: id.clone(),
        }),
        None => OneOf::Left(edit),
    }
}

#[cfg(test)]
mod tests {
    use std::str::FromStr;

    use serde_json::{Value, json};

    use super::*;
    use crate::lsp::abilities::Abilities;

    /// What a client with these abilities is sent for a change of an open
    /// document, and a new one.
    fn sent(abilities: Abilities) -> Value {
        let uri = |name: &str| Uri::from_str(&format!("file:///p/{name}")).expect("an address");
        let text = "a\n\u{1f6d1}b\n";
        let open = Document::new(uri("a.ladder"), "gradus-ladder", Some(7), text);
        let mut changes = Changes::new("Accept a -> b");
        let edit = Edit {
            span: Span::new(6, 7),
            text: "c".to_owned(),
        };
        changes.edit(&Arc::new(open), vec![edit]);
        changes.create(uri("a.grafcet"), "Step a\n");
        let world = World {
            abilities: Arc::new(abilities),
            ..World::default()
        };
        serde_json::to_value(changes.workspace_edit(&world)).expect("an edit")
    }

    fn range(line: u32, from: u32, to: u32) -> Value {
        json!({
            "start": { "line": line, "character": from },
            "end": { "line": line, "character": to },
        })
    }

    /// The edits that make `new` of `old`, as `line:column-line:column text`.
    #[track_caller]
    fn check(old: &str, new: &str, expected: &[&str]) {
        let rope = Rope::from_str(old);
        let edits = text_edits(&rope, &ide::changed(old, new), Encoding::Utf16);
        let said = edits.iter().map(|it| {
            let (from, to) = (it.range.start, it.range.end);
            let (line, column) = (from.line, from.character);
            format!(
                "{line}:{column}-{}:{} {:?}",
                to.line, to.character, it.new_text
            )
        });
        assert_eq!(said.collect::<Vec<_>>(), expected);
    }

    #[test]
    fn lines_behind_the_last_begin_at_its_end() {
        check("a\n", "a\nb\n", &[r#"0:1-0:1 "\nb""#]);
        check("a\n", "a\n\nb\nc\n", &[r#"0:1-0:1 "\n\nb\nc""#]);
        check("a\r\n", "a\r\nb\r\n", &[r#"0:1-0:1 "\r\nb""#]);
        check("\n", "\nb\n", &[r#"0:0-0:0 "\nb""#]);
        // With no line end there is nothing to begin before, and none to add.
        check("a", "a\nb", &[r#"0:1-0:1 "\nb""#]);
        check("", "b\n", &[r#"0:0-0:0 "b\n""#]);
        check("a\n", "a\nb", &[r#"1:0-1:0 "b""#]);
        check("a\n", "b\na\n", &[r#"0:0-0:0 "b\n""#]);
    }

    #[test]
    fn lines_behind_the_last_stay_behind_other_edits() {
        let rope = Rope::from_str("a\n");
        let edits = [(1, 2, "b\n"), (2, 2, "c\n")].map(|(start, end, text)| Edit {
            span: Span::new(start, end),
            text: text.to_owned(),
        });
        let sent = text_edits(&rope, &edits, Encoding::Utf16);
        let sent = serde_json::to_value(sent).expect("edits");
        let at = |line: u32, character: u32| json!({ "line": line, "character": character });
        let expected = json!([
            { "range": { "start": at(0, 1), "end": at(1, 0) }, "newText": "b\n" },
            { "range": { "start": at(1, 0), "end": at(1, 0) }, "newText": "c\n" },
        ]);
        assert_eq!(sent, expected);
    }

    #[test]
    fn a_client_that_says_nothing_is_sent_texts() {
        let expected = json!({ "changes": {
            "file:///p/a.ladder": [{ "range": range(1, 2, 3), "newText": "c" }],
            "file:///p/a.grafcet": [{ "range": range(0, 0, 0), "newText": "Step a\n" }],
        }});
        assert_eq!(sent(Abilities::default()), expected);
    }

    #[test]
    fn versions_are_named_where_they_are_understood() {
        let abilities = Abilities {
            document_changes: true,
            encoding: Encoding::Utf8,
            ..Abilities::default()
        };
        let expected = json!({ "documentChanges": [
            {
                "textDocument": { "uri": "file:///p/a.ladder", "version": 7 },
                "edits": [{ "range": range(1, 4, 5), "newText": "c" }],
            },
            {
                "textDocument": { "uri": "file:///p/a.grafcet", "version": null },
                "edits": [{ "range": range(0, 0, 0), "newText": "Step a\n" }],
            },
        ]});
        assert_eq!(sent(abilities), expected);
    }

    #[test]
    fn files_are_made_and_edits_labelled_where_the_client_can() {
        let abilities = Abilities {
            document_changes: true,
            creates_files: true,
            change_annotations: true,
            ..Abilities::default()
        };
        let edit = |range: Value, text: &str| json!({ "range": range, "newText": text, "annotationId": "gradus" });
        let expected = json!({
            "documentChanges": [
                {
                    "kind": "create",
                    "uri": "file:///p/a.grafcet",
                    "options": { "overwrite": false, "ignoreIfExists": false },
                    "annotationId": "gradus",
                },
                {
                    "textDocument": { "uri": "file:///p/a.ladder", "version": 7 },
                    "edits": [edit(range(1, 2, 3), "c")],
                },
                {
                    "textDocument": { "uri": "file:///p/a.grafcet", "version": null },
                    "edits": [edit(range(0, 0, 0), "Step a\n")],
                },
            ],
            "changeAnnotations": {
                "gradus": { "label": "Accept a -> b" },
            },
        });
        assert_eq!(sent(abilities), expected);
    }
}
