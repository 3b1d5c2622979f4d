//! In which section of a rule text a place stands.

use logic::notation::TokenKind;

use crate::statement::code;

/// The section that a place stands in, by its heading.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Section {
    /// Before the first heading of the text or of a part.
    Declarations,
    /// `Transitions:`
    Transitions,
    /// `Steps:`
    Steps,
    /// `Environment:`
    Environment,
    /// `Never:`
    Never,
}

const HEADINGS: [(&str, Section); 4] = [
    ("Transitions", Section::Transitions),
    ("Steps", Section::Steps),
    ("Environment", Section::Environment),
    ("Never", Section::Never),
];

/// The section that the byte `offset` of a rule text stands in.
pub(crate) fn section(text: &str, offset: usize) -> Section {
    let mut section = Section::Declarations;
    for line in text[..offset].lines() {
        let words = code(line, 0..line.len());
        let word = words.first().map_or("", |token| token.text(line));
        let heading = |(name, _): &&(&str, Section)| name.eq_ignore_ascii_case(word);
        match words.as_slice() {
            [_, colon] if colon.kind == TokenKind::Colon => {
                if let Some((_, found)) = HEADINGS.iter().find(heading) {
                    section = *found;
                }
            }
            [_, ..] if PARTS.iter().any(|it| it.eq_ignore_ascii_case(word)) => {
                section = Section::Declarations;
            }
            _ => {}
        }
    }
    section
}

/// Words that begin a part.
const PARTS: [&str; 3] = ["Partial", "Expansion", "Reusable"];
