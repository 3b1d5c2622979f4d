//! A document as it is at one moment.
//!
//! A document never changes: an edit makes the next one. So whoever works on
//! one, on whatever thread, keeps what it began with, and sees from the
//! document's own flag that a newer one is there. What a text holds is worked
//! out once, by the first who asks, while the others wait.

use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};

use ide::language;
use ide::symbols::{Symbol, names_of_program, symbols_of_scenario, symbols_of_spec};
use ide::{Ladder, Scenario, Spec};
use logic::{Budget, Cancel};
use ropey::Rope;
use source::{Diagnostic, Span};
use tower_lsp::ls_types::{Location, Position, Range, TextDocumentContentChangeEvent, Uri};

use super::key::FileKey;
use super::position::Encoding;
use super::world::World;

/// A document.
#[derive(Debug)]
pub struct Document {
    /// The address that the client knows it by.
    pub uri: Uri,
    /// What tells it from others.
    pub key: FileKey,
    /// The client's number for this state of it; `None` for a file that is not
    /// open.
    pub version: Option<i32>,
    /// Its text.
    pub rope: Rope,
    language_id: String,
    /// The ladder that it was before it was edited, until what it is now is
    /// known.
    before: Mutex<Option<Arc<Ladder>>>,
    contents: OnceLock<Contents>,
    findings: OnceLock<Vec<Diagnostic>>,
    outdated: Cancel,
}

/// What a document holds.
#[derive(Clone, Debug)]
pub enum Contents {
    /// A ladder of a known form, or a text that should be one.
    Ladder(Arc<Ladder>),
    /// A spec.
    Spec(Arc<Spec>),
    /// A scenario.
    Scenario(Arc<Scenario>),
    /// Something that is none of ours.
    Foreign,
}

impl Document {
    /// A document that was just opened, or read.
    pub fn new(uri: Uri, language_id: &str, version: Option<i32>, text: &str) -> Self {
        Self {
            key: FileKey::of(&uri),
            uri,
            version,
            rope: Rope::from_str(text),
            language_id: language_id.to_owned(),
            before: Mutex::default(),
            contents: OnceLock::new(),
            findings: OnceLock::new(),
            outdated: Cancel::default(),
        }
    }

    /// The document that a file holds, if it is text.
    pub fn closed(key: &FileKey) -> Option<Self> {
        let text = String::from_utf8(std::fs::read(key.path()?).ok()?).ok()?;
        Some(Self::new(key.uri()?, "", None, &text))
    }

    /// The same document, outdated when `cancel` is raised.
    pub fn until(self, cancel: Cancel) -> Self {
        Self {
            outdated: cancel,
            ..self
        }
    }

    /// The document after `changes`, made one after the other. This one is
    /// outdated from now on.
    pub fn edited(
        &self,
        version: i32,
        changes: Vec<TextDocumentContentChangeEvent>,
        encoding: Encoding,
    ) -> Self {
        let mut after = self.renewed();
        after.version = Some(version);
        for change in changes {
            match change.range {
                Some(range) => replace(&mut after.rope, range, &change.text, encoding),
                None => after.rope = Rope::from_str(&change.text),
            }
        }
        after
    }

    /// The same document, of which nothing is worked out yet. This one is
    /// outdated from now on, so that all work on it ends.
    pub fn renewed(&self) -> Self {
        self.outdate();
        self.again(self.last_ladder())
    }

    /// The same document, of whose ladder more is known.
    pub fn holding(&self, ladder: Arc<Ladder>) -> Self {
        Self {
            contents: OnceLock::from(Contents::Ladder(ladder)),
            findings: self.findings.clone(),
            outdated: self.outdated.clone(),
            ..self.again(None)
        }
    }

    /// The same text, of which no more is known than the ladder `before`.
    fn again(&self, before: Option<Arc<Ladder>>) -> Self {
        Self {
            uri: self.uri.clone(),
            key: self.key.clone(),
            version: self.version,
            rope: self.rope.clone(),
            language_id: self.language_id.clone(),
            before: Mutex::new(before),
            contents: OnceLock::new(),
            findings: OnceLock::new(),
            outdated: Cancel::default(),
        }
    }

    /// The last state of it of which everything is known.
    fn last_ladder(&self) -> Option<Arc<Ladder>> {
        // Before what it is: that may become known in between.
        let before = self.before().clone();
        match self.contents.get() {
            Some(Contents::Ladder(ladder)) if ladder.is_whole() => Some(Arc::clone(ladder)),
            _ => before,
        }
    }

