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

use std::borrow::Cow;
use std::ops::Range;

use quick_xml::Reader;
use quick_xml::errors::{Error, SyntaxError};
use quick_xml::events::{BytesRef, BytesStart, Event};
use source::{Diagnostic, Span, codes};

use crate::reading::Source;
use crate::xml::{Attribute, attributes, prefix_length, repeated};

/// Exports nest some twenty levels deep; far more is an attack.
const DEEPEST: usize = 256;

/// A text with the bytes it was read from, without the blanks around it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Text<'t> {
    pub(super) value: Cow<'t, str>,
    pub(super) span: Span,
}

impl<'t> Text<'t> {
    /// The text without the blanks at its ends.
    pub(super) fn trimmed(self) -> Cow<'t, str> {
        match self.value {
            Cow::Borrowed(value) => Cow::Borrowed(value.trim()),
            Cow::Owned(value) => Cow::Owned(value.trim().to_owned()),
        }
    }
}

/// The tree; its element 0 stands for the document and holds the root element.
pub(super) struct Document<'t> {
    source: Source<'t>,
    elements: Vec<Element<'t>>,
    /// The attributes of all elements, in document order.
    attributes: Vec<Attribute>,
    /// The pieces of text of all elements, in document order.
    pieces: Vec<Piece>,
}

/// An element. All that is inside of it follows it in the lists, up to what is
/// after it.
struct Element<'t> {
    name: &'t str,
    /// From the start tag's `<` to the end tag's `>`.
    span: Span,
    attributes: Range<u32>,
    pieces: Range<u32>,
    /// The first element that is not inside.
    after: u32,
}

/// A piece of text: bytes of the file as they are, or a character written as
/// an entity.
#[derive(Clone, Copy)]
struct Piece {
    start: u32,
    end: u32,
    entity: Option<char>,
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

    fn written(&self, piece: Piece) -> &'t str {
        let range = piece.start as usize..piece.end as usize;
        self.source.text.get(range).unwrap_or_default()
    }

    fn is_blank(&self, piece: Piece) -> bool {
        match piece.entity {
            Some(character) => character.is_whitespace(),
            None => self.written(piece).trim_start().is_empty(),
        }
    }

    /// The bytes of a piece without blanks; those of an entity are kept whole.
    fn trimmed(&self, piece: Piece) -> Span {
        let (mut start, mut end) = (piece.start as usize, piece.end as usize);
        if piece.entity.is_none() {
            let text = self.written(piece);
            start += text.len() - text.trim_start().len();
            end -= text.len() - text.trim_end().len();
        }
        self.source.span(start, end)
    }
}

impl<'d, 't> Tag<'d, 't> {
    fn element(self) -> &'d Element<'t> {
        &self.document.elements[self.at]
    }

    /// The local name.
    pub(super) fn name(self) -> &'t str {
        self.element().name
    }

    /// From the start tag's `<` to the end tag's `>`.
    pub(super) fn span(self) -> Span {
        self.element().span
    }

    /// The attribute with that local name.
    pub(super) fn attribute(self, name: &str) -> Option<Text<'t>> {
        let source = self.document.source;
        let own = wide(&self.element().attributes);
        let mut own = self.document.attributes.get(own)?.iter();
        let found = own.find(|own| has_local_name(own.name(source.text), name))?;
        let range = found.value();
        let value = source.text.get(range.clone())?;
        Some(Text {
            value: quick_xml::escape::unescape(value).unwrap_or(Cow::Borrowed(value)),
            span: source.span(range.start, range.end),
        })
    }

    /// Whether the attribute says `true`.
    pub(super) fn says(self, name: &str) -> bool {
        self.attribute(name)
            .is_some_and(|text| matches!(&*text.value, "true" | "TRUE" | "1"))
    }

    /// The elements directly inside.
    pub(super) fn children(self) -> impl Iterator<Item = Tag<'d, 't>> + Clone {
        let document = self.document;
        let after = self.element().after as usize;
        let child = move |at: usize| (at < after).then_some(Tag { document, at });
        std::iter::successors(child(self.at + 1), move |tag| {
            child(tag.element().after as usize)
        })
    }

    /// The first element of that name directly inside.
    pub(super) fn child(self, name: &str) -> Option<Tag<'d, 't>> {
        self.children().find(|child| child.name() == name)
    }

    /// All elements inside at any depth, in document order, that `wanted`
    /// picks; what lies inside a picked one is not looked at.
    pub(super) fn inside(
        self,
        wanted: impl Fn(Tag<'d, 't>) -> bool,
    ) -> impl Iterator<Item = Tag<'d, 't>> {
        let document = self.document;
        let end = self.element().after as usize;
        let mut next = self.at + 1;
        std::iter::from_fn(move || {
            let mut left = (next..end).map(|at| Tag { document, at });
            let found = left.find(|tag| wanted(*tag));
            next = found.map_or(end, |tag| tag.element().after as usize);
            found
        })
    }

    /// The text inside, that of inner elements too, without the blanks around
    /// it; `None` if there is nothing but blanks.
    pub(super) fn text(self) -> Option<Text<'t>> {
        let document = self.document;
        let pieces = document.pieces.get(wide(&self.element().pieces))?;
        let is_said = |piece: &Piece| !document.is_blank(*piece);
        let first = pieces.iter().position(is_said)?;
        let last = pieces.iter().rposition(is_said)?;
        let said = pieces.get(first..=last)?;
        let value = match said {
            [only] if only.entity.is_none() => Cow::Borrowed(document.written(*only).trim()),
            _ => {
                let mut whole = String::new();
                for piece in said {
                    match piece.entity {
                        Some(character) => whole.push(character),
                        None => whole.push_str(document.written(*piece)),
                    }
                }
                Cow::Owned(whole.trim().to_owned())
            }
        };
        let first = document.trimmed(*said.first()?);
        let span = first.cover(document.trimmed(*said.last()?));
        Some(Text { value, span })
    }
}

