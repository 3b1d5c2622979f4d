//! What can be folded away.

use std::cmp::Reverse;

use ::ladder::Format;
use source::Span;

use crate::{Ladder, Scenario, Spec};

/// A stretch that can be folded to its first line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Fold {
    /// From its first byte to its last.
    pub span: Span,
    /// Whether it says nothing but comments.
    pub is_comment: bool,
}

/// Programs, routines, rungs, and in rung notation declarations and comments.
pub fn folds_in_ladder(ladder: &Ladder) -> Vec<Fold> {
    let routines = &ladder.program().routines;
    let mut spans = Vec::new();
    for routine in routines {
        let name = ladder.routine_name(routine).unwrap_or(routine.span);
        let near = ladder.program().format == Format::Ladder;
        spans.push(match near {
            // The main routine of a program has no line but the program's.
            true => routine.span.cover(name),
            false => routine.span,
        });
        spans.extend(routine.rungs.iter().map(|rung| rung.span));
    }
    let mut folds: Vec<Fold> = spans.into_iter().map(code).collect();
    if ladder.program().format == Format::Ladder {
        folds.extend(declarations(ladder).into_iter().map(code));
        folds.extend(runs(&ladder.text, |line| line.starts_with("//")).map(comment));
    }
    several_lines(folds, &ladder.text)
}

/// Parts, sections, rules of several lines, decisions and comments.
pub fn folds_in_spec(spec: &Spec) -> Vec<Fold> {
    let places = &spec.reading.places;
    let sections = places.sections.iter().map(|it| it.span);
    let rules = places.rules.iter().map(|it| it.span);
    let is_decision = |line: &str| line.starts_with("//!");
    let decisions = runs(&spec.text, is_decision);
    let is_comment = |line: &str| line.starts_with("//") && !is_decision(line);
    let comments = runs(&spec.text, is_comment).map(comment);
    let folds = sections.chain(rules).chain(decisions).map(code);
    several_lines(folds.chain(comments).collect(), &spec.text)
}

/// Stretches of lines without a blank one or a comment between, and comments.
pub fn folds_in_scenario(scenario: &Scenario) -> Vec<Fold> {
    let is_comment = |line: &str| line.starts_with("//");
    let says = |line: &str| !line.trim().is_empty() && !line.starts_with("//");
    let steps = runs(&scenario.text, says).map(code);
    let comments = runs(&scenario.text, is_comment).map(comment);
    several_lines(steps.chain(comments).collect(), &scenario.text)
}

fn code(span: Span) -> Fold {
    Fold {
        span,
        is_comment: false,
    }
}

fn comment(span: Span) -> Fold {
    Fold {
        span,
        is_comment: true,
    }
}

/// Declarations that follow each other line by line, comments between.
fn declarations(ladder: &Ladder) -> Vec<Span> {
    let mut blocks: Vec<Span> = Vec::new();
    for declaration in ladder.program().declarations.iter() {
        match blocks.last_mut() {
            Some(block) if adjoin(&ladder.text, *block, declaration.span) => {
                *block = block.cover(declaration.span);
            }
            _ => blocks.push(declaration.span),
        }
    }
    blocks
}

/// Whether nothing but whole lines of comment stands between two declarations.
fn adjoin(text: &str, one: Span, next: Span) -> bool {
    let Some(between) = text.get(one.range().end..next.range().start) else {
        return false;
    };
    // The rest of the one's line, whole lines, the blanks before the next.
    let lines = between.trim_end_matches([' ', '\t']).lines().skip(1);
    lines.map(str::trim).all(|line| line.starts_with("//"))
}

/// Runs of lines that, blanks before them left out, are all `wanted`.
fn runs<'t>(text: &'t str, wanted: impl Fn(&str) -> bool + 't) -> impl Iterator<Item = Span> + 't {
    let mut lines = text.split_inclusive('\n');
    let mut at = 0;
    let mut run: Option<Span> = None;
    std::iter::from_fn(move || {
        for line in lines.by_ref() {
            let start = at;
            at += line.len();
            let said = line.trim_start_matches(['\u{feff}', ' ', '\t']);
            if wanted(said) {
                let here = Span::new(start, start + line.trim_end().len());
                run = Some(run.map_or(here, |run| run.cover(here)));
            } else if run.is_some() {
                return run.take();
            }
        }
        run.take()
    })
}