    fn before(&self) -> MutexGuard<'_, Option<Arc<Ladder>>> {
        self.before.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Tells whoever works on it that a newer one is there.
    pub fn outdate(&self) {
        self.outdated.cancel();
    }

    /// Whether a newer one is there.
    pub fn is_outdated(&self) -> bool {
        self.outdated.is_cancelled()
    }

    /// A budget that ends when the document is outdated.
    pub fn budget(&self) -> Budget {
        Budget {
            cancel: self.outdated.clone(),
            ..Budget::default()
        }
    }

    /// What it holds. May take long, so never on the thread of the protocol.
    pub fn contents(&self) -> &Contents {
        let contents = self.contents.get_or_init(|| {
            let text: Arc<str> = self.rope.to_string().into();
            match self.kind(&text) {
                Kind::Spec => Contents::Spec(Arc::new(Spec::read(text))),
                Kind::Scenario => Contents::Scenario(Arc::new(Scenario::read(text))),
                Kind::Ladder(certainty) => {
                    let before = self.before().clone();
                    let ladder = Ladder::following(before.as_deref(), text, &self.budget());
                    match certainty {
                        Certainty::Perhaps if !ladder.is_known() => Contents::Foreign,
                        _ => Contents::Ladder(Arc::new(ladder)),
                    }
                }
            }
        });
        if matches!(contents, Contents::Ladder(ladder) if ladder.is_whole()) {
            *self.before() = None;
        }
        contents
    }

    /// Everything there is to say about it. What a spec has to hear depends on
    /// its ladder; what a ladder has to hear, on nothing else. What a scenario has
    /// to hear comes of a run, see [`publish`](super::publish).
    pub fn findings(&self, world: &World, budget: &Budget) -> Vec<Diagnostic> {
        match self.contents() {
            Contents::Ladder(ladder) => {
                let found = self.findings.get_or_init(|| ladder.findings());
                found.clone()
            }
            Contents::Spec(spec) => {
                let beside = world.ladder_of(self);
                let ladder = beside.as_ref().and_then(|it| it.ladder());
                spec.findings(ladder.map(|it| &**it), budget)
            }
            Contents::Scenario(_) | Contents::Foreign => Vec::new(),
        }
    }

    /// The ladder that it holds, if it holds one.
    pub fn ladder(&self) -> Option<&Arc<Ladder>> {
        match self.contents() {
            Contents::Ladder(ladder) => Some(ladder),
            _ => None,
        }
    }

    /// The spec that it holds, if it holds one.
    pub fn spec(&self) -> Option<&Arc<Spec>> {
        match self.contents() {
            Contents::Spec(spec) => Some(spec),
            _ => None,
        }
    }

    /// The scenario that it holds, if it holds one.
    pub fn scenario(&self) -> Option<&Arc<Scenario>> {
        match self.contents() {
            Contents::Scenario(scenario) => Some(scenario),
            _ => None,
        }
    }

    /// Whether it may hold a scenario: to know costs no more than to read one.
    pub fn may_be_scenario(&self) -> bool {
        match self.contents.get() {
            Some(contents) => matches!(contents, Contents::Scenario(_)),
            None => self.is(".scenario", "gradus-scenario"),
        }
    }

    /// The names in it, told from reading it alone, which takes a small part of
    /// the time that an analysis does.
    pub fn names(&self) -> Vec<Symbol> {
        let text = self.rope.to_string();
        match self.kind(&text) {
            Kind::Spec => symbols_of_spec(&Spec::read(text.into())),
            Kind::Scenario => symbols_of_scenario(&Scenario::read(text.into())),
            Kind::Ladder(_) => {
                let program = ladder::read(text.as_bytes()).program;
                names_of_program(&program, &text)
            }
        }
    }

    /// The project's own notations are known by their names, so that an empty
    /// file can be begun; of all else only the content tells.
    fn kind(&self, text: &str) -> Kind {
        if self.is(".grafcet", "grafcet") {
            return Kind::Spec;
        }
        if self.is(".scenario", "gradus-scenario") {
            return Kind::Scenario;
        }
        let is_ladder = self.is(".ladder", "gradus-ladder");
        match language::of(text.as_bytes()) {
            language::File::Spec(_) => Kind::Spec,
            language::File::Scenario(_) if !is_ladder => Kind::Scenario,
            _ if is_ladder => Kind::Ladder(Certainty::Sure),
            _ => Kind::Ladder(Certainty::Perhaps),
        }
    }

    /// Whether its name, or the client, says that it is written in a notation.
    fn is(&self, ending: &str, id: &str) -> bool {
        let name = self.key.name().to_ascii_lowercase();
        name.ends_with(ending) || self.language_id == id
    }