fn wide(range: &Range<u32>) -> Range<usize> {
    range.start as usize..range.end as usize
}

/// A place in a text, or in a list that is shorter. No reader is given a text
/// that 32 bits cannot count.
fn narrow(place: usize) -> u32 {
    u32::try_from(place).unwrap_or(u32::MAX)
}

/// Reads the text as a tree. What is wrong with it goes to `diagnostics`.
pub(super) fn parse<'t>(source: Source<'t>, diagnostics: &mut Vec<Diagnostic>) -> Document<'t> {
    let mut growth = Growth {
        document: Document {
            source,
            // About as many as exports hold, to grow the lists seldom.
            elements: Vec::with_capacity(source.text.len() / 32),
            attributes: Vec::with_capacity(source.text.len() / 64),
            pieces: Vec::with_capacity(source.text.len() / 32),
        },
        open: vec![0],
        diagnostics,
    };
    growth.document.elements.push(Element {
        name: "",
        span: source.span(0, source.text.len()),
        attributes: 0..0,
        pieces: 0..0,
        after: 0,
    });
    growth.read();
    growth.document
}

struct Growth<'t, 'r> {
    document: Document<'t>,
    /// The elements not yet closed, the document first.
    open: Vec<usize>,
    diagnostics: &'r mut Vec<Diagnostic>,
}

