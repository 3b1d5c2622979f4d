//! The canonical layout of a text, as edits of what an editor shows.
//!
//! The formatters move blanks and line ends and keep every token in its place.
//! So the edits are those between tokens: they leave carets and marks where
//! they are, and any part of them is right without the rest.

use ::ladder::Format;
use logic::notation::{Token, TokenKind};
use source::{Edit, Span};

use crate::changed::narrowed;
use crate::{Ladder, Scenario, Spec, changed, statement};

/// What is laid out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// The whole text.
    Whole,
    /// The statements that a span touches.
    Statements(Span),
    /// What stands in one line, the line that holds a byte; no line is broken or
    /// joined.
    Line(usize),
}

/// The edits that lay a ladder text out. Only rung notation has a layout; where
/// a statement breaks the grammar, it stays as it is.
pub fn lay_out_ladder(ladder: &Ladder, extent: Extent) -> Option<Vec<Edit>> {
    let text = &*ladder.text;
    if ladder.program().format != Format::Ladder {
        return None;
    }
    let laid = ::ladder::text::format(text);
    Some(within(text, &laid.text, extent, statement::in_ladder))
}

/// The edits that lay a rule text out; lines that are not understood stay as
/// they are.
pub fn lay_out_spec(spec: &Spec, extent: Extent) -> Vec<Edit> {
    let laid = grafcet::format(&spec.text);
    within(&spec.text, &laid.text, extent, statement::in_spec)
}

/// The edits that lay a scenario out; lines that are not understood stay as they
/// are.
pub fn lay_out_scenario(scenario: &Scenario, extent: Extent) -> Vec<Edit> {
    let laid = ::scenario::format(&scenario.text);
    within(&scenario.text, &laid.text, extent, statement::line)
}

fn within(
    old: &str,
    new: &str,
    extent: Extent,
    statement: fn(&str, usize) -> std::ops::Range<usize>,
) -> Vec<Edit> {
    let edits = edits(old, new);
    let keep = |start: usize, end: usize| {
        let inside = move |edit: &Edit| {
            let range = edit.span.range();
            start <= range.start && range.end <= end
        };
        edits.iter().filter(move |edit| inside(edit)).cloned()
    };
    match extent {
        Extent::Whole => edits,
        Extent::Statements(span) => {
            let range = span.range();
            // A selection of whole lines ends where the next begins.
            let ends_before = range.end > range.start
                && old
                    .get(..range.end)
                    .is_some_and(|it| it.ends_with(['\n', '\r']));
            let last = range.end - usize::from(ends_before);
            let end = match range.end == old.len() {
                true => old.len(),
                false => statement(old, last).end,
            };
            keep(statement(old, range.start).start, end).collect()
        }
        Extent::Line(offset) => {
            let line = statement::line(old, offset);
            let stays = |edit: &Edit| !edit.text.contains(['\n', '\r']);
            keep(line.start, line.end).filter(stays).collect()
        }
    }
}

/// The edits between a text and the same in its layout: blanks and line ends
/// between tokens, and the few tokens that have another spelling there.
fn edits(old: &str, new: &str) -> Vec<Edit> {
    let (olds, news) = (pieces(old), pieces(new));
    if olds.len() != news.len() {
        return changed(old, new);
    }
    let mut edits = Vec::new();
    let (mut old_end, mut new_end) = (0, 0);
    let ends = [Token {
        kind: TokenKind::LineEnd,
        span: Span::at(old.len()),
    }];
    let new_ends = [Token {
        kind: TokenKind::LineEnd,
        span: Span::at(new.len()),
    }];
    let pairs = olds.iter().chain(&ends).zip(news.iter().chain(&new_ends));
    for (before, after) in pairs {
        let (from, to) = (before.span.range(), after.span.range());
        between(
            old,
            old_end..from.start,
            &new[new_end..to.start],
            &mut edits,
        );
        if before.text(old) != after.text(new) {
            edits.push(narrowed(old, from.clone(), after.text(new)));
        }
        (old_end, new_end) = (from.end, to.end);
    }
    edits
}

fn pieces(text: &str) -> Vec<Token> {
    let mut tokens = statement::tokens(text, 0..text.len());
    tokens.retain(|token| token.kind != TokenKind::LineEnd);
    tokens
}