    /// The byte at a position.
    pub fn offset(&self, position: Position, encoding: Encoding) -> usize {
        encoding.offset(&self.rope, position)
    }

    /// Where a span of it is.
    pub fn location(&self, span: Span, encoding: Encoding) -> Location {
        Location::new(self.uri.clone(), encoding.range(&self.rope, span))
    }
}

enum Kind {
    Ladder(Certainty),
    Spec,
    Scenario,
}

/// Whether a text that cannot be read is a ladder all the same.
enum Certainty {
    Sure,
    Perhaps,
}

fn replace(rope: &mut Rope, range: Range, text: &str, encoding: Encoding) {
    let span = encoding.span(rope, range).range();
    let start = rope.byte_to_char(span.start);
    rope.remove(start..rope.byte_to_char(span.end));
    rope.insert(start, text);
}

#[cfg(test)]
mod tests {
    use std::str::FromStr;

    use proptest::collection::vec;
    use proptest::prelude::*;
    use proptest::sample::Index;

    use super::*;

    fn open(text: &str) -> Document {
        let uri = Uri::from_str("file:///p/tank.ladder").expect("an address");
        Document::new(uri, "gradus-ladder", Some(1), text)
    }

    fn change(range: [u32; 4], text: &str) -> TextDocumentContentChangeEvent {
        let [from, at, to, end] = range;
        TextDocumentContentChangeEvent {
            range: Some(Range::new(Position::new(from, at), Position::new(to, end))),
            range_length: None,
            text: text.to_owned(),
        }
    }

    #[test]
    fn changes_are_made_one_after_the_other() {
        let before = open("a\nb\n");
        let changes = vec![change([0, 0, 0, 1], "long"), change([0, 4, 1, 0], " ")];
        let after = before.edited(2, changes, Encoding::Utf16);
        assert_eq!(after.rope.to_string(), "long b\n");
        assert!(before.is_outdated() && !after.is_outdated());
    }

    #[test]
    fn a_whole_text_replaces_the_old_one() {
        let whole = TextDocumentContentChangeEvent {
            range: None,
            range_length: None,
            text: "rung: a -> b".to_owned(),
        };
        let after = open("x").edited(2, vec![whole], Encoding::Utf8);
        assert_eq!(after.rope.to_string(), "rung: a -> b");
    }

    /// Characters of one to four bytes, and all that could be taken for an end
    /// of a line.
    const TEXT: &str = "[a\u{e4}\u{20ac}\u{1f6d1}\u{feff}\r\n\u{b}\u{85}\u{2028}]{0,12}";

    /// The places of `text` where a caret can stand, in both encodings.
    fn carets(text: &str) -> Vec<(usize, Position, Position)> {
        let mut all = Vec::new();
        let (mut line, mut utf8, mut utf16) = (0, 0, 0);
        let mut rest = text.char_indices().peekable();
        while let Some((at, character)) = rest.next() {
            all.push((at, Position::new(line, utf8), Position::new(line, utf16)));
            if character == '\r' && rest.peek().is_some_and(|(_, next)| *next == '\n') {
                rest.next();
            }
            if matches!(character, '\r' | '\n') {
                (line, utf8, utf16) = (line + 1, 0, 0);
            } else {
                utf8 += character.len_utf8() as u32;
                utf16 += character.len_utf16() as u32;
            }
        }
        all.push((
            text.len(),
            Position::new(line, utf8),
            Position::new(line, utf16),
        ));
        all
    }

    proptest! {
        #[test]
        fn any_edits_leave_what_they_leave_in_a_plain_text(
            before in TEXT,
            edits in vec((any::<Index>(), any::<Index>(), TEXT), 0..9),
        ) {
            for encoding in [Encoding::Utf8, Encoding::Utf16] {
                let mut text = before.clone();
                let mut document = open(&text);
                for (from, length, new) in &edits {
                    let carets = carets(&text);
                    let from = from.index(carets.len());
                    let to = from + length.index(carets.len() - from);
                    let place = |at: usize| match encoding {
                        Encoding::Utf8 => carets[at].1,
                        Encoding::Utf16 => carets[at].2,
                    };
                    let edit = TextDocumentContentChangeEvent {
                        range: Some(Range::new(place(from), place(to))),
                        range_length: None,
                        text: new.clone(),
                    };
                    document = document.edited(2, vec![edit], encoding);
                    text.replace_range(carets[from].0..carets[to].0, new);
                    prop_assert_eq!(document.rope.to_string(), text.as_str());
                }
            }
        }
    }
}