impl<'t> Growth<'t, '_> {
    fn read(&mut self) {
        let source = self.document.source;
        let mut reader = Reader::from_str(source.text);
        let config = reader.config_mut();
        config.check_end_names = false;
        config.allow_unmatched_ends = true;
        loop {
            let start = reader.buffer_position() as usize;
            let event = reader.read_event();
            let end = reader.buffer_position() as usize;
            let span = source.span(start, end);
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
                Ok(Event::End(tag)) => self.close(local(tag.name().into_inner()), span),
                Ok(Event::Text(_)) => self.push(start..end, None),
                Ok(Event::CData(_)) => {
                    self.push(start + "<![CDATA[".len()..end - "]]>".len(), None);
                }
                Ok(Event::GeneralRef(reference)) => {
                    let character = self.character(&reference, span);
                    self.push(start..end, character);
                }
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
                    let at = (reader.error_position() as usize).min(source.text.len());
                    self.wrong(&error, at);
                    let lasting = !matches!(error, Error::IllFormed(_)) || end <= start;
                    if lasting {
                        return self.close_all(source.text.len());
                    }
                }
            }
        }
    }

    /// Adds an element inside the innermost open one.
    fn add(&mut self, tag: &BytesStart<'_>, start: usize, span: Span) -> usize {
        let name = start + 1..start + 1 + tag.name().into_inner().len();
        let first = self.document.attributes.len();
        self.attributes(tag, name.end, span);
        let own = &self.document.attributes[first..];
        self.diagnostics.extend(repeated(self.document.source, own));
        let document = &mut self.document;
        let at = document.elements.len();
        let pieces = narrow(document.pieces.len());
        document.elements.push(Element {
            name: local(document.source.text.get(name).unwrap_or_default()),
            span,
            attributes: narrow(first)..narrow(document.attributes.len()),
            pieces: pieces..pieces,
            after: narrow(at + 1),
        });
        at
    }

    /// Adds the attributes of `tag`, which follow its name.
    fn attributes(&mut self, tag: &BytesStart<'_>, start: usize, span: Span) {
        let first = self.document.attributes.len();
        let offset = start - tag.name().into_inner().len();
        let after_name = start..offset + tag.len();
        let text = self.document.source.text;
        if attributes(text, after_name, &mut self.document.attributes).is_ok() {
            return;
        }
        // The XML reader knows what is wrong, and how to go on.
        self.document.attributes.truncate(first);
        // The library compares every attribute with every other, which would
        // cost a square.
        for attribute in tag.attributes().with_checks(false) {
            match attribute {
                Ok(attribute) => {
                    let name = attribute.key.into_inner();
                    self.document
                        .attributes
                        .extend(self.place(name, &attribute.value));
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
    }

    /// The attribute whose name and value are parts of the text.
    fn place(&self, name: &str, value: &str) -> Option<Attribute> {
        let text = self.document.source.text;
        let range = |part: &str| {
            let start = (part.as_ptr() as usize).checked_sub(text.as_ptr() as usize)?;
            Some(start..start + part.len())
        };
        Some(Attribute::new(range(name)?, range(value)?))
    }

    fn push(&mut self, range: Range<usize>, entity: Option<char>) {
        self.document.pieces.push(Piece {
            start: narrow(range.start),
            end: narrow(range.end),
            entity,
        });
    }

    /// The character that `&amp;` or `&#38;` stands for.
    fn character(&mut self, reference: &BytesRef<'_>, span: Span) -> Option<char> {
        let name = reference.clone().into_inner();
        let character = match reference.resolve_char_ref() {
            Ok(Some(character)) => Some(character),
            _ => quick_xml::escape::resolve_predefined_entity(&name)
                .and_then(|text| text.chars().next()),
        };
        if character.is_none() {
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
        }
        character
    }

    /// Notes that all inside of an element has been read.
    fn complete(&mut self, at: usize, span: Span) {
        let document = &mut self.document;
        let (after, pieces) = (document.elements.len(), document.pieces.len());
        let element = &mut document.elements[at];
        element.span = span;
        element.after = narrow(after);
        element.pieces.end = narrow(pieces);
    }

    /// Closes the innermost open element called `name`, and those inside it.
    fn close(&mut self, name: &str, span: Span) {
        let found = self
            .open
            .iter()
            .rposition(|&at| at != 0 && self.document.elements[at].name == name);
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
            let Element {
                name: inner,
                span: opened,
                ..
            } = self.document.elements[at];
            self.complete(at, Span::new(opened.start as usize, span.start as usize));
            let message = format!("`<{inner}>` is not closed before `</{name}>`");
            self.diagnostics.push(
                Diagnostic::new(codes::XML_SYNTAX, opened, message)
                    .help("add its end tag")
                    .related(span, "it is taken to end here"),
            );
        }
        if let Some(at) = self.open.pop() {
            self.complete(at, self.document.elements[at].span.cover(span));
        }
    }

    fn end(&mut self, end: usize) {
        if let Some(&at) = self.open.last().filter(|at| **at != 0) {
            let element = &self.document.elements[at];
            let here = self.document.source.span(end, end);
            self.diagnostics.push(
                Diagnostic::new(
                    codes::CUT_SHORT,
                    here,
                    format!("the file ends inside `<{}>`", element.name),
                )
                .help("copy or export it again; what was complete is read")
                .related(element.span, "opened here"),
            );
        }
        self.close_all(end);
    }

    fn close_all(&mut self, end: usize) {
        let end = self.document.source.span(end, end);
        while let Some(at) = self.open.pop() {
            self.complete(at, self.document.elements[at].span.cover(end));
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
        let source = self.document.source;
        let more_follows = source
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
        let span = source.span(at, at);
        self.diagnostics
            .push(Diagnostic::new(code, span, message).help(help));
    }
}

/// A qualified name without its prefix.
fn local(name: &str) -> &str {
    name.get(prefix_length(name)..).unwrap_or_default()
}

/// Whether `wanted` is what stands after the prefix of `name`.
fn has_local_name(name: &str, wanted: &str) -> bool {
    name.strip_suffix(wanted)
        .is_some_and(|prefix| prefix.is_empty() || prefix.ends_with(':'))
}
