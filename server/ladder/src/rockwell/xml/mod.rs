//! An XML document as a flat list of nodes, each with its place in the file.
//!
//! Not a general library: no namespaces, no entities but the five of XML
//! itself, no comments kept. What it adds to the pull reader is what a ladder
//! file needs: every element's bytes, text that maps back to the file
//! ([`Passage`](super::passage::Passage)), and a tree that survives a file that was cut short: elements
//! that never ended are there, marked as incomplete.

mod element;

use std::num::NonZeroU32;
use std::ops::Range;

use quick_xml::events::{BytesRef, Event};
use quick_xml::{Error, Reader};
use source::{Diagnostic, Span, codes};

pub(super) use element::Element;

use crate::reading::Source;
use crate::xml::{Attribute, attributes, prefix_length, repeated};

/// Deepest nesting that is read. Exports stay below 30.
const DEEPEST: usize = 256;

/// A document. Node 0, where there is one, is the root element.
pub(super) struct Document<'t> {
    source: Source<'t>,
    nodes: Vec<Node>,
    /// Those of all elements, in the order of the text.
    attributes: Vec<Attribute>,
}

/// A large file has a node for every few dozen bytes, so that nodes are kept
/// small: places of a file, and of a list of its nodes, fit 32 bits.
#[derive(Clone, Copy)]
struct Node {
    kind: NodeKind,
    /// The whole node, in bytes of the text.
    start: u32,
    end: u32,
    /// What is inside: the tag's name and attributes, or the text.
    inner_start: u32,
    inner_end: u32,
    // Node 0 is nobody's child.
    first_child: Option<NonZeroU32>,
    last_child: Option<NonZeroU32>,
    next: Option<NonZeroU32>,
}

#[derive(Clone, Copy, PartialEq)]
enum NodeKind {
    Element {
        /// Bytes of the name's namespace prefix, its colon included.
        prefix: u32,
        /// Bytes of the whole name.
        name_length: u32,
        /// Its first place in the list of attributes, and the one after its last.
        attributes: (u32, u32),
        complete: bool,
    },
    Text,
    Character(char),
}

/// Reads `source`; what is wrong with it is added to `diagnostics`, and what
/// stood before the fault is kept.
pub(super) fn read<'t>(source: Source<'t>, diagnostics: &mut Vec<Diagnostic>) -> Document<'t> {
    let mut document = Document {
        source,
        // About as many as exports hold, to grow the lists seldom.
        nodes: Vec::with_capacity(source.text.len() / 64),
        attributes: Vec::with_capacity(source.text.len() / 32),
    };
    if let Err(diagnostic) = document.fill(diagnostics) {
        diagnostics.push(*diagnostic);
    }
    document
}

impl<'t> Document<'t> {
    /// The root element.
    pub(super) fn root(&self) -> Option<Element<'_, 't>> {
        let at = self.nodes.iter().position(Node::is_element)?;
        Some(Element { document: self, at })
    }

