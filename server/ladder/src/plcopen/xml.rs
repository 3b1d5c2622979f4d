//! The XML text as a tree in which every tag, attribute and text knows its
//! bytes.
//!
//! A connection may name an element that comes later, and a name may be
//! declared after the body that uses it, so the whole document is needed at
//! once. The tree is an arena in document order. It is forgiving: a tag that
//! is never closed ends where its parent ends, an end tag that closes nothing
//! is reported and left out, and a text that breaks off keeps all that was
//! read. Namespaces are ignored: exporters disagree about them, and the local
//! names never clash.

use std::collections::HashSet;

use quick_xml::Reader;
use quick_xml::errors::{Error, SyntaxError};
use quick_xml::events::{BytesRef, BytesStart, Event};
use source::{Diagnostic, Span, codes};

use crate::reading::Source;

/// Exports nest some twenty levels deep; far more is an attack, and a tree
/// this shallow may be walked by recursion.
const DEEPEST: usize = 256;

/// A text with the bytes it was read from, without the blanks around it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Text {
    pub(super) value: String,
    pub(super) span: Span,
}

/// The tree; its node 0 stands for the document and holds the root element.
pub(super) struct Document<'t> {
    nodes: Vec<Node<'t>>,
}

struct Node<'t> {
    name: &'t str,
    attributes: Vec<(&'t str, Text)>,
    content: Vec<Content>,
    span: Span,
}

enum Content {
    Tag(usize),
    Text(Text),
}

/// An element of the tree.
#[derive(Clone, Copy)]
pub(super) struct Tag<'d, 't> {
    document: &'d Document<'t>,
    at: usize,
}

impl<'t> Document<'t> {
    /// The document as a whole.
    pub(super) fn root(&self) -> Tag<'_, 't> {
        Tag {
            document: self,
            at: 0,
        }
    }
}

impl<'d, 't> Tag<'d, 't> {
    fn node(self) -> &'d Node<'t> {
        &self.document.nodes[self.at]
    }

    /// The local name.
    pub(super) fn name(self) -> &'t str {
        self.node().name
    }

    /// From the start tag's `<` to the end tag's `>`.
    pub(super) fn span(self) -> Span {
        self.node().span
    }

    /// The attribute with that local name.
    pub(super) fn attribute(self, name: &str) -> Option<&'d Text> {
        self.node()
            .attributes
            .iter()
            .find(|(found, _)| *found == name)
            .map(|(_, text)| text)
    }

    /// Whether the attribute says `true`.
    pub(super) fn says(self, name: &str) -> bool {
        self.attribute(name)
            .is_some_and(|text| matches!(text.value.as_str(), "true" | "TRUE" | "1"))
    }

    /// The elements directly inside.
    pub(super) fn children(self) -> impl Iterator<Item = Tag<'d, 't>> {
        let document = self.document;
        self.node()
            .content
            .iter()
            .filter_map(move |part| match part {
                Content::Tag(at) => Some(Tag { document, at: *at }),
                Content::Text(_) => None,
            })
    }

    /// The first element of that name directly inside.
    pub(super) fn child(self, name: &str) -> Option<Tag<'d, 't>> {
        self.children().find(|child| child.name() == name)
    }

    /// All elements inside at any depth, in document order, that `wanted`
    /// picks; what lies inside a picked one is not looked at.
    pub(super) fn inside(self, wanted: &dyn Fn(Tag<'d, 't>) -> bool) -> Vec<Tag<'d, 't>> {
        let mut found = Vec::new();
        let mut open: Vec<_> = self.children().collect();
        open.reverse();
        while let Some(tag) = open.pop() {
            if wanted(tag) {
                found.push(tag);
                continue;
            }
            let before = open.len();
            open.extend(tag.children());
            open[before..].reverse();
        }
        found
    }

    /// The text inside, that of inner elements too, without the blanks around
    /// it; `None` if there is nothing but blanks.
    pub(super) fn text(self) -> Option<Text> {
        let mut pieces = Vec::new();
        self.collect(&mut pieces);
        let first = pieces.iter().position(|piece| !blank(piece))?;
        let last = pieces.iter().rposition(|piece| !blank(piece))?;
        let mut whole = String::new();
        for (at, piece) in pieces.iter().enumerate().take(last + 1).skip(first) {
            let mut value = piece.value.as_str();
            if at == first {
                value = value.trim_start();
            }
            if at == last {
                value = value.trim_end();
            }
            whole.push_str(value);
        }
        let span = trimmed(pieces.get(first)?).cover(trimmed(pieces.get(last)?));
        Some(Text { value: whole, span })
    }

    fn collect(self, pieces: &mut Vec<&'d Text>) {
        for part in &self.node().content {
            match part {
                Content::Text(text) => pieces.push(text),
                Content::Tag(at) => Tag {
                    document: self.document,
                    at: *at,
                }
                .collect(pieces),
            }
        }
    }
}

