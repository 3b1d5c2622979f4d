//! What can be typed in a decision line of a rule text.

use std::collections::BTreeSet;

use grafcet::{Role, spelled_state};
use logic::notation::{Token, TokenKind};
use source::Span;

use super::spec::Asked;
use super::{Completion, CompletionKind, Completions};
use crate::Decided;
use crate::next::{followers, why};
use crate::section::Section;
use crate::statement::{self, Typed, code, tokens};

/// The comment of a decision line in which a caret stands, behind its sign.
pub(super) fn decision_before(text: &str, offset: usize) -> Option<Token> {
    let line = statement::line(text, offset);
    let tokens = tokens(text, line);
    let comment = tokens
        .first()
        .filter(|token| token.kind == TokenKind::Comment)?;
    let is_inside = comment.span.range().start + SIGN.len() <= offset;
    (comment.text(text).starts_with(SIGN) && is_inside).then_some(*comment)
}

const SIGN: &str = "//!";

const VERDICTS: [(&str, &str); 5] = [
    ("accept", "the state follows, several together"),
    ("reject", "the state does not follow"),
    ("initial", "the sequence starts in the state"),
    ("keep", "the rule stays as it is, whatever the ladder gives"),
    ("end", "the branch of the state joins no other"),
];

impl Asked<'_> {
    /// Behind `//!`.
    pub(super) fn in_decision(&self, comment: Token, offset: usize) -> Completions {
        let text = &*self.spec.text;
        let start = comment.span.range().start + SIGN.len();
        // What is typed stands in a comment of the text, and is code of its own.
        let inner = Typed::at(&text[start..comment.span.range().end], offset - start);
        let span = Span::new(
            start + inner.span.range().start,
            start + inner.span.range().end,
        );
        let before = code(text, start..span.range().start.max(start));
        let words: Vec<&str> = before.iter().map(|token| token.name(text)).collect();
        let items = match words.as_slice() {
            _ if inner.in_comment => Vec::new(),
            [] => return self.decisions(comment, offset),
            ["accept" | "reject"] => self.states(),
            ["accept" | "reject", _] => vec![Completion::word("->", "the state after it follows")],
            ["accept" | "reject", from, "->"] => self.after(from, &[]),
            ["accept", from, "->", to @ ..] if to.last() == Some(&"&") => self.after(from, to),
            ["initial" | "end"] => self.states(),
            ["keep"] => self.named(Role::Transition, CompletionKind::Label),
            _ => Vec::new(),
        };
        Completions { span, items }
    }

    /// Whole decisions, which replace the line so far, and the words that begin
    /// one.
    fn decisions(&self, comment: Token, offset: usize) -> Completions {
        let mut items = self.lines(Section::Declarations);
        let word = |(word, detail): &(&str, &str)| {
            Completion::word(word, detail).insert(format!("{SIGN} {word} "))
        };
        items.extend(VERDICTS.iter().map(word));
        let end = comment.span.range().end;
        Completions {
            span: Span::new(comment.span.range().start, end.max(offset)),
            items,
        }
    }

    /// States that may follow `from`, about which nothing is decided, those in
    /// `taken` left out; then all others.
    fn after(&self, from: &str, taken: &[&str]) -> Vec<Completion> {
        let Some(ladder) = self.ladder else {
            return Vec::new();
        };
        let decided = Decided::of(self.spec);
        let mut items = Vec::new();
        let mut seen: BTreeSet<&str> = taken.iter().copied().collect();
        for succession in followers(ladder, &decided, self.weakest) {
            if *succession.from != *from || !seen.insert(&succession.to) {
                continue;
            }
            items.push(Completion {
                documentation: Some(why(succession, ladder, self.budget)),
                ..Completion::new(
                    &*succession.to,
                    CompletionKind::State,
                    succession.evidence.word(),
                )
                .insert(spelled_state(&succession.to))
            });
        }
        let others = self.states().into_iter();
        items.extend(others.filter(|it| *it.label != *from && !seen.contains(it.label.as_str())));
        items
    }
}
