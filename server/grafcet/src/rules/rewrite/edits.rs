use source::{Edit, Span};

use crate::rules::syntax::{Document, Line};

/// Replacements to be made in a text, none overlapping another.
pub(super) struct Edits<'d> {
    document: &'d Document<'d>,
    line_end: &'static str,
    list: Vec<Edit>,
}

impl<'d> Edits<'d> {
    pub(super) fn new(document: &'d Document<'d>) -> Self {
        Self {
            document,
            line_end: document.line_end(),
            list: Vec::new(),
        }
    }

    /// Replaces the bytes from `start` to `end`.
    pub(super) fn replace(&mut self, start: usize, end: usize, text: impl Into<String>) {
        self.list.push(Edit {
            span: Span::new(start, end),
            text: text.into(),
        });
    }

    pub(super) fn remove(&mut self, start: usize, end: usize) {
        self.replace(start, end, "");
    }

    /// Inserts whole lines at a place where a line starts or the text ends.
    /// What is inserted first at a place stands first.
    pub(super) fn insert_lines(&mut self, at: usize, lines: &[String]) {
        if !lines.is_empty() {
            let text = whole_lines(self.document.text, at, lines, self.line_end);
            self.replace(at, at, text);
        }
    }

    /// Inserts lines as [`Edits::insert_lines`] does, a blank line before them
    /// unless there is one already.
    pub(super) fn insert_block(&mut self, at: usize, mut lines: Vec<String>) {
        let before = self.document.text.get(..at).unwrap_or_default();
        let last = before.lines().next_back().unwrap_or_default();
        let after_line = !last.trim_matches(['\u{feff}', ' ', '\t']).is_empty();
        let after_insertion = self
            .list
            .iter()
            .any(|edit| edit.span == Span::at(at) && !edit.text.is_empty());
        if after_line || after_insertion {
            lines.insert(0, String::new());
        }
        self.insert_lines(at, &lines);
    }

    /// Sets, replaces or takes away (where it says nothing) the comment of a
    /// line.
    pub(super) fn comment(&mut self, line: &Line, said: &str) {
        let code_end = line.tokens.last().map(|token| token.span.range().end);
        let code_end = code_end.unwrap_or(line.start);
        match (line.comment, said.is_empty()) {
            (None, true) => {}
            (None, false) => self.replace(code_end, code_end, format!("  // {said}")),
            (Some(comment), true) => self.remove(code_end, comment.span.range().end),
            (Some(comment), false) => {
                let range = comment.span.range();
                self.replace(range.start, range.end, format!("// {said}"));
            }
        }
    }

    /// The text with all replacements made.
    pub(super) fn apply(mut self) -> String {
        let text = self.document.text;
        // Insertions at one place keep the order they were made in, and come
        // before what is replaced there.
        self.list.sort_by_key(|edit| edit.span);
        let mut out = String::with_capacity(text.len());
        let mut written = 0;
        for edit in &self.list {
            let range = edit.span.range();
            out.push_str(text.get(written..range.start).unwrap_or_default());
            out.push_str(&edit.text);
            written = range.end.max(written);
        }
        out.push_str(text.get(written..).unwrap_or_default());
        out
    }
}

/// `lines` as they are inserted at the byte `at`: each with its line end, or,
/// after a last line that has none, each with one before it.
pub(super) fn whole_lines(text: &str, at: usize, lines: &[String], line_end: &str) -> String {
    let before = text.get(..at).unwrap_or_default();
    let starts_line = before.is_empty() || before.ends_with(['\n', '\r']) || before == "\u{feff}";
    let mut inserted = String::new();
    for line in lines {
        if !starts_line {
            inserted.push_str(line_end);
        }
        inserted.push_str(line);
        if starts_line {
            inserted.push_str(line_end);
        }
    }
    inserted
}