fn blank(text: &Text) -> bool {
    text.value.trim().is_empty()
}

/// The bytes of a piece without blanks. Where the value has another length
/// than its bytes (an entity), the bytes are kept whole.
fn trimmed(piece: &Text) -> Span {
    if piece.value.len() != piece.span.len() {
        return piece.span;
    }
    let before = piece.value.len() - piece.value.trim_start().len();
    let after = piece.value.len() - piece.value.trim_end().len();
    Span::new(
        piece.span.start as usize + before,
        piece.span.end as usize - after,
    )
}

/// Reads the text as a tree. What is wrong with it goes to `diagnostics`.
pub(super) fn parse<'t>(source: Source<'t>, diagnostics: &mut Vec<Diagnostic>) -> Document<'t> {
    let mut growth = Growth {
        source,
        nodes: vec![Node {
            name: "",
            attributes: Vec::new(),
            content: Vec::new(),
            span: source.span(0, source.text.len()),
        }],
        open: vec![0],
        diagnostics,
    };
    growth.read();
    Document {
        nodes: growth.nodes,
    }
}

struct Growth<'t, 'r> {
    source: Source<'t>,
    nodes: Vec<Node<'t>>,
    /// The elements not yet closed, the document first.
    open: Vec<usize>,
    diagnostics: &'r mut Vec<Diagnostic>,
}

