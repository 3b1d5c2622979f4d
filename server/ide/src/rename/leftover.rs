//! Where the old name still stands after a renaming.
//!
//! A reader knows the contacts, coils and operands of a ladder. A file may hold
//! more: structured text, other diagrams, statements that break the grammar. A
//! name that is left there would come to mean nothing, or something else.

use ::ladder::Format;
use source::{Edit, Severity};

use super::written::{is_part_of, is_same, pieces};
use crate::{Ladder, statement};

/// The line, from 1, in which the variable written `local` still stands after
/// `edits`, as something else than people's own words.
pub(super) fn line_of(ladder: &Ladder, edits: &[Edit], edited: &str, local: &str) -> Option<usize> {
    match ladder.program().format {
        Format::Ladder => in_broken_statements(ladder, edits, local),
        Format::L5x | Format::Plcopen => find(&without_words_in_xml(edited), local),
        _ => find(&without_strings(edited), local),
    }
}

fn find(text: &str, local: &str) -> Option<usize> {
    let found = pieces(Format::NeutralText, text);
    let same = |it: &std::ops::Range<usize>| is_same(Format::NeutralText, &text[it.clone()], local);
    found
        .into_iter()
        .find(same)
        .map(|it| line_number(text, it.start))
}

fn line_number(text: &str, offset: usize) -> usize {
    text[..offset].lines().count().max(1)
}

/// In rung notation every name is known but those of statements that were not
/// understood.
fn in_broken_statements(ladder: &Ladder, edits: &[Edit], local: &str) -> Option<usize> {
    let text = &*ladder.text;
    let broken = ladder
        .diagnostics()
        .iter()
        .filter(|it| it.severity == Severity::Error);
    for finding in broken {
        let place = statement::in_ladder(text, finding.span.range().start);
        for piece in pieces(Format::Ladder, &text[place.clone()]) {
            let (start, end) = (place.start + piece.start, place.start + piece.end);
            let written = &text[start..end];
            let is_edited = edits.iter().any(|it| {
                let range = it.span.range();
                range.start <= start && end <= range.end
            });
            if !is_edited && (written == local || is_part_of(written, local)) {
                return Some(line_number(text, start));
            }
        }
    }
    None
}

/// Elements that hold people's own words.
const WORDS: [&str; 6] = [
    "Description",
    "Comment",
    "RevisionNote",
    "AdditionalHelpText",
    "documentation",
    "comment",
];

const CDATA: &str = "<![CDATA[";

/// The XML text with blanks for names of elements and attributes, comments, and
/// the elements that hold words. Its lines stay where they are.
fn without_words_in_xml(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(at) = rest.find('<') {
        out += &rest[..at];
        rest = &rest[at..];
        let name_end = |tag: &str| tag.find(|c: char| c.is_whitespace() || "/>".contains(c));
        let element = &rest[1..1 + name_end(&rest[1..]).unwrap_or(0)];
        let (kept, length) = if let Some(data) = rest.strip_prefix(CDATA) {
            let inner = data.split("]]>").next().unwrap_or_default();
            let length = CDATA.len() + inner.len() + "]]>".len();
            (inner.to_owned(), length.min(rest.len()))
        } else if rest.starts_with("<!--") {
            let length = rest.find("-->").map_or(rest.len(), |end| end + 3);
            (line_ends(&rest[..length]), length)
        } else if WORDS.contains(&element) {
            let tag = rest.find('>').map_or(rest.len(), |end| end + 1);
            let close = format!("</{element}>");
            let is_empty = rest[..tag].ends_with("/>");
            let length = match rest.find(&close).filter(|_| !is_empty) {
                Some(end) => end + close.len(),
                None => tag,
            };
            (line_ends(&rest[..length]), length)
        } else {
            let length = rest.find('>').map_or(rest.len(), |end| end + 1);
            (values(&rest[..length]), length)
        };
        out += &kept;
        out.push(' ');
        rest = &rest[length..];
    }
    out + rest
}

/// What stands between quotes in a tag, each value apart.
fn values(tag: &str) -> String {
    let mut out = String::new();
    let mut quote = None;
    for c in tag.chars() {
        match quote {
            None if matches!(c, '"' | '\'') => {
                quote = Some(c);
                out.push(' ');
            }
            Some(open) if c == open => {
                quote = None;
                out.push(' ');
            }
            Some(_) => out.push(c),
            None if matches!(c, '\r' | '\n') => out.push(c),
            None => {}
        }
    }
    out
}

fn line_ends(text: &str) -> String {
    text.chars().filter(|c| matches!(c, '\r' | '\n')).collect()
}

/// The text with blanks for what stands in double quotes.
fn without_strings(text: &str) -> String {
    let parts = text.split('"').enumerate();
    let part = |(at, part): (usize, &str)| match at % 2 {
        0 => part.to_owned(),
        _ => format!(" {} ", line_ends(part)),
    };
    parts.map(part).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_of_people_and_of_xml_are_none_of_the_program() {
        let text = "<Tag Name=\"a\" x='1'>\n<Description>\n<![CDATA[a]]></Description>\n<!-- a -->\
                    <Line><![CDATA[x<a;]]></Line></Tag>";
        assert_eq!(find(&without_words_in_xml(text), "Tag"), None);
        assert_eq!(find(&without_words_in_xml(text), "x"), Some(4));
        let left = text.replace("Name=\"a\"", "Name=\"b\"");
        assert_eq!(find(&without_words_in_xml(&left), "a"), Some(4));
        let left = left.replace("x<a;", "x<b;");
        assert_eq!(find(&without_words_in_xml(&left), "a"), None);
    }

    #[test]
    fn strings_are_none_either() {
        assert_eq!(
            find(&without_strings("RC: \"a\n\";\nXIC(A);"), "a"),
            Some(3)
        );
        assert_eq!(find(&without_strings("RC: \"a\n\";\nXIC(b);"), "a"), None);
    }
}
