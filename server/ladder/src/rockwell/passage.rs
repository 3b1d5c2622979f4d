use std::borrow::Cow;
use std::ops::Range;

use source::Span;

/// A stretch of text as the format means it, that knows the bytes of the file
/// behind every byte of its own.
///
/// Rung text in XML is split into CDATA sections, plain text and entities:
/// `GRT(a,b)` may be written `CMP(a&gt;b)`. A passage is the text put together
/// again; [`Passage::span`] leads back to the file, exactly in copied pieces,
/// and to the whole entity where one stands for a character.
#[derive(Clone, Debug)]
pub(super) struct Passage<'t> {
    text: Cow<'t, str>,
    pieces: Vec<Piece>,
    /// Where an empty passage stands.
    place: usize,
}

/// Bytes `at..at + length` of the passage came from `place`. Lengths are equal
/// exactly for copied text: an entity is longer than what it stands for.
#[derive(Clone, Copy, Debug)]
struct Piece {
    at: usize,
    length: usize,
    place: Span,
}

impl<'t> Passage<'t> {
    /// An empty passage that stands at byte `place` of the file.
    pub(super) fn empty(place: usize) -> Self {
        Self {
            text: Cow::Borrowed(""),
            pieces: Vec::new(),
            place,
        }
    }

    /// `text`, copied from byte `place` of the file on.
    pub(super) fn copied(text: &'t str, place: usize) -> Self {
        let mut passage = Self::empty(place);
        passage.push(text, Span::new(place, place + text.len()));
        passage
    }

    /// Adds `text`, which `place` of the file stands for.
    pub(super) fn push(&mut self, text: &'t str, place: Span) {
        self.note_piece(text.len(), place);
        if self.text.is_empty() {
            self.text = Cow::Borrowed(text);
        } else {
            self.text.to_mut().push_str(text);
        }
    }

    /// Adds one character, which `place` of the file stands for.
    pub(super) fn push_character(&mut self, character: char, place: Span) {
        self.note_piece(character.len_utf8(), place);
        self.text.to_mut().push(character);
    }

    fn note_piece(&mut self, length: usize, place: Span) {
        if length > 0 {
            self.pieces.push(Piece {
                at: self.text.len(),
                length,
                place,
            });
        }
    }

    /// The text.
    pub(super) fn text(&self) -> &str {
        &self.text
    }

    /// The bytes of the file that bytes `range` of the text came from.
    pub(super) fn span(&self, range: Range<usize>) -> Span {
        let start = self.start_of(range.start);
        if range.end <= range.start {
            return Span::at(start);
        }
        Span::new(start, self.end_of(range.end))
    }

    fn start_of(&self, at: usize) -> usize {
        match self.piece_with(at) {
            Some(piece) if at >= piece.at + piece.length => piece.place.end as usize,
            Some(piece) if piece.is_copied() => piece.place.start as usize + (at - piece.at),
            Some(piece) => piece.place.start as usize,
            None => self.place,
        }
    }

    fn end_of(&self, end: usize) -> usize {
        match self.piece_with(end.saturating_sub(1)) {
            Some(piece) if piece.is_copied() => {
                piece.place.start as usize + (end - piece.at).min(piece.length)
            }
            Some(piece) => piece.place.end as usize,
            None => self.place,
        }
    }

    fn piece_with(&self, at: usize) -> Option<&Piece> {
        let after = self.pieces.partition_point(|piece| piece.at <= at);
        self.pieces.get(after.checked_sub(1)?)
    }
}

impl Piece {
    fn is_copied(&self) -> bool {
        self.length == self.place.len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_entity_maps_to_its_whole_spelling() {
        let file = "CMP(a&gt;b);";
        let mut passage = Passage::empty(0);
        passage.push(&file[0..5], Span::new(0, 5));
        passage.push_character('>', Span::new(5, 9));
        passage.push(&file[9..], Span::new(9, 12));
        assert_eq!(passage.text(), "CMP(a>b);");
        let shown = |range: Range<usize>| &file[passage.span(range).range()];
        assert_eq!(shown(4..7), "a&gt;b");
        assert_eq!(shown(5..6), "&gt;");
        assert_eq!(shown(6..7), "b");
        assert_eq!(passage.span(9..9), Span::at(12));
    }
}