    fn fill(&mut self, diagnostics: &mut Vec<Diagnostic>) -> Result<(), Box<Diagnostic>> {
        let text = self.source.text;
        let mut reader = Reader::from_str(text);
        // An end tag that fits nothing is reported here, and reading goes on.
        reader.config_mut().check_end_names = false;
        reader.config_mut().allow_unmatched_ends = true;
        let mut open: Vec<usize> = Vec::new();
        loop {
            let start = reader.buffer_position() as usize;
            let event = match reader.read_event() {
                Ok(event) => event,
                Err(error) => {
                    let at = (reader.error_position() as usize).min(text.len());
                    return Err(self.fault(&error, at, &open));
                }
            };
            let end = reader.buffer_position() as usize;
            match event {
                Event::Start(tag) => {
                    let name = tag.name().into_inner();
                    let at =
                        self.add_element(start..end, start + 1..end - 1, name, &open, diagnostics);
                    open.push(at);
                    if open.len() > DEEPEST {
                        return Err(self.too_deep(start, end));
                    }
                }
                Event::Empty(tag) => {
                    let name = tag.name().into_inner();
                    let at =
                        self.add_element(start..end, start + 1..end - 2, name, &open, diagnostics);
                    self.close(at, end);
                }
                Event::End(tag) => {
                    let name = tag.name().into_inner();
                    self.end(name, start..end, &mut open, diagnostics);
                }
                Event::Text(_) => self.add_text(start..end, &open),
                Event::CData(_) => {
                    let inner = start + "<![CDATA[".len()..end.saturating_sub("]]>".len());
                    self.add_text(inner, &open);
                }
                Event::GeneralRef(entity) => match character(&entity) {
                    Some(character) => {
                        self.add(
                            NodeKind::Character(character),
                            start..end,
                            start..end,
                            &open,
                        );
                    }
                    None => {
                        diagnostics.push(self.unknown_entity(start, end));
                        self.add_text(start..end, &open);
                    }
                },
                Event::DocType(doctype) => {
                    if doctype.contains('[') {
                        diagnostics.push(self.refused_doctype(start, end));
                    }
                }
                Event::Comment(_) | Event::Decl(_) | Event::PI(_) => {}
                Event::Eof => {
                    return match open.last() {
                        Some(&at) => Err(self.cut_short(at)),
                        None => Ok(()),
                    };
                }
            }
        }
    }

    fn add_element(
        &mut self,
        whole: Range<usize>,
        inner: Range<usize>,
        name: &str,
        open: &[usize],
        diagnostics: &mut Vec<Diagnostic>,
    ) -> usize {
        let inner = inner.start..inner.end.max(inner.start);
        let first = self.attributes.len();
        let after_name = inner.start + name.len()..inner.end;
        let fault = attributes(self.source.text, after_name, &mut self.attributes).err();
        if let Some(at) = fault {
            diagnostics.push(
                Diagnostic::new(
                    codes::XML_SYNTAX,
                    Span::at(self.source.base + at),
                    "an attribute is not of the form name=\"value\"",
                )
                .help("the attributes before this place are read; export the file again"),
            );
        }
        diagnostics.extend(repeated(self.source, &self.attributes[first..]));
        let kind = NodeKind::Element {
            prefix: narrow(prefix_length(name)),
            name_length: narrow(name.len()),
            attributes: (narrow(first), narrow(self.attributes.len())),
            complete: false,
        };
        self.add(kind, whole, inner, open)
    }

    /// Closes the innermost open element of that name, and those inside it.
    fn end(
        &mut self,
        name: &str,
        place: Range<usize>,
        open: &mut Vec<usize>,
        diagnostics: &mut Vec<Diagnostic>,
    ) {
        let Some(depth) = open.iter().rposition(|&at| self.name_at(at) == name) else {
            let message = format!("`</{name}>` closes nothing that is open");
            let place = self.source.span(place.start, place.end);
            diagnostics.push(
                Diagnostic::new(codes::XML_SYNTAX, place, message)
                    .help("remove it, or add the start tag that it belongs to"),
            );
            return;
        };
        for at in open.drain(depth + 1..).rev() {
            let message = format!("`<{}>` is not closed before `</{name}>`", self.name_at(at));
            let node = &mut self.nodes[at];
            node.end = narrow(place.start);
            let tag = self
                .source
                .span(node.start as usize, node.inner_end as usize + 1);
            diagnostics.push(
                Diagnostic::new(codes::XML_SYNTAX, tag, message)
                    .help("add its end tag; it is taken to end where the other one stands"),
            );
        }
        if let Some(at) = open.pop() {
            self.close(at, place.end);
        }
    }

