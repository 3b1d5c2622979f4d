use std::borrow::Cow;

use source::Span;

use super::{Document, Node, NodeKind, wide};
use crate::rockwell::passage::Passage;

/// An element of a document.
#[derive(Clone, Copy)]
pub(crate) struct Element<'d, 't> {
    pub(super) document: &'d Document<'t>,
    pub(super) at: usize,
}

impl<'d, 't> Element<'d, 't> {
    /// The tag's name, without a namespace prefix.
    pub(crate) fn name(self) -> &'t str {
        let node = self.node();
        match node.kind {
            NodeKind::Element {
                prefix,
                name_length,
                ..
            } => {
                let start = node.inner_start;
                self.document.text_at(start + prefix, start + name_length)
            }
            _ => "",
        }
    }

    /// Whether its end tag was there.
    pub(crate) fn is_complete(self) -> bool {
        matches!(self.node().kind, NodeKind::Element { complete: true, .. })
    }

    /// The value of an attribute. Its name is compared without case: tools
    /// other than Rockwell's write `use` and `Datatype`.
    pub(crate) fn attribute(self, name: &str) -> Option<Cow<'t, str>> {
        let NodeKind::Element { attributes, .. } = self.node().kind else {
            return None;
        };
        let text = self.document.source.text;
        let own = attributes.0 as usize..attributes.1 as usize;
        let mut own = self.document.attributes.get(own)?.iter();
        let found = own.find(|own| {
            own.name_length() == name.len() && own.name(text).eq_ignore_ascii_case(name)
        })?;
        let value = text.get(found.value())?;
        Some(quick_xml::escape::unescape(value).unwrap_or(Cow::Borrowed(value)))
    }

    /// Whether an attribute has this value, both compared without case.
    pub(crate) fn attribute_is(self, name: &str, value: &str) -> bool {
        self.attribute(name)
            .is_some_and(|found| found.eq_ignore_ascii_case(value))
    }

    /// The elements directly inside.
    pub(crate) fn children(self) -> impl Iterator<Item = Element<'d, 't>> {
        let document = self.document;
        self.inside()
            .filter(|&at| document.nodes[at].is_element())
            .map(move |at| Element { document, at })
    }

    /// Whether nothing but blanks is inside.
    pub(crate) fn is_leaf(self) -> bool {
        self.node().first_child.is_none()
    }

    /// The elements directly inside that have this name, compared without case.
    pub(crate) fn children_named(self, name: &str) -> impl Iterator<Item = Element<'d, 't>> {
        self.children()
            .filter(move |child| child.name().eq_ignore_ascii_case(name))
    }

    /// The first element directly inside that has this name.
    pub(crate) fn child(self, name: &str) -> Option<Element<'d, 't>> {
        self.children_named(name).next()
    }

    /// Itself and all elements inside it, in the order of the text. The depth of
    /// a document is bounded, and so is this walk's memory.
    pub(crate) fn descendants(self) -> impl Iterator<Item = Element<'d, 't>> {
        let document = self.document;
        // What follows an element that never ended is all inside it.
        let end = if self.is_complete() {
            self.node().end
        } else {
            u32::MAX
        };
        document.nodes[self.at..]
            .iter()
            .take_while(move |node| node.start < end)
            .enumerate()
            .filter(|(_, node)| node.is_element())
            .map(move |(after, _)| Element {
                document,
                at: self.at + after,
            })
    }

    /// The text directly inside.
    pub(crate) fn passage(self) -> Passage<'t> {
        let document = self.document;
        let source = document.source;
        let mut passage = Passage::empty(source.base + self.node().inner_end as usize);
        for at in self.inside() {
            let node = &document.nodes[at];
            let place = source.span(node.inner_start as usize, node.inner_end as usize);
            match node.kind {
                NodeKind::Text => {
                    let text = document.text_at(node.inner_start, node.inner_end);
                    passage.push(text, place);
                }
                NodeKind::Character(character) => passage.push_character(character, place),
                NodeKind::Element { .. } => {}
            }
        }
        passage
    }

    /// The bytes of the element, tags included.
    pub(crate) fn span(self) -> Span {
        let node = self.node();
        let source = self.document.source;
        source.span(node.start as usize, node.end as usize)
    }

    /// The bytes of the start tag.
    pub(crate) fn tag_span(self) -> Span {
        let node = self.node();
        let source = self.document.source;
        let end = node.inner_end as usize;
        let rest = source.text.get(end..).unwrap_or_default();
        let closing = if rest.starts_with("/>") { 2 } else { 1 };
        source.span(node.start as usize, end + closing)
    }

    fn inside(self) -> impl Iterator<Item = usize> {
        let document = self.document;
        let first = self.node().first_child;
        std::iter::successors(first, move |&at| document.nodes[wide(at)].next).map(wide)
    }

    fn node(self) -> &'d Node {
        &self.document.nodes[self.at]
    }
}
