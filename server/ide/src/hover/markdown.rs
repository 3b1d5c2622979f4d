//! People's own words in Markdown.
//!
//! Names and comments of programs may hold anything, and must be shown as they
//! are. A sign that Markdown would take for its own needs a backslash before
//! it; no other sign gets one, since Neovim shows backslashes in a terminal.

/// `text`, the words of one line, as Markdown shows it.
pub(super) fn escaped(text: &str) -> String {
    let signs: Vec<char> = text.chars().collect();
    let mut out = String::with_capacity(text.len());
    for (at, &c) in signs.iter().enumerate() {
        if means_something(&signs, at) {
            out.push('\\');
        }
        out.push(c);
    }
    out
}

/// `text` as the words of a link.
pub(super) fn in_brackets(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        if c.is_ascii_punctuation() && !"().,:;-".contains(c) {
            out.push('\\');
        }
        out.push(c);
    }
    out
}

/// Whether Markdown could take the sign at `at` for one of its own.
fn means_something(signs: &[char], at: usize) -> bool {
    let (before, after) = (&signs[..at], &signs[at + 1..]);
    let next = after.first();
    let begins = before.iter().all(|c| c.is_whitespace());
    let is_blank = |c: Option<&char>| c.is_some_and(|c| c.is_whitespace());
    let is_word = |c: Option<&char>| c.is_some_and(|c| c.is_alphanumeric());
    match signs[at] {
        '`' => true,
        '\\' => next.is_none_or(|c| c.is_ascii_punctuation() || c.is_whitespace()),
        '*' | '~' => begins || !is_blank(before.last()) || !is_blank(next),
        '_' => begins || !is_word(before.last()) || !is_word(next),
        '<' => next.is_some_and(|c| c.is_ascii_alphabetic() || matches!(c, '/' | '!' | '?')),
        '&' => after.contains(&';'),
        // The address of a link, or a label that one is given by.
        '[' | ']' => {
            let rest = after.iter().skip_while(|c| **c != ']');
            let behind = match signs[at] {
                ']' => next,
                _ => rest.skip(1).find(|c| matches!(c, '(' | '[' | ':')),
            };
            behind.is_some_and(|c| matches!(c, '(' | '[' | ':'))
        }
        // Headings, quotations, lists and rules begin lines.
        '#' | '>' | '-' | '+' | '=' | '|' | ':' => begins,
        '.' | ')' => !before.is_empty() && before.iter().all(char::is_ascii_digit),
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use pulldown_cmark::{Event, Options, Parser, Tag, TagEnd};

    use super::*;
    use crate::hover::Target;
    use crate::{Hover, Term};

    #[test]
    fn names_and_conditions_of_programs_need_no_backslash() {
        for text in [
            "Motor_Start",
            "Local:1:I.Data[0].3",
            "Open valve v1: holds a state (seal-in)",
            "Pump #2 & fan, 5 > 3 * 1",
            "<- back",
        ] {
            assert_eq!(escaped(text), text);
        }
    }

    #[test]
    fn signs_of_markdown_get_one() {
        for (text, expected) in [
            ("*danger*", "\\*danger\\*"),
            ("_x_", "\\_x\\_"),
            ("`x`", "\\`x\\`"),
            ("1. Fill", "1\\. Fill"),
            ("# 1", "\\# 1"),
            ("[a](b)", "\\[a\\](b)"),
            ("<b>", "\\<b>"),
            ("a &amp; b", "a \\&amp; b"),
        ] {
            assert_eq!(escaped(text), expected);
        }
    }

    #[test]
    fn rungs_are_links_where_they_have_an_address() {
        let rungs = crate::hover::Rungs {
            label: "Driven by",
            named: vec![
                ("rung 0 of Tank (Fill [1])".to_owned(), source::Span::at(5)),
                ("rung 1 of Tank".to_owned(), source::Span::at(70)),
            ],
            more: 3,
        };
        let hover = Hover {
            span: source::Span::at(0),
            name: "v1".to_owned(),
            address: None,
            summary: String::new(),
            blocks: vec![crate::Block::Rungs(rungs)],
            terms: vec![Term::SealIn],
        };
        let link = |target: Target| match target {
            Target::Rung(span) => (span.start < 10).then(|| "file:///tank.ladder#L1".to_owned()),
            Target::Page(_) => None,
        };
        assert_eq!(
            hover.markdown(&link),
            "**v1**\n\nDriven by [rung 0 of Tank (Fill \\[1\\])](file:///tank.ladder#L1), \
             rung 1 of Tank and 3 more"
        );
        assert_eq!(
            hover.plain(),
            "v1\n\nDriven by rung 0 of Tank (Fill [1]), rung 1 of Tank and 3 more"
        );
    }

    #[test]
    fn words_lead_to_their_pages_where_there_are_addresses() {
        let hover = Hover {
            span: source::Span::at(0),
            name: "v1".to_owned(),
            address: None,
            summary: String::new(),
            blocks: Vec::new(),
            terms: vec![Term::SealIn, Term::StepRegister],
        };
        let link = |target: Target| match target {
            Target::Page(term) => Some(format!("page:/{}.md", term.name())),
            Target::Rung(_) => None,
        };
        assert_eq!(
            hover.markdown(&link),
            "**v1**\n\nMore on [seal-in](page:/seal-in.md), [step register](page:/step-register.md)"
        );
        assert_eq!(hover.markdown(&|_| None), "**v1**");
        assert_eq!(hover.plain(), "v1");
    }

    /// What is shown of `markdown`: paragraphs of plain words, the first of
    /// which may begin with a heading.
    fn shown(markdown: &str) -> String {
        let all =
            Options::ENABLE_TABLES | Options::ENABLE_STRIKETHROUGH | Options::ENABLE_TASKLISTS;
        let mut words = String::new();
        for event in Parser::new_ext(markdown, all) {
            match event {
                Event::Start(Tag::Paragraph | Tag::Strong)
                | Event::End(TagEnd::Paragraph | TagEnd::Strong) => {}
                Event::HardBreak => words.push('\n'),
                Event::Text(text) => words += &text,
                other => panic!("{markdown:?} holds {other:?}"),
            }
        }
        words
    }

    proptest! {
        #[test]
        fn whatever_people_write_is_shown_as_it_is(
            name in r"[a1_(\[][-a1 _*`~\\\[\]()<>#+=|&;:.!/?\u{e4}]{0,16}[a1_)\]]",
            summary in r"[-a1 _*`~\\\[\]()<>#+=|&;:.!/?\u{e4}]{1,16}",
        ) {
            // Blanks around words are no words.
            let summary = summary.trim();
            let hover = Hover {
                span: source::Span::at(0),
                name: name.clone(),
                address: None,
                summary: summary.to_owned(),
                blocks: Vec::new(),
                terms: Vec::new(),
            };
            let wanted = match summary {
                "" => name,
                _ => format!("{name}\n{summary}"),
            };
            prop_assert_eq!(shown(&hover.markdown(&|_| None)), wanted);
            prop_assert_eq!(shown(&escaped(summary)), summary);
        }
    }
}