    fn add_text(&mut self, range: Range<usize>, open: &[usize]) {
        let text = self.source.text.get(range.clone()).unwrap_or_default();
        // Most texts are the blanks between tags, and those are ASCII.
        if !text.trim_ascii_start().trim_start().is_empty() && !open.is_empty() {
            self.add(NodeKind::Text, range.clone(), range, open);
        }
    }

    fn add(
        &mut self,
        kind: NodeKind,
        whole: Range<usize>,
        inner: Range<usize>,
        open: &[usize],
    ) -> usize {
        let at = self.nodes.len();
        self.nodes.push(Node {
            kind,
            start: narrow(whole.start),
            end: narrow(whole.end),
            inner_start: narrow(inner.start),
            inner_end: narrow(inner.end),
            first_child: None,
            last_child: None,
            next: None,
        });
        let Some(&parent) = open.last() else {
            return at;
        };
        let child = NonZeroU32::new(narrow(at));
        let before = std::mem::replace(&mut self.nodes[parent].last_child, child);
        match before {
            Some(sibling) => self.nodes[wide(sibling)].next = child,
            None => self.nodes[parent].first_child = child,
        }
        at
    }

    fn close(&mut self, at: usize, end: usize) {
        let node = &mut self.nodes[at];
        node.end = narrow(end);
        if let NodeKind::Element { complete, .. } = &mut node.kind {
            *complete = true;
        }
    }

    /// The tag's whole name.
    fn name_at(&self, at: usize) -> &'t str {
        let node = &self.nodes[at];
        match node.kind {
            NodeKind::Element { name_length, .. } => {
                self.text_at(node.inner_start, node.inner_start + name_length)
            }
            _ => "",
        }
    }

    fn text_at(&self, start: u32, end: u32) -> &'t str {
        let range = start as usize..end as usize;
        self.source.text.get(range).unwrap_or_default()
    }

    fn fault(&self, error: &Error, at: usize, open: &[usize]) -> Box<Diagnostic> {
        if let (Error::Syntax(_), Some(&element)) = (error, open.last()) {
            // The reader met the end of the file inside a tag or a section.
            return self.cut_short(element);
        }
        let place = self.source.span(at, at);
        let message = format!("the XML is not well formed: {error}");
        Box::new(
            Diagnostic::new(codes::XML_SYNTAX, place, message)
                .help("what stood before this place is read; export the file again"),
        )
    }

    fn cut_short(&self, element: usize) -> Box<Diagnostic> {
        let node = &self.nodes[element];
        let message = format!(
            "the file ends inside the element `{}`, which began here",
            self.name_at(element)
        );
        let tag = self
            .source
            .span(node.start as usize, node.inner_end as usize + 1);
        Box::new(
            Diagnostic::new(codes::CUT_SHORT, tag, message)
                .help("copy or export the file again; what was complete is read"),
        )
    }

    fn unknown_entity(&self, start: usize, end: usize) -> Diagnostic {
        let written = self.source.text.get(start..end).unwrap_or_default();
        let message = format!("`{written}` is no entity that XML defines");
        let place = self.source.span(start, end);
        Diagnostic::new(codes::XML_SYNTAX, place, message)
            .help("write the character itself, or its number such as `&#233;`; it stays as it is")
    }

    fn refused_doctype(&self, start: usize, end: usize) -> Diagnostic {
        Diagnostic::new(
            codes::XML_REFUSED,
            self.source.span(start, end),
            "the document type declares entities or elements of its own, which are not expanded",
        )
        .help("remove the `<!DOCTYPE ...>` declaration; the rest is read")
    }

    fn too_deep(&self, start: usize, end: usize) -> Box<Diagnostic> {
        let message = format!("elements are nested deeper than {DEEPEST}");
        Box::new(
            Diagnostic::new(codes::XML_REFUSED, self.source.span(start, end), message)
                .help("no export nests so deep; what stood before this place is read"),
        )
    }
}

impl Node {
    fn is_element(&self) -> bool {
        matches!(self.kind, NodeKind::Element { .. })
    }
}