impl<'t> Growth<'t, '_> {
    fn read(&mut self) {
        let mut reader = Reader::from_str(self.source.text);
        let config = reader.config_mut();
        config.check_end_names = false;
        config.allow_unmatched_ends = true;
        loop {
            let start = reader.buffer_position() as usize;
            let event = reader.read_event();
            let end = reader.buffer_position() as usize;
            let span = self.source.span(start, end);
            match event {
                Ok(Event::Start(tag)) => {
                    if self.open.len() > DEEPEST {
                        return self.too_deep(span, end);
                    }
                    let at = self.add(&tag, start, span);
                    self.open.push(at);
                }
                Ok(Event::Empty(tag)) => {
                    self.add(&tag, start, span);
                }
                Ok(Event::End(tag)) => self.close(tag.local_name().into_inner(), span),
                Ok(Event::Text(_)) => {
                    let value = self.source.text.get(start..end).unwrap_or_default();
                    self.push(value.to_owned(), span);
                }
                Ok(Event::CData(data)) => {
                    let inner = self
                        .source
                        .span(start + "<![CDATA[".len(), end - "]]>".len());
                    self.push(data.into_inner().into_owned(), inner);
                }
                Ok(Event::GeneralRef(reference)) => self.refer(&reference, span),
                Ok(Event::DocType(text)) => {
                    if text.contains('[') || text.contains("<!ENTITY") {
                        self.diagnostics.push(
                            Diagnostic::new(
                                codes::XML_REFUSED,
                                span,
                                "the document type declares entities or elements of its own, which are not expanded",
                            )
                            .help("remove the `<!DOCTYPE ...>` declaration; the rest is read"),
                        );
                    }
                }
                Ok(Event::Eof) => return self.end(end),
                Ok(_) => {}
                Err(error) => {
                    let at = (reader.error_position() as usize).min(self.source.text.len());
                    self.wrong(&error, at);
                    let lasting = !matches!(error, Error::IllFormed(_)) || end <= start;
                    if lasting {
                        return self.close_all(self.source.text.len());
                    }
                }
            }
        }
    }

    /// Adds an element inside the innermost open one.
    fn add(&mut self, tag: &BytesStart<'_>, start: usize, span: Span) -> usize {
        let length = tag.name().into_inner().len();
        let qualified = self.source.text.get(start + 1..start + 1 + length);
        let mut attributes = Vec::new();
        // The library compares every attribute with every other, which would
        // cost a square.
        for attribute in tag.attributes().with_checks(false) {
            match attribute {
                Ok(attribute) => {
                    attributes.extend(self.attribute(attribute.key.into_inner(), &attribute.value))
                }
                Err(_) => self.diagnostics.push(
                    Diagnostic::new(
                        codes::XML_SYNTAX,
                        span,
                        "an attribute is not of the form name=\"value\"",
                    )
                    .help("the other attributes of the tag are read; export the file again"),
                ),
            }
        }
        if may_repeat(&attributes) {
            self.report_repeated(tag);
        }
        let at = self.nodes.len();
        self.nodes.push(Node {
            name: local(qualified.unwrap_or_default()),
            attributes,
            content: Vec::new(),
            span,
        });
        self.hold(Content::Tag(at));
        at
    }

    /// Reports the first attribute whose name, prefix and all, an earlier one
    /// bears.
    fn report_repeated(&mut self, tag: &BytesStart<'_>) {
        let mut seen = HashSet::new();
        let mut attributes = tag.attributes();
        let mut attributes = attributes.with_checks(false).flatten();
        let Some(repeated) = attributes.find(|it| !seen.insert(it.key.into_inner())) else {
            return;
        };
        let key = repeated.key.into_inner();
        if let Some((_, value)) = self.attribute(key, &repeated.value) {
            let message = format!("the attribute `{key}` stands here twice");
            self.diagnostics.push(
                Diagnostic::new(codes::XML_SYNTAX, value.span, message)
                    .help("remove one of them; the first counts"),
            );
        }
    }

    /// The attribute `key="value"`, both borrowed from the text.
    fn attribute(&self, key: &str, value: &str) -> Option<(&'t str, Text)> {
        let text = self.source.text;
        let key_at = (key.as_ptr() as usize).checked_sub(text.as_ptr() as usize)?;
        let value_at = (value.as_ptr() as usize).checked_sub(text.as_ptr() as usize)?;
        let key = text.get(key_at..key_at + key.len())?;
        let unescaped = match quick_xml::escape::unescape(value) {
            Ok(unescaped) => unescaped.into_owned(),
            Err(_) => value.to_owned(),
        };
        let value = Text {
            value: unescaped,
            span: self.source.span(value_at, value_at + value.len()),
        };
        Some((local(key), value))
    }

    fn push(&mut self, value: String, span: Span) {
        self.hold(Content::Text(Text { value, span }));
    }

    fn hold(&mut self, content: Content) {
        if let Some(node) = self.open.last().and_then(|at| self.nodes.get_mut(*at)) {
            node.content.push(content);
        }
    }

    fn refer(&mut self, reference: &BytesRef<'_>, span: Span) {
        let name = reference.clone().into_inner();
        let value = match reference.resolve_char_ref() {
            Ok(Some(character)) => Some(character.to_string()),
            _ => quick_xml::escape::resolve_predefined_entity(&name).map(str::to_owned),
        };
        let Some(value) = value else {
            self.diagnostics.push(
                Diagnostic::new(
                    codes::XML_SYNTAX,
                    span,
                    format!("`&{name};` is no entity that XML defines"),
                )
                .help(
                    "write the character itself, or its number such as `&#233;`; it stays as it is",
                ),
            );
            return self.push(format!("&{name};"), span);
        };
        self.push(value, span);
    }

    /// Closes the innermost open element called `name`, and those inside it.
    fn close(&mut self, name: &str, span: Span) {
        let found = self
            .open
            .iter()
            .rposition(|&at| at != 0 && self.nodes[at].name == name);
        let Some(depth) = found else {
            self.diagnostics.push(
                Diagnostic::new(
                    codes::XML_SYNTAX,
                    span,
                    format!("`</{name}>` closes nothing that is open"),
                )
                .help("remove it, or add the start tag it belongs to"),
            );
            return;
        };
        while self.open.len() > depth + 1 {
            let Some(at) = self.open.pop() else { return };
            let node = &mut self.nodes[at];
            let opened = node.span;
            node.span = Span::new(opened.start as usize, span.start as usize);
            let message = format!("`<{}>` is not closed before `</{name}>`", node.name);
            self.diagnostics.push(
                Diagnostic::new(codes::XML_SYNTAX, opened, message)
                    .help("add its end tag")
                    .related(span, "it is taken to end here"),
            );
        }
        if let Some(at) = self.open.pop() {
            let node = &mut self.nodes[at];
            node.span = node.span.cover(span);
        }
    }

    fn end(&mut self, end: usize) {
        if let Some(&at) = self.open.last().filter(|at| **at != 0) {
            let node = &self.nodes[at];
            let here = self.source.span(end, end);
            self.diagnostics.push(
                Diagnostic::new(
                    codes::CUT_SHORT,
                    here,
                    format!("the file ends inside `<{}>`", node.name),
                )
                .help("copy or export it again; what was complete is read")
                .related(node.span, "opened here"),
            );
        }
        self.close_all(end);
    }

    fn close_all(&mut self, end: usize) {
        let end = self.source.span(end, end);
        for at in self.open.drain(..) {
            let node = &mut self.nodes[at];
            node.span = node.span.cover(end);
        }
    }

    fn too_deep(&mut self, span: Span, end: usize) {
        let message = format!("elements are nested deeper than {DEEPEST}");
        self.diagnostics.push(
            Diagnostic::new(codes::XML_REFUSED, span, message)
                .help("no export nests so deep; what stood before this place is read"),
        );
        self.close_all(end);
    }

    fn wrong(&mut self, error: &Error, at: usize) {
        let more_follows = self
            .source
            .text
            .get(at + 1..)
            .is_some_and(|rest| rest.contains('<'));
        let breaks_off = matches!(error, Error::Syntax(_)) && !more_follows
            || matches!(
                error,
                Error::Syntax(SyntaxError::UnclosedComment | SyntaxError::UnclosedCData)
            );
        let (code, message, help) = if breaks_off {
            (
                codes::CUT_SHORT,
                "the file ends inside what begins here".to_owned(),
                "copy or export it again; what was complete is read",
            )
        } else {
            (
                codes::XML_SYNTAX,
                format!("the XML is not well formed: {error}"),
                "mend it, or export the file again",
            )
        };
        let span = self.source.span(at, at);
        self.diagnostics
            .push(Diagnostic::new(code, span, message).help(help));
    }
}

/// Whether two attributes may bear one name. Nearly all tags have few of them,
/// and comparing these costs less than hashing.
fn may_repeat(attributes: &[(&str, Text)]) -> bool {
    const FEW: usize = 16;
    let is_known = |(at, (name, _)): (usize, &(&str, Text))| {
        let mut before = attributes.iter().take(at);
        before.any(|(other, _)| other == name)
    };
    attributes.len() > FEW || attributes.iter().enumerate().any(is_known)
}

/// A qualified name without its prefix.
fn local(name: &str) -> &str {
    name.rsplit(':').next().unwrap_or(name)
}
