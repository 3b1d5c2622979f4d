//! What is shown of real programs, whatever they hold: every place lies in the
//! text, names lie in what they name, and lists are as the protocol wants them.

use std::fs;
use std::path::{Path, PathBuf};

use ide::hierarchy::{Direction, neighbours, stage_at};
use ide::navigate::{Pair, Side, declaration, definition, highlights, references, subject};
use ide::symbols::{Symbol, names_of_program, symbols_of_ladder};
use ide::tokens::tokens_in_ladder;
use ide::{Block, Ladder, folds_in_ladder, hover_in_ladder, link_in_ladder, selections_in_ladder};
use logic::Budget;
use source::Span;

/// Real files are many, and some are large: of each, this many places are
/// looked at.
const PLACES: usize = 60;

/// A file with more bytes takes seconds in a test that is not optimized.
const LARGEST: u64 = 400_000;

fn files() -> Vec<PathBuf> {
    let Some(corpus) = end_to_end::corpus() else {
        return Vec::new();
    };
    let folders = ["l5x", "plcopen", "ascii"].map(|name| corpus.join(name));
    let entries = folders.iter().filter_map(|it| fs::read_dir(it).ok());
    let paths = entries.flatten().flatten().map(|entry| entry.path());
    let small = |path: &PathBuf| {
        path.metadata()
            .is_ok_and(|it| it.is_file() && it.len() < LARGEST)
    };
    let mut files: Vec<PathBuf> = paths.filter(small).collect();
    files.sort();
    files
}

/// What a hover draws is no wider than editors show, and what it does not draw
/// it says.
#[test]
fn drawings_in_hovers_fit() {
    let (mut drawn, mut undrawn) = (0, 0);
    for path in files() {
        let Ok(text) = fs::read_to_string(&path) else {
            continue;
        };
        let ladder = Ladder::read(text.into(), &Budget::default());
        let mut shown = 0;
        for routine in &ladder.program().routines {
            let step = routine.rungs.len() / PLACES + 1;
            for rung in routine.rungs.iter().step_by(step) {
                let at = rung.span.range().start;
                let Some(hover) = hover_in_ladder(&ladder, None, at, &Budget::default()) else {
                    continue;
                };
                for block in &hover.blocks {
                    match block {
                        Block::Drawing(lines) => {
                            drawn += 1;
                            let widths = lines.lines().map(|line| line.chars().count());
                            let widest = widths.max().unwrap_or_default();
                            assert!(widest <= 76, "{}:\n{lines}", path.display());
                        }
                        Block::Text(text) if text.ends_with("to be drawn here.") => undrawn += 1,
                        _ => {}
                    }
                }
                shown += 1;
            }
            if shown > PLACES {
                break;
            }
        }
    }
    println!("{drawn} rungs were drawn, {undrawn} are too large");
}

#[test]
fn everything_that_is_shown_lies_where_it_is_said_to() {
    let mut shown = 0;
    for path in files() {
        let Ok(text) = fs::read_to_string(&path) else {
            continue;
        };
        let ladder = Ladder::read(text.into(), &Budget::default());
        if !ladder.is_known() {
            continue;
        }
        shown += 1;
        lists(&ladder, &path);
        places(&ladder, &path);
    }
    println!("{shown} programs were looked at");
}

#[track_caller]
fn lies_in(ladder: &Ladder, span: Span, path: &Path) {
    let inside = ladder.text.get(span.range()).is_some();
    assert!(
        inside,
        "{}: {span:?} is no part of the text",
        path.display()
    );
}

fn lists(ladder: &Ladder, path: &Path) {
    let names = names_of_program(ladder.program(), &ladder.text);
    for symbol in symbols_of_ladder(ladder).iter().chain(&names) {
        symbols(ladder, symbol, path);
    }
    let mut end = 0;
    for token in tokens_in_ladder(ladder) {
        lies_in(ladder, token.span, path);
        let apart = token.span.start >= end && !token.span.is_empty();
        assert!(apart, "{}: {token:?}", path.display());
        end = token.span.end;
    }
    for fold in folds_in_ladder(ladder) {
        lies_in(ladder, fold.span, path);
    }
    if let Some(link) = link_in_ladder(ladder) {
        lies_in(ladder, link, path);
    }
}

fn symbols(ladder: &Ladder, symbol: &Symbol, path: &Path) {
    lies_in(ladder, symbol.whole, path);
    let named = symbol.whole.cover(symbol.span) == symbol.whole;
    assert!(named, "{}: {symbol:?}", path.display());
    for child in &symbol.children {
        symbols(ladder, child, path);
    }
}

/// Everything that can be asked about some places, spread over the names.
fn places(ladder: &Ladder, path: &Path) {
    let budget = Budget::default();
    let pair = Pair {
        ladder: Some(ladder),
        spec: None,
    };
    let mentions = ladder.names().all();
    let step = mentions.len() / PLACES + 1;
    for mention in mentions.iter().step_by(step) {
        let at = mention.span.range().start;
        let jumps = [definition, declaration].map(|ask| ask(pair, Side::Ladder, at));
        for jump in jumps.into_iter().flatten() {
            assert!(jump.from.touches(at), "{}: {jump:?}", path.display());
            for target in jump.to {
                lies_in(ladder, target.whole, path);
                assert_eq!(target.whole.cover(target.name), target.whole);
            }
        }
        if let Some(subject) = subject(pair, Side::Ladder, at) {
            let found = references(pair, &subject);
            let here = found.iter().any(|it| it.span.touches(at));
            assert!(here, "{}: {subject:?} is not at {at}", path.display());
            let lit = highlights(pair, Side::Ladder, at);
            assert_eq!(lit.len(), found.len(), "{}", path.display());
        }
        if let Some(item) = stage_at(pair, Side::Ladder, at) {
            for direction in [Direction::Before, Direction::After] {
                for neighbour in neighbours(pair, &item.stage, direction, &budget) {
                    lies_in(ladder, neighbour.item.at.whole, path);
                }
            }
        }
        let chain = selections_in_ladder(ladder, at);
        assert!(chain.len() > 1, "{}: {at}", path.display());
        for pair in chain.windows(2) {
            assert_eq!(pair[0].cover(pair[1]), pair[1], "{}", path.display());
        }
    }
}