/// A place in a text, or in its list of nodes, which is shorter. No reader is
/// given a text that 32 bits cannot count.
fn narrow(place: usize) -> u32 {
    u32::try_from(place).unwrap_or(u32::MAX)
}

fn wide(node: NonZeroU32) -> usize {
    node.get() as usize
}

/// The character that `&amp;` or `&#38;` stands for.
fn character(entity: &BytesRef<'_>) -> Option<char> {
    if entity.is_char_ref() {
        return entity.resolve_char_ref().ok().flatten();
    }
    match &**entity {
        "lt" => Some('<'),
        "gt" => Some('>'),
        "amp" => Some('&'),
        "apos" => Some('\''),
        "quot" => Some('"'),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(text: &str) -> (Document<'_>, Vec<String>) {
        let mut diagnostics = Vec::new();
        let document = read(Source { text, base: 0 }, &mut diagnostics);
        let codes = diagnostics.iter().map(|d| d.code.to_string()).collect();
        (document, codes)
    }

    #[test]
    fn elements_attributes_and_text_know_their_places() {
        let text = "<a>\n<b k = 'v&amp;w'  x=\"\">one<![CDATA[<two>]]></b></a>";
        let (document, codes) = check(text);
        assert!(codes.is_empty());
        let b = document.root().and_then(|a| a.child("B")).expect("b");
        assert_eq!(b.attribute("K").as_deref(), Some("v&w"));
        assert_eq!(b.attribute("x").as_deref(), Some(""));
        let passage = b.passage();
        assert_eq!(passage.text(), "one<two>");
        assert_eq!(&text[passage.span(3..8).range()], "<two>");
        assert!(text[b.span().range()].starts_with("<b k"));
    }

    #[test]
    fn what_stood_before_a_fault_is_kept() {
        for (text, code) in [
            ("<a><b/><c>", "G1006"),
            ("<a><b/><c x=\"", "G1006"),
            ("<a><b/><![CDATA[ x", "G1006"),
        ] {
            let (document, codes) = check(text);
            assert_eq!(codes, [code], "{text}");
            let root = document.root().expect("root");
            assert!(!root.is_complete(), "{text}");
            assert!(root.child("b").is_some_and(Element::is_complete), "{text}");
        }
    }

    #[test]
    fn what_follows_a_fault_is_read() {
        for text in [
            "<a><b/></c><d/></a>",
            "<a><b/><c></a>",
            "<a><b/><c x/><d/></a>",
            "<a><b/><c x=\"1\" x=\"2\"/><d/></a>",
        ] {
            let (document, codes) = check(text);
            assert_eq!(codes, ["G1004"], "{text}");
            let root = document.root().expect("root");
            assert!(root.is_complete(), "{text}");
            assert!(root.child("b").is_some_and(Element::is_complete), "{text}");
            assert!(root.child("d").is_some() == text.contains("<d/>"), "{text}");
        }
    }

    #[test]
    fn an_entity_that_nothing_defines_stays_as_it_is() {
        let (document, codes) = check("<a><b/>&nbsp;<c/></a>");
        assert_eq!(codes, ["G1004"]);
        let root = document.root().expect("root");
        assert!(root.is_complete() && root.child("c").is_some());
        assert_eq!(root.passage().text(), "&nbsp;");
    }

    #[test]
    fn constructs_that_could_grow_without_bound_are_refused() {
        let (document, codes) = check("<!DOCTYPE a [<!ENTITY x \"y\">]><a>&x;</a>");
        assert_eq!(codes, ["G1005", "G1004"]);
        assert_eq!(document.root().expect("root").passage().text(), "&x;");
        let deep = "<a>".repeat(300);
        let (_, codes) = check(&deep);
        assert_eq!(codes, ["G1005"]);
        let (_, codes) = check("<!DOCTYPE a><a/>");
        assert!(codes.is_empty());
    }
}