/// Replaces what stands between two tokens. The indentation of a line belongs
/// to the statement that begins there, the line ends before it do not.
fn between(text: &str, at: std::ops::Range<usize>, new: &str, edits: &mut Vec<Edit>) {
    let old = &text[at.clone()];
    let split = |gap: &str| gap.rfind(['\n', '\r']).map(|last| last + 1);
    let mut replace = |at: std::ops::Range<usize>, new: &str| {
        if text[at.clone()] != *new {
            edits.push(narrowed(text, at, new));
        }
    };
    match (split(old), split(new)) {
        (Some(a), Some(b)) => {
            replace(at.start..at.start + a, &new[..b]);
            replace(at.start + a..at.end, &new[b..]);
        }
        _ => replace(at, new),
    }
}

#[cfg(test)]
mod tests {
    use logic::Budget;

    use super::*;
    use crate::edited;

    fn lay_out(text: &str, extent: Extent) -> String {
        let ladder = Ladder::read(text.into(), &Budget::default());
        edited(text, &lay_out_ladder(&ladder, extent).expect("a layout"))
    }

    const RUNGS: &str =
        "input   a\r\n\r\n\r\nrung:a*b->c\r\nrung:(a+\r\n  rung :d->e// odd \u{1f6d1}\r\n";

    #[test]
    fn a_whole_text_is_laid_out_as_the_formatter_does() {
        let laid =
            "input a\r\n\r\nrung: a * b -> c\r\nrung:(a+\r\nrung: d -> e  // odd \u{1f6d1}\r\n";
        assert_eq!(::ladder::text::format(RUNGS).text, laid);
        assert_eq!(lay_out(RUNGS, Extent::Whole), laid);
    }

    #[test]
    fn only_what_is_between_tokens_is_replaced() {
        let ladder = Ladder::read("rung:a*b->c\n".into(), &Budget::default());
        let edits = lay_out_ladder(&ladder, Extent::Whole).expect("a layout");
        let spans: Vec<_> = edits
            .iter()
            .map(|it| (it.span.start, it.span.end, &*it.text))
            .collect();
        assert_eq!(
            spans,
            [
                (5, 5, " "),
                (6, 6, " "),
                (7, 7, " "),
                (8, 8, " "),
                (10, 10, " ")
            ]
        );
    }

    #[test]
    fn statements_outside_a_range_stay() {
        let at = |part: &str| RUNGS.find(part).expect("in the text");
        let span = Span::new(at("->c"), at("rung:(a"));
        assert_eq!(
            lay_out(RUNGS, Extent::Statements(span)),
            RUNGS.replace("rung:a*b->c", "rung: a * b -> c")
        );
        let last = Span::at(at("d->e"));
        assert_eq!(
            lay_out(RUNGS, Extent::Statements(last)),
            RUNGS.replace("  rung :d->e// odd", "rung: d -> e  // odd")
        );
    }

    #[test]
    fn a_line_is_neither_broken_nor_joined() {
        let text = "rung: a*\n  b->c\n";
        let at = text.find("b->c").expect("in the text");
        assert_eq!(lay_out(text, Extent::Line(at)), "rung: a*\n  b -> c\n");
        assert_eq!(lay_out(text, Extent::Whole), "rung: a * b -> c\n");
    }

    #[test]
    fn a_scenario_is_laid_out_step_by_step() {
        let text = "on s=>on v1\r\n\r\n\r\n?\r\non  ls2 ,off s=> only\r\n";
        let laid = "on s => on v1\r\n\r\n?\r\non ls2, off s => only\r\n";
        let scenario = Scenario::read(text.into());
        assert_eq!(
            edited(text, &lay_out_scenario(&scenario, Extent::Whole)),
            laid
        );
        let first = lay_out_scenario(&scenario, Extent::Line(3));
        assert_eq!(edited(text, &first), text.replace("s=>on", "s => on"));
    }

    #[test]
    fn a_rule_text_is_laid_out_too() {
        let text = "step  a ,b\nTransitions:\nt1:a*m|-@b\n//!  accept v1->v2\n? left\n";
        let spec = Spec::read(text.into());
        let laid = "Step a, b\n\nTransitions:\nt1: a*m |- @b\n//! accept v1 -> v2\n? left\n";
        assert_eq!(edited(text, &lay_out_spec(&spec, Extent::Whole)), laid);
        let rule = Span::at(text.find("m|-").expect("in the text"));
        assert_eq!(
            edited(text, &lay_out_spec(&spec, Extent::Statements(rule))),
            text.replace("t1:a*m|-@b", "t1: a*m |- @b")
        );
    }
}