/// The folds that have something to hide, in the order of the text, each once.
fn several_lines(mut folds: Vec<Fold>, text: &str) -> Vec<Fold> {
    folds.retain(|fold| {
        let said = text.get(fold.span.range()).unwrap_or_default();
        said.trim_end().contains(['\n', '\r'])
    });
    for fold in &mut folds {
        let said = text.get(fold.span.range()).unwrap_or_default();
        let start = fold.span.range().start;
        fold.span = Span::new(start, start + said.trim_end().len());
    }
    folds.sort_by_key(|it| (it.span.start, Reverse(it.span.end), it.is_comment));
    folds.dedup_by_key(|it| it.span);
    nested(folds)
}

/// Those that lie inside of each other or apart. In XML the elements of two
/// rungs may be mixed; then only the first of the two folds.
fn nested(folds: Vec<Fold>) -> Vec<Fold> {
    let mut open: Vec<u32> = Vec::new();
    let mut nested = Vec::new();
    for fold in folds {
        while open.last().is_some_and(|end| *end <= fold.span.start) {
            open.pop();
        }
        if open.last().is_none_or(|end| fold.span.end <= *end) {
            open.push(fold.span.end);
            nested.push(fold);
        }
    }
    nested
}

#[cfg(test)]
mod tests {
    use logic::Budget;

    use super::*;

    /// `first line..last line`, counted from 1, with `//` behind comments.
    fn lines(text: &str, folds: &[Fold]) -> Vec<String> {
        let line = |at: usize| text[..at].matches('\n').count() + 1;
        let shown = folds.iter().map(|it| {
            let range = it.span.range();
            let mark = if it.is_comment { " //" } else { "" };
            format!("{}..{}{mark}", line(range.start), line(range.end))
        });
        shown.collect()
    }

    fn in_ladder(text: &str) -> Vec<String> {
        let ladder = Ladder::read(text.into(), &Budget::default());
        lines(text, &folds_in_ladder(&ladder))
    }

    #[test]
    fn programs_declarations_rungs_and_comments_fold() {
        let text = "\
// A tank
// of water.
program Tank
input s // rung for rung
// a heading
input ls2

output v1
rung: (s + v1)
    * /ls2
    -> v1

routine Doors
rung: a -> b
";
        assert_eq!(
            in_ladder(text),
            ["1..2 //", "3..11", "4..6", "9..11", "13..14"]
        );
        assert_eq!(in_ladder(&text.replace('\n', "\r\n")), in_ladder(text));
    }

    #[test]
    fn what_takes_one_line_does_not_fold() {
        assert_eq!(in_ladder("// one\nrung: a -> b"), [""; 0]);
    }

    #[test]
    fn steps_without_a_line_between_fold() {
        let text = "// of\n// a tank\nfor a.ladder\n\non s\nscan\n// then\non b\nscan\n";
        let scenario = Scenario::read(text.into());
        assert_eq!(
            lines(text, &folds_in_scenario(&scenario)),
            ["1..2 //", "5..6", "8..9"]
        );
    }

    #[test]
    fn stretches_that_are_mixed_do_not_both_fold() {
        let fold = |start, end| code(Span::new(start, end));
        let mixed = vec![fold(0, 9), fold(1, 5), fold(3, 7), fold(5, 9)];
        assert_eq!(nested(mixed), [fold(0, 9), fold(1, 5), fold(5, 9)]);
    }

    #[test]
    fn sections_parts_and_decisions_fold() {
        let text = "\
Step X0
Transitions:
t1: X0*a
  *b |- @X0
// about t2
// and more
t2: X0 |- @X0

//! accept v1 -> v2
//! accept v2 -> v3
Partial G1
Step Y0
";
        let spec = Spec::read(text.into());
        assert_eq!(
            lines(text, &folds_in_spec(&spec)),
            ["2..7", "5..6 //", "9..10", "11..12"]
        );
    }
}
